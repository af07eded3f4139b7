#include "app/cli/figures_paper.h"

#include "core/base/file.h"
#include "core/image/image_io.h"
#include "core/session/script.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oversketch::cli {
namespace {

constexpr int kPanels = 3, kPanelWidth = 660, kPaperGap = 40;
constexpr int kPaperPageWidth = 2 * kMargin + kPanels * kPanelWidth + (kPanels - 1) * kPaperGap;
constexpr double kPaperMostWidth = kPanelWidth - 60, kPaperMostHeight = 560;
constexpr int kPanelHead = 100, kPanelFoot = 64;
/// Steps after which descent has come to rest on the sample.
constexpr int kManySteps = 5000;
constexpr double kArrowLength = 10;
/// Of the photograph that is shown, px.
constexpr double kPhotographCell = 6;

/// Three pictures side by side, each with two lines above.
struct Strip {
  Page page;
  double scale;
  double middle_y;

  Point middle(int panel) const { return {kMargin + panel * (kPanelWidth + kPaperGap) + 0.5 * kPanelWidth, middle_y}; }
  void head(int panel, const std::string& name, std::initializer_list<Words> more) {
    const double x = middle(panel).x;
    page.write({{name, kInkColor, true}}, kHeadSize, {x, kHeadHeight + 34.0}, Align::kCentre);
    page.write(more, kSmallSize, {x, kHeadHeight + 70.0}, Align::kCentre);
  }
};

Strip make_strip(const FigureInput& input, const Point& size, const std::string& title, const std::string& subtitle) {
  const double scale = std::min(kPaperMostWidth / size.x, kPaperMostHeight / size.y);
  const int content = static_cast<int>(std::lround(scale * size.y));
  Strip strip{Page(kPaperPageWidth, kHeadHeight + kPanelHead + content + kPanelFoot, input.lettering), scale,
              kHeadHeight + kPanelHead + 0.5 * content};
  strip.page.head(title, subtitle);
  strip.page.rule(kHeadHeight - 12);
  return strip;
}

Result<std::vector<PaperRun>> run_all(const FigureCase& shown, std::initializer_list<PaperSetup> setups,
                                      const Watch& watch) {
  std::vector<PaperRun> runs;
  for (const PaperSetup& setup : setups) {
    auto run = run_paper(shown, setup, watch);
    if (!run) return at(shown.given.name, run.error());
    runs.push_back(std::move(*run));
  }
  return runs;
}

std::string energy_text(const PaperRun& run) {
  const double energy = run.solution.energies.back();
  return number_text(energy, energy < 100 ? 1 : 0);
}

Words flips_text(const PaperRun& run) {
  const int flips = run.distortion.flipped_cells;
  return {flips > 0 ? "flips " + number_text(flips, 0) : "no flips", flips > 0 ? kFlipColor : kGoodColor, true};
}

struct Sample {
  FigureCase shown;
  Image photograph;
};

/// The first region of a sample script and its photograph.
Result<Sample> read_sample(const FigureInput& input) {
  const auto path = input.samples / "puffer.jsonl";
  const auto text = read_text_file(path);
  if (!text) return text.error();
  const auto lines = parse_script(*text, path.string());
  if (!lines) return lines.error();
  DeformCase given;
  std::string source;
  for (const ScriptLine& line : *lines)
    if (const auto* command = std::get_if<Command>(&line.step)) {
      if (const auto* add = std::get_if<LayerAdd>(command); add && source.empty()) source = add->source.name;
      if (const auto* set = std::get_if<RegionSet>(command); set && given.outline.empty()) given.outline = set->outline;
      if (const auto* set = std::get_if<SketchSet>(command); set && given.sketch.empty()) given.sketch = set->curve;
    }
  auto photograph = load_image(input.samples / source);
  if (!photograph) return photograph.error();
  auto shown = make_figure_case(std::move(given), false);
  if (!shown) return at(path.string(), shown.error());
  return Sample{std::move(*shown), std::move(*photograph)};
}

/// The mesh in the source, at the start and after 50 steps, with the photograph in it.
Result<std::string> draw_meshes(const FigureInput& input) {
  const auto sample = read_sample(input);
  if (!sample) return sample.error();
  const FigureCase& shown = sample->shown;
  const auto runs = run_all(shown, {{kPhotographCell, 1, 0}, {kPhotographCell, 1, 50}}, *input.watch);
  if (!runs) return runs.error();
  Box box = bounds(shown.sketch.points());
  for (const PaperRun& run : *runs)
    for (const Point p : run.solution.positions)
      box.add(p);
  Strip strip = make_strip(input, box.size(), "The mesh before and after",
                           "The paper's method; the source is shown larger than it is");
  const auto& mesh = *runs->front().mesh;
  const Box source = bounds(mesh.vertices);
  const double source_scale = std::min(kPaperMostWidth / source.size().x, strip.scale * box.size().y / source.size().y);
  for (int i = 0; i < kPanels; ++i) {
    const PaperRun& run = (*runs)[i == 2 ? 1 : 0];
    RegionPicture region = deformed_region(shown, run);
    if (i == 0) region.positions = mesh.vertices, region.boundary = shown.given.outline;
    const View view = i == 0 ? centred(source, source_scale, strip.middle(0))
                             : centred(box, strip.scale, strip.middle(i), shown.upwards);
    const auto drawn = draw_photographed(strip.page, region, view, sample->photograph, *input.watch);
    if (!drawn) return drawn.error();
    draw_wires(strip.page, mesh, region.positions, view, 2.6, color_of(kInkColor, 0.4), i > 0);
    draw_wires(strip.page, mesh, region.positions, view, 1.1, color_of(0xFFFFFF, 0.8), false);
    const Points& curve = i == 0 ? shown.given.outline : shown.sketch.points();
    strip.page.stroke(view(curve), 3, true, color_of(kSketchColor));
    const std::string vertices = number_text(static_cast<double>(mesh.vertices.size()), 0) + " vertices";
    if (i == 0)
      strip.head(i, "Source", {{vertices + " and the outline", kQuietColor}});
    else
      strip.head(i, i == 1 ? "Start: by arc length" : "After 50 steps",
                 {flips_text(run), {"     energy ", kQuietColor}, {energy_text(run), kInkColor, true}});
  }
  return save_page(input, std::move(strip.page), "paper-mesh.png");
}

/// The part of the gradients that runs along the sketch: 0 where all are orthogonal to it.
double tangential_part(const PaperRun& run) {
  double along = 0, all = 0;
  for (std::size_t i = 0; i < run.solution.handles.size(); ++i) {
    const Point g = run.solution.gradients[i];
    along += std::abs(dot(g, run.sketch.tangent(run.solution.handle_s[i])));
    all += length(g);
  }
  return all > 0 ? along / all : 0;
}

Result<std::string> draw_gradients(const FigureInput& input, const FigureCase& shown) {
  const auto runs =
      run_all(shown, {{kFigureCell, 1, 0}, {kFigureCell, 1, 50}, {kFigureCell, 1, kManySteps}}, *input.watch);
  if (!runs) return runs.error();
  const Box box = bounds(shown.sketch.points());
  Strip strip =
      make_strip(input, box.size() + Point{60, 60}, "Gradients on the handles",
                 "The way each handle wants to go, ten times as long as it is: against the gradient of the energy. At "
                 "rest it is orthogonal to the sketch");
  const std::array<std::string, kPanels> names = {"Start", "After 50 steps",
                                                  "After " + number_text(kManySteps, 0) + " steps"};
  for (int i = 0; i < kPanels; ++i) {
    const PaperRun& run = (*runs)[static_cast<std::size_t>(i)];
    const View view = centred(box, strip.scale, strip.middle(i), shown.upwards);
    draw_wires(strip.page, *run.mesh, run.solution.positions, view, 1.2, color_of(0x7C8796, 0.55), false);
    strip.page.stroke(view(shown.sketch.points()), 2.4, true, color_of(kSketchColor, 0.85));
    for (std::size_t h = 0; h < run.solution.handles.size(); ++h) {
      const Point from = run.solution.handles[h], to = from - kArrowLength * run.solution.gradients[h];
      strip.page.arrow(view(from), view(to), 2.6, color_of(kAccentColor));
      strip.page.disc(view(from), 3.6, color_of(kInkColor));
    }
    strip.head(i, names[static_cast<std::size_t>(i)],
               {{"along the sketch ", kQuietColor},
                {number_text(100 * tangential_part(run), 1) + " %", kInkColor, true},
                {"     energy ", kQuietColor},
                {energy_text(run), kInkColor, true}});
  }
  return save_page(input, std::move(strip.page), "paper-gradients.png");
}

Result<std::string> draw_weights(const FigureInput& input, const FigureCase& shown) {
  constexpr std::array<double, kPanels> kWeights = {1, 0.5, 0.1};
  const auto runs =
      run_all(shown, {{kFigureCell, kWeights[0], 50}, {kFigureCell, kWeights[1], 50}, {kFigureCell, kWeights[2], 50}},
              *input.watch);
  if (!runs) return runs.error();
  const Box box = bounds(shown.sketch.points());
  Strip strip =
      make_strip(input, box.size(), "The weight of the handles",
                 "The less ω, the stiffer the inside and the further the boundary stays from the sketch; 50 steps");
  for (int i = 0; i < kPanels; ++i) {
    const PaperRun& run = (*runs)[static_cast<std::size_t>(i)];
    const View view = centred(box, strip.scale, strip.middle(i), shown.upwards);
    const auto drawn = draw_checked(strip.page, deformed_region(shown, run), view, 2 * kFigureCell, *input.watch);
    if (!drawn) return drawn.error();
    strip.page.stroke(view(shown.sketch.points()), 2.8, true, color_of(kSketchColor));
    strip.head(i, "ω = " + number_text(kWeights[static_cast<std::size_t>(i)], i == 0 ? 0 : 1),
               {flips_text(run),
                {"     σ₁/σ₂ ", kQuietColor},
                {number_text(run.distortion.sigma_ratio_mean, 2), kInkColor, true},
                {"     off the sketch ", kQuietColor},
                {number_text(run.distance.mean, 1) + " px", kInkColor, true}});
  }
  return save_page(input, std::move(strip.page), "paper-weight.png");
}

Result<std::string> draw_cells(const FigureInput& input, const FigureCase& shown) {
  constexpr std::array<double, kPanels> kCells = {20, 10, 5};
  const auto runs = run_all(shown, {{kCells[0], 1, 50}, {kCells[1], 1, 50}, {kCells[2], 1, 50}}, *input.watch);
  if (!runs) return runs.error();
  const Box box = bounds(shown.sketch.points());
  Strip strip = make_strip(input, box.size(), "The size of the cells",
                           "50 steps each; the part of the energy that they take off depends on the cells");
  for (int i = 0; i < kPanels; ++i) {
    const PaperRun& run = (*runs)[static_cast<std::size_t>(i)];
    const View view = centred(box, strip.scale, strip.middle(i), shown.upwards);
    draw_wires(strip.page, *run.mesh, run.solution.positions, view, 1.5, color_of(kAccentColor), true);
    strip.page.stroke(view(shown.sketch.points()), 2.8, true, color_of(kSketchColor));
    const double fall = 1 - run.solution.energies.back() / run.solution.energies.front();
    strip.head(i, number_text(kCells[static_cast<std::size_t>(i)], 0) + " px",
               {{number_text(static_cast<double>(run.mesh->vertices.size()), 0) + " vertices     ", kQuietColor},
                flips_text(run),
                {"     energy ", kQuietColor},
                {"−" + number_text(100 * fall, 0) + " %", kInkColor, true}});
  }
  return save_page(input, std::move(strip.page), "paper-cells.png");
}

} // namespace

Result<Json> draw_paper(const FigureInput& input) {
  const auto shown = read_figure_case(input, input.names.empty() ? "fish" : input.names.front());
  if (!shown) return shown.error();
  Json files = Json::array();
  const auto meshes = draw_meshes(input);
  if (!meshes) return meshes.error();
  files.push_back(*meshes);
  for (const auto draw : {draw_gradients, draw_weights, draw_cells}) {
    const auto file = draw(input, *shown);
    if (!file) return file.error();
    files.push_back(*file);
  }
  return files;
}

} // namespace oversketch::cli
