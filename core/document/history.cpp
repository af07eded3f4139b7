#include "core/document/history.h"

#include "core/document/command_table.h"

#include <unordered_map>
#include <unordered_set>

namespace oversketch {
namespace {

void for_each_image(const Document& document, const auto& visit) {
  visit(document.target.image);
  for (const Layer& layer : document.layers)
    visit(layer.source.image);
}

std::size_t bytes_of(const Image& image) {
  return image.pixels().values().size_bytes();
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
    saved_ = 0;
  } else {
    entries_.resize(std::min(entries_.size(), cursor_ + 1));
    if (saved_ && *saved_ >= entries_.size()) saved_.reset();
  }
  entries_.push_back({next_id_++, std::move(after), command, std::move(label)});
  cursor_ = entries_.size() - 1;
  trim();
}

void History::trim() {
  // Image bytes held by each entry and not by the present document; an image in several entries counts once, at the
  // youngest.
  std::unordered_set<const void*> counted;
  for_each_image(present(), [&](const Image& image) { counted.insert(&image.pixels()); });
  std::size_t kept = 0, bytes = 0;
  for (std::size_t i = entries_.size(); i-- > 0;) {
    for_each_image(entries_[i].document, [&](const Image& image) {
      if (counted.insert(&image.pixels()).second) bytes += bytes_of(image);
    });
    const bool within_least = kept < limits_.least_steps + 1;
    if (!within_least && (bytes > limits_.image_bytes || kept > limits_.most_steps)) break;
    ++kept;
  }
  const std::size_t dropped = entries_.size() - kept;
  if (dropped == 0) return;
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
