#include "engine/document/command_stack.h"

namespace dollytrack {

CommandStack::CommandStack(ProjectState initial) {
    reset(std::move(initial));
}

void CommandStack::reset(ProjectState initial) {
    history_.steps.clear();
    history_.steps.push_back({"Open", std::make_shared<const ProjectState>(std::move(initial))});
    history_.position = 0;
    merge_key_.clear();
    saved_ = state();
}

void CommandStack::push(std::string name, ProjectState next, std::string merge_key) {
    if (next == *state()) return;
    auto shared = std::make_shared<const ProjectState>(std::move(next));
    const bool merges = !merge_key.empty() && merge_key == merge_key_ && !canRedo() && canUndo();
    history_.steps.resize(history_.position + 1);
    merge_key_ = std::move(merge_key);
    if (!merges) {
        history_.steps.push_back({std::move(name), std::move(shared)});
        ++history_.position;
        return;
    }
    history_.steps.back() = {std::move(name), std::move(shared)};
    // The value was dragged back to its start, so there is no step.
    if (*history_.steps[history_.position - 1].state == *state()) {
        history_.steps.pop_back();
        --history_.position;
        merge_key_.clear();
    }
}

void CommandStack::restore(History history) {
    history_ = std::move(history);
    merge_key_.clear();
    saved_.reset();
}

std::string CommandStack::undoName() const {
    return canUndo() ? history_.steps[history_.position].name : std::string();
}

std::string CommandStack::redoName() const {
    return canRedo() ? history_.steps[history_.position + 1].name : std::string();
}

const CommandStack::State& CommandStack::undo() {
    return goTo(canUndo() ? history_.position - 1 : history_.position);
}

const CommandStack::State& CommandStack::redo() {
    return goTo(canRedo() ? history_.position + 1 : history_.position);
}

std::vector<std::string> CommandStack::names() const {
    std::vector<std::string> names;
    for (const Step& step : history_.steps) names.push_back(step.name);
    return names;
}

const CommandStack::State& CommandStack::goTo(std::size_t position) {
    if (position < history_.steps.size()) history_.position = position;
    merge_key_.clear();
    return state();
}

const CommandStack::State& CommandStack::rewind(History earlier) {
    history_ = std::move(earlier);
    merge_key_.clear();
    return state();
}

bool CommandStack::isSaved() const {
    return saved_ && (saved_ == state() || *saved_ == *state());
}

}  // namespace dollytrack
