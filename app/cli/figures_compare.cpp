#include "app/cli/figures.h"

#include "core/deform/match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace oversketch::cli {
namespace {

constexpr int kColumns = 4, kColumnWidth = 500, kGap = 36;
constexpr double kMostHeight = 400, kMostWidth = kColumnWidth - 36;
/// Above each row's pictures; room for names and numbers.
constexpr int kRowHead = 76, kRowFoot = 40, kColumnHead = 88, kFoot = 92;
constexpr int kPageWidth = 2 * kMargin + kColumns * kColumnWidth + (kColumns - 1) * kGap;

double column_left(int column) {
  return kMargin + column * (kColumnWidth + kGap);
}
double column_middle(int column) {
  return column_left(column) + 0.5 * kColumnWidth;
}

struct Row {
  FigureCase shown;
  std::vector<DeformedCase> solved;
  Match match;
  double scale = 1;
  int height = 0;
};

Result<Row> make_row(const FigureInput& input, const std::string& name) {
  auto shown = read_figure_case(input, name);
  if (!shown) return shown.error();
  std::vector<DeformedCase> solved;
  for (const Method method : {Method::kInitial, Method::kPaper, Method::kFlipfree}) {
    auto one = solve_figure(*shown, method, *input.watch);
    if (!one) return one.error();
    solved.push_back(std::move(*one));
  }
  const auto matches = match_curves(MatchSource(shown->outline), shown->sketch, {}, {}, *input.watch);
  if (!matches) return matches.error();
  const Point source = bounds(shown->outline.points()).size();
  Box box = bounds(shown->sketch.points());
  for (const DeformedCase& one : solved)
    for (const Point p : one.deformation.boundary)
      box.add(p);
  const Point size{std::max(source.x, box.size().x), std::max(source.y, box.size().y)};
  const double scale = std::min(kMostWidth / size.x, kMostHeight / size.y);
  const int height = kRowHead + static_cast<int>(std::lround(scale * size.y)) + kRowFoot;
  return Row{std::move(*shown), std::move(solved), matches->front(), scale, height};
}

void draw_dots(Page& page, const Row& row, const Points& moved, const View& view, bool goals) {
  if (goals)
    for (int k = 0; k < kDots; ++k) {
      const double s = row.match.sketch_at(row.shown.outline.length() * k / kDots);
      draw_goal(page, view(row.shown.sketch.at(s)), k);
    }
  for (int k = 0; k < kDots; ++k)
    draw_dot(page, view(follow_outline(row.shown, moved, static_cast<double>(k) / kDots)), k);
}

Result<void> draw_row(Page& page, const Row& row, double top, const Watch& watch) {
  const double middle = top + kRowHead + 0.5 * (row.height - kRowHead - kRowFoot);
  const Points& outline = row.shown.given.outline;
  page.write({{row.shown.given.name, kInkColor, true}}, kTextSize, {column_middle(0), top + 44}, Align::kCentre);
  const View source_view = centred(bounds(outline), row.scale, {column_middle(0), middle}, row.shown.upwards);
  const Deformation& flipfree = row.solved.back().deformation;
  auto drawn = draw_checked(page, source_region(row.shown, flipfree), source_view, 2 * kFigureCell, watch);
  if (!drawn) return drawn;
  page.stroke(source_view(outline), 2, true, color_of(kInkColor, 0.55));
  draw_dots(page, row, outline, source_view, false);

  const Box sketch_box = bounds(row.shown.sketch.points());
  for (int i = 0; i < 3; ++i) {
    const DeformedCase& solved = row.solved[static_cast<std::size_t>(i)];
    const double x = column_middle(i + 1);
    const View view = centred(sketch_box, row.scale, {x, middle}, row.shown.upwards);
    drawn = draw_checked(page, deformed_region(row.shown, solved.deformation), view, 2 * kFigureCell, watch);
    if (!drawn) return drawn;
    page.stroke(view(row.shown.sketch.points()), 2.6, true, color_of(kSketchColor));
    draw_dots(page, row, solved.deformation.outline, view, true);
    write_metrics(page, solved.metrics, {x, top + 44});
  }
  return {};
}

void draw_column_heads(Page& page, double top) {
  constexpr std::array<std::array<const char*, 2>, kColumns> kHeads = {
      {{"Source", "chessboard and a dozen places"},
       {"Paper: start", "by arc length"},
       {"Paper: 50 steps", "of gradient descent"},
       {"Flip-free", "matched by shape, then solved"}}};
  for (int i = 0; i < kColumns; ++i) {
    const auto& head = kHeads[static_cast<std::size_t>(i)];
    page.write({{head[0], i == kColumns - 1 ? kAccentColor : kInkColor, true}}, kHeadSize, {column_middle(i), top + 28},
               Align::kCentre);
    page.write({{head[1], kQuietColor}}, kSmallSize, {column_middle(i), top + 60}, Align::kCentre);
  }
}

void draw_legend(Page& page, double top) {
  const double y = top + 44, text = y + 7;
  double x = kMargin + 12;
  const auto say = [&](const std::string& words, double width) {
    page.write({{words, kQuietColor}}, kSmallSize, {x + 26, text});
    x += width;
  };
  draw_dot(page, {x, y}, 7);
  say("where a place of the outline went", 410);
  draw_goal(page, {x, y}, 7);
  say("where it belongs by the match", 370);
  page.rectangle(x - 12, y - 1.5, 26, 3, color_of(kSketchColor));
  say("sketch", 150);
  page.rectangle(x - 11, y - 11, 22, 22, color_of(kFlipColor, 0.55));
  say("flipped cell", 190);
  page.write(
      {{"σ₁/σ₂: mean stretch ratio of the cells;  area ×: largest by smallest, 95th by 5th percentile", kQuietColor}},
      kSmallSize, {x - 2, text});
}

} // namespace

Result<Json> draw_compare(const FigureInput& input) {
  std::vector<std::string> names = input.names;
  if (names.empty()) names = {"fish", "pineapple", "cactus_noisy", "bar2S", "star2blob", "bar2disc"};
  std::vector<Row> rows;
  int height = kHeadHeight + kColumnHead + kFoot + kMargin / 2;
  for (const std::string& name : names) {
    input.watch->report(static_cast<double>(rows.size()) / static_cast<double>(names.size()), "compare: " + name);
    auto row = make_row(input, name);
    if (!row) return row.error();
    height += row->height;
    rows.push_back(std::move(*row));
  }
  Page page(kPageWidth, height, input.lettering);
  page.head("A region takes the shape of a sketch", "Cells of " + number_text(kFigureCell, 0) +
                                                        " px for all three, the same sketch in each row; squares of " +
                                                        number_text(2 * kFigureCell, 0) + " px");
  double top = kHeadHeight;
  draw_column_heads(page, top);
  top += kColumnHead;
  for (const Row& row : rows) {
    page.rule(top);
    const auto drawn = draw_row(page, row, top, *input.watch);
    if (!drawn) return at(row.shown.given.name, drawn.error());
    top += row.height;
  }
  page.rule(top);
  draw_legend(page, top);
  const auto saved = save_page(input, std::move(page), "compare.png");
  if (!saved) return saved.error();
  return Json::array({*saved});
}

} // namespace oversketch::cli
