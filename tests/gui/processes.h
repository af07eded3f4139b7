#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oversketch::testing {

/// No test waits longer than this for anything, seconds.
inline constexpr int kPatience_s = 60;

/// A program that was started; ended with the object, if not before.
class Process {
public:
  /// @param environment  in addition to the test's own.
  /// @param output  where stdout and stderr go.
  Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
          const std::filesystem::path& output);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running();
  void send(int signal) const;
  /// The exit code, once it has ended by itself; none when it did not in time.
  std::optional<int> wait();
  /// Processor time used so far, seconds.
  double cpu_s() const;

private:
  pid_t id_ = -1;
  std::optional<int> status_;
};

/// A screen that nobody sees, on a display number of its own.
class VirtualScreen {
public:
  VirtualScreen(int width, int height, const std::filesystem::path& output);
  /// ":7"; empty when it did not start.
  const std::string& name() const { return name_; }

private:
  std::optional<Process> server_;
  std::string name_;
};

} // namespace oversketch::testing
