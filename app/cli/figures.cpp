#include "app/cli/figures.h"

#include "app/assets.h"

#include "core/deform/cleanup.h"
#include "core/image/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <system_error>

namespace oversketch::cli {
namespace {

namespace fs = std::filesystem;

struct FiguresArguments {
  std::vector<std::string> figures, cases;
  std::string out, folder;
};

using DrawFigure = Result<Json> (*)(const FigureInput&);

const std::vector<std::pair<std::string, std::vector<DrawFigure>>> figure_table() {
  return {{"compare", {draw_compare}},
          {"paper", {draw_paper, write_paper_table}},
          {"alternatives", {draw_alternatives}},
          {"errors", {draw_errors}}};
}

Result<FigureInput> prepare(const FiguresArguments& options, const Watch& watch) {
  const auto assets = find_assets();
  if (!assets) return assets.error();
  auto lettering = Lettering::load(*assets);
  if (!lettering) return lettering.error();
  std::error_code failure;
  fs::create_directories(options.out, failure);
  if (failure) return Error{"file.write", "the folder cannot be made: " + failure.message(), options.out};
  return FigureInput{std::move(*lettering), options.folder.empty() ? *assets / "cases" : fs::path(options.folder),
                     *assets / "samples",   options.out,
                     options.cases,         &watch};
}

Result<Json> draw(const FiguresArguments& options, const Watch& watch) {
  const auto input = prepare(options, watch);
  if (!input) return input.error();
  Json report;
  report["files"] = Json::array();
  for (const auto& [name, parts] : figure_table()) {
    const auto& asked = options.figures;
    if (!asked.empty() && std::find(asked.begin(), asked.end(), name) == asked.end()) continue;
    for (const DrawFigure part : parts) {
      watch.report(0, name);
      const auto files = part(*input);
      if (!files) return files.error();
      for (const Json& file : *files)
        report["files"].push_back(file);
    }
  }
  return report;
}

} // namespace

Result<FigureCase> make_figure_case(DeformCase given, bool upwards) {
  const ClosedCurve outline(given.outline);
  const auto clean = clean_sketch(given.sketch, outline.signed_area());
  if (!clean) return clean.error();
  return FigureCase{std::move(given), outline, clean->curve, upwards};
}

Result<FigureCase> read_figure_case(const FigureInput& input, const std::string& name) {
  const fs::path path = input.cases / (name + ".json");
  auto given = read_case(path);
  if (!given) return given.error();
  auto made = make_figure_case(std::move(*given), true);
  return made ? made : at(path.string(), made.error());
}

Result<DeformedCase> solve_figure(const FigureCase& shown, Method method, const Watch& watch) {
  DeformOptions options;
  options.method = method;
  options.cell_px = kFigureCell;
  auto solved = solve_case(shown.given, options, watch);
  return solved ? std::move(solved) : at(shown.given.name, solved.error());
}

RegionPicture deformed_region(const FigureCase& shown, const Deformation& deformation) {
  return {deformation.mesh.get(), deformation.positions, deformation.boundary, shown.given.outline};
}

RegionPicture source_region(const FigureCase& shown, const Deformation& deformation) {
  return {deformation.mesh.get(), deformation.mesh->vertices, shown.given.outline, shown.given.outline};
}

Point follow_outline(const FigureCase& shown, const Points& moved, double fraction) {
  const double s = fraction * shown.outline.length();
  const int from = shown.outline.segment_at(s), to = (from + 1) % shown.outline.size();
  const double along = shown.outline.forward(shown.outline.s_at(from), s);
  const double whole = shown.outline.forward(shown.outline.s_at(from), shown.outline.s_at(to));
  return lerp(moved[static_cast<std::size_t>(from)], moved[static_cast<std::size_t>(to)],
              whole > 0 ? std::min(1.0, along / whole) : 0);
}

std::uint32_t dot_color(int k) {
  constexpr std::array<std::uint32_t, kDots> kColors = {0xE5484D, 0xF76B15, 0xFFB224, 0xC6CC1E, 0x5FB62B, 0x12A56B,
                                                        0x0FB5AE, 0x1899D6, 0x4A5FE0, 0x7C4DDB, 0xB83FC9, 0xE5359B};
  return kColors[static_cast<std::size_t>(k % kDots)];
}

void draw_dot(Canvas& canvas, Point at, int k) {
  canvas.disc(at, 9.5, color_of(kInkColor, 0.75));
  canvas.disc(at, 8.2, color_of(0xFFFFFF));
  canvas.disc(at, 6.4, color_of(dot_color(k)));
}

void draw_goal(Canvas& canvas, Point at, int k) {
  canvas.cross(at, 13, 7, color_of(0xFFFFFF, 0.9));
  canvas.cross(at, 11.5, 3.6, color_of(dot_color(k)));
}

void write_metrics(Page& page, const Metrics& metrics, Point at) {
  const DistortionMetrics& d = metrics.distortion;
  const bool flips = d.flipped_cells > 0;
  const auto ratio = number_text(d.sigma_ratio_mean, d.sigma_ratio_mean < 100 ? 2 : 0);
  const auto spread = number_text(d.area_spread, d.area_spread < 100 ? 1 : 0);
  page.write({{flips ? "flips " + number_text(d.flipped_cells, 0) : "no flips", flips ? kFlipColor : kGoodColor, true},
              {"     σ₁/σ₂ ", kQuietColor},
              {ratio, kInkColor, true},
              {"     area ×", kQuietColor},
              {spread, kInkColor, true}},
             kSmallSize, at, Align::kCentre);
}

Result<std::string> save_page(const FigureInput& input, Page page, const std::string& name) {
  const auto saved = save_image(Image(std::move(page).take()), input.out / name);
  if (!saved) return saved.error();
  return name;
}

void add_figures(Cli& cli) {
  const auto options = std::make_shared<FiguresArguments>();
  CLI::App* sub = cli.add("figures", "Draw the method's pictures, the paper's own and its table from sample material.",
                          "figures compare --out pictures");
  std::vector<std::string> names;
  for (const auto& figure : figure_table())
    names.push_back(figure.first);
  sub->add_option(
         "figures", options->figures,
         "compare: source, paper and flip-free side by side; paper: meshes, gradients, weights, cell sizes and "
         "the table of times; alternatives: other ways to match; errors: how far blending is from the exact "
         "solution; none: all")
      ->check(CLI::IsMember(names))
      ->type_name("NAME");
  sub->add_option("--out", options->out, "folder for the pictures")->required()->type_name("DIR");
  sub->add_option("--cases", options->folder,
                  "folder with the curve pairs, which are drawn with y upwards (default: those of the program)")
      ->type_name("DIR");
  sub->add_option("--case", options->cases, "show this case, a file's name without .json, instead of the usual ones")
      ->type_name("CASE")
      ->take_all()
      ->expected(1);
  cli.on_run(sub, [options](const Watch& watch) { return draw(*options, watch); });
}

} // namespace oversketch::cli
