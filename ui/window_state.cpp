#include "ui/window_state.h"

#include "ui/panels/window_parts.h"

namespace oversketch {

WindowState::WindowState(std::function<void()> wake, std::unique_ptr<SystemDialog> system,
                         std::filesystem::path samples)
    : parts_(std::make_unique<Parts>(wake, std::move(system), std::move(samples))) {}

WindowState::~WindowState() = default;

} // namespace oversketch
