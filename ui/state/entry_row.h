#pragma once

#include "ui/state/shortcuts.h"

namespace oversketch {

/// How the tables of entries are written: one line an entry, what is not said is the default.
struct EntryRow : Entry {
  constexpr EntryRow keys(Chord first, Chord second = {}) const {
    EntryRow row = *this;
    row.chord = first;
    row.other = second;
    return row;
  }
  constexpr EntryRow when(bool (*is)(const EntryContext&)) const {
    EntryRow row = *this;
    row.enabled = is;
    return row;
  }
  constexpr EntryRow mark(bool (*is)(const EntryContext&)) const {
    EntryRow row = *this;
    row.checked = is;
    return row;
  }
  constexpr EntryRow named(std::string (*label_of)(const EntryContext&)) const {
    EntryRow row = *this;
    row.full_label = label_of;
    return row;
  }
  constexpr EntryRow below_line() const {
    EntryRow row = *this;
    row.begins_group = true;
    return row;
  }
  constexpr EntryRow on_canvas() const {
    EntryRow row = *this;
    row.canvas_key = true;
    return row;
  }
};

constexpr EntryRow make_row(Menu menu, std::string_view id, std::string_view label, void (*act)(const EntryContext&),
                            std::string_view help) {
  EntryRow row;
  row.id = id;
  row.menu = menu;
  row.label = label;
  row.help = help;
  row.act = act;
  return row;
}

constexpr Chord plain(Key key) {
  return {key, {}};
}
constexpr Chord plain(char key) {
  return {key_of(key), {}};
}
constexpr Chord ctrl(char key) {
  return {key_of(key), {.ctrl = true}};
}
constexpr Chord ctrl_shift(char key) {
  return {key_of(key), {.shift = true, .ctrl = true}};
}

template <class A>
void emit(const EntryContext& context) {
  context.sink.emit(A{});
}

inline bool has_tab(const EntryContext& context) {
  return context.snapshot != nullptr;
}
inline bool has_target(const EntryContext& context) {
  return has_tab(context) && !context.snapshot->document.empty();
}

/// The parts of the table, in the order of the menus.
std::span<const EntryRow> file_entries();
std::span<const EntryRow> layer_entries();
std::span<const EntryRow> view_entries();

} // namespace oversketch
