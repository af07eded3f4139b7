#include "app/cli/figure_font.h"

#include "core/base/file.h"

#include <stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oversketch::cli {
namespace {

/// What stands for bytes that are no UTF-8.
constexpr int kNoLetter = 0xFFFD;
/// Straight pieces of a curved piece of outline, for letters of at most about 50 px.
constexpr int kPiecesPerCurve = 8;

/// The letter that starts `text`, which is cut off there.
int take_letter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const int lead = byte(0);
  const std::size_t more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : 1;
  int letter = more == 0 ? lead : lead & (0x3F >> more);
  bool sound = more == 0 || (lead >= 0xC2 && lead < 0xF5 && text.size() > more);
  for (std::size_t i = 1; sound && i <= more; ++i) {
    sound = (byte(i) & 0xC0) == 0x80;
    letter = (letter << 6) | (byte(i) & 0x3F);
  }
  text.remove_prefix(sound ? more + 1 : 1);
  return sound ? letter : kNoLetter;
}

/// Straight pieces of one glyph's outline.
class OutlineMaker {
public:
  OutlineMaker(Point start, double scale) : start_(start), scale_(scale) {}

  void add(const stbtt_vertex& v) {
    const Point to = place(v.x, v.y), c = place(v.cx, v.cy), d = place(v.cx1, v.cy1);
    if (v.type == STBTT_vmove) rings_.emplace_back();
    if (rings_.empty()) return;
    if (v.type == STBTT_vcurve || v.type == STBTT_vcubic) {
      const Point from = last_;
      // A quadratic piece is the cubic one with its control point at two thirds of the way from either end.
      const Point first = v.type == STBTT_vcubic ? c : lerp(from, c, 2.0 / 3);
      const Point second = v.type == STBTT_vcubic ? d : lerp(to, c, 2.0 / 3);
      for (int i = 1; i < kPiecesPerCurve; ++i) {
        const double t = static_cast<double>(i) / kPiecesPerCurve, u = 1 - t;
        rings_.back().push_back(u * u * u * from + 3 * u * u * t * first + 3 * u * t * t * second + t * t * t * to);
      }
    }
    rings_.back().push_back(to);
    last_ = to;
  }

  std::vector<Points> take() && { return std::move(rings_); }

private:
  Point place(double x, double y) const { return start_ + scale_ * Point{x, -y}; }

  Point start_;
  double scale_;
  Point last_;
  std::vector<Points> rings_;
};

} // namespace

struct Font::Data {
  std::vector<std::byte> bytes;
  stbtt_fontinfo info{};

  /// Calls `visit` with each glyph and where it starts, in font units; gives where the text ends.
  template <class Visit>
  double walk(std::string_view text, const Visit& visit) const {
    double x = 0;
    for (int before = 0; !text.empty();) {
      const int glyph = stbtt_FindGlyphIndex(&info, take_letter(text));
      if (before != 0) x += stbtt_GetGlyphKernAdvance(&info, before, glyph);
      visit(glyph, x);
      int advance = 0;
      stbtt_GetGlyphHMetrics(&info, glyph, &advance, nullptr);
      x += advance;
      before = glyph;
    }
    return x;
  }
};

Result<Font> Font::load(const std::filesystem::path& path) {
  auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  auto data = std::make_shared<Data>();
  data->bytes = std::move(*bytes);
  const auto* start = reinterpret_cast<const unsigned char*>(data->bytes.data());
  // The library looks at the first bytes without asking how many there are.
  constexpr std::size_t kLeastBytes = 64;
  const int offset = data->bytes.size() < kLeastBytes ? -1 : stbtt_GetFontOffsetForIndex(start, 0);
  if (offset < 0 || stbtt_InitFont(&data->info, start, offset) == 0)
    return Error{"font.unreadable", "this is no font that can be read", path.string()};
  return Font(std::move(data));
}

double Font::width(std::string_view text, double size) const {
  return data_->walk(text, [](int, double) {}) *
         stbtt_ScaleForMappingEmToPixels(&data_->info, static_cast<float>(size));
}

std::vector<Points> Font::outlines(std::string_view text, double size, Point start) const {
  const double scale = stbtt_ScaleForMappingEmToPixels(&data_->info, static_cast<float>(size));
  std::vector<Points> rings;
  data_->walk(text, [&](int glyph, double x) {
    stbtt_vertex* vertices = nullptr;
    const int count = stbtt_GetGlyphShape(&data_->info, glyph, &vertices);
    OutlineMaker maker(start + Point{scale * x, 0}, scale);
    for (int i = 0; i < count; ++i)
      maker.add(vertices[i]);
    stbtt_FreeShape(&data_->info, vertices);
    for (Points& ring : std::move(maker).take())
      rings.push_back(std::move(ring));
  });
  return rings;
}

} // namespace oversketch::cli
