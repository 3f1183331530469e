#include "app/editor/project/workspace.h"

#include "app/editor/shell/menu_names.h"
#include "engine/core/log.h"
#include "engine/document/edits_json.h"
#include "engine/document/history_json.h"
#include "engine/document/operation.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/sha256.h"
#include "engine/plan/plan_json.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace dollytrack::editor {
namespace {

using Clock = std::chrono::steady_clock;

/// The section of a project file with the editor's view.
constexpr const char* kView = "view";

/// The hidden objects and the export settings of a view.
nlohmann::json choicesIn(const nlohmann::json& view) {
    nlohmann::json choices = {{"hidden", nlohmann::json::array()}};
    for (const char* name : {"hidden", "export"}) {
        if (view.is_object() && view.contains(name)) choices[name] = view[name];
    }
    return choices;
}

}  // namespace

Workspace::Workspace(std::function<void()> wake)
    : wake_(wake),
      file_watch_(known_files_, wake),
      loader_(wake),
      importer_(wake),
      saver_(wake),
      lighter_(wake),
      planner_(wake) {}

Workspace::~Workspace() {
    saver_.finish();
}

void Workspace::open(const std::filesystem::path& path,
                     const std::optional<std::filesystem::path>& scene_instead) {
    load(path, scene_instead, false);
}

void Workspace::restore(const std::filesystem::path& copy,
                        const std::optional<std::filesystem::path>& scene_instead) {
    load(copy, scene_instead, true);
}

void Workspace::load(const std::filesystem::path& path,
                     const std::optional<std::filesystem::path>& scene_instead, bool restored) {
    state_when_asked_ = stack_.state();
    std::error_code ignored;
    const std::filesystem::path absolute = std::filesystem::absolute(path, ignored);
    LoadOutcome outcome{absolute, fail(ErrorCode::Failed, ""), restored};
    outcome.relocated = scene_instead.has_value();
    startLoading(std::move(outcome), [absolute, scene_instead] {
        Result<ProjectContent> content = readProject(absolute);
        if (content && scene_instead) content->scene_file = *scene_instead;
        return content;
    });
}

void Workspace::cancelOpening() {
    if (loader_.state().busy) return loader_.cancel();
    importer_.cancel();
    abandonImport();
}

void Workspace::startLoading(LoadOutcome outcome, std::function<Result<ProjectContent>()> read) {
    loader_.start([outcome = std::move(outcome), read = std::move(read),
                   latest = loaded_](const JobContext& job) mutable {
        try {
            Result<ProjectContent> content = read();
            if (content && sceneIsGone(*content)) outcome.missing_scene = content->scene_file;
            outcome.opened = std::move(content).and_then([&](ProjectContent&& content_read) {
                return openProject(std::move(content_read), job);
            });
            if (outcome.opened && outcome.restored) takeHistory(outcome);
        } catch (const std::exception& error) {
            outcome.opened = fail(ErrorCode::Failed,
                                  std::string("The scene cannot be loaded: ") + error.what() + ".",
                                  outcome.path.string());
        }
        latest->put(std::move(outcome));
    });
}

/// Drops the plan and the light of the scene.
void Workspace::showNothing() {
    planner_.cancel();
    lighter_.drop();
    shown_ = {};
    first_serial_ = ++serial_;
}

void Workspace::close() {
    showNothing();
    importer_.cancel();
    stack_before_import_.reset();
    opened_.reset();
    ++document_;
    restored_from_.clear();
    keeps_import_ = false;
    changed_file_.reset();
    file_watch_.beginAnew();
    stack_.reset({});
    new_scene_ = NewScene::Opened;
}

void Workspace::takeHistory(LoadOutcome& outcome) {
    outcome.origin = Autosave::takeOrigin(outcome.opened->others);
    Result<CommandStack::History> history = historyFromJson(outcome.origin.history);
    if (history) {
        for (CommandStack::Step& step : history->steps) {
            if (!step.state->import.is_null()) continue;
            ProjectState completed = *step.state;
            completed.import = outcome.opened->import;
            step.state = std::make_shared<const ProjectState>(std::move(completed));
        }
        // The project's sections take precedence over the history's current state.
        history->steps[history->position].state =
            std::make_shared<const ProjectState>(outcome.opened->state);
        outcome.stack.emplace().restore(std::move(*history));
    } else {
        outcome.opened->warnings.push_back("The work was restored without its undo history.");
    }
}

void Workspace::install(OpenedProject opened, CommandStack stack) {
    close();
    log::info("project", "opened " + opened.scene_file.string());
    for (const std::string& warning : opened.warnings) log::warn("project", warning);
    if (!opened.warnings.empty()) {
        std::string text;
        for (const std::string& warning : opened.warnings) text += warning + "\n";
        text.pop_back();
        notices_.push_back({false, "Please note", text});
    }
    stack_ = std::move(stack);
    if (!opened.project.empty()) known_files_->remember(opened.project, opened.file_sha256);
    file_has_plan_ = opened.file_has_plan;
    view_in_file_ = opened.others.value(kView, nlohmann::json());
    opened_ = std::move(opened);
    logImport();
    replan();
}

void Workspace::finishOpening(LoadOutcome outcome) {
    const std::string name = outcome.path.filename().string();
    if (outcome.opened && unsaved() && stack_.state() != state_when_asked_) {
        notices_.push_back({true, name + " was not opened",
                            "The open project was changed in the meantime. Save it, then open " +
                                name + " again."});
        return;
    }
    if (outcome.opened) {
        if (outcome.restored) {
            // The file may have changed since; the recorded hash is that of the restored work.
            outcome.opened->project = std::move(outcome.origin.project);
            outcome.opened->file_sha256 = std::move(outcome.origin.sha256);
        }
        CommandStack stack =
            outcome.stack ? std::move(*outcome.stack) : CommandStack(outcome.opened->state);
        install(std::move(*outcome.opened), std::move(stack));
        if (outcome.restored) restored_from_ = outcome.path;
        // The project file does not contain the new scene path yet.
        if (outcome.restored || outcome.relocated) stack_.markUnsaved();
        return;
    }
    const Error& error = outcome.opened.error();
    if (error.code == ErrorCode::Cancelled) return;
    Notice notice{true, "Cannot open " + name, withMenuNames(describe(error))};
    if (!outcome.missing_scene.empty()) {
        notice.text = "Its scene " + outcome.missing_scene.string() +
                      " no longer exists. Locate it, or put it back and open the project again.";
        notice.missing_scene_of = outcome.path;
        notice.restores = outcome.restored;
    } else if (outcome.path.extension() == ".txt") {
        notice.text += "\nA camera path is opened with File > Import a camera path, in a scene.";
    }
    log::error("project", describe(error));
    notices_.push_back(std::move(notice));
}

ProjectFile Workspace::snapshot(bool with_plan) const {
    ProjectFile file;
    file.scene = opened_->scene_file;
    file.scene_sha256 = opened_->imported->source_sha256;
    file.import = state().import;
    file.parameters = state().parameters;
    file.edits = editsJson(state().edits, opened_->loaded_edits);
    file.others = opened_->others;
    if (with_plan && planIsCurrent() && shown_.plan)
        file.result = resultJson(*shown_.scene, *shown_.plan);
    return file;
}

void Workspace::setView(const nlohmann::json& view) {
    if (isOpen()) opened_->others[kView] = view;
}

void Workspace::save(const std::filesystem::path& path, OnConflict on_conflict) {
    if (!isOpen()) return;
    if (isImporting()) {
        notices_.push_back({false, "The project was not saved",
                            "The scene is being read again. Save when it is shown."});
        return;
    }
    const bool planned = planIsCurrent() && shown_.plan;
    const bool asks = on_conflict == OnConflict::Ask;
    // Another camera or frame alone is no reason to write a file.
    const bool nothing_new =
        asks && !unsaved() && path == this->path() && (file_has_plan_ || !planned) &&
        choicesIn(opened_->others.value(kView, nlohmann::json())) == choicesIn(view_in_file_);
    SaveOrder order;
    order.outcome = {++save_serial_, document_, path, stack_.state(), planned};
    order.file = snapshot(false);
    order.outcome.view = order.file.others.value(kView, nlohmann::json());
    order.scene = shown_.scene;
    if (planned) order.plan = shown_.plan;
    order.asks = asks;
    order.nothing_new = nothing_new;
    save_orders_->put(std::move(order));
    // A newer task replaces a waiting one, so each task takes all orders.
    saver_.start([orders = save_orders_, known = known_files_, saved = saved_](const JobContext&) {
        for (SaveOrder& one : orders->takeAll()) {
            write(one, *known);
            saved->put(std::move(one.outcome));
        }
    });
}

void Workspace::write(SaveOrder& order, KnownFiles& known) {
    SaveOutcome& done = order.outcome;
    std::error_code error;
    done.was_there = order.nothing_new && std::filesystem::exists(done.path, error);
    done.changed_elsewhere = !done.was_there && order.asks && known.changedElsewhere(done.path);
    if (done.was_there || done.changed_elsewhere) return;
    try {
        if (order.plan) order.file.result = resultJson(*order.scene, *order.plan);
        const Result<std::string> text = projectText(order.file, done.path);
        done.status = text ? writeWhole(done.path, *text) : tl::unexpected(text.error());
        if (done.status) known.remember(done.path, sha256Of(*text));
    } catch (const std::exception& failure) {
        done.status = fail(ErrorCode::Failed,
                           std::string("The project cannot be written: ") + failure.what() +
                               "; close other programs and save again.",
                           done.path.string());
    }
}

void Workspace::finishSaving(SaveOutcome outcome) {
    if (outcome.serial == save_serial_) saves_answered_ = save_serial_;
    if (!outcome.status) {
        log::error("project", describe(outcome.status.error()));
        notices_.push_back({true, "Cannot save", describe(outcome.status.error())});
        return;
    }
    if (outcome.was_there)
        return log::info("project", "nothing to save in " + outcome.path.string());
    const bool same_document = isOpen() && outcome.document == document_;
    if (outcome.changed_elsewhere) {
        log::warn("project", "not saved: another program has changed " + outcome.path.string());
        if (same_document) changed_file_ = outcome.path;
        return;
    }
    log::info("project", "saved " + outcome.path.string());
    if (!same_document) return;
    opened_->project = outcome.path;
    file_watch_.beginAnew();
    file_has_plan_ = outcome.has_plan;
    view_in_file_ = std::move(outcome.view);
    stack_.markSaved(outcome.state);
}

Status Workspace::checkEditable() const {
    if (!isOpen()) return fail(ErrorCode::Failed, "No scene is open.");
    if (isImporting()) {
        return fail(ErrorCode::Failed, "The scene is being read again; try again in a moment.");
    }
    if (!shown_.scene && shown_.error) {
        return fail(shown_.error->code,
                    "There is no scene to edit, because the last change failed; undo it. " +
                        withMenuNames(shown_.error->message),
                    shown_.error->where);
    }
    if (!shown_.scene) {
        return fail(ErrorCode::Failed, "The scene is still being prepared; try again in a moment.");
    }
    if (!(shown_.state->edits.scene.definitions == state().edits.scene.definitions)) {
        return fail(ErrorCode::Failed, "The objects are being rebuilt; try again in a moment.");
    }
    return {};
}

Status Workspace::apply(const nlohmann::json& operation, const std::string& merge_key) {
    if (Status status = checkEditable(); !status) return status;
    ProjectState next = state();
    Result<std::string> name =
        applyOperation(next, {*shown_.scene, planning::setParameter}, operation);
    if (!name) return tl::unexpected(std::move(name.error()));
    const CommandStack::State before = stack_.state();
    stack_.push(*name, std::move(next), merge_key);
    if (stack_.state() != before) replan();
    return {};
}

Status Workspace::applyAll(const nlohmann::json& operations, const std::string& name) {
    if (Status status = checkEditable(); !status) return status;
    ProjectState next = state();
    if (auto done = applyOperations(next, *shown_.scene, planning::setParameter, operations);
        !done) {
        return tl::unexpected(std::move(done.error()));
    }
    const CommandStack::State before = stack_.state();
    stack_.push(name, std::move(next));
    if (stack_.state() != before) replan();
    return {};
}

void Workspace::setParameters(const nlohmann::json& parameters, const std::string& name,
                              const std::string& merge_key) {
    if (isImporting()) return;  // a failed import would take them back
    ProjectState next = state();
    next.parameters = parameters;
    const CommandStack::State before = stack_.state();
    stack_.push(name, std::move(next), merge_key);
    if (stack_.state() != before) replan();
}

void Workspace::setState(ProjectState state, const std::string& name) {
    state.import = this->state().import;
    CommandStack stack = stack_;
    stack.push(name, std::move(state));
    replaceHistory(std::move(stack));
}

void Workspace::undo() {
    CommandStack stack = stack_;
    stack.undo();
    replaceHistory(std::move(stack));
}

void Workspace::redo() {
    CommandStack stack = stack_;
    stack.redo();
    replaceHistory(std::move(stack));
}

void Workspace::goTo(std::size_t step) {
    CommandStack stack = stack_;
    stack.goTo(step);
    replaceHistory(std::move(stack));
}

void Workspace::rewind(CommandStack::History earlier) {
    CommandStack stack = stack_;
    stack.rewind(std::move(earlier));
    // A drag changes no import settings: those of a failed import must not come back.
    if (isOpen() && stack.state()->import == state().import) replaceHistory(std::move(stack));
}

void Workspace::replan() {
    if (isImporting()) return;  // finishImport() plans
    changed_at_ = Clock::now();
    lighter_.setWaiting(true);
    planner_.start({opened_->imported, stack_.state(), ++serial_});
}

void Workspace::stopPlanning() {
    stopped_serial_ = serial_;
    planner_.cancel();
}

void Workspace::updateLight() {
    lighter_.poll();
    const bool planning = planner_.state().busy;
    lighter_.setWaiting(planning);
    if (shown_.plan && shown_.measured && !planning) lighter_.follow(shown_);
}

void Workspace::take(PlanOutcome outcome) {
    if (outcome.error && outcome.error->code != ErrorCode::Cancelled) {
        log::warn("planning", describe(*outcome.error));
    }
    if (outcome.serial != shown_.serial) {  // later outcomes of a request repeat its warnings
        for (const std::string& warning : outcome.warnings) log::warn("edits", warning);
    }
    const bool answers = outcome.plan || outcome.error;  // not only the scene
    if (answers && outcome.serial == serial_ && (shown_.serial != serial_ || !shown_.plan)) {
        latency_ms_ = std::chrono::duration<double, std::milli>(Clock::now() - changed_at_).count();
    }
    const bool refused = outcome.error && outcome.error->code == ErrorCode::Usage;
    if (refused && shown_.plan && shown_.state->edits.scene == outcome.state->edits.scene) {
        // A refused combination of parameters is usually temporary: the previous plan stays, with
        // its scene, parameters and edits.
        shown_.serial = outcome.serial;
        shown_.error = std::move(outcome.error);
        shown_.outdated = true;
        return;
    }
    if (shown_.geometry != outcome.geometry) lighter_.drop();
    shown_ = std::move(outcome);
}

/// Whether to show an outcome. A plan for an outdated request is shown, as it is newer than the one
/// on the screen; an error for an outdated request is not.
bool Workspace::isWanted(const PlanOutcome& outcome) const {
    if (outcome.serial == serial_) return true;
    const bool first_scene = outcome.scene && !outcome.error && !shown_.scene;
    return outcome.serial >= first_serial_ && (outcome.plan || first_scene);
}

void Workspace::poll() {
    if (std::optional<LoadOutcome> outcome = loaded_->take()) finishOpening(std::move(*outcome));
    if (auto outcome = importer_.take(); outcome && isOpen()) finishImport(std::move(*outcome));
    if (std::optional<PlanOutcome> outcome = planner_.poll();
        outcome && isOpen() && isWanted(*outcome)) {
        take(std::move(*outcome));
    }
    for (SaveOutcome& outcome : saved_->takeAll()) finishSaving(std::move(outcome));
    // Not during saving, when the file is new but its hash is not recorded yet.
    if (!saving()) file_watch_.look(path());
    updateLight();
}

const std::filesystem::path& Workspace::path() const {
    static const std::filesystem::path kNone;
    return opened_ ? opened_->project : kNone;
}

std::string Workspace::title() const {
    if (!isOpen()) return "Dollytrack";
    const std::filesystem::path shown =
        path().empty() ? opened_->scene_file.filename() : path().filename();
    return (unsaved() ? "● " : "") + shown.string() + " – Dollytrack";
}

std::optional<Workspace::Notice> Workspace::takeNotice() {
    if (notices_.empty()) return std::nullopt;
    Notice first = std::move(notices_.front());
    notices_.erase(notices_.begin());
    return first;
}

std::string Workspace::planError() const {
    return shown_.error ? withMenuNames(describe(*shown_.error)) : std::string();
}

}  // namespace dollytrack::editor
