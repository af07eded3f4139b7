#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch::frame {

/// A source of this project; `path` is relative to the project's folder, with slashes.
struct Source {
  std::string path;
  std::string text;
};

/// The rooms of core, each with the rooms it may include (itself not named).
using RoomTable = std::map<std::string, std::set<std::string>>;

/// All *.h and *.cpp below core, ui and app, in order of their paths.
std::vector<Source> read_sources(const std::filesystem::path& project);

std::string read_text(const std::filesystem::path& path);

/// The table as core/CMakeLists.txt has it: the ROOMS of each add_room().
RoomTable parse_cmake_rooms(std::string_view cmake);

/// The same text with comments and the insides of string and character literals turned into spaces; lines stay lines.
std::string blank_comments_and_literals(std::string_view text);

/// Each check gives its offences as "path:line: what is wrong"; none is an empty list.
using Offences = std::vector<std::string>;

/// Project includes are written from the root and keep to the table; core knows no ui or app, ui no app, and the two
/// programs not each other.
Offences check_includes(const Source& source, const RoomTable& rooms);

/// Each outside library is included by the rooms that wrap it alone.
Offences check_libraries(const Source& source);

/// Core and ui print nothing.
Offences check_printing(const Source& source);

/// No global, class-static or function-static variable that is not const, and nothing thread_local.
Offences check_state(const Source& source);

/// At most 400 lines; a header starts with #pragma once.
Offences check_shape(const Source& source);

} // namespace oversketch::frame
