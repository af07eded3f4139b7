// Works, keeps a journal and saves until it is killed; says on its standard output what is done: J after a step is in
// the journal, S before a save, D when it is done, each with the number of steps so far.

#include "core/io/journal.h"
#include "core/io/project.h"

#include "tests/fault/work.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

namespace {

void say(char what, std::size_t steps) {
  char line[32];
  const int length = std::snprintf(line, sizeof line, "%c %zu\n", what, steps);
  if (::write(STDOUT_FILENO, line, static_cast<std::size_t>(length)) != length) std::_Exit(3);
}

} // namespace

int main(int argc, char** argv) {
  using namespace oversketch;
  namespace fault = oversketch::testing;
  if (argc != 3) return 2;
  const std::filesystem::path folder(argv[1]);
  fault::Work work(static_cast<unsigned>(std::atoi(argv[2])));
  auto journal = Journal::begin(folder / "state", "work.ora");
  if (!journal) return 3;
  std::size_t written = 0;
  for (int i = 0; i < fault::kWorkSteps; ++i) {
    for (; written < work.session().log().size(); ++written) {
      if (!journal->append(work.session().log()[written])) return 3;
      say('J', written + 1);
    }
    if (i % fault::kStepsPerSave == 0) {
      say('S', written);
      if (!save_project(work.session(), folder / "work.ora")) return 3;
      say('D', written);
    }
    work.go_on();
  }
  return 0;
}
