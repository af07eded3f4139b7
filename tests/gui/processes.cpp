#include "tests/gui/processes.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace oversketch::testing {
namespace {

[[noreturn]] void become(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
                         const std::filesystem::path& output) {
  // A test that is killed takes its programs along.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (const auto& [name, value] : environment)
    setenv(name.c_str(), value.c_str(), 1);
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& argument : command)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

/// Waits until the file descriptor has something to read.
bool wait_readable(int descriptor) {
  pollfd wanted = {descriptor, POLLIN, 0};
  return poll(&wanted, 1, kPatience_s * 1000) == 1;
}

} // namespace

Process::Process(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
                 const std::filesystem::path& output) {
  id_ = fork();
  if (id_ == 0) become(command, environment, output);
}

Process::~Process() {
  if (!running()) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

void Process::send(int signal) const {
  kill(id_, signal);
}

bool Process::running() {
  if (id_ < 0 || status_) return false;
  int status = 0;
  if (waitpid(id_, &status, WNOHANG) == id_) status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return !status_;
}

std::optional<int> Process::wait() {
  if (!running()) return status_;
  // Readable when the process has ended.
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, id_, 0));
  if (descriptor >= 0) {
    wait_readable(descriptor);
    close(descriptor);
  }
  running();
  return status_;
}

double Process::cpu_s() const {
  std::ifstream file("/proc/" + std::to_string(id_) + "/stat");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  // The second field is the name in brackets; utime and stime are the 14th and 15th.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i)
    fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

VirtualScreen::VirtualScreen(int width, int height, const std::filesystem::path& output) {
  int ends[2] = {};
  if (pipe(ends) != 0) return;
  const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
  // The server finds a free number itself and writes it when it can be talked to.
  server_.emplace(std::vector<std::string>{"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", size,
                                           "-nolisten", "tcp", "-noreset", "-dpi", "96"},
                  std::map<std::string, std::string>{}, output);
  close(ends[1]);
  std::string number;
  for (char c = 0; wait_readable(ends[0]) && read(ends[0], &c, 1) == 1 && c != '\n';)
    number += c;
  close(ends[0]);
  if (!number.empty()) name_ = ":" + number;
}

} // namespace oversketch::testing
