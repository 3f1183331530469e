#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/format_table/scene_format.h"
#include "engine/io/settings/annotation_file.h"
#include "engine/io/trajectories/trajectory_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace dollytrack::editor {

void Editor::askForFile(const std::string& id) {
    ui::FileRequest request;
    request.id = id;
    if (!settings_.last_folder.empty()) request.start = settings_.last_folder;
    for (const std::string& recent : settings_.recent) {
        const std::filesystem::path folder = std::filesystem::path(recent).parent_path();
        if (std::ranges::find(request.recent_folders, folder) == request.recent_folders.end()) {
            request.recent_folders.push_back(folder);
        }
    }
    const std::vector<std::string> scenes = sceneExtensions();
    std::vector<std::string> all = scenes;
    all.push_back(".dolly");
    if (id == "open") {
        request.title = "Open a scene or a project";
        request.filters = {
            {"Scenes and projects", all}, {"Projects", {".dolly"}}, {"Scenes", scenes}};
    } else if (id == "locate scene") {
        request.title = "Locate the project's scene";
        request.filters = {{"Scenes", scenes}};
    } else if (id == "save") {
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title = "Save the project";
        request.accept = "Save";
        request.extension = ".dolly";
        request.filters = {{"Projects", {".dolly"}}};
        request.name = workspace_.path().empty() ? workspace_.sceneFile().stem().string() + ".dolly"
                                                 : workspace_.path().filename().string();
        // The folder of the built-in scene is read-only.
        const std::filesystem::path& beside =
            workspace_.path().empty() ? workspace_.sceneFile() : workspace_.path();
        if (beside != example_) request.start = beside.parent_path();
    } else if (id == "annotations") {
        const std::filesystem::path beside = annotationFileOf(workspace_.sceneFile());
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title =
            "Write the annotations beside the scene, where they are found automatically";
        request.accept = "Write";
        request.extension = ".json";
        request.filters = {{"Annotations", {".json"}}};
        request.start = beside.parent_path();
        request.name = beside.filename().string();
    } else if (id == "labels") {
        request.title = "Classes of datasets, or words and their classes";
        request.accept = "Choose";
        request.filters = {{"Label files", {".json", ".csv"}}};
    } else if (id == "preview.png") {
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title = "Save the camera's image";
        request.accept = "Save";
        request.extension = ".png";
        request.filters = {{"PNG images", {".png"}}};
        request.name = fmt::format("frame_{:06}.png",
                                   picture_to_save_ ? picture_to_save_->frame : playback_.frame());
    } else if (id == "camera path") {
        request.title = "Import a camera path";
        request.accept = "Import";
        request.filters = {
            {"Trajectories", {".txt", ".json", ".csv", ".tum", ".kitti", ".xml", ".sh3d"}}};
    } else if (id == "poses") {
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title = "Save the camera path as text (TUM: seconds, x y z, qx qy qz qw)";
        request.accept = "Save";
        request.extension = ".txt";
        request.filters = {{"Trajectories", {".txt"}}};
        request.name = workspace_.sceneFile().stem().string() + ".txt";
    } else if (id == "kept plan") {
        request.title = "Compare with the plan of another project of this scene";
        request.accept = "Compare";
        request.filters = {{"Projects", {".dolly"}}};
    } else if (id == "models") {
        request.purpose = ui::FileRequest::Purpose::ChooseFolder;
        request.title = "Folder of models that the scene file names";
        request.accept = "Add";
    } else if (id == "export folder") {
        request.purpose = ui::FileRequest::Purpose::ChooseFolder;
        request.title = "Folder for the dataset";
        request.accept = "Choose";
    } else if (id == "export rig") {
        request.title = "Additional cameras mounted on the planned one";
        request.accept = "Choose";
        request.filters = {{"Rigs", {".json"}}};
    } else if (id == "export projects") {
        request.title = "Add a project to the queue";
        request.accept = "Add";
        request.filters = {{"Projects", {".dolly"}}};
    }
    files_.ask(std::move(request));
}

void Editor::askForUnit() {
    const ImportReport& report = workspace_.importReport();
    const auto text = std::make_shared<std::string>(
        fmt::format("{:g}", report.proposal.unit_m.value_or(report.unit_m)));
    const ui::NumberLimits limits{{1e-9, 1e6}, "%.6g", " m"};
    const auto read = [this, text, limits] {
        const std::optional<double> unit_m = ui::readNumber(*text, limits).value;
        if (!unit_m) return;
        workspace_.changeImport("unit_m", *unit_m,
                                fmt::format("Read the scene with 1 unit = {:g} m", *unit_m));
    };
    questions_.ask(
        {"Unit of length",
         fmt::format("The scene is read with 1 unit of the file = {:g} m.", report.unit_m),
         {{"Read", read}},
         false,
         {text, limits, "m for 1 unit of the file"}});
}

void Editor::answerFile(const ui::FileAnswer& answer) {
    if (answer.path.has_parent_path()) settings_.last_folder = answer.path.parent_path().string();
    if (answer.id == "open") {
        openAfterAsking(answer.path);
    } else if (answer.id == "locate scene") {
        questions_.afterUnsaved(
            [this, project = scene_wanted_by_, scene = answer.path,
             restores = scene_wanted_to_restore_] {
                restores ? workspace_.restore(project, scene) : workspace_.open(project, scene);
            },
            "before another is opened");
    } else if (answer.id == "save") {
        // The dialog has already confirmed replacing an existing file.
        workspace_.setView(viewToStore());
        workspace_.save(answer.path, Workspace::OnConflict::Overwrite);
    } else if (answer.id == "annotations") {
        const ProjectFile project = workspace_.snapshot(false);
        Status written = writeAnnotations(answer.path, project.import, project.edits);
        if (written) {
            log::info("editor", "wrote the annotations to " + answer.path.string());
        } else {
            questions_.tell({true, "Cannot write the annotations", describe(written.error()), {}});
        }
    } else if (answer.id == "labels") {
        workspace_.changeImport("labels", answer.path.string(), "Use a label file");
    } else if (answer.id == "models") {
        nlohmann::json folders =
            workspace_.state().import.value("model_folders", nlohmann::json::array());
        const std::string folder = answer.path.string();
        if (std::find(folders.begin(), folders.end(), folder) == folders.end()) {
            folders.push_back(folder);
        }
        workspace_.changeImport("model_folders", std::move(folders), "Add a folder of models");
    } else if (answer.id == "camera path") {
        readMotion({answer.path, {}});
    } else if (answer.id == "poses") {
        if (plan() == nullptr) return;
        const Status written = writeWhole(answer.path, tumText(plan()->trajectory));
        if (written) {
            saved_path_ = answer.path;
            log::info("editor", "saved the camera path as " + answer.path.string());
        } else {
            questions_.tell({true, "Cannot save the camera path", describe(written.error()), {}});
        }
    } else if (answer.id == "kept plan") {
        comparison_.read(answer.path, workspace_);
    } else if (answer.id == "preview.png") {
        if (picture_to_save_ && picture_to_save_->record.width > 0) {
            pictures_.save(answer.path, std::move(*picture_to_save_));
        }
        picture_to_save_.reset();
    } else {
        answerExportFile(answer);
    }
}

void Editor::save() {
    if (workspace_.path().empty()) {
        askForFile("save");
    } else {
        workspace_.setView(viewToStore());
        workspace_.save(workspace_.path(), Workspace::OnConflict::Ask);
    }
}

void Editor::openAfterAsking(const std::filesystem::path& path) {
    questions_.afterUnsaved([this, path] { workspace_.open(path); }, "before another is opened");
}

Questions::Callbacks Editor::questionCallbacks() {
    Questions::Callbacks callbacks;
    callbacks.save = [this] { save(); };
    callbacks.save_as = [this] { askForFile("save"); };
    callbacks.restore = [this](const RecoveredWork& work) {
        questions_.afterUnsaved([this, file = work.file] { workspace_.restore(file); },
                                "before the other is restored");
    };
    callbacks.find_scene = [this](const std::filesystem::path& project, bool restores) {
        scene_wanted_by_ = project;
        scene_wanted_to_restore_ = restores;
        askForFile("locate scene");
    };
    callbacks.continue_exports = [this](const std::vector<int>& jobs) {
        for (const int job : jobs) exports_->resume(job);
        docks_.open(panelName(Panel::Export));
    };
    callbacks.forget_exports = [this](const std::vector<int>& jobs) {
        for (const int job : jobs) exports_->remove(job);
    };
    callbacks.unfinished_exports = [this] { return exports_ ? exports_->unfinished() : 0; };
    return callbacks;
}

void Editor::drawDialogs() {
    if (const std::string error = drawing_.takeError(); !error.empty()) {
        log::error("drawing", error);
        questions_.tell({true, "The scene cannot be drawn", error, {}});
    }
    if (const std::optional<Error> error = pictures_.takeError()) {
        questions_.tell({true, "Cannot save the image", describe(*error), {}});
    }
    if (std::vector<RecoveredWork> recovered = autosave_.takeRecoveredWork(); !recovered.empty()) {
        questions_.offer(std::move(recovered));
    }
    if (exports_) {
        if (auto found = exports_->takeFound(); !found.empty()) {
            questions_.offerExports(std::move(found));
        }
        if (const auto other = other_projects_.take()) addOtherProject(*other);
    }
    if (const std::optional<ui::FileAnswer> answer = files_.draw()) answerFile(*answer);
    drawSheet();
    questions_.draw(files_.isOpen());
    ui::CommandPaletteView palette;
    palette.commands = &commands_;
    palette.parameters = &palette_parameters_;
    palette.scene = workspace_.shown().scene.get();
    const ui::CommandPaletteActions chosen = ui::drawCommandPalette(palette, panels_.palette);
    if (!chosen.run.empty()) commands_.find(chosen.run)->run();
    if (chosen.select_object != 0) selectObject(chosen.select_object, false);
    if (!chosen.focus_parameter.empty()) {
        parameters_.filter = chosen.focus_parameter;
        docks_.open(panelName(Panel::Parameters));
    }
    ui::drawHelpOverlay(commands_, panels_.help);
}

}  // namespace dollytrack::editor
