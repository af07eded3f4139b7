#include "app/gui/frame_loop.h"

#include "app/gui/zenity_dialog.h"
#include "core/image/image_io.h"
#include "ui/editor_window.h"
#include "ui/render/screen.h"

#include <imgui.h>

#include <algorithm>
#include <limits>

namespace oversketch::gui {
namespace {

/// Dear ImGui lays out anew over some passes; hovering shows in the pass after.
constexpr int kPassesAfterChange = 3;
/// How often the progress of work is shown.
constexpr double kProgress_s = 0.1;

LoadedPreferences load_user_preferences() {
  return load_preferences(settings_path());
}

/// Without a home nothing is kept against a crash.
std::filesystem::path find_state_folder() {
  const auto folder = default_state_folder();
  return folder ? *folder : std::filesystem::path();
}

} // namespace

FrameLoop::FrameLoop(Options options, std::filesystem::path assets, Window& window)
    : options_(std::move(options)),
      assets_(std::move(assets)),
      window_(window),
      keeper_(settings_path()),
      imgui_(window),
      editor_({.assets = assets_,
               .preferences = load_user_preferences().preferences,
               .wake =
                   [this] {
                     changed_ = true;
                     Window::wake();
                   },
               .keep_preferences = [this](const Preferences& p) { keeper_.keep(p); },
               .state_folder = find_state_folder()}),
      window_state_(
          [this] {
            changed_ = true;
            Window::wake();
          },
          std::make_unique<ZenityDialog>(), assets_ / "samples"),
      termination_([this] {
        told_to_end_ = true;
        Window::wake();
      }) {
  if (options_.ui_map) map_.emplace(*options_.ui_map);
}

FrameLoop::~FrameLoop() = default;

void FrameLoop::open_what_was_asked() {
  if (const auto loaded = load_user_preferences(); loaded.problem)
    editor_.perform(action::Say{to_line(*loaded.problem)});
  if (options_.sample) editor_.perform(action::OpenSample{});
  for (const auto& file : options_.files)
    editor_.perform(action::Open{file});
  if (options_.script) {
    const auto folder = options_.script->parent_path();
    editor_.run_script_in_tab(*options_.script, options_.out.value_or(folder.empty() ? "." : folder));
  }
}

float FrameLoop::scale() const {
  const float display = options_.scale.value_or(window_.content_scale());
  return std::clamp(display * static_cast<float>(editor_.state().preferences.ui_scale), 0.5f, 8.0f);
}

double FrameLoop::wait_time() const {
  if (passes_due_ > 0 || !window_.input().empty() || changed_) return 0;
  double wait = reply_.next_frame_s - Window::now_s();
  if (editor_.busy()) wait = std::min(wait, kProgress_s);
  const EditorState& state = editor_.state();
  if (!state.said.empty() && state.said_until > Window::now_s())
    wait = std::min(wait, state.said_until - Window::now_s());
  // Never exactly nothing: a time that has just come is seen by the next look at the clock.
  return std::max(wait, 0.001);
}

bool FrameLoop::gather() {
  const bool busy = editor_.busy();
  const bool line_shown = editor_.state().said_until > Window::now_s();
  const double before = Window::now_s();
  window_.wait(wait_time());
  batch_ = reply_.field_awaits_keys ? std::vector<RawEvent>() : window_.input().take_batch();
  events_ += batch_.size();
  if (!batch_.empty()) pointer_ = batch_.back().event.position;
  const bool line_ended = line_shown && editor_.state().said_until <= Window::now_s();
  const bool time_came = reply_.next_frame_s > before && reply_.next_frame_s <= Window::now_s();
  const bool asked = window_.take_redraw_request();
  if (changed_.exchange(false) || asked || !batch_.empty() || line_ended || time_came)
    passes_due_ = std::max(passes_due_, kPassesAfterChange);
  if (busy || reply_.field_awaits_keys) passes_due_ = std::max(passes_due_, 1);
  return passes_due_ > 0;
}

void FrameLoop::take_drops() {
  for (const DroppedFiles& drop : window_.take_drops()) {
    const auto& target = reply_.canvases.target;
    const bool on_target = target && drop.position.x >= target->x && drop.position.x < target->x + target->w &&
                           drop.position.y >= target->y && drop.position.y < target->y + target->h;
    for (const auto& path : drop.paths) {
      if (on_target && kind_of_file(path) == FileKind::kPicture)
        sink_.emit(action::AddSource{path});
      else
        sink_.emit(action::Open{path});
    }
  }
}

void FrameLoop::carry_out() {
  take_drops();
  if (window_.take_close_request()) sink_.emit(action::Quit{});
  auto actions = sink_.take();
  if (!actions.empty()) passes_due_ = kPassesAfterChange;
  editor_.perform_all(std::move(actions));
  std::vector<const LiveSession*> sessions;
  for (const Tab& tab : editor_.state().tabs)
    sessions.push_back(tab.session.get());
  pictures_.keep_results(sessions);
  for (const Error& problem : editor_.take_problems())
    if (!first_problem_) first_problem_ = problem;
  if (const auto problem = keeper_.take_problem()) editor_.perform(action::Say{to_line(*problem)});
}

std::string FrameLoop::title() const {
  const Tab* tab = editor_.state().tab();
  if (tab == nullptr) return "Oversketch";
  return tab->name + (tab->read_only ? " (read only)" : "") + (tab->session->snapshot()->modified ? " *" : "") +
         " – Oversketch";
}

Result<void> FrameLoop::set_look() {
  return imgui_.set_look(editor_.state().preferences.theme, scale(), assets_);
}

Result<void> FrameLoop::lay_out() {
  if (auto set = set_look(); !set) return set;
  widgets_ = {};
  reply_ = {};
  pictures_.begin_frame();
  if (const Tab* tab = editor_.state().tab()) pictures_.update_result(*tab->session);
  times_.spent_on(FramePart::kUpload);
  imgui_.begin_frame(batch_);
  // The window may have been given another size meanwhile.
  const ImVec2 now = ImGui::GetIO().DisplaySize;
  if (const Point size{now.x, now.y}; size != size_) {
    size_ = size;
    passes_due_ = kPassesAfterChange;
  }
  const DrawContext context = {imgui_.look(), widgets_, sink_, reply_, Window::now_s()};
  draw_editor_window(editor_.state(), window_state_, pictures_, to_events(batch_), context);
  window_.set_cursor(reply_.cursor.value_or(imgui_.cursor()));
  window_.set_title(title());
  times_.spent_on(FramePart::kLayout);
  batch_.clear();
  --passes_due_;
  return {};
}

Result<void> FrameLoop::draw() {
  // Panels settle before anything is drawn: where there is no graphics hardware, drawing is most of the work.  What
  // asks for more each time does not keep the frame from being seen.
  for (int pass = 0;; ++pass) {
    if (auto laid_out = lay_out(); !laid_out) return laid_out;
    const bool settled = passes_due_ <= 0 && sink_.pending().empty();
    if (settled || pass == kPassesAfterChange || pictures_.wants_frame()) break;
    imgui_.drop_frame();
    carry_out();
    editor_.update(reply_.canvases, Window::now_s());
    times_.spent_on(FramePart::kState);
  }
  imgui_.end_frame();
  times_.spent_on(FramePart::kDraw);
  if (pictures_.wants_frame()) passes_due_ = std::max(passes_due_, 1);
  return write_map(widgets_, reply_);
}

Result<void> FrameLoop::write_map(const WidgetMap& widgets, const FrameReply& reply) {
  if (!map_) return {};
  const EditorState& state = editor_.state();
  const ShownFrame frame = {.widgets = widgets,
                            .canvases = reply.canvases,
                            .title = title(),
                            .status = reply.status,
                            .busy = editor_.busy() || passes_due_ > 0 || !sink_.pending().empty() ||
                                    !window_.input().empty(),
                            .wants_text = ImGui::GetIO().WantTextInput,
                            .pointer = pointer_,
                            .events = events_,
                            .window = {0, 0, static_cast<float>(size_.x), static_cast<float>(size_.y)}};
  return map_->write(print_ui_map(state, frame));
}

Result<void> FrameLoop::take_screenshot() const {
  const Raster<Rgba8> pixels = imgui_.read_last_frame();
  Raster<Rgba> picture(pixels.width(), pixels.height());
  std::ranges::transform(pixels.values(), picture.values().begin(), [](const Rgba8& p) {
    return Rgba{static_cast<float>(p.r) / 255, static_cast<float>(p.g) / 255, static_cast<float>(p.b) / 255, 1};
  });
  return save_image(Image(std::move(picture)), *options_.screenshot);
}

Result<void> FrameLoop::settle() {
  if (editor_.busy() || changed_ || passes_due_ > 0 || !window_.input().empty()) return {};
  if (options_.screenshot && !screenshot_taken_) {
    screenshot_taken_ = true;
    if (auto taken = take_screenshot(); !taken) return taken;
  }
  if (options_.exit_when_idle) ended_ = true;
  return {};
}

Result<void> FrameLoop::run() {
  // Letters are drawn before anything waits for a frame.
  if (auto set = set_look(); !set) return set;
  open_what_was_asked();
  while (!ended_) {
    const bool draws = gather();
    times_.skip();
    editor_.update(reply_.canvases, Window::now_s());
    times_.spent_on(FramePart::kState);
    if (draws && window_.is_hidden()) {
      // Nothing is seen; keys and clicks do not come either.
      passes_due_ = 0;
      batch_.clear();
    } else if (draws) {
      if (auto drawn = draw(); !drawn) return drawn;
    }
    carry_out();
    times_.spent_on(FramePart::kState);
    if (draws && options_.frame_times) times_.end_frame();
    if (auto settled = settle(); !settled) return settled;
    if (editor_.wants_to_quit() || told_to_end_) ended_ = true;
  }
  if (options_.record)
    if (auto recorded = editor_.record_front(*options_.record); !recorded) return recorded;
  if (options_.frame_times)
    if (auto written = times_.write(*options_.frame_times); !written) return written;
  if (!told_to_end_) editor_.leave();
  if (options_.exit_when_idle && first_problem_) return *first_problem_;
  return {};
}

} // namespace oversketch::gui
