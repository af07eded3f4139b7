#pragma once

#include <span>
#include <string>
#include <string_view>

namespace oversketch {

/// The candidate nearest to `word` by edit distance (insert, delete, replace, swap of neighbours), or "" when none is
/// within a third of the longer word's length.  The first of equals.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates);

/// `: did you mean "X"?`, or nothing when no candidate is near.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);

} // namespace oversketch
