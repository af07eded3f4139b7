#pragma once

#include "ui/state/editor.h"

#include "core/image/image_io.h"
#include "tests/support/documents.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace oversketch::testing {

namespace fs = std::filesystem;

inline const fs::path kAssets = OVERSKETCH_SOURCE_DIR "/assets";

/// An editor without a window: a frame goes by whenever the test says so.
class EditorTest : public ::testing::Test {
protected:
  EditorTest() : editor_({kAssets, {}, {}, [this](const Preferences& p) { kept_ = p; }}) {}

  void frame() { editor_.update(canvases_, now_s_ += 0.01); }
  void settle() {
    do {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (editor_.busy());
    frame();
  }
  void does(Action action) {
    editor_.perform_all({std::move(action)});
    settle();
  }
  /// The answer of that id, as the dialog gives it.
  void answer(const std::string& id) {
    ASSERT_TRUE(state().question);
    for (const Question::Answer& offered : state().question->answers) {
      if (offered.id != id) continue;
      std::vector<Action> actions = offered.actions;
      actions.push_back(action::Dismiss{});
      editor_.perform_all(std::move(actions));
      return settle();
    }
    FAIL() << "no answer " << id;
  }
  const EditorState& state() const { return editor_.state(); }
  std::shared_ptr<const Snapshot> snapshot() const { return state().tab()->session->snapshot(); }
  std::string code_of_problem() {
    const auto problems = editor_.take_problems();
    return problems.empty() ? "none" : problems.front().code;
  }

  fs::path picture(const std::string& name, int width = 60, int height = 40) {
    const auto saved = save_image(wavy_image(width, height, 0.3), folder_ / name);
    EXPECT_TRUE(saved.ok());
    return folder_ / name;
  }
  /// A document with unsaved changes.
  void begin_work() {
    does(action::Open{picture("sea.png")});
    does(action::AddSource{picture("fish.png", 50, 45)});
    ASSERT_TRUE(snapshot()->modified);
  }

  TempFolder folder_;
  std::optional<Preferences> kept_;
  CanvasRects canvases_;
  double now_s_ = 0;
  Editor editor_;
};

} // namespace oversketch::testing
