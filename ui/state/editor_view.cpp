// The editor's views: what is looked at, and how near.
#include "ui/state/editor.h"

namespace oversketch {

std::optional<Point> Editor::picture_size(const Tab& tab, Side side) const {
  const auto snapshot = tab.session->snapshot();
  const Document& document = snapshot->document;
  const Image* image = &document.target.image;
  if (side == Side::kSource) {
    const Layer* layer = document.selected ? document.find(*document.selected) : nullptr;
    if (layer == nullptr) return std::nullopt;
    image = &layer->source.image;
  }
  if (image->empty()) return std::nullopt;
  return Point{static_cast<double>(image->width()), static_cast<double>(image->height())};
}

std::optional<Point> Editor::canvas_size(Side side) const {
  const auto& rect = canvases_.at(side);
  if (!rect || rect->w < 1 || rect->h < 1) return std::nullopt;
  return Point{rect->w, rect->h};
}

void Editor::fit(Tab& tab, Side side) {
  const auto canvas = canvas_size(side), picture = picture_size(tab, side);
  if (!canvas || !picture) return;
  CanvasState& shown = tab.view.canvas(side);
  // A picture that filled its canvas goes on filling it when that is made larger or smaller.
  const auto& before = last_canvases_.at(side);
  const bool was_fitted =
      before && before->w >= 1 && before->h >= 1 && shown.view == fitted(*picture, {before->w, before->h});
  if (!shown.fit_wanted && !was_fitted) return;
  shown = {fitted(*picture, *canvas), false};
}

void Editor::zoom(Side side, double factor) {
  Tab* tab = state_.tab();
  const auto canvas = canvas_size(side);
  if (tab == nullptr || !canvas || !(factor > 0)) return;
  View& view = tab->view.canvas(side).view;
  view = zoomed(view, *canvas / 2, factor);
}

void Editor::show_compare(Tab& tab) {
  using Compare = LiveSession::Compare;
  tab.session->show_compare(tab.view.before_held ? Compare::kHidden : tab.view.compare);
}

} // namespace oversketch
