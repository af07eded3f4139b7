#include "tests/gui/hand.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>

#include <cmath>
#include <sstream>

namespace oversketch::testing {
namespace {

std::string class_of(Display* display, Window window) {
  XClassHint hint = {};
  if (XGetClassHint(display, window, &hint) == 0) return "";
  std::string name = hint.res_class;
  XFree(hint.res_name);
  XFree(hint.res_class);
  return name;
}

Window find_editor(Display* display, Window below) {
  Window root = 0, parent = 0, *children = nullptr, found = 0;
  unsigned count = 0;
  if (class_of(display, below) == "oversketch") return below;
  if (XQueryTree(display, below, &root, &parent, &children, &count) == 0) return 0;
  for (unsigned i = 0; i < count && found == 0; ++i)
    found = find_editor(display, children[i]);
  if (children != nullptr) XFree(children);
  return found;
}

KeySym symbol_of(const std::string& name) {
  if (name == "ctrl") return XK_Control_L;
  if (name == "shift") return XK_Shift_L;
  if (name == "alt") return XK_Alt_L;
  return XStringToKeysym(name.c_str());
}

/// X's name of the key that writes a character.
std::string key_name(char character) {
  switch (character) {
  case ' ':
    return "space";
  case '.':
    return "period";
  case '/':
    return "slash";
  case '-':
    return "minus";
  case '_':
    return "underscore";
  case ',':
    return "comma";
  default:
    return {character};
  }
}

} // namespace

struct Hand::State {
  Display* display = nullptr;
  Window window = 0;
  int x = 0;
  int y = 0;
  Point place;

  void key(KeySym symbol, bool down) {
    XTestFakeKeyEvent(display, XKeysymToKeycode(display, symbol), down ? True : False, CurrentTime);
    XFlush(display);
  }
};

Hand::Hand(const std::string& display) : state_(std::make_unique<State>()) {
  state_->display = XOpenDisplay(display.c_str());
}

Hand::~Hand() {
  if (state_->display != nullptr) XCloseDisplay(state_->display);
}

bool Hand::find_window() {
  if (state_->display == nullptr) return false;
  const Window root = DefaultRootWindow(state_->display);
  state_->window = find_editor(state_->display, root);
  Window child = 0;
  return state_->window != 0 &&
         XTranslateCoordinates(state_->display, state_->window, root, 0, 0, &state_->x, &state_->y, &child) == True;
}

void Hand::move(Point to) {
  state_->place = {std::round(to.x), std::round(to.y)};
  XTestFakeMotionEvent(state_->display, -1, state_->x + static_cast<int>(state_->place.x),
                       state_->y + static_cast<int>(state_->place.y), CurrentTime);
  XFlush(state_->display);
}

void Hand::press(int button) {
  XTestFakeButtonEvent(state_->display, static_cast<unsigned>(button), True, CurrentTime);
  XFlush(state_->display);
}

void Hand::release(int button) {
  XTestFakeButtonEvent(state_->display, static_cast<unsigned>(button), False, CurrentTime);
  XFlush(state_->display);
}

void Hand::wheel(int steps) {
  const int button = steps > 0 ? 4 : 5;
  for (int i = 0; i < std::abs(steps); ++i) {
    press(button);
    release(button);
  }
}

void Hand::click(Point at, int button) {
  move(at);
  press(button);
  release(button);
}

void Hand::draw(const Points& points) {
  move(points.front());
  press();
  for (const Point p : points)
    move(p);
  release();
}

void Hand::hold(const std::string& key) {
  state_->key(symbol_of(key), true);
}

void Hand::let_go(const std::string& key) {
  state_->key(symbol_of(key), false);
}

void Hand::key(const std::string& chord) {
  std::istringstream parts(chord);
  std::vector<std::string> keys;
  for (std::string part; std::getline(parts, part, '+');)
    keys.push_back(part);
  for (const std::string& name : keys)
    hold(name);
  for (auto name = keys.rbegin(); name != keys.rend(); ++name)
    let_go(*name);
}

void Hand::type(const std::string& text) {
  for (const char character : text) {
    const bool shifted = (character >= 'A' && character <= 'Z') || character == '_';
    key((shifted ? "shift+" : "") + key_name(character));
  }
}

Point Hand::place() const {
  return state_->place;
}

void Hand::ask_to_close() {
  XEvent event = {};
  event.xclient.type = ClientMessage;
  event.xclient.window = state_->window;
  event.xclient.message_type = XInternAtom(state_->display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(state_->display, "WM_DELETE_WINDOW", False));
  event.xclient.data.l[1] = CurrentTime;
  XSendEvent(state_->display, state_->window, False, NoEventMask, &event);
  XFlush(state_->display);
}

void Hand::resize(int width, int height) {
  XResizeWindow(state_->display, state_->window, static_cast<unsigned>(width), static_cast<unsigned>(height));
  XFlush(state_->display);
}

} // namespace oversketch::testing
