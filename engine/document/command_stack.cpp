#include "engine/document/command_stack.h"

namespace dollytrack {

CommandStack::CommandStack(ProjectState initial) {
    reset(std::move(initial));
}

void CommandStack::reset(ProjectState initial) {
    steps_.clear();
    steps_.push_back({"Open", std::make_shared<const ProjectState>(std::move(initial))});
    position_ = 0;
    merge_key_.clear();
    saved_ = state();
}

void CommandStack::push(std::string name, ProjectState next, std::string merge_key) {
    if (next == *state()) return;
    auto shared = std::make_shared<const ProjectState>(std::move(next));
    const bool merges = !merge_key.empty() && merge_key == merge_key_ && !canRedo() && canUndo();
    steps_.resize(position_ + 1);
    merge_key_ = std::move(merge_key);
    if (!merges) {
        steps_.push_back({std::move(name), std::move(shared)});
        ++position_;
        return;
    }
    steps_.back() = {std::move(name), std::move(shared)};
    // Dragged back to where it began: nothing was done.
    if (*steps_[position_ - 1].state == *state()) {
        steps_.pop_back();
        --position_;
        merge_key_.clear();
    }
}

std::string CommandStack::undoName() const {
    return canUndo() ? steps_[position_].name : std::string();
}

std::string CommandStack::redoName() const {
    return canRedo() ? steps_[position_ + 1].name : std::string();
}

const CommandStack::State& CommandStack::undo() {
    return goTo(canUndo() ? position_ - 1 : position_);
}

const CommandStack::State& CommandStack::redo() {
    return goTo(canRedo() ? position_ + 1 : position_);
}

std::vector<std::string> CommandStack::names() const {
    std::vector<std::string> names;
    for (const Step& step : steps_) names.push_back(step.name);
    return names;
}

const CommandStack::State& CommandStack::goTo(std::size_t position) {
    if (position < steps_.size()) position_ = position;
    merge_key_.clear();
    return state();
}

bool CommandStack::isSaved() const {
    return saved_ && (saved_ == state() || *saved_ == *state());
}

}  // namespace dollytrack
