#pragma once

#include "app/gui/input_queue.h"

#include "core/base/result.h"
#include "ui/widgets/frame_reply.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

struct GLFWcursor;
struct GLFWwindow;

namespace oversketch::gui {

/// Files that were dropped onto the window, and where.
struct DroppedFiles {
  std::vector<std::filesystem::path> paths;
  Point position;
};

struct WindowSize {
  int width = 0;
  int height = 0;
  bool operator==(const WindowSize&) const = default;
};

/// The window and all that the system tells of it: the only place that calls GLFW, besides Dear ImGui's backend.
/// @threads the main thread's, wake() apart.
class Window {
public:
  /// Opens a window with OpenGL 3.3.
  /// @errors window.no-display, window.no-opengl.
  static Result<std::unique_ptr<Window>> open(const std::string& title, WindowSize size);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits until something happens, or for so long; takes all that has happened into the queue.
  /// @param seconds  0 or less: does not wait; infinite: for ever.
  void wait(double seconds);
  /// Ends a wait.
  /// @threads any.
  static void wake();
  /// Seconds since the program began: the frame clock.
  static double now_s();

  InputQueue& input() { return input_; }
  std::vector<DroppedFiles> take_drops();
  /// Whether the window was asked to close since the last call.
  bool take_close_request();
  /// Whether it was resized, uncovered, or anything happened that is to be seen, since the last call.
  bool take_redraw_request();

  /// Window pixels, and those of its picture.
  WindowSize size() const;
  WindowSize picture_size() const;
  /// Window pixels per design pixel, as the display has it.
  float content_scale() const;
  /// Iconified, or of no size: nothing is to be drawn.
  bool is_hidden() const;

  void set_title(const std::string& title);
  void set_cursor(CursorShape shape);
  void show_picture();

  GLFWwindow* handle() const { return window_; }

private:
  explicit Window(GLFWwindow* window);
  void install_callbacks();
  void make_cursors();
  void push_move(double x, double y);
  void push_button(int button, int action, int mods);
  void push_key(int key, int scancode, int action, int mods);
  void push(RawEvent::Kind kind, InputEvent::Kind event_kind, RawEvent raw);

  GLFWwindow* window_;
  InputQueue input_;
  std::vector<DroppedFiles> drops_;
  Point pointer_;
  Modifiers modifiers_;
  bool close_asked_ = false;
  bool redraw_asked_ = true;
  std::string title_;
  CursorShape cursor_ = CursorShape::kArrow;
  std::array<GLFWcursor*, 11> cursors_{};
};

} // namespace oversketch::gui
