#include "app/gui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace oversketch::gui {
namespace {

Key to_named_key(int key) {
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12)
    return static_cast<Key>(static_cast<int>(Key::kF1) + key - GLFW_KEY_F1);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return key_of(static_cast<char>('0' + key - GLFW_KEY_KP_0));
  switch (key) {
  case GLFW_KEY_ESCAPE:
    return Key::kEscape;
  case GLFW_KEY_ENTER:
  case GLFW_KEY_KP_ENTER:
    return Key::kEnter;
  case GLFW_KEY_TAB:
    return Key::kTab;
  case GLFW_KEY_BACKSPACE:
    return Key::kBackspace;
  case GLFW_KEY_DELETE:
    return Key::kDelete;
  case GLFW_KEY_LEFT:
    return Key::kLeft;
  case GLFW_KEY_RIGHT:
    return Key::kRight;
  case GLFW_KEY_UP:
    return Key::kUp;
  case GLFW_KEY_DOWN:
    return Key::kDown;
  case GLFW_KEY_HOME:
    return Key::kHome;
  case GLFW_KEY_END:
    return Key::kEnd;
  case GLFW_KEY_PAGE_UP:
    return Key::kPageUp;
  case GLFW_KEY_PAGE_DOWN:
    return Key::kPageDown;
  case GLFW_KEY_SPACE:
    return Key::kSpace;
  case GLFW_KEY_LEFT_SHIFT:
  case GLFW_KEY_RIGHT_SHIFT:
    return Key::kShift;
  case GLFW_KEY_LEFT_CONTROL:
  case GLFW_KEY_RIGHT_CONTROL:
    return Key::kCtrl;
  case GLFW_KEY_LEFT_ALT:
  case GLFW_KEY_RIGHT_ALT:
    return Key::kAlt;
  case GLFW_KEY_KP_ADD:
    return key_of('+');
  case GLFW_KEY_KP_SUBTRACT:
    return key_of('-');
  default:
    return Key::kNone;
  }
}

} // namespace

Key to_key(int glfw_key, int scancode) {
  if (const Key named = to_named_key(glfw_key); named != Key::kNone) return named;
  // Digits by their place: some layouts write them with Shift.
  if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return key_of(static_cast<char>(glfw_key));
  const char* name = glfwGetKeyName(glfw_key, scancode);
  const bool one_character = name != nullptr && name[0] > ' ' && name[0] < 127 && name[1] == 0;
  if (one_character) return key_of(name[0] >= 'a' && name[0] <= 'z' ? static_cast<char>(name[0] - 'a' + 'A') : name[0]);
  // A layout of another alphabet: the place of the key on the common one.
  return glfw_key > ' ' && glfw_key < 127 ? key_of(static_cast<char>(glfw_key)) : Key::kNone;
}

} // namespace oversketch::gui
