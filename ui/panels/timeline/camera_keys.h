#pragma once

#include "ui/panels/timeline/frame_axis.h"
#include "ui/panels/timeline/timeline_panel.h"

namespace dollytrack::ui {

/// The row of the timeline with the keys of a given camera motion.
struct CameraKeyRow {
    float top = 0.0F;  // px on the screen
    float bottom = 0.0F;
    // Of the widget that covers the timeline.
    bool hovered = false;
    bool active = false;
};

[[nodiscard]] bool hasCameraKeys(const TimelineView& view);

/// Frames of room after the trajectory, so that the last key can be dragged to a later time; 0
/// without camera keys.
[[nodiscard]] double cameraKeyMargin(const TimelineView& view);

/// The time to which a camera key may be moved that is nearest to `time_s`: a multiple of the frame
/// interval, between the keys before and after it.
[[nodiscard]] double keyTimeNear(const TimelineView& view, int key, double time_s);

/// Selecting, dragging and double-clicking camera keys. Returns whether the mouse is on one or
/// drags one, so that it does not select frames.
bool editCameraKeys(const TimelineView& view, const FrameAxis& axis, const CameraKeyRow& row,
                    TimelineState& state, TimelineActions& actions);

/// Draws the keys at their times, and where they are passed if that is another time; and the
/// tooltip of the key under the mouse.
void drawCameraKeys(const TimelineView& view, const TimelineState& state, const FrameAxis& axis,
                    const CameraKeyRow& row);

}  // namespace dollytrack::ui
