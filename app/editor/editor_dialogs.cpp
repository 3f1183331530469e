#include "app/editor/editor.h"

#include "engine/core/log.h"
#include "engine/io/durable_file.h"
#include "engine/io/png_writer.h"
#include "ui/viewport/false_color.h"
#include "ui/widgets/message_box.h"

#include <fmt/format.h>

namespace dollytrack::editor {
namespace {

const std::vector<std::string> kSceneEndings = {".obj", ".fbx", ".gltf", ".glb",
                                                ".dae", ".ply", ".stl"};

}  // namespace

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
    std::vector<std::string> all = kSceneEndings;
    all.push_back(".dolly");
    if (id == "open") {
        request.title = "Open a scene or a project";
        request.filters = {
            {"Scenes and projects", all}, {"Projects", {".dolly"}}, {"Scenes", kSceneEndings}};
    } else if (id == "locate scene") {
        request.title = "Where is the project's scene now?";
        request.filters = {{"Scenes", kSceneEndings}};
    } else if (id == "save") {
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title = "Save the project";
        request.accept = "Save";
        request.extension = ".dolly";
        request.filters = {{"Projects", {".dolly"}}};
        request.name = workspace_.path().empty() ? workspace_.sceneFile().stem().string() + ".dolly"
                                                 : workspace_.path().filename().string();
        if (!workspace_.path().empty()) request.start = workspace_.path().parent_path();
    } else if (id == "preview.png") {
        request.purpose = ui::FileRequest::Purpose::Save;
        request.title = "Save the camera's picture";
        request.accept = "Save";
        request.extension = ".png";
        request.filters = {{"PNG pictures", {".png"}}};
        request.name =
            fmt::format("frame_{:06}.png", picture_to_save_ ? picture_to_save_->frame : frame_);
    } else if (id == "export folder") {
        request.purpose = ui::FileRequest::Purpose::ChooseFolder;
        request.title = "Folder for the dataset";
        request.accept = "Choose";
    } else if (id == "export projects") {
        request.title = "Add a project to the queue";
        request.accept = "Add";
        request.filters = {{"Projects", {".dolly"}}};
    }
    files_.ask(std::move(request));
}

void Editor::answerFile(const ui::FileAnswer& answer) {
    if (answer.path.has_parent_path()) settings_.last_folder = answer.path.parent_path().string();
    if (answer.id == "open") {
        openAfterAsking(answer.path);
    } else if (answer.id == "locate scene") {
        if (scene_wanted_to_restore_) {
            workspace_.restore(scene_wanted_by_, answer.path);
        } else {
            workspace_.open(scene_wanted_by_, answer.path);
        }
    } else if (answer.id == "save") {
        // The dialog has asked already whether a file that is there may be replaced.
        workspace_.save(answer.path, Workspace::IfChanged::Overwrite);
    } else if (answer.id == "preview.png") {
        if (picture_to_save_ && picture_to_save_->record.width > 0) {
            savePicture(answer.path, *picture_to_save_);
        }
        picture_to_save_.reset();
    } else {
        answerExportFile(answer);
    }
}

void Editor::savePicture(const std::filesystem::path& path, const ui::PreviewImage& image) {
    // Exact values where the format holds them, else the picture one sees.
    const render::FrameRecord& record = image.record;
    io::PngFormat format = io::PngFormat::Rgb8;
    std::vector<std::uint8_t> pixels;
    const auto asBytes = [&](const std::vector<std::uint16_t>& values) {
        const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());  // NOLINT
        pixels.assign(first, first + 2 * values.size());
        format = io::PngFormat::Gray16;
    };
    switch (image.modality) {
        case ui::Modality::Rgb:
            pixels = record.rgb;
            break;
        case ui::Modality::Depth:
            asBytes(render::depthInMillimetres(record.depth_m));
            break;
        case ui::Modality::Instance:
            asBytes(record.instance);
            break;
        case ui::Modality::Semantic:
            pixels = record.semantic;
            format = io::PngFormat::Gray8;
            break;
        case ui::Modality::Normal: {
            render::View view;
            view.intrinsics = makeIntrinsics(workspace_.shown().params.camera);
            const std::vector<std::uint8_t> rgba = ui::falseColor(record, view, image.modality);
            for (std::size_t i = 0; i < rgba.size(); ++i) {
                if (i % 4 != 3) pixels.push_back(rgba[i]);
            }
            break;
        }
    }
    const Status written = io::encodePng(record.width, record.height, format, pixels)
                               .and_then([&](const std::vector<std::uint8_t>& png) -> Status {
                                   return io::writeWhole(path, std::span<const std::uint8_t>(png));
                               });
    if (!written) {
        notice_ = Workspace::Notice{true, "Cannot save the picture", describe(written.error()), {}};
    } else {
        log::info("editor", "saved " + path.string());
    }
}

void Editor::save() {
    if (workspace_.path().empty()) {
        askForFile("save");
    } else {
        workspace_.save(workspace_.path(), Workspace::IfChanged::Ask);
    }
}

void Editor::afterUnsaved(std::function<void()> then, const std::string& what_next) {
    if (!workspace_.unsaved()) return then();
    after_unsaved_ = std::move(then);
    unsaved_what_next_ = what_next;
}

void Editor::openAfterAsking(const std::filesystem::path& path) {
    afterUnsaved([this, path] { workspace_.open(path); }, "before another is opened");
}

void Editor::drawUnsaved() {
    // One message at a time; this one comes after what saving may ask.
    if (!after_unsaved_ || !changed_file_.empty() || !lost_.empty()) return;
    if (saving_for_question_) {
        // The question is answered when the project is on the disk, or saving was given up.
        if (workspace_.saving() || files_.isOpen()) return;
        saving_for_question_ = false;
        const std::function<void()> then = std::exchange(after_unsaved_, nullptr);
        if (!workspace_.unsaved()) then();
        return;
    }
    const std::string name = workspace_.path().empty() ? workspace_.sceneFile().filename().string()
                                                       : workspace_.path().filename().string();
    switch (ui::askUnsaved(name, unsaved_what_next_)) {
        case ui::UnsavedAnswer::Save:
            saving_for_question_ = true;
            save();
            break;
        case ui::UnsavedAnswer::Discard: {
            const std::function<void()> then = std::exchange(after_unsaved_, nullptr);
            then();
            break;
        }
        case ui::UnsavedAnswer::Cancel:
            after_unsaved_ = nullptr;
            break;
        case ui::UnsavedAnswer::None:
            break;
    }
}

void Editor::drawLostWork() {
    if (lost_.empty()) return;
    const LostWork& work = lost_.front();
    ui::MessageBox box;
    box.title = "Unsaved work was found";
    box.text = fmt::format(
        "The editor ended without saving {}.\nThe last copy is of {}.",
        work.project.empty() ? "a project of " + work.scene : work.project.filename().string(),
        work.when);
    box.buttons = {"Restore", "Delete the copy", "Later"};
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    if (pressed == 0) {
        workspace_.restore(work.file);
        restored_ = work;
        lost_.clear();  // one at a time; the others are offered again next time
        return;
    }
    if (pressed == 1) Autosave::forget(work);
    lost_.erase(lost_.begin());
}

void Editor::drawChangedFile() {
    if (std::optional<std::filesystem::path> file = workspace_.takeChangedFile()) {
        changed_file_ = std::move(*file);
    }
    if (changed_file_.empty()) return;
    ui::MessageBox box;
    box.title = changed_file_.filename().string() + " was changed by another program";
    box.text =
        "It does not hold what was opened or saved here last. Overwriting it loses what the other "
        "program wrote.";
    // Enter presses the first, which loses nothing.
    box.buttons = {"Save as…", "Overwrite", "Cancel"};
    const int pressed = ui::drawMessageBox(box);
    if (pressed < 0) return;
    const std::filesystem::path file = std::exchange(changed_file_, {});
    if (pressed == 0) askForFile("save");
    if (pressed == 1) workspace_.save(file, Workspace::IfChanged::Overwrite);
}

void Editor::drawDialogs() {
    if (!notice_) notice_ = workspace_.takeNotice();
    if (const std::string error = drawing_.takeError(); !error.empty() && !notice_) {
        log::error("drawing", error);
        notice_ = Workspace::Notice{true, "The scene cannot be drawn", error, {}};
    }
    if (const std::optional<ui::FileAnswer> answer = files_.draw()) answerFile(*answer);
    drawSheet();
    drawLostWork();
    drawChangedFile();
    drawUnsaved();
    if (notice_ && lost_.empty() && changed_file_.empty() && !files_.isOpen()) {
        ui::MessageBox box;
        box.is_error = notice_->is_error;
        box.title = notice_->title;
        box.text = notice_->text;
        const bool locate = !notice_->missing_scene_of.empty();
        if (locate) box.buttons = {"Find the scene…", "Cancel"};
        const int pressed = ui::drawMessageBox(box);
        if (pressed >= 0) {
            if (locate && pressed == 0) {
                scene_wanted_by_ = notice_->missing_scene_of;
                scene_wanted_to_restore_ = notice_->restores;
                askForFile("locate scene");
            }
            notice_.reset();
        }
    }
    ui::CommandPaletteView palette;
    palette.commands = &commands_;
    palette.parameters = &palette_parameters_;
    palette.scene = workspace_.shown().scene.get();
    const ui::CommandPaletteActions chosen = ui::drawCommandPalette(palette, palette_);
    if (!chosen.run.empty()) commands_.find(chosen.run)->run();
    if (chosen.select_object != 0) selectObject(chosen.select_object, false);
    if (!chosen.focus_parameter.empty()) {
        parameter_filter_ = chosen.focus_parameter;
        focus_tab_ = "Parameters";
    }
    ui::drawHelpOverlay(commands_, help_);
}

}  // namespace dollytrack::editor
