#pragma once

#include "engine/document/project_state.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack {

/// Undo and redo by snapshots: each step holds the whole state, so undoing restores exactly what
/// was there. States are shared pointers, so stepping copies none.
class CommandStack {
  public:
    using State = std::shared_ptr<const ProjectState>;
    struct Step {
        std::string name;
        State state;
    };
    /// All steps, beginning with the initial state, and the index of the current one. Cheap to
    /// copy.
    struct History {
        std::vector<Step> steps;
        std::size_t position = 0;
    };

    explicit CommandStack(ProjectState initial = {});

    /// Appends a step with a new state. Steps that were undone are discarded. A state equal to the
    /// current one adds no step. A step with the same non-empty merge key as the last step replaces
    /// it, so that dragging a slider makes one step; endMerge() ends the drag.
    void push(std::string name, ProjectState next, std::string merge_key = {});
    void endMerge() { merge_key_.clear(); }

    [[nodiscard]] const State& state() const { return history_.steps[history_.position].state; }
    [[nodiscard]] bool canUndo() const { return history_.position > 0; }
    [[nodiscard]] bool canRedo() const { return history_.position + 1 < history_.steps.size(); }
    [[nodiscard]] std::string undoName() const;  // empty when there is nothing to undo
    [[nodiscard]] std::string redoName() const;

    /// Returns the new current state; the unchanged one if there is nothing to undo or redo.
    const State& undo();
    const State& redo();

    /// For a history panel: the names of all steps, beginning with the initial state; the index of
    /// the current step; and a jump to any step.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] std::size_t position() const { return history_.position; }
    const State& goTo(std::size_t position);

    /// Returns to the steps of an earlier moment, as if nothing had been pushed since: for a drag
    /// that is cancelled. Steps that had been undone then can be redone again.
    const State& rewind(History earlier);

    /// Marks the current state as saved. isSaved() compares states, so it is true again after
    /// undoing back to the saved state.
    void markSaved() { saved_ = state(); }
    /// Marks an earlier state as saved: the one that was handed to the writer while editing went
    /// on.
    void markSaved(State state) { saved_ = std::move(state); }
    /// Marks no state as saved.
    void markUnsaved() { saved_.reset(); }
    [[nodiscard]] bool isSaved() const;

    /// Discards all steps and starts with the state of another project, which counts as saved.
    void reset(ProjectState initial);

    [[nodiscard]] const History& history() const { return history_; }
    /// Replaces all steps by those of an earlier run of the program: at least one step, and an
    /// index within them. No state counts as saved.
    void restore(History history);

  private:
    History history_;
    std::string merge_key_;
    State saved_;
};

}  // namespace dollytrack
