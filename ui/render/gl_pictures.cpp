#include "ui/render/gl_pictures.h"

#include "ui/widgets/imgui_compat.h"

#include <algorithm>
#include <vector>

namespace oversketch {
namespace {

/// Uploading in one frame, beyond the first piece.
constexpr auto kUploadTime = std::chrono::milliseconds(5);
/// Frames for which a small picture that is not drawn is kept.
constexpr std::uint64_t kSmallFrames = 240;
/// Screen pixels of the checkerboard's squares.
constexpr float kSquare = 8;
/// From this zoom on pixels are shown as squares.
constexpr double kHardPixels = 4;

Raster<Rgba8> checkerboard() {
  const Rgba8 light = {204, 204, 204, 255}, dark = {153, 153, 153, 255};
  Raster<Rgba8> pixels(2, 2, light);
  pixels.at(1, 0) = pixels.at(0, 1) = dark;
  return pixels;
}

void bind_from_list(const ImDrawList*, const ImDrawCmd* command) {
  bind_sampler(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(command->UserCallbackData))); // NOLINT
}

Sampling sampling_at(double zoom) {
  // At one to one there is nothing between the pixels to show.
  if (zoom >= kHardPixels || zoom == 1) return Sampling::kNearest;
  return zoom > 1 ? Sampling::kLinear : Sampling::kTrilinear;
}

} // namespace

GlPictures::GlPictures(std::size_t budget_bytes) : budget_bytes_(budget_bytes), checker_(checkerboard()) {}

template <class Work>
void GlPictures::timed(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  spent_ += std::chrono::steady_clock::now() - begin;
}

bool GlPictures::has_time() const {
  return spent_ < kUploadTime;
}

void GlPictures::begin_frame() {
  ++frame_;
  spent_ = {};
  behind_ = false;
  forget_unused();
}

void GlPictures::forget_unused() {
  std::erase_if(small_, [&](const auto& entry) { return entry.second.last_frame + kSmallFrames < frame_; });
  std::size_t total = 0;
  std::vector<std::pair<std::uint64_t, Hash>> unused;
  for (const auto& [content, shown] : shown_) {
    total += shown.tiles->bytes();
    if (shown.last_frame + 1 < frame_) unused.emplace_back(shown.last_frame, content);
  }
  std::ranges::sort(unused);
  for (const auto& [last_frame, content] : unused) {
    if (total <= budget_bytes_) break;
    total -= shown_.at(content).tiles->bytes();
    shown_.erase(content);
  }
}

ImTextureID GlPictures::small(const std::shared_ptr<const Raster<Rgba8>>& pixels) {
  if (!pixels || pixels->empty()) return compat::to_texture_id(checker_.name());
  Small& entry = small_[pixels];
  entry.last_frame = frame_;
  if (entry.texture.empty()) entry.texture = Texture(*pixels);
  return compat::to_texture_id(entry.texture.name());
}

void GlPictures::bind(ImDrawList& list, Sampling sampling) const {
  const auto name = static_cast<std::uintptr_t>(samplers_.name(sampling));
  list.AddCallback(bind_from_list, reinterpret_cast<void*>(name)); // NOLINT: a number is all that is passed
}

void GlPictures::draw_tiles(ImDrawList& list, TiledPicture& tiles, const View& view, ImVec2 corner, ImVec2 end) {
  const Sampling sampling = sampling_at(view.zoom);
  const auto draw_squares = [&](ImVec2 from, ImVec2 to) {
    const auto square = [&](ImVec2 at) {
      return ImVec2((at.x - corner.x) / (2 * kSquare), (at.y - corner.y) / (2 * kSquare));
    };
    bind(list, Sampling::kTiled);
    list.AddImage(compat::to_texture_id(checker_.name()), from, to, square(from), square(to));
    bind(list, sampling);
  };
  list.PushClipRect(corner, end, true);
  bind(list, sampling);
  for (const int tile : tiles.visible_tiles(view, corner, end))
    tiles.draw(list, tile, view, corner, end, draw_squares);
  list.AddCallback(bind_from_list, nullptr);
  list.PopClipRect();
}

void GlPictures::draw(ImDrawList& list, const ShownPicture& picture, const View& view, ImVec2 corner, ImVec2 end) {
  if (!picture.pixels || picture.pixels->empty()) return;
  const Raster<Rgba8>& pixels = *picture.pixels;
  Shown& shown = shown_[picture.content];
  shown.last_frame = frame_;
  if (!shown.tiles) shown.tiles = std::make_unique<TiledPicture>(pixels.width(), pixels.height(), false);
  for (const int tile : shown.tiles->visible_tiles(view, corner, end)) {
    if (!shown.tiles->tile_missing(tile)) continue;
    if (!has_time()) {
      behind_ = true;
      break;
    }
    timed([&] { shown.tiles->put(tile, pixels.rect(), pixels); });
  }
  draw_tiles(list, *shown.tiles, view, corner, end);
}

void GlPictures::draw_result(ImDrawList& list, const LiveSession& session, const View& view, ImVec2 corner,
                             ImVec2 end) {
  const auto found = results_.find(&session);
  if (found != results_.end() && found->second.tiles) draw_tiles(list, *found->second.tiles, view, corner, end);
}

void GlPictures::update_result(LiveSession& session) {
  PictureUpdate update = session.take_picture_update();
  Result& result = results_[&session];
  if (update.whole) {
    result.waiting.clear();
    result.done_tiles = 0;
    const bool same_size =
        result.tiles && result.tiles->width() == update.width && result.tiles->height() == update.height;
    if (update.width <= 0 || update.height <= 0)
      result.tiles.reset();
    else if (!same_size)
      result.tiles = std::make_unique<TiledPicture>(update.width, update.height, true);
  }
  for (PicturePatch& patch : update.patches)
    result.waiting.push_back(std::move(patch));
  if (!result.tiles) result.waiting.clear();
  upload_waiting(result);
}

void GlPictures::upload_waiting(Result& result) {
  while (!result.waiting.empty()) {
    const PicturePatch& patch = result.waiting.front();
    const Rect rect = {patch.x, patch.y, patch.pixels.width(), patch.pixels.height()};
    for (; result.done_tiles < result.tiles->tile_count(); ++result.done_tiles) {
      if (!has_time()) {
        behind_ = true;
        return;
      }
      timed([&] { result.tiles->put(result.done_tiles, rect, patch.pixels); });
    }
    result.waiting.pop_front();
    result.done_tiles = 0;
  }
}

void GlPictures::keep_results(std::span<const LiveSession* const> sessions) {
  std::erase_if(results_,
                [&](const auto& entry) { return std::ranges::find(sessions, entry.first) == sessions.end(); });
}

} // namespace oversketch
