#pragma once

#include "core/clone/clone.h"
#include "tests/unit/clone/clone_support.h"

#include <gtest/gtest.h>

namespace oversketch {

inline WarpedRegion region_for(const Mask& mask, unsigned seed) {
  return noise_region(grown(mask.bounds(), 1), seed);
}

inline BlendOptions with_mode(BlendMode mode, Domain domain = Domain::kEncoded) {
  BlendOptions options;
  options.mode = mode;
  options.domain = domain;
  return options;
}

/// The target after cloning; the report too if asked for.
inline Raster<Rgba> cloned(Raster<Rgba> target, const WarpedRegion& source, const Mask& mask, int dx, int dy,
                           const BlendOptions& options, CloneReport* report = nullptr) {
  const Result<CloneSystem> system = CloneSystem::make(mask);
  EXPECT_TRUE(system.ok());
  const Result<CloneReport> done = clone_into(target, source, dx, dy, *system, options);
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : to_string(done.error()));
  if (done.ok() && report != nullptr) *report = *done;
  return target;
}

} // namespace oversketch
