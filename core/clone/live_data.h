#pragma once

#include "core/base/bulk_allocator.h"
#include "core/clone/domain_tables.h"
#include "core/clone/lazy.h"
#include "core/clone/live.h"
#include "core/clone/live_rows.h"

#include <array>
#include <vector>

namespace oversketch {

struct LiveRegion::Data {
  CloneSystem system;
  /// By pixel number.
  std::vector<LivePixel, BulkAllocator<LivePixel>> pixels;
  /// The source at the outer pixel of each of the graph's ring edges.
  std::vector<Rgba> ring;
  /// Where the ring's pixels are, row by row, each once.
  struct RingPlace {
    int y = 0;
    int x = 0;
    /// Of `ring`.
    int edge = 0;
  };
  mutable Lazy<std::vector<RingPlace>> ring_places;
  /// Whether all pixels are.
  bool is_opaque = true;
  /// Of the domains but kEncoded, made when they are first used.
  mutable std::array<Lazy<DomainTables>, 2> tables;

  explicit Data(const CloneSystem& of) : system(of) {}

  /// Null in the encoded domain.
  std::shared_ptr<const DomainTables> tables_of(Domain domain) const {
    if (domain == Domain::kEncoded) return nullptr;
    return tables[domain == Domain::kLog].get([&] { return Result<DomainTables>(DomainTables(domain)); }).value();
  }
};

} // namespace oversketch
