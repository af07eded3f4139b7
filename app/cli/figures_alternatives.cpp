#include "app/cli/figures.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace oversketch::cli {
namespace {

constexpr int kAlternativesColumns = 4, kAlternativesColumnWidth = 400, kAlternativesGap = 36;
constexpr double kAlternativesMostHeight = 290, kAlternativesMostWidth = kAlternativesColumnWidth - 40;
constexpr int kAlternativesRowHead = 96, kAlternativesRowFoot = 36;
/// A runner-up is a close call up to this cost: the best one's times and plus so much.
constexpr double kCloseFactor = 1.25, kCloseCost = 0.02;

double alternatives_middle(int column) {
  return kMargin + column * (kAlternativesColumnWidth + kAlternativesGap) + 0.5 * kAlternativesColumnWidth;
}

struct AlternativesRow {
  FigureCase shown;
  std::vector<DeformedCase> solved;
  double scale = 1;
  int height = 0;
};

Result<AlternativesRow> make_alternatives_row(const FigureInput& input, const std::string& name) {
  auto shown = read_figure_case(input, name);
  if (!shown) return shown.error();
  DeformOptions options;
  options.cell_px = kFigureCell;
  auto solved = solve_case_alternatives(shown->given, options, kAlternativesColumns - 1, *input.watch);
  if (!solved) return at(name, solved.error());
  const double best = solved->front().metrics.match_cost.value_or(0);
  std::erase_if(*solved, [&](const DeformedCase& one) {
    return one.metrics.match_cost.value_or(0) > kCloseFactor * best + kCloseCost;
  });
  const Point source = bounds(shown->outline.points()).size(), target = bounds(shown->sketch.points()).size();
  const Point size{std::max(source.x, target.x), std::max(source.y, target.y)};
  const double scale = std::min(kAlternativesMostWidth / size.x, kAlternativesMostHeight / size.y);
  const int height = kAlternativesRowHead + static_cast<int>(std::lround(scale * size.y)) + kAlternativesRowFoot;
  return AlternativesRow{std::move(*shown), std::move(*solved), scale, height};
}

/// Degrees, clockwise on the screen, of the similarity that takes `from` nearest to `to`; −180…180.
double turn_between(const Points& from, const Points& to) {
  std::complex<double> from_mean = 0, to_mean = 0, sum = 0;
  const auto count = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += to_complex(from[i]) / count;
    to_mean += to_complex(to[i]) / count;
  }
  for (std::size_t i = 0; i < from.size(); ++i)
    sum += std::conj(to_complex(from[i]) - from_mean) * (to_complex(to[i]) - to_mean);
  return std::arg(sum) * 180 / std::numbers::pi;
}

void draw_dots(Page& page, const FigureCase& shown, const Points& moved, const View& view) {
  for (int k = 0; k < kDots; ++k)
    draw_dot(page, view(follow_outline(shown, moved, static_cast<double>(k) / kDots)), k);
}

Result<void> draw_alternatives_row(Page& page, const AlternativesRow& row, double top, const Watch& watch) {
  const double middle = top + kAlternativesRowHead + 0.5 * (row.height - kAlternativesRowHead - kAlternativesRowFoot);
  const Points& outline = row.shown.given.outline;
  const View source_view = centred(bounds(outline), row.scale, {alternatives_middle(0), middle}, row.shown.upwards);
  page.write({{row.shown.given.name, kInkColor, true}}, kTextSize, {alternatives_middle(0), top + 40}, Align::kCentre);
  auto drawn =
      draw_checked(page, source_region(row.shown, row.solved.front().deformation), source_view, 2 * kFigureCell, watch);
  if (!drawn) return drawn;
  page.stroke(source_view(outline), 2, true, color_of(kInkColor, 0.55));
  draw_dots(page, row.shown, outline, source_view);

  for (int i = 0; i < static_cast<int>(row.solved.size()); ++i) {
    const DeformedCase& solved = row.solved[static_cast<std::size_t>(i)];
    const double x = alternatives_middle(i + 1);
    const View view = centred(bounds(row.shown.sketch.points()), row.scale, {x, middle}, row.shown.upwards);
    drawn = draw_checked(page, deformed_region(row.shown, solved.deformation), view, 2 * kFigureCell, watch);
    if (!drawn) return drawn;
    page.stroke(view(row.shown.sketch.points()), 2.6, true, color_of(kSketchColor));
    draw_dots(page, row.shown, solved.deformation.outline, view);
    const double turn = turn_between(outline, solved.deformation.outline);
    page.write({{i == 0 ? "best" : "or", i == 0 ? kAccentColor : kInkColor, true},
                {"   turned " + number_text(std::round(std::abs(turn)), 0) + "°   match cost ", kQuietColor},
                {number_text(solved.metrics.match_cost.value_or(0), 3), kInkColor, true}},
               kSmallSize, {x, top + 40}, Align::kCentre);
    write_metrics(page, solved.metrics, {x, top + 72});
  }
  return {};
}

} // namespace

Result<Json> draw_alternatives(const FigureInput& input) {
  std::vector<std::string> names = input.names;
  if (names.empty()) names = {"ell90", "bar2S", "star2blob"};
  std::vector<AlternativesRow> rows;
  int height = kHeadHeight + kMargin / 2, columns = 0;
  for (const std::string& name : names) {
    auto row = make_alternatives_row(input, name);
    if (!row) return row.error();
    height += row->height;
    columns = std::max(columns, 1 + static_cast<int>(row->solved.size()));
    rows.push_back(std::move(*row));
  }
  const int width = 2 * kMargin + columns * kAlternativesColumnWidth + (columns - 1) * kAlternativesGap;
  Page page(width, height, input.lettering);
  page.head("Where a sketch can be taken in several ways",
            "The best match of the curves, and the runners-up to choose from");
  double top = kHeadHeight;
  for (const AlternativesRow& row : rows) {
    page.rule(top);
    const auto drawn = draw_alternatives_row(page, row, top, *input.watch);
    if (!drawn) return at(row.shown.given.name, drawn.error());
    top += row.height;
  }
  const auto saved = save_page(input, std::move(page), "alternatives.png");
  if (!saved) return saved.error();
  return Json::array({*saved});
}

} // namespace oversketch::cli
