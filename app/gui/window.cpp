#include "app/gui/window.h"

#include "app/gui/cursor_images.h"
#include "app/gui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <utility>

namespace oversketch::gui {
namespace {

std::string take_glfw_error() {
  const char* why = nullptr;
  glfwGetError(&why);
  return why != nullptr ? why : "no reason given";
}

Window& window_of(GLFWwindow* window) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void set_hints() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  // Nothing here needs them, and a software rasteriser clears them at every frame.
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "oversketch");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "oversketch");
}

bool is_modifier(int key) {
  return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

Modifiers to_modifiers(int mods) {
  return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

} // namespace

Result<std::unique_ptr<Window>> Window::open(const std::string& title, WindowSize size) {
  if (glfwInit() != GLFW_TRUE) return Error{"window.no-display", "no window can be opened: " + take_glfw_error(), ""};
  set_hints();
  GLFWwindow* handle = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (handle == nullptr) {
    Error error{"window.no-opengl",
                "Oversketch needs OpenGL 3.3, which this display does not offer (" + take_glfw_error() +
                    "). A driver for the graphics card, or Mesa's software drawing (libgl1-mesa-dri), may be missing",
                ""};
    glfwTerminate();
    return error;
  }
  glfwMakeContextCurrent(handle);
  glfwSwapInterval(1);
  auto window = std::unique_ptr<Window>(new Window(handle));
  window->title_ = title;
  return window;
}

Window::Window(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window_, this);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  double x = 0, y = 0;
  glfwGetCursorPos(window_, &x, &y);
  pointer_ = {x, y};
  install_callbacks();
  make_cursors();
}

Window::~Window() {
  for (GLFWcursor* cursor : cursors_)
    glfwDestroyCursor(cursor);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::install_callbacks() {
  using Kind = RawEvent::Kind;
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) { window_of(w).push_move(x, y); });
  glfwSetMouseButtonCallback(
      window_, [](GLFWwindow* w, int button, int action, int mods) { window_of(w).push_button(button, action, mods); });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    RawEvent raw;
    raw.event.scroll = {x, y};
    window_of(w).push(Kind::kWheel, InputEvent::Kind::kWheel, raw);
  });
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    window_of(w).push_key(key, scancode, action, mods);
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned int character) {
    RawEvent raw;
    raw.code = static_cast<int>(character);
    window_of(w).push(Kind::kText, InputEvent::Kind::kMove, raw);
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    RawEvent raw;
    raw.action = entered;
    window_of(w).push(Kind::kEnter, InputEvent::Kind::kMove, raw);
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    RawEvent raw;
    raw.action = focused;
    window_of(w).modifiers_ = {};
    window_of(w).push(Kind::kFocus, InputEvent::Kind::kFocusLost, raw);
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    // The pointer's events pause during a drag from another window: here its place must be asked for.
    double x = 0, y = 0;
    glfwGetCursorPos(w, &x, &y);
    window_of(w).drops_.push_back({{paths, paths + count}, {x, y}});
    window_of(w).redraw_asked_ = true;
  });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
    glfwSetWindowShouldClose(w, GLFW_FALSE);
    window_of(w).close_asked_ = window_of(w).redraw_asked_ = true;
  });
  const auto redraw = [](GLFWwindow* w) { window_of(w).redraw_asked_ = true; };
  glfwSetWindowRefreshCallback(window_, redraw);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { window_of(w).redraw_asked_ = true; });
  glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { window_of(w).redraw_asked_ = true; });
  glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { window_of(w).redraw_asked_ = true; });
}

void Window::push(RawEvent::Kind kind, InputEvent::Kind event_kind, RawEvent raw) {
  raw.kind = kind;
  raw.event.kind = event_kind;
  raw.event.position = pointer_;
  raw.event.time_s = now_s();
  raw.event.modifiers = modifiers_;
  input_.push(raw);
}

void Window::push_move(double x, double y) {
  pointer_ = {x, y};
  push(RawEvent::Kind::kMove, InputEvent::Kind::kMove, {});
}

void Window::push_button(int button, int action, int mods) {
  if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
  modifiers_ = to_modifiers(mods);
  RawEvent raw;
  raw.code = button;
  raw.action = action;
  raw.mods = mods;
  raw.event.button = button == GLFW_MOUSE_BUTTON_RIGHT    ? MouseButton::kRight
                     : button == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::kMiddle
                                                          : MouseButton::kLeft;
  push(RawEvent::Kind::kButton, action == GLFW_PRESS ? InputEvent::Kind::kPress : InputEvent::Kind::kRelease, raw);
}

void Window::push_key(int key, int scancode, int action, int mods) {
  RawEvent raw;
  raw.code = key;
  raw.scancode = scancode;
  raw.action = action;
  raw.mods = mods;
  raw.event.key = to_key(key, scancode);
  // On X11 a modifier's own event tells of the modifiers before it.
  if (!is_modifier(key)) modifiers_ = to_modifiers(mods);
  if (raw.event.key == Key::kShift) modifiers_.shift = action != GLFW_RELEASE;
  if (raw.event.key == Key::kCtrl) modifiers_.ctrl = action != GLFW_RELEASE;
  if (raw.event.key == Key::kAlt) modifiers_.alt = action != GLFW_RELEASE;
  push(RawEvent::Kind::kKey,
       action == GLFW_PRESS    ? InputEvent::Kind::kKeyDown
       : action == GLFW_REPEAT ? InputEvent::Kind::kKeyRepeat
                               : InputEvent::Kind::kKeyUp,
       raw);
}

void Window::wait(double seconds) {
  if (seconds <= 0)
    glfwPollEvents();
  else if (std::isinf(seconds))
    glfwWaitEvents();
  else
    glfwWaitEventsTimeout(seconds);
}

void Window::wake() {
  glfwPostEmptyEvent();
}

double Window::now_s() {
  return glfwGetTime();
}

std::vector<DroppedFiles> Window::take_drops() {
  return std::exchange(drops_, {});
}

bool Window::take_close_request() {
  return std::exchange(close_asked_, false);
}

bool Window::take_redraw_request() {
  return std::exchange(redraw_asked_, false);
}

WindowSize Window::size() const {
  WindowSize size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return size;
}

WindowSize Window::picture_size() const {
  WindowSize size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  // Where the system itself magnifies the window, its pixels are already larger.
  const int width = size().width;
  const float magnified = width > 0 ? static_cast<float>(picture_size().width) / static_cast<float>(width) : 1;
  return magnified > 0 ? x / magnified : x;
}

bool Window::is_hidden() const {
  const WindowSize picture = picture_size();
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE || picture.width <= 0 || picture.height <= 0;
}

void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void Window::make_cursors() {
  const auto at = [&](CursorShape shape) -> GLFWcursor*& { return cursors_[static_cast<std::size_t>(shape)]; };
  at(CursorShape::kArrow) = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
  at(CursorShape::kText) = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
  at(CursorShape::kCross) = glfwCreateStandardCursor(GLFW_CROSSHAIR_CURSOR);
  at(CursorShape::kHand) = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
  at(CursorShape::kResizeEw) = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
  at(CursorShape::kResizeNs) = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
  for (const CursorShape shape :
       {CursorShape::kGrab, CursorShape::kMove, CursorShape::kResizeNwse, CursorShape::kResizeNesw}) {
    CursorImage image = draw_cursor(shape, content_scale());
    const GLFWimage pixels = {image.side, image.side, image.rgba.data()};
    at(shape) = glfwCreateCursor(&pixels, image.side / 2, image.side / 2);
  }
}

void Window::set_cursor(CursorShape shape) {
  if (shape == cursor_) return;
  cursor_ = shape;
  const bool hidden = shape == CursorShape::kNone;
  glfwSetInputMode(window_, GLFW_CURSOR, hidden ? GLFW_CURSOR_HIDDEN : GLFW_CURSOR_NORMAL);
  if (!hidden) glfwSetCursor(window_, cursors_[static_cast<std::size_t>(shape)]);
}

void Window::show_picture() {
  glfwSwapBuffers(window_);
}

} // namespace oversketch::gui
