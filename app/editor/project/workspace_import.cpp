#include "app/editor/project/workspace.h"

#include "app/editor/shell/menu_names.h"
#include "engine/core/log.h"

#include <string>
#include <utility>

namespace dollytrack::editor {

/// Makes this the undo history. If its current state has other import settings, the scene is
/// imported again first.
void Workspace::replaceHistory(CommandStack stack) {
    if (!isOpen()) return;
    std::swap(stack_, stack);
    if (stack_.state() == stack.state()) return;
    if (state().import == opened_->import) {
        if (std::exchange(stack_before_import_, std::nullopt)) importer_.cancel();
        return replan();
    }
    if (!isImporting()) stack_before_import_ = std::move(stack);
    if (importer_.awaited() != state().import) importer_.start(snapshot(false), path());
}

void Workspace::setImport(nlohmann::json import, const std::string& name) {
    if (import == state().import) {
        // The same settings again: a label file or a model may have changed.
        if (!isImporting()) importer_.start(snapshot(false), path());
        return;
    }
    ProjectState next = state();
    next.import = std::move(import);
    CommandStack stack = stack_;
    stack.push(name, std::move(next));
    replaceHistory(std::move(stack));
}

void Workspace::changeImport(const char* setting, nlohmann::json value, const std::string& name) {
    if (!isOpen()) return;
    nlohmann::json import = state().import;
    import[setting] = std::move(value);
    if (import[setting].is_null()) import.erase(setting);
    setImport(std::move(import), name);
}

void Workspace::applyProposal() {
    nlohmann::json import = state().import;
    const ImportProposal& proposal = opened_->imported->report.proposal;
    if (proposal.unit_m) import["unit_m"] = *proposal.unit_m;
    if (proposal.up_axis) import["up_axis"] = proposal.up_axis->text();
    setImport(std::move(import), "Read the scene with " + settingsText(proposal));
}

void Workspace::keepImport(const std::string& name) {
    const ImportReport& report = importReport();
    ProjectState next = state();
    if (!report.proposal.unit_doubt.empty()) next.import["unit_m"] = report.unit_m;
    const std::optional<UpAxis> up = parseUpAxis(report.up_axis);
    if (!report.proposal.up_doubt.empty() && up) next.import["up_axis"] = up->text();
    keeps_import_ = true;
    opened_->import = next.import;  // the scene was imported with these values
    stack_.push(name, std::move(next));
    replan();
}

std::optional<nlohmann::json> Workspace::previousImport() const {
    const CommandStack::History& history = stack_.history();
    for (std::size_t i = history.position; i > 0; --i) {
        const nlohmann::json& before = history.steps[i - 1].state->import;
        if (before != history.steps[i].state->import) return before;
    }
    return std::nullopt;
}

void Workspace::revertImport() {
    const std::optional<nlohmann::json> before = previousImport();
    if (!before) return;
    const CommandStack::History& history = stack_.history();
    if (history.steps[history.position - 1].state->import == *before) return undo();
    setImport(*before, "Read the scene as before");
}

/// Returns to the step before the import that was cancelled or has failed.
void Workspace::abandonImport() {
    const std::optional<CommandStack> before = std::exchange(stack_before_import_, std::nullopt);
    if (!before) return;
    const bool was_asked = state_when_asked_ == stack_.state();
    stack_.rewind(before->history());
    if (was_asked) state_when_asked_ = stack_.state();
    if (!planIsCurrent() && !planningStopped()) replan();
}

void Workspace::finishImport(ImportWorker::Outcome outcome) {
    if (!outcome.scene) {
        const Error& error = outcome.scene.error();
        if (error.code != ErrorCode::Cancelled) {
            log::error("import", describe(error));
            notices_.push_back(
                {true, "The scene was not read again", withMenuNames(describe(error))});
        }
        return abandonImport();
    }
    stack_before_import_.reset();
    opened_->imported = std::move(*outcome.scene);
    opened_->import = std::move(outcome.import);
    keeps_import_ = false;
    showNothing();
    new_scene_ = NewScene::ReadAgain;
    log::info("project", "read " + opened_->scene_file.string() + " again");
    logImport();
    replan();
}

void Workspace::logImport() const {
    for (const std::string& warning : importReport().warnings) {
        log::warn("import", withMenuNames(warning));
    }
    for (const std::string& note : importReport().notes) {
        log::info("import", withMenuNames(note));
    }
}

}  // namespace dollytrack::editor
