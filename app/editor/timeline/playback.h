#pragma once

#include "app/editor/timeline/play_clock.h"

namespace dollytrack::editor {

/// The frame of the trajectory that is looked at, by hand or while it plays.
class Playback {
  public:
    [[nodiscard]] int frame() const { return frame_; }
    [[nodiscard]] bool playing() const { return clock_.runs(); }
    [[nodiscard]] int frameCount() const { return count_; }

    /// Another trajectory; the frame stays where it has as many.
    void setFrameCount(int count);
    void goTo(int frame);
    /// From the beginning where it stands at the end.
    void toggle();
    /// Back to the first frame, at rest.
    void reset();
    /// Moves on after `frames` more, a fraction mostly. Stops at the end, or begins again.
    void advance(double frames, bool loop);

  private:
    int count_ = 0;
    int frame_ = 0;
    PlayClock clock_;
};

}  // namespace dollytrack::editor
