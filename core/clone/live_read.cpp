#include "core/clone/live_read.h"

#include "core/clone/pixel_planes.h"
#include "core/clone/placed_pair.h"

#include <algorithm>
#include <span>
#include <tuple>

namespace oversketch {
namespace {

using Data = LiveRegion::Data;

std::vector<Data::RingPlace> list_places(const PixelGraph& graph) {
  std::vector<Data::RingPlace> places;
  places.reserve(graph.ring.size());
  for (std::size_t i = 0; i < graph.ring.size(); ++i)
    places.push_back({graph.ring[i].y, graph.ring[i].x, static_cast<int>(i)});
  const auto key = [](const Data::RingPlace& p) { return std::tuple(p.y, p.x); };
  std::sort(places.begin(), places.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  places.erase(
      std::unique(places.begin(), places.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
      places.end());
  return places;
}

Rgba color_of(const LivePixel& p) {
  const auto value = [](std::int16_t v) { return static_cast<float>(v - 32) / LivePixel::kOpaque; };
  return {value(p.r), value(p.g), value(p.b), value(p.a)};
}

class LiveReader {
public:
  LiveReader(const Raster<Rgba8>& below, const Data& region, int dx, int dy, const BlendOptions& options)
      : below_(below),
        region_(region),
        dx_(dx),
        dy_(dy),
        domain_(options.domain),
        places_(region.ring_places
                    .get([&] { return Result<std::vector<Data::RingPlace>>(list_places(region.system.graph())); })
                    .value()) {}

  void operator()(const Mask::Run& stretch, float* out, std::size_t stride) const {
    const int y = clamp_to(stretch.y, dy_, below_.height());
    if (region_.is_opaque && domain_ == Domain::kEncoded && read_target(stretch, y, out + 3 * stride, stride))
      return for_source(
          stretch,
          [&](const LivePixel* from, int x, int count) {
            to_planes(from, static_cast<std::size_t>(count), out + (x - stretch.x0), stride);
          },
          [&](const Rgba& p, int x) {
            write({{p.r, p.g, p.b, 0}}, out + (x - stretch.x0), stride);
          });
    const auto both = [&](const Rgba& source, int x) {
      const Rgba target = from_display(below_.at(clamp_to(x, dx_, below_.width()), y));
      const PlacedPair::Values pair = PlacedPair::pair_of(source, target, domain_, false);
      write(pair.source, out + (x - stretch.x0), stride);
      write(pair.target, out + 3 * stride + (x - stretch.x0), stride);
    };
    for_source(
        stretch,
        [&](const LivePixel* from, int x, int count) {
          for (int i = 0; i < count; ++i)
            both(color_of(from[i]), x + i);
        },
        both);
  }

private:
  static int clamp_to(int x, int shift, int size) {
    return static_cast<int>(std::clamp<std::int64_t>(static_cast<std::int64_t>(x) + shift, 0, size - 1));
  }

  static void write(const Channels& c, float* out, std::size_t stride) {
    for (std::size_t k = 0; k < 3; ++k)
      out[k * stride] = static_cast<float>(c.v[k]);
  }

  /// @returns whether all are opaque; else what was written is not meant.
  bool read_target(const Mask::Run& stretch, int y, float* out, std::size_t stride) const {
    bool is_opaque = true;
    // Pixels follow each other but where the picture ends.
    for (int x = stretch.x0; x < stretch.x1;) {
      const int from = clamp_to(x, dx_, below_.width()), last = clamp_to(stretch.x1 - 1, dx_, below_.width());
      const bool moves = x + 1 < stretch.x1 && clamp_to(x + 1, dx_, below_.width()) == from + 1;
      const int count = moves ? last - from + 1 : 1;
      is_opaque &= to_planes(&below_.at(from, y), static_cast<std::size_t>(count), out + (x - stretch.x0), stride);
      x += count;
    }
    return is_opaque;
  }

  /// Calls `inside(pixels, x, count)` for the mask's pixels of a stretch and `ring(pixel, x)` for those of its ring.
  template <class Inside, class Ring>
  void for_source(const Mask::Run& stretch, Inside inside, Ring ring) const {
    const PixelGraph& graph = region_.system.graph();
    const std::vector<Mask::Run>& runs = graph.mask.runs();
    auto run = std::lower_bound(runs.begin(), runs.end(), stretch, [](const Mask::Run& a, const Mask::Run& b) {
      return std::tuple(a.y, a.x1) < std::tuple(b.y, b.x0 + 1);
    });
    for (; run != runs.end() && run->y == stretch.y && run->x0 < stretch.x1; ++run)
      inside(region_.pixels.data() + graph.first[static_cast<std::size_t>(run - runs.begin())], run->x0,
             run->x1 - run->x0);
    auto place =
        std::lower_bound(places_->begin(), places_->end(), stretch, [](const Data::RingPlace& a, const Mask::Run& b) {
          return std::tuple(a.y, a.x) < std::tuple(b.y, b.x0);
        });
    for (; place != places_->end() && place->y == stretch.y && place->x < stretch.x1; ++place)
      ring(region_.ring[static_cast<std::size_t>(place->edge)], place->x);
  }

  const Raster<Rgba8>& below_;
  const Data& region_;
  int dx_;
  int dy_;
  Domain domain_;
  std::shared_ptr<const std::vector<Data::RingPlace>> places_;
};

} // namespace

ReadPixels read_live(const Raster<Rgba8>& below, const Data& region, int dx, int dy, const BlendOptions& options) {
  return LiveReader(below, region, dx, dy, options);
}

} // namespace oversketch
