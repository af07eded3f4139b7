#pragma once

#include "core/base/rect.h"
#include "core/base/result.h"
#include "core/base/watch.h"
#include "core/image/image.h"
#include "core/io/limits.h"
#include "core/session/session.h"

#include <filesystem>
#include <string>
#include <vector>

namespace oversketch {

/// Everything a project file says, as values: gathered where the session is, written from any thread.
///
/// A viewer that lays `layers` over `background` with src-over, at 8 bits, gets `merged` to the bit: a layer's picture
/// has the composite's own pixels with alpha 255 where it paints an opaque pixel, and is transparent elsewhere.  Pixels
/// of the composite that stay translucent stand in the background, since no two programs round a mixture alike.
struct ProjectContents {
  struct LayerPicture {
    std::string name;
    Rect rect;
    Image pixels;
  };

  SavedSession saved;
  Image merged;
  Image background;
  /// Visible layers, lowest first; 1 × 1 and transparent where one paints nothing.
  std::vector<LayerPicture> layers;
};

/// Of the present document: a preview is dropped.
/// @errors document.none, those of Session::composite.
Result<ProjectContents> gather_project(Session& session, const KeptHistory& kept = {}, const Watch& watch = {});

struct SaveOptions {
  /// 0: as many as the watch allows; 4 at most.
  int threads = 0;
  KeptHistory history{};
  /// What load_project() will hold the file against.
  IoLimits limits{};
};

/// Writes an OpenRaster file that holds the project (contract: "Project file"): whole or not at all, the file that was
/// there kept as NAME~.  Equal contents give equal bytes.  Where all of the history would be more than load_project()
/// takes, the oldest steps are left out.
///
/// @errors project.newer (the file there was saved by a newer program), project.too-large (what load_project() would
///   refuse), those of encode_png and write_file, cancelled; the old file is as it was then.
/// @cost 12 megapixels with two layers, a grainy picture: 1.4 to 1.8 s of processor time, most of it packing pictures
///   on all threads; 38 MB.
/// @threads pure but for the file.
Result<void> write_project(const ProjectContents& contents, const std::filesystem::path& path,
                           const SaveOptions& options = {}, const Watch& watch = {});

/// Both; the session is not marked as saved.
Result<void> save_project(Session& session, const std::filesystem::path& path, const SaveOptions& options = {},
                          const Watch& watch = {});

struct LoadOptions {
  IoLimits limits{};
  int threads = 0;
};

struct LoadedProject {
  Session session;
  /// The file was saved by a newer program, and is shown as a picture without its layers: do not save over it.
  bool read_only = false;
  /// Whether the file is another program's: its picture is the target, its layers are offered by OraFile.
  bool foreign = false;
  /// For the person, where something is to be said.
  std::string message;
};

/// Opens an OpenRaster file.
///
/// A project of this program goes on where it was saved: document, history, cursor; unmodified.  Nothing is solved yet;
/// load_project_picture() is what can be shown at once.
/// @errors those of OraFile, project.damaged (with the part), session.inconsistent; `where` begins with the path.
Result<LoadedProject> load_project(const std::filesystem::path& path, const LoadOptions& options = {},
                                   const Watch& watch = {});

/// The merged picture alone.
Result<Image> load_project_picture(const std::filesystem::path& path, const LoadOptions& options = {});

/// Version of the project in the file; 0 where it is a foreign one.
/// @errors as load_project.
Result<int> read_project_version(const std::filesystem::path& path, const LoadOptions& options = {});

/// Longest side of Thumbnails/thumbnail.png.
inline constexpr int kThumbnailSide = 256;

} // namespace oversketch
