#pragma once

#include "app/editor/project/motion_worker.h"
#include "ui/panels/edits/move_form.h"
#include "ui/viewport/move_handles.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// Makes the camera move of the form in the background whenever it changes, and shows its path in
/// the viewport, with handles that set the form's options.
class MovePreviewer {
  public:
    explicit MovePreviewer(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Call once per window frame with the camera move of the form, or nullopt to remove the
    /// preview.
    void follow(const std::optional<planning::MoveRequest>& move, const PlanOutcome& shown);

    /// Whether a handle takes the mouse in this window frame.
    [[nodiscard]] bool takesMouse(const ui::GizmoView& view) const;
    [[nodiscard]] bool dragging() const { return drag_.has_value(); }
    /// Draws the path and its handles, which change the options of the form. At the first change of
    /// a drag, returns the options before it.
    std::optional<planning::MoveOptions> draw(const ui::GizmoView& view, ui::MoveDraft& draft);
    /// Ends a drag and restores the options before it. Returns whether it had changed them.
    bool cancelDrag(ui::MoveDraft& draft);

    /// The move on the screen, which may be older than the form; null: none.
    [[nodiscard]] const ui::MovePreview* preview() const { return preview_ ? &*preview_ : nullptr; }
    /// How obstacles change the move; empty: not at all.
    [[nodiscard]] const std::string& note() const { return note_; }
    /// Why the move cannot be made; null: it can.
    [[nodiscard]] const Error* error() const { return error_ ? &*error_ : nullptr; }

  private:
    void take();

    MotionWorker worker_;
    std::optional<planning::MoveRequest> move_;  // the last move requested from the worker
    std::uint64_t serial_ = 0;                   // of the plan for which it was requested
    std::optional<ui::MovePreview> preview_;
    std::string note_;
    std::optional<Error> error_;
    std::optional<ui::MoveDrag> drag_;
    bool drag_changed_ = false;  // whether the current drag has changed the options
};

}  // namespace dollytrack::editor
