#include "tests/unit/frame/source_rules.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <regex>
#include <sstream>

namespace oversketch::frame {
namespace {

constexpr std::size_t kMostLines = 400;

/// The headers of a library, and the folders whose sources may include them.
struct Library {
  std::string_view header;
  std::vector<std::string_view> folders;
};

std::vector<Library> list_libraries() {
  return {{"Eigen/", {"core/deform/", "core/clone/"}},
          {"unsupported/Eigen/", {}},
          {"nlohmann/", {"core/document/", "core/session/", "core/io/", "ui/state/", "app/"}},
          {"jpeglib.h", {"core/image/"}},
          {"spng.h", {"core/image/"}},
          {"zlib.h", {"core/image/"}},
          {"libexif/", {"core/image/"}},
          {"stb_image", {"core/image/"}},
          {"stb_truetype", {"app/cli/figure_font"}},
          {"xxhash.h", {"core/base/"}},
          {"zip.h", {"core/io/"}},
          {"pugixml", {"core/io/"}},
          {"CLI/", {"app/"}},
          {"imgui", {"ui/", "app/gui/"}},
          {"GLFW/", {"app/gui/"}},
          {"GL/", {"ui/render/"}},
          {"GLES", {"ui/render/"}},
          {"KHR/", {"ui/render/"}},
          {"EGL/", {"ui/render/"}},
          {"glad/", {"ui/render/"}},
          {"epoxy/", {"ui/render/"}},
          {"X11/", {}},
          {"wayland", {}}};
}

/// Calls `visit` with each line and its number, from 1.
void for_each_line(const std::string& text, const std::function<void(const std::string&, std::size_t)>& visit) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number)
    visit(line, number);
}

std::string place(const Source& source, std::size_t line, const std::string& sentence) {
  return source.path + ":" + std::to_string(line) + ": " + sentence;
}

bool is_header(const Source& source) {
  return source.path.ends_with(".h");
}

/// What an #include line names, with its opening quote or bracket in front; nothing for any other line.
std::optional<std::string> included_by(const std::string& line) {
  const auto hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return std::nullopt;
  static const std::regex pattern(R"re(^\s*#\s*include\s*(["<][^">]+)[">])re");
  std::smatch match;
  if (!std::regex_search(line, match, pattern)) return std::nullopt;
  return match[1].str();
}

/// "core/mesh", "ui/canvas", "app/cli": the first two parts of a path; the first alone where the second is the file.
std::string room_of(std::string_view path) {
  const auto first = path.find('/');
  const auto second = first == std::string_view::npos ? first : path.find('/', first + 1);
  return std::string(path.substr(0, second == std::string_view::npos ? first : second));
}

std::string allow_include(const std::string& from, const std::string& to, const RoomTable& rooms) {
  if (from == to) return "";
  const bool to_core = to.starts_with("core/"), to_ui = to == "ui" || to.starts_with("ui/");
  if (from.starts_with("core/")) {
    const auto row = rooms.find(from.substr(5));
    if (row == rooms.end()) return from + " is not a room of core/CMakeLists.txt";
    const bool allowed = to_core && row->second.contains(to.substr(5));
    return allowed ? "" : from + " may not include " + to;
  }
  const bool shared_by_programs = to == "app" && from.starts_with("app/");
  if (to_core || shared_by_programs) return "";
  if (to_ui && (from == "ui" || from.starts_with("ui/") || from == "app/gui")) return "";
  return from + " may not include " + to;
}

/// The length of the comment or literal that starts at `at`, 0 where none does.
std::size_t measure_comment_or_literal(std::string_view text, std::size_t at) {
  const auto until = [&](std::string_view end, std::size_t from) {
    const auto found = text.find(end, from);
    return (found == std::string_view::npos ? text.size() : found + end.size()) - at;
  };
  const std::string_view rest = text.substr(at);
  if (rest.starts_with("//")) return std::min(text.find('\n', at), text.size()) - at;
  if (rest.starts_with("/*")) return until("*/", at + 2);
  if (rest.starts_with("R\"")) {
    const auto open = std::min(text.find('(', at), text.size());
    return until(")" + std::string(text.substr(at + 2, open - at - 2)) + "\"", open);
  }
  const bool digit_separator = at > 0 && std::isalnum(static_cast<unsigned char>(text[at - 1]));
  if (text[at] != '"' && (text[at] != '\'' || digit_separator)) return 0;
  auto end = at + 1;
  while (end < text.size() && text[end] != text[at] && text[end] != '\n')
    end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size()) - at;
}

/// Why the declaration on this line is mutable state of static lifetime, or "".  The line stands without comments.
std::string find_static_state(const std::string& line) {
  static const std::regex word(R"(\bstatic\s)");
  static const std::regex per_thread(R"(\bthread_local\b)");
  static const std::regex immutable(R"(\b(const|constexpr)\b)");
  static const std::regex global(R"(^[A-Za-z_:][\w:<>,*& ]*[ >*&]\w+\s*(\[[^\]]*\]\s*)*[=;{])");
  static const std::regex no_variable(R"(\b(const|constexpr|using|struct|class|enum|union|namespace|template|typedef)"
                                      R"(|return|concept|friend|requires|operator|extern|else|do|public|private)\b)");
  std::smatch match;
  if (std::regex_search(line, per_thread)) return "thread_local state";
  if (std::regex_search(line, match, word)) {
    const std::string rest = match.suffix().str();
    const auto end = rest.find_first_of("=;{(");
    const bool function = end != std::string::npos && rest[end] == '(';
    const bool fixed = std::regex_search(match.prefix().str() + rest.substr(0, end), immutable);
    return function || fixed ? "" : "a static variable that is not const";
  }
  const bool looks_global = std::regex_search(line, match, global) && !std::regex_search(match.str(), no_variable);
  return looks_global ? "a global variable that is not const" : "";
}

} // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Source> read_sources(const std::filesystem::path& project) {
  std::vector<Source> sources;
  for (const char* folder : {"core", "ui", "app"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(project / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      sources.push_back({entry.path().lexically_relative(project).generic_string(), read_text(entry.path())});
    }
  }
  std::ranges::sort(sources, {}, &Source::path);
  return sources;
}

RoomTable parse_cmake_rooms(std::string_view cmake) {
  RoomTable rooms;
  const std::string text(cmake);
  const std::regex call(R"(^\s*add_room\(([^)]*)\))", std::regex::multiline);
  for (auto match = std::sregex_iterator(text.begin(), text.end(), call); match != std::sregex_iterator(); ++match) {
    std::istringstream words((*match)[1].str());
    std::string name, word;
    words >> name;
    auto& row = rooms[name];
    for (bool in_rooms = false; words >> word;) {
      if (word == "ROOMS" || word.ends_with("LIBRARIES"))
        in_rooms = word == "ROOMS";
      else if (in_rooms)
        row.insert(word);
    }
  }
  return rooms;
}

std::string blank_comments_and_literals(std::string_view text) {
  std::string blanked(text);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = measure_comment_or_literal(text, at);
    for (std::size_t i = at; i < at + length; ++i)
      if (blanked[i] != '\n') blanked[i] = ' ';
    at += std::max<std::size_t>(length, 1);
  }
  return blanked;
}

Offences check_includes(const Source& source, const RoomTable& rooms) {
  Offences offences;
  for_each_line(source.text, [&](const std::string& line, std::size_t number) {
    const auto included = included_by(line);
    if (!included || included->front() != '"') return;
    const std::string path = included->substr(1);
    const bool from_root = path.starts_with("core/") || path.starts_with("ui/") || path.starts_with("app/");
    const std::string wrong = from_root ? allow_include(room_of(source.path), room_of(path), rooms)
                                        : "\"" + path + "\" is not written from the project's root";
    if (!wrong.empty()) offences.push_back(place(source, number, wrong));
  });
  return offences;
}

Offences check_libraries(const Source& source) {
  const auto libraries = list_libraries();
  Offences offences;
  for_each_line(source.text, [&](const std::string& line, std::size_t number) {
    const auto included = included_by(line);
    if (!included) return;
    const std::string header = included->substr(1);
    for (const Library& library : libraries) {
      if (!header.starts_with(library.header)) continue;
      const auto owns = [&](std::string_view folder) { return source.path.starts_with(folder); };
      if (std::ranges::none_of(library.folders, owns))
        offences.push_back(place(source, number, "<" + header + "> is not for this room"));
    }
  });
  return offences;
}

Offences check_printing(const Source& source) {
  if (source.path.starts_with("app/")) return {};
  const std::regex printing(R"(\b(v?f?printf|f?puts|f?putchar|f?putc|perror)\s*\(|\bstd::(cout|cerr|clog)\b)"
                            R"(|<(iostream|print|syncstream)>)");
  Offences offences;
  for_each_line(blank_comments_and_literals(source.text), [&](const std::string& line, std::size_t number) {
    std::smatch match;
    if (std::regex_search(line, match, printing)) offences.push_back(place(source, number, "prints: " + match.str()));
  });
  return offences;
}

Offences check_state(const Source& source) {
  Offences offences;
  for_each_line(blank_comments_and_literals(source.text), [&](const std::string& line, std::size_t number) {
    const std::string wrong = find_static_state(line);
    if (!wrong.empty()) offences.push_back(place(source, number, wrong));
  });
  return offences;
}

Offences check_shape(const Source& source) {
  Offences offences;
  const auto lines = static_cast<std::size_t>(std::ranges::count(source.text, '\n'));
  if (lines > kMostLines)
    offences.push_back(place(source, lines, "more than " + std::to_string(kMostLines) + " lines"));
  if (is_header(source) && !source.text.starts_with("#pragma once\n"))
    offences.push_back(place(source, 1, "a header starts with #pragma once"));
  return offences;
}

} // namespace oversketch::frame
