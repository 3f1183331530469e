#pragma once

#include "engine/document/project_state.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack {

/// Undo and redo as snapshots: each step holds the whole state, so that going back cannot differ
/// from what was there. States are shared, never copied when stepping.
class CommandStack {
  public:
    using State = std::shared_ptr<const ProjectState>;
    struct Step {
        std::string name;
        State state;
    };
    /// All steps, the first that of the initial state, and where in them one is. Cheap to copy.
    struct History {
        std::vector<Step> steps;
        std::size_t position = 0;
    };

    explicit CommandStack(ProjectState initial = {});

    /// The state after a new step; what could be redone is forgotten. Equal states make no step. A
    /// step with the same non-empty merge key as the last one replaces it, so that the drag of a
    /// slider is one step; endMerge() ends the drag.
    void push(std::string name, ProjectState next, std::string merge_key = {});
    void endMerge() { merge_key_.clear(); }

    [[nodiscard]] const State& state() const { return history_.steps[history_.position].state; }
    [[nodiscard]] bool canUndo() const { return history_.position > 0; }
    [[nodiscard]] bool canRedo() const { return history_.position + 1 < history_.steps.size(); }
    [[nodiscard]] std::string undoName() const;  // empty when there is nothing to undo
    [[nodiscard]] std::string redoName() const;

    /// The state afterwards; the same one when there is nothing to undo or redo.
    const State& undo();
    const State& redo();

    /// For a history panel: names of all steps, the first that of the initial state; where we are
    /// in it; and going anywhere in it.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] std::size_t position() const { return history_.position; }
    const State& goTo(std::size_t position);

    /// Remembers that this state is on disk; isSaved() compares states, so that undoing back to
    /// the saved one counts.
    void markSaved() { saved_ = state(); }
    /// The same for an earlier state: what was handed to the disk while editing went on.
    void markSaved(State state) { saved_ = std::move(state); }
    /// No state is on disk.
    void markUnsaved() { saved_.reset(); }
    [[nodiscard]] bool isSaved() const;

    /// Forgets all steps and begins with another project's state, which counts as saved.
    void reset(ProjectState initial);

    [[nodiscard]] const History& history() const { return history_; }
    /// Takes up where an earlier program was: at least one step, the position in it. No state
    /// counts as saved.
    void restore(History history);

  private:
    History history_;
    std::string merge_key_;
    State saved_;
};

}  // namespace dollytrack
