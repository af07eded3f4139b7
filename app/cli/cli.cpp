#include "app/cli/cli.h"

#include "app/version.h"

#include "core/base/file.h"
#include "core/base/suggest.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <new>

namespace oversketch::cli {
namespace {

constexpr int kRefused = 1, kUsage = 2;
constexpr int kMostThreads = 1024;

/// Control characters, as a file's name may have them, are shown and not sent to the terminal.
std::string printable(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      shown += c;
      continue;
    }
    constexpr char digits[] = "0123456789abcdef";
    shown += {'\\', 'x', digits[(c >> 4) & 15], digits[c & 15]};
  }
  return shown;
}

void print_error(const Error& error) {
  std::fprintf(stderr, "oversketch-cli: %s\n", printable(to_string(error)).c_str());
}

/// Runs the work; what a library throws becomes an Error here and nowhere else.
Result<Json> guarded(const std::function<Result<Json>(const Watch&)>& work, const Watch& watch) {
  try {
    return work(watch);
  } catch (const std::bad_alloc&) {
    return Error{"memory", "there is not enough memory for this", ""};
  } catch (const BugError& bug) {
    return Error{"internal", std::string("a mistake in the program, please report it: ") + bug.what(), ""};
  } catch (const std::exception& problem) {
    return Error{"internal", problem.what(), ""};
  }
}

/// One line on a terminal that is drawn over; nothing elsewhere.
std::function<void(double, std::string_view)> terminal_progress() {
  if (isatty(STDERR_FILENO) == 0) return {};
  return [last = std::chrono::steady_clock::time_point()](double done, std::string_view stage) mutable {
    const auto now = std::chrono::steady_clock::now();
    if (now - last < std::chrono::milliseconds(100)) return;
    last = now;
    std::fprintf(stderr, "\r\033[K%3.0f %%  %.*s", 100 * done, static_cast<int>(stage.size()), stage.data());
  };
}

void clear_progress() {
  if (isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

} // namespace

Cli::Cli()
    : app_("Oversketch without a window: deforms parts of pictures to sketches and blends them in.", "oversketch-cli") {
  app_.require_subcommand(1);
  app_.set_version_flag("--version", std::string("Oversketch ") + kVersion);
  app_.set_help_flag("-h,--help", "Print this help and exit");
  app_.footer("Exit codes: 0 done, 1 the input was refused (the reason is on stderr), 2 wrong usage.\n"
              "oversketch-cli SUBCOMMAND --help has an example of each.");
  add_run(*this);
  add_render(*this);
  add_info(*this);
  add_deform(*this);
  add_evaluate(*this);
  add_clone(*this);
  add_warp(*this);
  add_bench(*this);
  add_figures(*this);
  add_commands(*this);
}

CLI::App* Cli::add(const std::string& name, const std::string& description, const std::string& example) {
  CLI::App* sub = app_.add_subcommand(name, description);
  names_.push_back(name);
  sub->footer("Example:\n  oversketch-cli " + example);
  sub->add_option("--report", report_path_, "write what was done and the times as JSON")->type_name("FILE");
  sub->add_option("--threads", threads_, "use at most N threads (0: as many as there are cores)")
      ->type_name("N")
      ->check(CLI::Range(0, kMostThreads));
  return sub;
}

void Cli::add_memory_option(CLI::App* subcommand) {
  subcommand
      ->add_option("--memory", memory_mb_,
                   "MB that the pictures it opens may take, 16 bytes a pixel and their files, and each layer of a "
                   "document, 56 bytes a pixel; what asks for more is refused")
      ->type_name("MB")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 30))
      ->capture_default_str();
}

IoLimits Cli::limits() const {
  IoLimits limits;
  limits.memory_bytes = memory_mb_ << 20;
  return limits;
}

void Cli::on_run(CLI::App* subcommand, std::function<Result<Json>(const Watch&)> work) {
  subcommand->callback([this, name = subcommand->get_name(), work = std::move(work)] { chosen_ = name, work_ = work; });
}

int Cli::run(int argc, char** argv) {
  // A file larger than the system allows is then an error of writing like others.
  std::signal(SIGXFSZ, SIG_IGN);
  if (argc > 1 && argv[1][0] != '-' && std::find(names_.begin(), names_.end(), argv[1]) == names_.end()) {
    const std::vector<std::string_view> candidates(names_.begin(), names_.end());
    std::fprintf(stderr, "oversketch-cli: there is no subcommand \"%s\"%s (--help lists them)\n",
                 printable(argv[1]).c_str(), did_you_mean(argv[1], candidates).c_str());
    return kUsage;
  }
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    return app_.exit(problem) == 0 ? 0 : kUsage;
  }
  return perform(chosen_, work_);
}

int Cli::perform(const std::string& name, const std::function<Result<Json>(const Watch&)>& work) {
  StageTimes times;
  Watch watch;
  watch.times = &times;
  watch.progress = terminal_progress();
  watch.threads = threads_;
  const auto start = std::chrono::steady_clock::now();
  const auto done = guarded(work, watch);
  clear_progress();
  if (!done) return print_error(done.error()), kRefused;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    return print_error({"file.write", "the output could not be written", "standard output"}), kRefused;
  if (report_path_.empty()) return 0;

  Json report;
  report["version"] = kVersion;
  report["command"] = name;
  report["threads"] = watch.threads_up_to(kMostThreads);
  report["wall_ms"] = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  report["stages_ms"] = Json::object();
  for (const auto& [stage, ms] : times.stages_ms)
    report["stages_ms"][stage] = ms;
  for (const auto& [key, value] : done->items())
    report[key] = value;
  const auto written = write_file(report_path_, report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  if (!written) return print_error(written.error()), kRefused;
  return 0;
}

} // namespace oversketch::cli
