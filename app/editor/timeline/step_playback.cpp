#include "app/editor/timeline/step_playback.h"

namespace dollytrack::editor {

void StepPlayback::toggle(const Next& next) {
    if (playing()) return clock_.stop();
    clock_.start();
    if (!next(taken_)) taken_ = 0;
}

void StepPlayback::advance(double steps, const Next& next) {
    for (int due = clock_.advance(steps); due > 0; --due) {
        const std::optional<std::size_t> stop = next(taken_);
        if (!stop) return clock_.stop();
        taken_ = *stop;
    }
}

}  // namespace dollytrack::editor
