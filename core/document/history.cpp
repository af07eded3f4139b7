#include "core/document/history.h"

#include "core/document/command_table.h"

#include <algorithm>
#include <unordered_set>

namespace oversketch {
namespace {

/// To what share of its budget a history is cut that is beyond it, so that not every step has to look through all.
constexpr double kTrimmed = 0.75;

/// Each entry holds a document of its own, curves and all.
std::size_t own_bytes(const Document& document) {
  std::size_t bytes = sizeof(History::Entry) + document.target.name.size();
  for (const Layer& layer : document.layers)
    bytes += sizeof(Layer) + layer.name.size() + layer.source.name.size() +
             (layer.outline.size() + layer.sketch.size()) * sizeof(Point) + layer.pins.size() * sizeof(Pin);
  return bytes;
}

/// Its own, and those of the images of `after` that `before` does not share.  Commands leave the order of layers nearly
/// as it was, so the layer at the same index is asked first.
std::size_t count_new_bytes(const Document& before, const Document& after) {
  const auto same = [](const Image& a, const Image& b) { return &a.pixels() == &b.pixels(); };
  std::size_t bytes =
      own_bytes(after) + (same(before.target.image, after.target.image) ? 0 : after.target.image.bytes());
  for (std::size_t i = 0; i < after.layers.size(); ++i) {
    const Image& image = after.layers[i].source.image;
    if (i < before.layers.size() && same(before.layers[i].source.image, image)) continue;
    const bool known = std::any_of(before.layers.begin(), before.layers.end(),
                                   [&](const Layer& layer) { return same(layer.source.image, image); });
    if (!known && !same(after.target.image, image)) bytes += image.bytes();
  }
  return bytes;
}

} // namespace

const Document& History::present() const {
  static const Document none;
  return entries_.empty() ? none : entries_[cursor_].document;
}

Result<void> History::execute(const Command& command) {
  auto after = oversketch::apply(present(), command);
  if (!after) return after.error();
  std::string label = label_of(command, present(), *after);
  push(std::move(*after), command, std::move(label));
  return {};
}

void History::push(Document after, const Command& command, std::string label) {
  if (std::holds_alternative<DocumentNew>(command)) {
    entries_.clear();
    bytes_ = 0;
    saved_ = 0;
  } else {
    while (entries_.size() > cursor_ + 1) {
      bytes_ -= entries_.back().new_bytes;
      entries_.pop_back();
    }
    if (saved_ && *saved_ >= entries_.size()) saved_.reset();
  }
  const std::size_t new_bytes = count_new_bytes(present(), after);
  bytes_ += new_bytes;
  entries_.push_back({next_id_++, std::move(after), command, std::move(label), new_bytes});
  cursor_ = entries_.size() - 1;
  trim();
}

/// How many of the youngest entries stay within the limits.
std::size_t History::count_kept() const {
  // Bytes held by each entry and not by the present document; an image in several entries counts once, at the youngest.
  std::unordered_set<const void*> counted;
  for_each_image(present(), [&](const Image& image) { counted.insert(&image.pixels()); });
  std::size_t kept = 0, bytes = 0;
  for (std::size_t i = entries_.size(); i-- > 0;) {
    bytes += own_bytes(entries_[i].document);
    for_each_image(entries_[i].document, [&](const Image& image) {
      if (counted.insert(&image.pixels()).second) bytes += image.bytes();
    });
    const bool within_least = kept < limits_.least_steps + 1;
    if (!within_least &&
        (static_cast<double>(bytes) > kTrimmed * static_cast<double>(limits_.bytes) || kept > limits_.most_steps))
      break;
    ++kept;
  }
  return kept;
}

void History::trim() {
  // Looking through all entries is only worth it when they could be too much.
  if (bytes_ <= limits_.bytes && entries_.size() <= limits_.most_steps + 1) return;
  const std::size_t dropped = entries_.size() - count_kept();
  if (dropped == 0) return;
  for (std::size_t i = 0; i < dropped; ++i)
    bytes_ -= entries_[i].new_bytes;
  // The oldest entry holds all its images alone now.
  bytes_ -= entries_[dropped].new_bytes;
  entries_[dropped].new_bytes = count_new_bytes(Document{}, entries_[dropped].document);
  bytes_ += entries_[dropped].new_bytes;
  entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(dropped));
  cursor_ -= dropped;
  if (saved_ && *saved_ < dropped)
    saved_.reset();
  else if (saved_)
    *saved_ -= dropped;
}

Result<void> History::undo(std::size_t steps) {
  if (steps > cursor_)
    return Error{"history.nothing-to-undo", "there are only " + std::to_string(cursor_) + " steps to undo", ""};
  cursor_ -= steps;
  return {};
}

Result<void> History::redo(std::size_t steps) {
  const std::size_t ahead = entries_.empty() ? 0 : entries_.size() - 1 - cursor_;
  if (steps > ahead)
    return Error{"history.nothing-to-redo", "there are only " + std::to_string(ahead) + " steps to redo", ""};
  cursor_ += steps;
  return {};
}

Result<void> History::jump(std::size_t index) {
  if (index >= entries_.size())
    return Error{"history.index", "the history has " + std::to_string(entries_.size()) + " entries", ""};
  cursor_ = index;
  return {};
}

void History::restore(std::vector<Entry> entries, std::size_t cursor) {
  CHECK(cursor < entries.size() || (cursor == 0 && entries.empty()), "the present entry is one of the entries");
  bytes_ = 0;
  const Document none;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].id = next_id_++;
    entries[i].new_bytes = count_new_bytes(i == 0 ? none : entries[i - 1].document, entries[i].document);
    bytes_ += entries[i].new_bytes;
  }
  entries_ = std::move(entries);
  cursor_ = cursor;
  saved_ = cursor;
}

void History::mark_saved() {
  if (!entries_.empty()) saved_ = cursor_;
}

bool History::modified() const {
  return !entries_.empty() && saved_ != cursor_;
}

Result<void> Gesture::preview(const Command& command) {
  auto after = oversketch::apply(base_, command);
  if (!after) return after.error();
  pending_ = std::move(*after);
  command_ = command;
  return {};
}

void Gesture::commit() {
  if (!pending_) return;
  std::string label = label_of(*command_, base_, *pending_);
  history_->push(std::move(*pending_), *command_, std::move(label));
  cancel();
}

void Gesture::cancel() {
  pending_.reset();
  command_.reset();
}

} // namespace oversketch
