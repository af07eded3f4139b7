#pragma once

// oversketch/document.json of a project file: a SavedSession without its pixels.

#include "core/base/hash.h"
#include "core/base/result.h"
#include "core/io/limits.h"
#include "core/session/saved_session.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace oversketch {

/// Version that is written.  1: the first.
inline constexpr int kProjectVersion = 1;

/// A picture of the project and the archive's part that holds it.
struct StoredPicture {
  Image image;
  std::string part;
};

/// Every picture of the session by its content; parts are not yet named.
std::map<Hash, StoredPicture> pictures_of(const SavedSession& saved);

/// @param pictures  all of the session's, parts named.
/// @cost about 100 ns a coordinate that is not the same as the step's before.
std::string print_project(const SavedSession& saved, const std::map<Hash, StoredPicture>& pictures);

/// Which version the text is of: it begins with {"version":N, so that this is known without reading the rest.
/// @errors project.damaged.
Result<int> peek_project_version(std::string_view start);
inline constexpr std::size_t kVersionBytes = 32;

/// The text read as far as it can be without pictures.
class ProjectText {
public:
  struct Picture {
    Hash hash;
    std::string part;
    int width = 0;
    int height = 0;
  };

  /// @errors project.damaged, project.too-large, project.newer (a version above kProjectVersion); `where` is the place
  ///   within the text.
  static Result<ProjectText> parse(std::string_view text, const IoLimits& limits);
  ~ProjectText();
  ProjectText(ProjectText&&) noexcept;
  ProjectText& operator=(ProjectText&&) noexcept;

  const std::vector<Picture>& pictures() const;
  /// Everything is tested: numbers against their ranges, curves, ids, references.
  /// @param images  one for each of pictures().
  /// @errors project.damaged, project.too-large, those of check_closed_curve.
  Result<SavedSession> session(const std::vector<Image>& images) const;

private:
  struct Data;
  explicit ProjectText(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

} // namespace oversketch
