#pragma once

#include "ui/state/action.h"
#include "ui/theme/theme.h"
#include "ui/widgets/frame_reply.h"
#include "ui/widgets/widget_map.h"

namespace oversketch {

/// What every draw function is given besides its model.
struct DrawContext {
  const ThemeLook& look;
  WidgetMap& widgets;
  ActionSink& sink;
  FrameReply& reply;
  /// Seconds since the program began, the frame's time.
  double now_s = 0;
};

} // namespace oversketch
