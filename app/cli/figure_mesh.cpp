#include "app/cli/figure_mesh.h"

#include "app/cli/figure_page.h"

#include "core/base/check.h"
#include "core/geometry/mask.h"
#include "core/image/resample.h"
#include "core/warp/warp.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace oversketch::cli {
namespace {

/// Pixels of the picture that is made for each one that is shown, a side.
constexpr int kFine = 3;
constexpr std::uint32_t kDarkSquare = 0x5C8AD0, kLightSquare = 0xF7EBC6, kSquareLine = 0x2C4A7C;
/// Width of the lines between squares, source px.
constexpr double kLineWidth = 0.5;

Points corners_of(const QuadMesh& mesh, const Points& positions, int cell) {
  Points corners;
  for (const int vertex : mesh.cells[static_cast<std::size_t>(cell)])
    corners.push_back(positions[static_cast<std::size_t>(vertex)]);
  return corners;
}

/// A picture and the mesh's vertices in its pixels.
struct Texture {
  Image image;
  QuadMesh mesh;
  Points outline;
};

Points mirrored(Points points) {
  for (Point& p : points)
    p.y = -p.y;
  return points;
}

/// The same region with y the other way; corners run as they should again.
QuadMesh mirrored(QuadMesh mesh) {
  mesh.vertices = mirrored(std::move(mesh.vertices));
  for (auto& cell : mesh.cells)
    cell = {cell[3], cell[2], cell[1], cell[0]};
  return mesh;
}

Texture chessboard(const RegionPicture& region, double square, int texels) {
  Texture texture{Image(), *region.mesh, region.outline};
  const Box box = bounds(region.mesh->vertices);
  const Point middle = bounds(region.outline).centre();
  for (Point& p : texture.mesh.vertices)
    p = texels * (p - box.low);
  for (Point& p : texture.outline)
    p = texels * (p - box.low);
  texture.mesh.cell *= texels;
  Raster<Rgba> pixels(static_cast<int>(std::ceil(texels * box.size().x)) + 1,
                      static_cast<int>(std::ceil(texels * box.size().y)) + 1);
  const Rgba dark = color_of(kDarkSquare), light = color_of(kLightSquare), line = color_of(kSquareLine);
  const auto at_line = [&](double halves) { return std::abs(halves - std::round(halves)) * square < kLineWidth; };
  const auto softened = [&](const Rgba& c) {
    return Rgba{0.72f * c.r + 0.28f * line.r, 0.72f * c.g + 0.28f * line.g, 0.72f * c.b + 0.28f * line.b, 1};
  };
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      const Point at = Point{x + 0.5, y + 0.5} / texels + box.low - middle;
      const Point halves = (2 / square) * at;
      const bool odd = (static_cast<int>(std::floor(at.x / square)) + static_cast<int>(std::floor(at.y / square))) & 1;
      const Rgba& plain = odd ? dark : light;
      pixels.at(x, y) = at_line(halves.x) || at_line(halves.y) ? softened(plain) : plain;
    }
  texture.image = Image(std::move(pixels));
  return texture;
}

/// Draws the texture into a finer picture and gives that, made smaller, to the canvas.
Result<void> draw_textured(Canvas& canvas, const RegionPicture& region, const View& view, const Texture& texture,
                           bool flips, const Watch& watch) {
  const Box box = bounds(view(region.boundary));
  const int left = static_cast<int>(std::floor(box.low.x)) - 2, top = static_cast<int>(std::floor(box.low.y)) - 2;
  const int width = static_cast<int>(std::ceil(box.high.x)) + 2 - left;
  const int height = static_cast<int>(std::ceil(box.high.y)) + 2 - top;
  const View fine{kFine * view.scale,
                  kFine * (view.offset - Point{static_cast<double>(left), static_cast<double>(top)})};
  const Points positions = fine(region.positions);
  Canvas picture(kFine * width, kFine * height, {0, 0, 0, 0});
  const Mask mask = rasterize_polygon(fine(region.boundary), {0, 0, picture.width(), picture.height()});
  const Mask inside = rasterize_polygon(texture.outline, texture.image.rect());
  const auto warped = warp_region(texture.image, texture.mesh, positions, mask, watch, &inside);
  if (!warped) return warped.error();
  Raster<Rgba> cut(picture.width(), picture.height(), {0, 0, 0, 0});
  for (const Mask::Run& run : mask.runs())
    for (int x = run.x0; x < run.x1; ++x)
      cut.at(x, run.y) = warped->pixels.at(x - warped->rect.x, run.y - warped->rect.y);
  picture.draw(cut, 0, 0);
  if (flips)
    for (const int cell : find_flipped(texture.mesh, positions)) {
      const Points ring = corners_of(texture.mesh, positions, cell);
      picture.fill(ring, color_of(kFlipColor, 0.55));
      picture.stroke(ring, 0.6 * kFine, true, color_of(kFlipColor, 0.7));
    }
  canvas.draw(downscaled(Image(std::move(picture).take()), width, height).pixels(), left, top);
  return {};
}

} // namespace

Points View::operator()(const Points& points) const {
  Points shown;
  shown.reserve(points.size());
  for (const Point p : points)
    shown.push_back((*this)(p));
  return shown;
}

View centred(const Box& content, double scale, Point centre, bool upwards) {
  View view{scale, {0, 0}, upwards};
  view.offset = centre - view(content.centre());
  return view;
}

std::vector<int> find_flipped(const QuadMesh& mesh, const Points& positions) {
  std::vector<int> flipped;
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell) {
    const Points p = corners_of(mesh, positions, cell);
    for (std::size_t k = 0; k < 4; ++k)
      if (!(cross(p[(k + 1) % 4] - p[k], p[(k + 3) % 4] - p[k]) > 0)) {
        flipped.push_back(cell);
        break;
      }
  }
  return flipped;
}

Result<void> draw_checked(Canvas& canvas, const RegionPicture& region, const View& view, double square,
                          const Watch& watch) {
  if (view.upwards) {
    const QuadMesh mesh = mirrored(*region.mesh);
    const RegionPicture upright{&mesh, mirrored(region.positions), mirrored(region.boundary), mirrored(region.outline)};
    return draw_checked(canvas, upright, {view.scale, view.offset}, square, watch);
  }
  const int texels = std::max(2, static_cast<int>(std::ceil(kFine * view.scale)));
  return draw_textured(canvas, region, view, chessboard(region, square, texels), true, watch);
}

Result<void> draw_photographed(Canvas& canvas, const RegionPicture& region, const View& view, const Image& photograph,
                               const Watch& watch) {
  CHECK(!view.upwards, "a photograph has y downwards");
  return draw_textured(canvas, region, view, {photograph, *region.mesh, region.outline}, false, watch);
}

void draw_wires(Canvas& canvas, const QuadMesh& mesh, const Points& positions, const View& view, double width,
                Rgba color, bool flips) {
  const Points shown = view(positions);
  std::set<std::pair<int, int>> edges;
  for (const auto& cell : mesh.cells)
    for (std::size_t k = 0; k < 4; ++k)
      edges.insert(std::minmax(cell[k], cell[(k + 1) % 4]));
  std::vector<Points> segments;
  for (const auto& [a, b] : edges)
    segments.push_back({shown[static_cast<std::size_t>(a)], shown[static_cast<std::size_t>(b)]});
  if (flips)
    for (const int cell : find_flipped(mesh, positions))
      canvas.fill(corners_of(mesh, shown, cell), color_of(kFlipColor, 0.4));
  canvas.stroke_segments(segments, width, color);
}

} // namespace oversketch::cli
