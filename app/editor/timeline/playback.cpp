#include "app/editor/timeline/playback.h"

#include <algorithm>

namespace dollytrack::editor {

void Playback::setFrameCount(int count) {
    count_ = count;
    goTo(frame_);
}

void Playback::goTo(int frame) {
    frame_ = std::clamp(frame, 0, std::max(count_ - 1, 0));
}

void Playback::toggle() {
    if (playing()) return clock_.stop();
    clock_.start();
    if (frame_ + 1 >= count_) frame_ = 0;
}

void Playback::reset() {
    frame_ = 0;
    clock_.stop();
}

void Playback::advance(double frames, bool loop) {
    if (count_ < 2) return clock_.stop();
    const int next = frame_ + clock_.advance(frames);
    if (next < count_ || loop) {
        frame_ = next % count_;
    } else {
        frame_ = count_ - 1;
        clock_.stop();
    }
}

}  // namespace dollytrack::editor
