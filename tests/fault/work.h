#pragma once

// An evening's work in small: what the process that is killed does, and what whoever looks afterwards knows it did.

#include "core/base/check.h"
#include "core/image/image_io.h"
#include "core/session/session.h"

#include "tests/support/documents.h"

namespace oversketch::testing {

inline constexpr int kWorkSteps = 400;
/// A save comes after every so many steps.
inline constexpr int kStepsPerSave = 3;

/// The same steps each time for one seed; one step is one more entry in the session's log.
class Work {
public:
  explicit Work(unsigned seed) : random_(seed) {
    DocumentNew begin;
    begin.target = ImageRef{"target.jpg", read_from_file(wavy_image(90, 80, 1))};
    (void)session_.execute(begin).ok();
  }

  Session& session() { return session_; }

  /// Makes one step.
  void go_on() {
    for (const std::size_t steps = session_.log().size(); session_.log().size() == steps;) {
      if (random_.below(8) == 0)
        (void)session_.undo().ok();
      else if (random_.below(10) == 0)
        (void)session_.redo().ok();
      else
        try_command();
    }
  }

private:
  /// What cannot be drawn is undone by hand: such documents cannot be saved.
  void try_command() {
    const Command command = random_.next();
    if (session_.preview(command) && session_.composite()) session_.commit_preview();
    session_.drop_preview();
  }

  /// As it comes out of a JPEG.
  static Image read_from_file(const Image& picture) {
    auto jpeg = encode_jpeg(picture);
    CHECK(jpeg, "a picture");
    auto image = decode_file(std::move(*jpeg));
    CHECK(image, "what was written");
    return std::move(*image);
  }

  RandomCommands random_;
  Session session_;
};

} // namespace oversketch::testing
