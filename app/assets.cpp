#include "app/assets.h"

namespace oversketch {

namespace fs = std::filesystem;

Result<fs::path> find_assets() {
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure);
  if (failure) return Error{"assets.missing", "the program cannot be found: " + failure.message(), "/proc/self/exe"};
  return find_assets_of(program);
}

Result<fs::path> find_assets_of(const fs::path& program) {
  for (fs::path folder = program.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    std::error_code failure;
    if (fs::is_directory(folder / "assets", failure)) return folder / "assets";
    if (folder == folder.parent_path()) break;
  }
  return Error{"assets.missing", "there is no folder \"assets\" beside the program nor above it", program.string()};
}

} // namespace oversketch
