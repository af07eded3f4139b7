#pragma once

#include "core/io/journal.h"
#include "ui/state/editor_state.h"

#include <chrono>

namespace oversketch {

/// A journal as a person knows it: the document's name, and when it was last changed, by the clock on the wall.
RecoveredWork describe_lost_work(const AbandonedJournal& journal, std::chrono::system_clock::time_point now);

/// "today 14:03", "yesterday 09:12", "Tuesday 09:12" within a week, else "3 March 2026".
std::string describe_time(std::chrono::system_clock::time_point time, std::chrono::system_clock::time_point now);

} // namespace oversketch
