#include "ui/state/recovered_work.h"

#include "ui/state/file_jobs.h"

#include <ctime>

namespace oversketch {
namespace {

std::tm local_time(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm local{};
  localtime_r(&seconds, &local);
  return local;
}

/// Midnights between them, by the calendar.
long days_between(std::tm earlier, std::tm later) {
  for (std::tm* day : {&earlier, &later}) {
    day->tm_hour = 12;
    day->tm_min = day->tm_sec = 0;
    day->tm_isdst = -1;
  }
  const double seconds = std::difftime(std::mktime(&later), std::mktime(&earlier));
  return static_cast<long>(seconds / 86400 + (seconds < 0 ? -0.5 : 0.5));
}

} // namespace

std::string describe_time(std::chrono::system_clock::time_point time, std::chrono::system_clock::time_point now) {
  static constexpr const char* kDays[] = {"Sunday", "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday"};
  static constexpr const char* kMonths[] = {"January", "February", "March",     "April",   "May",      "June",
                                            "July",    "August",   "September", "October", "November", "December"};
  const std::tm then = local_time(time);
  const long days = days_between(then, local_time(now));
  char clock[16];
  std::snprintf(clock, sizeof clock, " %02d:%02d", then.tm_hour, then.tm_min);
  if (days == 0) return std::string("today") + clock;
  if (days == 1) return std::string("yesterday") + clock;
  if (days > 1 && days < 7) return kDays[then.tm_wday] + std::string(clock);
  return std::to_string(then.tm_mday) + " " + kMonths[then.tm_mon] + " " + std::to_string(1900 + then.tm_year);
}

RecoveredWork describe_lost_work(const AbandonedJournal& journal, std::chrono::system_clock::time_point now) {
  RecoveredWork work;
  work.journal = journal.folder;
  const std::filesystem::path name(journal.name);
  work.name = name.is_absolute() ? name.stem().string() : journal.name;
  if (work.name.empty()) work.name = "Untitled";
  if (name.is_absolute() && kind_of_file(name) == FileKind::kProject) work.project = name;
  work.when = describe_time(journal.last_change, now);
  work.steps = static_cast<std::size_t>(journal.unsaved_steps);
  work.stamp = journal.stamp;
  return work;
}

} // namespace oversketch
