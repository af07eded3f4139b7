#pragma once

#include "app/cli/figure_canvas.h"
#include "app/cli/figure_font.h"

#include <filesystem>
#include <initializer_list>
#include <string>

namespace oversketch::cli {

// What all figures look like.  Sizes in px; pages are made for screens of two pixels a point.

inline constexpr std::uint32_t kPaperColor = 0xFCFBF8, kInkColor = 0x1D2127, kQuietColor = 0x6A707B,
                               kRuleColor = 0xE4E1D8, kSketchColor = 0xDF2935, kFlipColor = 0xE11D2E,
                               kGoodColor = 0x1A7F4B, kAccentColor = 0x3A6FC9;

inline constexpr int kMargin = 64;
inline constexpr double kTitleSize = 38, kHeadSize = 25, kTextSize = 22, kSmallSize = 20;

/// A piece of a line of text.
struct Words {
  std::string text;
  std::uint32_t color = kInkColor;
  bool strong = false;
};

enum class Align { kLeft, kCentre };

/// The two weights that figures are lettered in.
struct Lettering {
  Font regular;
  Font strong;

  /// From the folder `assets`.
  /// @errors those of Font::load.
  static Result<Lettering> load(const std::filesystem::path& assets);
};

/// A sheet with text.
class Page : public Canvas {
public:
  Page(int width, int height, const Lettering& lettering);

  /// One line; `at` is the start, or with kCentre the middle, of its baseline.
  void write(std::initializer_list<Words> line, double size, Point at, Align align = Align::kLeft);
  /// The title, and a quieter line below it.
  void head(const std::string& title, const std::string& subtitle);
  /// A thin line across the sheet between the margins.
  void rule(double y);

private:
  Lettering lettering_;
};

/// Where content starts below head().
inline constexpr int kHeadHeight = 172;

/// `decimals` digits after the point, groups of three before it: "2 661"; "∞".
std::string number_text(double value, int decimals);

} // namespace oversketch::cli
