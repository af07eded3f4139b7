#include "ui/window_state.h"

#include "ui/panels/window_parts.h"

namespace oversketch {

WindowState::WindowState(std::function<void()> wake, std::unique_ptr<SystemDialog> system)
    : parts_(std::make_unique<Parts>()) {
  parts_->wake = std::move(wake);
  parts_->system = std::move(system);
}

WindowState::~WindowState() = default;

} // namespace oversketch
