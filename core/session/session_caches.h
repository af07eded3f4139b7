#pragma once

#include "core/session/content_cache.h"
#include "core/session/session.h"

#include <string>

namespace oversketch {

struct Session::Caches {
  // Systems are small beside their use; shapes hold up to 60 bytes a pixel of the region, composites 16.
  ContentCache<DeformSystem> systems{16};
  ContentCache<DeformSystem> systems_by_solver{16};
  // About 100 kB each.
  ContentCache<Deformation> solutions{256};
  ContentCache<Deformation> deformations{64};
  // By the picture's content; at most a third of it more, made where a region is shrunk.
  ContentCache<ImagePyramid> sources{4};
  ContentCache<LayerShape> shapes{6};
  ContentCache<Image> composites{3};
  // What each layer painted, on top of those below it.
  ContentCache<WarpedRegion> painted{16};
};

/// Where an error of a layer is.
inline std::string place_of(const Layer& layer) {
  return "layer " + to_string(layer.id);
}

} // namespace oversketch
