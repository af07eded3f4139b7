#include "app/gui/zenity_dialog.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace oversketch::gui {
namespace {

namespace fs = std::filesystem;
using For = FileRequest::For;

fs::path find_program(const char* name) {
  const char* path = std::getenv("PATH");
  if (path == nullptr) return {};
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / name;
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

const char* title_of(For purpose) {
  switch (purpose) {
  case For::kOpen:
    return "Open";
  case For::kAddSource:
    return "Add source image";
  case For::kSetTarget:
    return "Change target";
  case For::kSaveAs:
    return "Save as";
  case For::kExport:
    return "Export picture";
  }
  return "";
}

} // namespace

std::vector<std::string> zenity_arguments(const FileRequest& request) {
  std::vector<std::string> arguments = {"zenity", "--file-selection",
                                        std::string("--title=") + title_of(request.purpose)};
  const bool saves = request.purpose == For::kSaveAs || request.purpose == For::kExport;
  if (saves) arguments.emplace_back("--save");
  std::error_code error;
  // A folder is told from a file by its slash.
  if (!request.proposal.empty())
    arguments.push_back("--filename=" + request.proposal.string() +
                        (fs::is_directory(request.proposal, error) ? "/" : ""));
  const std::string pictures = "*.png *.jpg *.jpeg *.bmp *.tga *.hdr *.PNG *.JPG *.JPEG";
  if (request.purpose == For::kSaveAs) {
    arguments.emplace_back("--file-filter=Projects | *.ora *.jsonl");
  } else if (request.purpose == For::kOpen) {
    arguments.push_back("--file-filter=Pictures and projects | *.ora *.jsonl " + pictures);
  } else {
    arguments.push_back("--file-filter=Pictures | " + pictures);
  }
  arguments.emplace_back("--file-filter=All files | *");
  return arguments;
}

ZenityDialog::ZenityDialog() {
  if (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr) program_ = find_program("zenity");
}

ZenityDialog::~ZenityDialog() {
  stop();
}

void ZenityDialog::start(const FileRequest& request) {
  stop();
  int ends[2] = {-1, -1};
  if (program_.empty() || pipe2(ends, O_CLOEXEC) != 0) return;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  auto arguments = zenity_arguments(request);
  std::vector<char*> pointers;
  for (std::string& argument : arguments)
    pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  // It shall end when told to, whatever signals this program holds.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  if (posix_spawn(&child_, program_.c_str(), &files, &attributes, pointers.data(), environ) != 0) child_ = -1;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  close(ends[1]);
  output_ = ends[0];
  fcntl(output_, F_SETFL, O_NONBLOCK);
  answer_.clear();
}

std::optional<fs::path> ZenityDialog::poll() {
  // It could not be started: as if nothing had been chosen.
  if (child_ < 0) return fs::path();
  char buffer[4096];
  for (ssize_t got = 0; (got = read(output_, buffer, sizeof buffer)) > 0;)
    answer_.append(buffer, static_cast<std::size_t>(got));
  int status = 0;
  const pid_t ended = waitpid(child_, &status, WNOHANG);
  if (ended == 0) return std::nullopt;
  for (ssize_t got = 0; (got = read(output_, buffer, sizeof buffer)) > 0;)
    answer_.append(buffer, static_cast<std::size_t>(got));
  child_ = -1;
  stop();
  const bool given = ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  const std::string_view line = std::string_view(answer_).substr(0, answer_.find('\n'));
  return given ? fs::path(line) : fs::path();
}

void ZenityDialog::stop() {
  if (output_ >= 0) close(output_);
  output_ = -1;
  if (child_ < 0) return;
  kill(child_, SIGTERM);
  waitpid(child_, nullptr, 0);
  child_ = -1;
}

} // namespace oversketch::gui
