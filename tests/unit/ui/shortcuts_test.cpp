#include "ui/state/shortcuts.h"

#include "ui/panels/dialogs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace oversketch {
namespace {

/// An editor's state with one document in front, and a snapshot of it that has something to do everywhere.
class Shortcuts : public ::testing::Test {
protected:
  Shortcuts() {
    Layer low, high;
    low.id = {1};
    high.id = {2};
    high.outline = {{1, 1}, {9, 1}, {5, 9}};
    snapshot.document.layers = {low, high};
    snapshot.document.selected = LayerId{2};
    snapshot.document.target.image = Image(Raster<Rgba>(20, 10));
    snapshot.history = {"Open sea.jpg", "Outline", "Move 40, 12", "Pin"};
    snapshot.cursor = 2;
  }
  InputEvent key(Key which, Modifiers modifiers = {}, InputEvent::Kind kind = InputEvent::Kind::kKeyDown) const {
    InputEvent event;
    event.kind = kind;
    event.key = which;
    event.modifiers = modifiers;
    return event;
  }
  std::vector<Action> read(const InputEvents& events, bool taken = false) {
    read_keys(events, taken, context);
    return sink.take();
  }

  EditorState state;
  Snapshot snapshot;
  WindowFlags flags;
  ActionSink sink;
  EntryContext context{state, &snapshot, flags, sink};
};

TEST_F(Shortcuts, ControlTabGoesRoundTheDocuments) {
  const auto goes = [&](std::size_t front, bool back) {
    state.front = front;
    const auto actions = read({key(Key::kTab, {.shift = back, .ctrl = true})});
    return actions.empty() ? -1 : static_cast<int>(std::get<action::SelectTab>(actions[0]).tab);
  };
  state.tabs.resize(1);
  EXPECT_EQ(goes(0, false), -1);
  EXPECT_EQ(goes(0, true), -1);
  state.tabs.resize(3);
  EXPECT_EQ(goes(0, false), 1);
  EXPECT_EQ(goes(2, false), 0);
  EXPECT_EQ(goes(2, true), 1);
  EXPECT_EQ(goes(0, true), 2);
}

TEST_F(Shortcuts, NoTwoEntriesShareKeysOrNames) {
  std::map<std::string, std::string_view> keys;
  std::set<std::string_view> ids;
  for (const Entry& entry : entries()) {
    EXPECT_TRUE(ids.insert(entry.id).second) << entry.id;
    for (const Chord& chord : {entry.chord, entry.other}) {
      if (chord.key == Key::kNone) continue;
      const auto [at, fresh] = keys.emplace(to_string(chord), entry.id);
      EXPECT_TRUE(fresh) << to_string(chord) << " is " << at->second << " and " << entry.id;
    }
  }
}

TEST_F(Shortcuts, EveryEntrySaysWhatItDoesAndDoesIt) {
  for (const Entry& entry : entries()) {
    EXPECT_FALSE(entry.label.empty()) << entry.id;
    EXPECT_GE(entry.help.size(), 8U) << entry.id;
    ASSERT_NE(entry.act, nullptr) << entry.id;
  }
}

TEST_F(Shortcuts, KeysThatPeopleBringAreThere) {
  const std::map<std::string, std::string> expected = {{"Ctrl+N", "file.new"},
                                                       {"Ctrl+O", "file.open"},
                                                       {"Ctrl+S", "file.save"},
                                                       {"Ctrl+Shift+S", "file.save_as"},
                                                       {"Ctrl+E", "file.export_again"},
                                                       {"Ctrl+Shift+E", "file.export"},
                                                       {"Ctrl+W", "file.close"},
                                                       {"Ctrl+Q", "file.quit"},
                                                       {"Ctrl+Z", "edit.undo"},
                                                       {"Ctrl+Y", "edit.redo"},
                                                       {"Ctrl+Shift+Z", "edit.redo"},
                                                       {"Ctrl+0", "view.fit"},
                                                       {"Ctrl+1", "view.actual"},
                                                       {"+", "view.zoom_in"},
                                                       {"-", "view.zoom_out"},
                                                       {"Tab", "view.overlays"},
                                                       {"Ctrl+H", "view.overlays"},
                                                       {"F1", "help.shortcuts"},
                                                       {"[", "edit.tolerance_less"},
                                                       {"]", "edit.tolerance_more"},
                                                       {"L", "tool.outline"},
                                                       {"S", "tool.sketch"},
                                                       {"P", "tool.pin"},
                                                       {"V", "tool.move"},
                                                       {"H", "tool.pan"}};
  for (const auto& [keys, id] : expected) {
    const bool found = std::ranges::any_of(entries(), [&keys = keys, &id = id](const Entry& entry) {
      return entry.id == id && (to_string(entry.chord) == keys || to_string(entry.other) == keys);
    });
    EXPECT_TRUE(found) << keys << " is not " << id;
  }
}

TEST_F(Shortcuts, KeysAreReadInOrder) {
  const auto actions = read({key(key_of('O'), {.ctrl = true}), key(key_of('Z'), {.ctrl = true}),
                             key(key_of('Z'), {.shift = true, .ctrl = true})});
  ASSERT_EQ(actions.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<action::Open>(actions[0]));
  EXPECT_TRUE(std::holds_alternative<action::Undo>(actions[1]));
  EXPECT_TRUE(std::holds_alternative<action::Redo>(actions[2]));
}

TEST_F(Shortcuts, NothingIsReadWhileSomebodyTypes) {
  EXPECT_TRUE(read({key(key_of('S'), {.ctrl = true}), key(Key::kTab)}, true).empty());
}

TEST_F(Shortcuts, CanvasKeysAreLeftToTheCanvases) {
  EXPECT_TRUE(read({key(key_of('L')), key(key_of('+')), key(key_of('0'), {.ctrl = true}), key(key_of('['))}).empty());
}

TEST_F(Shortcuts, PlainLettersAreNotTheirControlKeys) {
  EXPECT_EQ(find_entry(key_of('S'), {})->id, "tool.sketch");
  EXPECT_EQ(find_entry(key_of('S'), {.ctrl = true})->id, "file.save");
  EXPECT_EQ(find_entry(key_of('S'), {.ctrl = true, .alt = true}), nullptr);
  EXPECT_EQ(find_entry(key_of('='), {.shift = true})->id, "view.zoom_in") << "a + is a shifted = on many keyboards";
  EXPECT_EQ(find_entry(Key::kNone, {}), nullptr);
}

TEST_F(Shortcuts, UndoRepeatsWhileHeldAndSaveDoesNot) {
  const auto repeat = InputEvent::Kind::kKeyRepeat;
  EXPECT_EQ(read({key(key_of('Z'), {.ctrl = true}, repeat)}).size(), 1U);
  EXPECT_TRUE(read({key(key_of('S'), {.ctrl = true}, repeat)}).empty());
}

TEST_F(Shortcuts, UndoAndRedoNameTheStep) {
  EXPECT_EQ(label_of(entry_of("edit.undo"), context), "Undo Move 40, 12");
  EXPECT_EQ(label_of(entry_of("edit.redo"), context), "Redo Pin");
  snapshot.cursor = 0;
  EXPECT_EQ(label_of(entry_of("edit.undo"), context), "Undo");
  EXPECT_FALSE(is_enabled(entry_of("edit.undo"), context)) << "undo never crosses opening a file";
  snapshot.cursor = 3;
  EXPECT_FALSE(is_enabled(entry_of("edit.redo"), context));
}

TEST_F(Shortcuts, WhatCannotBeDoneIsNotDone) {
  context.snapshot = nullptr;
  for (const Entry& entry : entries()) {
    if (is_enabled(entry, context)) continue;
    EXPECT_TRUE(read({key(entry.chord.key, entry.chord.modifiers)}).empty()) << entry.id;
  }
  EXPECT_FALSE(is_enabled(entry_of("file.save"), context));
  EXPECT_FALSE(is_enabled(entry_of("layer.remove"), context));
  EXPECT_TRUE(is_enabled(entry_of("file.open"), context));
}

TEST_F(Shortcuts, LayersAreRaisedAndLoweredWithinTheStack) {
  EXPECT_FALSE(is_enabled(entry_of("layer.raise"), context)) << "it is the highest already";
  ASSERT_TRUE(is_enabled(entry_of("layer.lower"), context));
  entry_of("layer.lower").act(context);
  EXPECT_EQ(std::get<action::Execute>(sink.take().at(0)).command, Command(LayerOrder{{}, 0}));
  snapshot.document.selected = LayerId{1};
  entry_of("layer.raise").act(context);
  EXPECT_EQ(std::get<action::Execute>(sink.take().at(0)).command, Command(LayerOrder{{}, 1}));
}

TEST_F(Shortcuts, ToleranceStaysInRangeAndAlwaysMoves) {
  for (const char* id : {"edit.tolerance_less", "edit.tolerance_more"}) {
    state.preferences.tolerance_px = 10;
    for (int i = 0; i < 100; ++i) {
      const double before = state.preferences.tolerance_px;
      entry_of(id).act(context);
      state.preferences = std::get<action::SetPreferences>(sink.take().at(0)).preferences;
      EXPECT_GE(state.preferences.tolerance_px, 1);
      EXPECT_LE(state.preferences.tolerance_px, 100);
      if (before > 1 && before < 100) {
        EXPECT_NE(state.preferences.tolerance_px, before);
      }
    }
  }
}

TEST_F(Shortcuts, OverlaysHideWithoutForgetting) {
  state.overlays.handles = true;
  const auto hidden = read({key(Key::kTab)});
  const Overlays overlays = std::get<action::SetOverlays>(hidden.at(0)).overlays;
  EXPECT_FALSE(overlays.shown);
  EXPECT_TRUE(overlays.handles);
}

TEST_F(Shortcuts, EveryOverlayToolAndComparisonHasItsRow) {
  Overlays all;
  for (const OverlayRow& row : overlay_rows())
    all.*row.on = true;
  const Overlays every{.shown = true,
                       .curves = true,
                       .pins = true,
                       .correspondence = true,
                       .handles = true,
                       .control_mesh = true,
                       .display_mesh = true,
                       .gradients = true,
                       .flipped = true,
                       .heat_sigma = true,
                       .heat_area = true,
                       .bleed = true};
  EXPECT_EQ(all, every);
  EXPECT_EQ(tool_rows().size(), 5U);
  EXPECT_EQ(compare_rows().size(), 6U);
}

TEST_F(Shortcuts, EntriesReachTheirActions) {
  std::set<std::size_t> reached;
  for (const Entry& entry : entries()) {
    if (!is_enabled(entry, context) || entry.id == "view.next_tab" || entry.id == "view.previous_tab" ||
        entry.id == "layer.remove_pin")
      continue;
    entry.act(context);
    for (const Action& action : sink.take())
      reached.insert(action.index());
  }
  const auto reaches = [&](const Action& action) { return reached.contains(action.index()); };
  EXPECT_TRUE(reaches(action::NewDocument{}));
  EXPECT_TRUE(reaches(action::Open{}));
  EXPECT_TRUE(reaches(action::OpenSample{}));
  EXPECT_TRUE(reaches(action::AddSource{}));
  EXPECT_TRUE(reaches(action::SetTarget{}));
  EXPECT_TRUE(reaches(action::Save{}));
  EXPECT_TRUE(reaches(action::SaveAs{}));
  EXPECT_TRUE(reaches(action::Export{}));
  EXPECT_TRUE(reaches(action::ExportAgain{}));
  EXPECT_TRUE(reaches(action::Quit{}));
  EXPECT_TRUE(reaches(action::Undo{}));
  EXPECT_TRUE(reaches(action::Redo{}));
  EXPECT_TRUE(reaches(action::Execute{}));
  EXPECT_TRUE(reaches(action::PickTool{}));
  EXPECT_TRUE(reaches(action::SetOverlays{}));
  EXPECT_TRUE(reaches(action::SetPreferences{}));
  EXPECT_TRUE(reaches(action::Fit{}));
  EXPECT_TRUE(reaches(action::ZoomBy{}));
  EXPECT_TRUE(reaches(action::ZoomTo{}));
  EXPECT_TRUE(reaches(action::ShowWindow{}));
}

TEST(ShortcutSearch, FindsKeysNamesAndMeanings) {
  const auto all = find_shortcuts("");
  EXPECT_GT(all.size(), 30U);
  const auto has = [](const std::vector<ShortcutRow>& rows, std::string_view what) {
    return std::ranges::any_of(rows, [&](const ShortcutRow& row) { return row.what == what; });
  };
  EXPECT_TRUE(has(find_shortcuts("undo"), "Undo"));
  EXPECT_TRUE(has(find_shortcuts("CTRL+Z"), "Undo"));
  EXPECT_TRUE(has(find_shortcuts("png"), "Export…"));
  EXPECT_TRUE(has(find_shortcuts("save name"), "Save as…")) << "all words, anywhere";
  EXPECT_FALSE(has(find_shortcuts("save name"), "Save"));
  EXPECT_TRUE(find_shortcuts("nothing is called this").empty());
}

} // namespace
} // namespace oversketch
