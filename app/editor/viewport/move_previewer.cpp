#include "app/editor/viewport/move_previewer.h"

#include <utility>

namespace dollytrack::editor {

void MovePreviewer::follow(const std::optional<planning::MoveRequest>& move,
                           const PlanOutcome& shown) {
    if (!move) {
        if (move_) worker_.cancel();
        move_.reset();
        preview_.reset();
        error_.reset();
        drag_.reset();
        note_.clear();
        return;
    }
    if (move_ != move || serial_ != shown.serial) {
        // The path of another kind of move, or around another object, would have wrong handles.
        const bool same_subject =
            move_ && move_->kind == move->kind && move_->object_id == move->object_id;
        if (!same_subject) {
            preview_.reset();
            drag_.reset();
        }
        move_ = move;
        serial_ = shown.serial;
        worker_.make(*move, {}, shown);
    }
    take();
}

void MovePreviewer::take() {
    std::optional<Result<MotionWorker::Outcome>> outcome = worker_.take();
    if (!outcome) return;
    error_.reset();
    note_.clear();
    if (!*outcome) {
        if (outcome->error().code != ErrorCode::Cancelled) error_ = outcome->error();
        return;
    }
    ui::MovePreview preview;
    for (const MotionFrame& frame : (*outcome)->motion.frames) {
        preview.path.push_back(frame.pose.position);
    }
    preview.look_at = (*outcome)->look_at;
    preview.floor_z = (*outcome)->floor_z;
    preview.has_subject = move_->object_id.has_value() || move_->options.contains("target");
    preview_ = std::move(preview);
    note_ = (*outcome)->note;
}

bool MovePreviewer::takesMouse(const ui::GizmoView& view) const {
    return dragging() || (move_ && preview_ && ui::isOnMoveHandle(view, *move_, *preview_));
}

std::optional<planning::MoveOptions> MovePreviewer::draw(const ui::GizmoView& view,
                                                         ui::MoveDraft& draft) {
    if (!move_ || !preview_) return std::nullopt;
    planning::MoveRequest move = draft.request();
    const bool changed = ui::drawMoveHandles(view, *preview_, move, drag_);
    const bool first = changed && !drag_changed_;
    drag_changed_ = drag_ && (drag_changed_ || changed);
    if (!changed) return std::nullopt;
    std::swap(draft.options[draft.kind], move.options);
    return first ? std::optional(std::move(move.options)) : std::nullopt;
}

bool MovePreviewer::cancelDrag(ui::MoveDraft& draft) {
    if (!drag_) return false;
    draft.options[draft.kind] = drag_->move.options;
    drag_.reset();
    return std::exchange(drag_changed_, false);
}

}  // namespace dollytrack::editor
