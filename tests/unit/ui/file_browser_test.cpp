#include "ui/panels/file_browser.h"

#include "core/image/image_io.h"
#include "core/io/project.h"
#include "tests/support/temp_folder.h"
#include "tests/unit/ui/headless.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

namespace oversketch {
namespace {

namespace fs = std::filesystem;
using For = FileRequest::For;
using testing::Headless;

class Browser : public Headless {
protected:
  Browser() : Headless(ImVec2(1000, 700)) {
    fs::create_directories(root() / "pictures");
    fs::create_directories(root() / "more");
    EXPECT_TRUE(save_image(Image(Raster<Rgba>(40, 20, {1, 0, 0, 1})), root() / "fish.png").ok());
    std::ofstream(root() / "project.jsonl") << "{}";
    std::ofstream(root() / "text.txt") << "hello";
  }
  fs::path root() const { return folder_.path(); }

  void ask(For purpose, const fs::path& proposal) {
    request = {purpose, proposal};
    settle();
  }
  /// Until what was asked of the disk has come.
  void settle() {
    for (int i = 0; i < 5000; ++i) {
      browser.update(request, recent);
      if (!browser.reading()) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "the folder was never read";
  }
  void open_window() {
    show(
        [this](const DrawContext& context) {
          browser.update(request, recent);
          draw_file_browser(browser, pictures, events, context);
        },
        true);
  }
  int row(std::string_view name) const {
    for (std::size_t i = 0; i < browser.rows().size(); ++i)
      if (browser.rows()[i].name == name) return static_cast<int>(i);
    return -1;
  }
  std::string listed() const {
    std::string all;
    for (const FileRow& entry : browser.rows())
      all += entry.name + " ";
    return all;
  }
  void keys(std::initializer_list<Key> pressed, bool typing = false, double now = 0) {
    InputEvents all;
    for (const Key key : pressed)
      all.push_back(key_event(key));
    browser.read_keys(all, typing, now, sink_);
  }

  testing::TempFolder folder_;
  FileRequest request;
  std::vector<fs::path> recent;
  FileBrowser browser{{}, {}};
};

TEST_F(Browser, ListsTheFolderOfItsPurpose) {
  ask(For::kOpen, root());
  EXPECT_EQ(listed(), "more pictures fish.png project.jsonl text.txt ");
  ask(For::kAddSource, root());
  EXPECT_EQ(listed(), "more pictures fish.png ");
  ask(For::kSaveAs, root() / "sea.jsonl");
  EXPECT_EQ(listed(), "more pictures project.jsonl ");
  EXPECT_EQ(browser.name, "sea.jsonl");
}

TEST_F(Browser, AnswersWithTheActionOfItsPurpose) {
  for (const For purpose : {For::kOpen, For::kAddSource, For::kSetTarget}) {
    ask(purpose, root());
    browser.choose(row("fish.png"));
    browser.accept(sink_);
    const auto actions = take();
    ASSERT_EQ(actions.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<action::Dismiss>(actions[0]));
    const fs::path path = root() / "fish.png";
    if (purpose == For::kOpen) {
      EXPECT_EQ(std::get<action::Open>(actions[1]).path, path);
    } else if (purpose == For::kAddSource) {
      EXPECT_EQ(std::get<action::AddSource>(actions[1]).path, path);
    } else {
      EXPECT_EQ(std::get<action::SetTarget>(actions[1]).path, path);
    }
  }
}

TEST_F(Browser, EntersFoldersAndComesBackToThem) {
  ask(For::kOpen, root());
  browser.choose(row("pictures"));
  browser.accept(sink_);
  settle();
  EXPECT_TRUE(take().empty());
  EXPECT_EQ(browser.folder(), root() / "pictures");
  browser.go_up();
  settle();
  EXPECT_EQ(browser.folder(), root());
  ASSERT_NE(browser.chosen_row(), nullptr);
  EXPECT_EQ(browser.chosen_row()->name, "pictures");
}

TEST_F(Browser, IsDrivenByKeys) {
  ask(For::kOpen, root());
  keys({Key::kHome, Key::kDown});
  EXPECT_EQ(browser.chosen_row()->name, "pictures");
  keys({Key::kEnd});
  EXPECT_EQ(browser.chosen_row()->name, "text.txt");
  keys({key_of('P'), key_of('R')});
  EXPECT_EQ(browser.chosen_row()->name, "project.jsonl");
  keys({key_of('P')}, false, 10);
  EXPECT_EQ(browser.chosen_row()->name, "pictures") << "after a pause a letter begins anew";
  keys({Key::kEnter});
  settle();
  EXPECT_EQ(browser.folder(), root() / "pictures");
  keys({Key::kBackspace});
  settle();
  EXPECT_EQ(browser.folder(), root());
  keys({Key::kDown, Key::kEnter}, true);
  EXPECT_TRUE(take().empty()) << "a text field has the keyboard";
  keys({Key::kEscape}, true);
  take_one<action::Dismiss>();
}

TEST_F(Browser, TypedPathsAreGoneToOrRefused) {
  ask(For::kOpen, root());
  browser.path_text = (root() / "pictures").string();
  browser.accept_path(sink_);
  settle();
  EXPECT_EQ(browser.folder(), root() / "pictures");
  browser.path_text = "../fish.png";
  browser.accept_path(sink_);
  EXPECT_EQ(take_all<action::Open>().at(0).path, root() / "fish.png");
  browser.path_text = "nowhere.png";
  browser.accept_path(sink_);
  EXPECT_TRUE(take().empty());
  EXPECT_NE(browser.message.find("nowhere.png"), std::string::npos);
}

TEST_F(Browser, TheButtonTakesTheTypedPathBeforeWhatIsChosen) {
  ask(For::kOpen, root());
  settle();
  ASSERT_NE(browser.chosen_row(), nullptr);
  browser.path_text = (root() / "fish.png").string();
  EXPECT_TRUE(browser.can_confirm());
  browser.confirm(sink_);
  EXPECT_EQ(take_all<action::Open>().at(0).path, root() / "fish.png");
  browser.path_text = (root() / "pictures").string();
  browser.click(0);
  const std::string row = browser.chosen_row()->path;
  browser.confirm(sink_);
  settle();
  if (fs::is_directory(row))
    EXPECT_EQ(browser.folder(), row) << "a click takes the place of what was typed";
  else
    EXPECT_EQ(take_all<action::Open>().at(0).path, row);
}

TEST_F(Browser, ReplacingIsAsked) {
  ask(For::kSaveAs, root() / "project.jsonl");
  browser.accept_name(sink_);
  EXPECT_TRUE(take().empty());
  ASSERT_TRUE(browser.replaces().has_value());
  browser.keep_file();
  browser.accept_name(sink_);
  browser.replace(sink_);
  const auto saved = take_all<action::SaveAs>();
  ASSERT_EQ(saved.size(), 1U);
  EXPECT_EQ(saved[0].path, root() / "project.jsonl");
  EXPECT_TRUE(saved[0].replace);
}

TEST_F(Browser, NewNamesNeedNoQuestionAndGetTheirEnding) {
  ask(For::kExport, root() / "out.png");
  browser.name = "result";
  browser.set_format(ExportFormat::kPng16);
  EXPECT_EQ(browser.name, "result.png");
  browser.accept_name(sink_);
  const auto exported = take_all<action::Export>();
  ASSERT_EQ(exported.size(), 1U);
  EXPECT_EQ(exported[0].path, root() / "result.png");
  EXPECT_EQ(exported[0].depth, 16);
  EXPECT_FALSE(exported[0].replace);
  EXPECT_EQ(with_saved_ending("a", For::kExport, ExportFormat::kJpeg), "a.jpg");
  EXPECT_EQ(with_saved_ending("a.png", For::kExport, ExportFormat::kJpeg), "a.png");
  EXPECT_EQ(format_of("a.JPG"), ExportFormat::kJpeg);
  EXPECT_EQ(format_of("a"), ExportFormat::kPng);
}

TEST_F(Browser, SavingIntoAFolderThatIsNotThereIsRefused) {
  ask(For::kSaveAs, root() / "sea.jsonl");
  browser.name = "nowhere/sea.jsonl";
  browser.accept_name(sink_);
  EXPECT_TRUE(take().empty());
  EXPECT_FALSE(browser.message.empty());
  browser.name.clear();
  browser.accept_name(sink_);
  EXPECT_TRUE(take().empty());
}

TEST_F(Browser, UnreadableFoldersAreAMessage) {
  ask(For::kOpen, root());
  browser.go_to(root() / "gone");
  settle();
  EXPECT_FALSE(browser.message.empty());
  EXPECT_TRUE(browser.rows().empty());
  browser.go_up();
  settle();
  EXPECT_TRUE(browser.message.empty());
  EXPECT_FALSE(browser.rows().empty());
}

TEST_F(Browser, MakesFolders) {
  ask(For::kSaveAs, root() / "sea.jsonl");
  browser.new_folder = "fresh";
  browser.make_folder();
  settle();
  EXPECT_EQ(browser.folder(), root() / "fresh");
  browser.go_up();
  settle();
  browser.new_folder = "fresh";
  browser.make_folder();
  EXPECT_FALSE(browser.message.empty());
}

TEST_F(Browser, ListsRecentFilesInTheirOrder) {
  recent = {root() / "text.txt", root() / "gone.png", root() / "fish.png"};
  ask(For::kOpen, root());
  browser.go_to_recent();
  settle();
  EXPECT_EQ(listed(), "text.txt fish.png ");
}

TEST_F(Browser, PicturesArePreviewedAndBadOnesSayWhy) {
  const FilePreview fish = read_preview(root() / "fish.png");
  ASSERT_NE(fish.picture, nullptr);
  EXPECT_EQ(fish.text, "40 × 20 px");
  EXPECT_EQ(fish.picture->at(0, 0), (Rgba8{255, 0, 0, 255}));
  std::ofstream(root() / "bad.png") << "no picture";
  const FilePreview bad = read_preview(root() / "bad.png");
  EXPECT_EQ(bad.picture, nullptr);
  EXPECT_FALSE(bad.text.empty());
  EXPECT_EQ(read_preview(root() / "text.txt").picture, nullptr);
  Session session;
  DocumentNew what;
  what.width = 30;
  what.height = 20;
  ASSERT_TRUE(session.execute(what).ok());
  ASSERT_TRUE(save_project(session, root() / "work.ora").ok());
  const FilePreview project = read_preview(root() / "work.ora");
  ASSERT_NE(project.picture, nullptr);
  EXPECT_EQ(project.picture->width(), 30);
  EXPECT_EQ(project.text, "30 × 20 px");
}

TEST_F(Browser, ItsWindowIsClicked) {
  ask(For::kExport, root() / "fish.png");
  open_window();
  settle();
  frame();
  for (const char* id : {"browser.path", "browser.up", "browser.new_folder", "browser.place.home", "browser.sort.name",
                         "browser.sort.size", "browser.sort.date", "browser.name", "browser.format.jpeg",
                         "browser.filter.all", "browser.hidden", "browser.accept", "browser.cancel"})
    EXPECT_TRUE(has(id)) << id;
  for (const auto& [name, box] : widgets_.boxes())
    if (name != "dialog.browser" && name != "browser.list") {
      EXPECT_TRUE(widgets_.tips().contains(name)) << name;
    }
  click("browser.accept");
  frame();
  ASSERT_TRUE(has("browser.replace"));
  click("browser.replace");
  EXPECT_TRUE(take_all<action::Export>().at(0).replace);
}

TEST_F(Browser, RowsAreChosenAndDoubleClicked) {
  ask(For::kOpen, root());
  open_window();
  frame();
  const std::string id = "browser.row." + std::to_string(row("fish.png"));
  click(id);
  EXPECT_EQ(browser.chosen_row()->name, "fish.png");
  EXPECT_TRUE(take().empty());
  double_click(id);
  EXPECT_EQ(take_all<action::Open>().at(0).path, root() / "fish.png");
}

TEST_F(Browser, SmallWindowsKeepListAndAnswersInReach) {
  ImGui::GetIO().DisplaySize = ImVec2(320, 240);
  ask(For::kOpen, root());
  open_window();
  frame();
  EXPECT_TRUE(has("browser.path"));
  EXPECT_TRUE(has("browser.list"));
}

TEST_F(Browser, APathIsTypedWithoutGoingToItsField) {
  ask(For::kOpen, root() / "more");
  open_window();
  frame();
  const std::string path = (root() / "pictures").string();
  type(path.substr(0, 1).c_str());
  for (int i = 0; i < 3; ++i)
    frame();
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  type(path.substr(1).c_str());
  EXPECT_EQ(browser.path_text, path);
  press(ImGuiKey_Enter);
  settle();
  EXPECT_EQ(browser.folder(), root() / "pictures");
}

TEST_F(Browser, APathIsPastedIntoItsField) {
  ask(For::kOpen, root() / "more");
  open_window();
  frame();
  ImGui::SetClipboardText(" ~/sea.png\nmore");
  events = {key_event(key_of('V'), {.ctrl = true})};
  frame();
  frame();
  EXPECT_EQ(browser.path_text, "~/sea.png");
  EXPECT_FALSE(browser.begin_path("sea.png")) << "letters go to a name";
}

} // namespace
} // namespace oversketch
