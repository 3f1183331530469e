#include "app/editor/editor.h"
#include "app/editor/export/export_folders.h"
#include "app/editor/export/export_program.h"
#include "app/editor/files/local_time.h"
#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "render/dataset/export_preset.h"
#include "render/dataset/folder/dataset_listing.h"
#include "render/dataset/size_estimate.h"
#include "render/encoders/modalities.h"
#include "render/formats/formats.h"
#include "render/frames/frame_needs.h"
#include "ui/panels/export/export_draft.h"
#include "ui/widgets/files/path_line.h"

#include <fmt/format.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::editor {
namespace {

std::vector<ui::ExportChoice> modalityChoices(RenderMode mode) {
    std::vector<ui::ExportChoice> choices;
    for (const render::Modality& one : render::modalities()) {
        if ((one.needs & render::kNeedsRig) != 0) continue;  // available with a rig only
        const bool colour =
            (one.needs & (render::kNeedsRgb | render::kNeedsLayers | render::kNeedsSensorLight)) !=
                0 ||
            one.name == std::string_view("rgb_right");
        const bool traced = (one.needs & render::kNeedsLayers) != 0;
        choices.push_back({one.name, one.text, one.standard, colour,
                           std::string(render::groupName(one.group)),
                           traced && mode == RenderMode::Fast
                               ? "Set render mode to traced or reference to write it."
                               : ""});
    }
    return choices;
}

std::vector<ui::ExportChoice> formatChoices() {
    std::vector<ui::ExportChoice> choices;
    for (const render::Format& one : render::formats()) {
        const char* missing = one.missing != nullptr ? one.missing() : nullptr;
        choices.push_back({one.name, one.text, one.standard, (one.needs & render::kNeedsRgb) != 0,
                           std::string(render::groupName(one.group)),
                           missing != nullptr ? missing : ""});
    }
    return choices;
}

template <class Row>
std::vector<std::string> namesOf(const Result<std::vector<const Row*>>& rows) {
    std::vector<std::string> names;
    for (const Row* row : rows.value_or(std::vector<const Row*>())) names.emplace_back(row->name);
    return names;
}

std::vector<ui::ExportPresetChoice> presetChoices() {
    std::vector<ui::ExportPresetChoice> choices;
    for (const render::ExportPreset& one : render::exportPresets()) {
        choices.push_back({one.name, one.title, one.text,
                           namesOf(render::chooseModalities(one.modalities)),
                           namesOf(render::chooseFormats(one.formats))});
    }
    return choices;
}

/// Estimated bytes of a frame with the selected contents.
double bytesPerFrame(const ui::ExportView& view, const ui::ExportDraft& draft) {
    const std::size_t distances = 1 + std::ranges::count(draft.flow_distances, ',');
    const double pixels = 1.0 * view.camera.width_px * view.camera.height_px;
    const auto isWritten = [](const auto& row, const std::vector<ui::ExportChoice>& choices,
                              const std::vector<std::string>& turned) {
        const auto choice = std::ranges::find(choices, row.name, &ui::ExportChoice::name);
        return choice != choices.end() && ui::isWritten(*choice, turned);
    };
    double bytes = 0.0;
    for (const render::Modality& one : render::modalities()) {
        if (!isWritten(one, view.modalities, draft.turned_modalities)) continue;
        bytes += render::bytesPerFrame(one, pixels, distances);
    }
    for (const render::Format& one : render::formats()) {
        if (isWritten(one, view.formats, draft.turned_formats)) {
            bytes += one.bytes_per_pixel * pixels;
        }
    }
    return bytes;
}

/// A typed path, made absolute; empty if nothing was typed.
std::filesystem::path typedHere(const std::string& text) {
    std::error_code ignored;
    return text.empty() ? std::filesystem::path()
                        : ui::typedPath(text, std::filesystem::current_path(ignored));
}

/// Describes a complete dataset: "40 frames, written 2024-05-31 17:04:09". Reads its dataset.json,
/// or that of each room.
std::string describeDataset(const std::filesystem::path& folder) {
    std::error_code error;
    const bool of_rooms = !std::filesystem::exists(folder / render::kCardFile, error);
    std::vector<std::filesystem::path> datasets = {folder};
    std::filesystem::path newest = folder / render::kCardFile;
    if (of_rooms) {
        newest = folder / "rooms.json";
        datasets.clear();
        const nlohmann::json rooms = readBoundedJson(newest).value_or(nlohmann::json());
        for (const nlohmann::json& room : listIn(rooms, "rooms")) {
            datasets.push_back(folder / textIn(room, "name"));
        }
    }
    std::size_t frames = 0;
    for (const std::filesystem::path& dataset : datasets) {
        if (const auto opened = GuardedFolder::open(dataset)) {
            frames += render::framesListed(*opened);
        }
    }
    const std::filesystem::file_time_type written = std::filesystem::last_write_time(newest, error);
    return fmt::format("{} frame{}, written {}", frames, frames == 1 ? "" : "s",
                       error ? "at an unknown time" : localTime(written));
}

/// Converts a finding to the panel's text.
void say(const FolderFinding& found, bool other_files_may_stay, ui::ExportView& view) {
    using Kind = FolderFinding::Kind;
    view.folder_warns = true;
    switch (found.kind) {
        case Kind::Unknown:
        case Kind::Free:
            break;
        case Kind::New:
            view.folder_warns = false;
            view.folder_says = "It will be created.";
            break;
        case Kind::NewInNew:
            view.folder_says = fmt::format("It will be created, with all folders below {}.",
                                           found.around.string());
            break;
        case Kind::Dataset:
            view.folder_says = "It contains a dataset; Export asks before replacing it.";
            break;
        case Kind::Unfinished:
            view.folder_says = "Its unfinished export will be replaced.";
            break;
        case Kind::OtherFiles:
            if (other_files_may_stay) {
                view.folder_says = "It contains other files, which are kept.";
            } else {
                view.why_not_folder =
                    "It contains other files: choose another folder, or tick the box that allows "
                    "them.";
            }
            break;
        case Kind::NoFolder:
            view.why_not_folder = found.around.empty()
                                      ? "This is a file, not a folder."
                                      : found.around.string() + " is a file, not a folder.";
            break;
    }
}

}  // namespace

std::filesystem::path Editor::exportFolder() const {
    return typedHere(panels_.export_draft.folder);
}

void Editor::makeExportQueue() {
    const Result<std::filesystem::path> program = findExportProgram();
    if (!program) {
        why_no_export_ = describe(program.error());
        return;
    }
    exports_ = std::make_unique<ExportQueue>(stateFolder() / "exports", *program, &Window::wake);
    why_no_folders_ = whyNoFolders();
}

ui::ExportView Editor::exportView() {
    ui::ExportView view;
    const ui::ExportDraft& draft = panels_.export_draft;
    if (workspace_.isOpen() && parameters_.read(workspace_.state().parameters)) {
        view.parameters = &parameters_.fields();
        view.standard = &parameters_.standard();
    }
    if (!draft.folder.empty()) {
        say(export_folder_.of(exportFolder()), draft.overwrite, view);
    }
    view.project = workspace_.path().empty() && workspace_.isOpen()
                       ? workspace_.sceneFile().stem().string()
                       : workspace_.path().stem().string();
    if (!exports_) {
        view.why_not = why_no_export_;
    } else if (!workspace_.isOpen()) {
        view.why_not = "No scene is open.";
    } else if (!workspace_.planIsCurrent()) {
        view.why_not =
            workspace_.planError().empty() ? "Planning is still running." : workspace_.planError();
    } else if (frameCount() == 0) {
        view.why_not = "There is no trajectory, because no object can be captured.";
    }
    if (const std::size_t collisions = plan_timeline_.collisions().size(); collisions > 0) {
        view.doubt = fmt::format("The camera collides in {} place{}.", collisions,
                                 collisions == 1 ? "" : "s");
    }
    view.frame_count = frameCount();
    view.current_frame = playback_.frame();
    view.camera = workspace_.shown().params.camera;
    view.has_tracks = hasTracks();
    view.modalities = modalityChoices(parameters_.params().picture.render_mode);
    view.formats = formatChoices();
    view.presets = presetChoices();
    view.bytes_per_frame = bytesPerFrame(view, draft);
    if (exports_) {
        view.jobs = exports_->jobs();
        view.held = exports_->held();
        const ui::ExportJob* job =
            draft.folder.empty() ? nullptr : jobThatWillWrite(exportFolder(), view.jobs);
        if (job != nullptr) {
            // Not a warning: every export that is started here leads to this state.
            view.folder_warns = false;
            view.folder_says = fmt::format("The export of {} {} here.", job->request.name,
                                           job->active() ? "writes" : "will write");
            if (view.why_not.empty()) {
                view.why_not = view.folder_says + " Choose another folder for one more.";
            }
        }
    }
    view.why_no_folder = why_no_folders_;
    view.reading = other_projects_.reading().filename().string();
    return view;
}

void Editor::drawExport() {
    const ui::ExportView view = exportView();
    const ui::ExportActions actions = ui::drawExportPanel(view, panels_.export_draft);
    export_missing_ = actions.missing_height;
    if (!actions.edited.empty()) setParameter(actions.edited);
    if (actions.finished) workspace_.endMerge();
    if (actions.choose_folder) askForFile("export folder");
    if (actions.choose_rig) askForFile("export rig");
    if (actions.add_files) askForFile("export projects");
    if (actions.cancel_reading) other_projects_.cancel();
    if (!exports_) return;
    if (actions.add_current && view.why_not.empty()) queueExport(view);
    if (actions.toggle_hold) exports_->hold(!exports_->held());
    if (actions.cancel != 0) exports_->cancel(actions.cancel);
    if (actions.resume != 0) resumeExport(actions.resume, view.jobs);
    if (actions.remove != 0) exports_->remove(actions.remove);
    if (actions.earlier != 0) exports_->move(actions.earlier, -1);
    if (actions.later != 0) exports_->move(actions.later, 1);
    const int wanted = actions.open_folder != 0 ? actions.open_folder : actions.show_sheet;
    for (const ui::ExportJob& job : view.jobs) {
        if (job.id != wanted) continue;
        if (actions.show_sheet != 0) {
            sheet_.show(job.contact_sheet);
        } else if (const Status opened = openFolder(job.request.folder); !opened) {
            log::warn("export", describe(opened.error()));
        }
    }
}

void Editor::resumeExport(int id, const std::vector<ui::ExportJob>& jobs) {
    const auto job = std::ranges::find(jobs, id, &ui::ExportJob::id);
    const ui::ExportJob* other =
        job != jobs.end() ? jobThatWillWrite(job->request.folder, jobs) : nullptr;
    if (other == nullptr) return exports_->resume(id);
    questions_.tell({true,
                     "The folder is in use",
                     fmt::format("{} is being exported into {}.\nTry again when it has finished.",
                                 other->request.name, other->request.folder.string()),
                     {}});
}

void Editor::queueExport(const ui::ExportView& view) {
    ui::ExportRequest request = ui::requestOf(view, panels_.export_draft);
    request.folder = exportFolder();
    request.rig = typedHere(panels_.export_draft.rig);
    auto add = [this, project = std::make_shared<const ProjectFile>(workspace_.snapshot())](
                   const ui::ExportRequest& wanted) { exports_->add(wanted, project); };
    // Checked again now, because an export may just have finished there.
    const FolderFinding found = lookAtFolder(request.folder);
    if (found.kind == FolderFinding::Kind::Dataset) return askToReplace(request, add);
    if (found.kind != FolderFinding::Kind::NewInNew) return add(request);
    // Several missing folders suggest a typing error.
    questions_.ask({"Create the folders?",
                    fmt::format("{}\ndoes not exist; only {} does.", request.folder.string(),
                                found.around.string()),
                    {{"Create and export", [add, request] { add(request); }}}});
}

void Editor::askToReplace(const ui::ExportRequest& request,
                          const std::function<void(const ui::ExportRequest&)>& add) {
    ui::ExportRequest beside = request;
    beside.folder = freeFolderBeside(request.folder, exports_->jobs());
    ui::ExportRequest replacing = request;
    replacing.overwrite = true;
    questions_.ask(
        {"The folder contains a dataset",
         fmt::format("{} contains {}.\nOverwriting replaces it when the new one is complete.",
                     request.folder.string(), describeDataset(request.folder)),
         {{"Export to " + beside.folder.filename().string(),
           [this, add, beside] {
               panels_.export_draft.folder = beside.folder.string();
               add(beside);
           }},
          {"Overwrite", [add, replacing] { add(replacing); }}},
         false});
}

void Editor::answerExportFile(const ui::FileAnswer& answer) {
    if (answer.id == "export folder") panels_.export_draft.folder = answer.path.string();
    if (answer.id == "export rig") panels_.export_draft.rig = answer.path.string();
    if (answer.id == "export projects" && exports_) {
        other_projects_.read(answer.path);
    }
}

void Editor::addOtherProject(const OtherProject& other) {
    if (!other.render_mode) {
        questions_.tell(
            {true, "The project cannot be exported", describe(other.render_mode.error()), {}});
        return;
    }
    const std::filesystem::path& project = other.file;
    // What can be written depends on that project's parameters, not on those of the open one.
    const ui::ExportDraft& draft = panels_.export_draft;
    ui::ExportView view = exportView();
    view.modalities = modalityChoices(*other.render_mode);
    const std::string left_out = ui::leftOut(view, draft);
    ui::ExportRequest request = ui::requestOf(view, draft);
    if (request.modalities.empty() && !left_out.empty()) {
        questions_.tell({true,
                         "Nothing would be exported",
                         fmt::format("{} cannot be written for {}, whose render mode is fast.",
                                     left_out, project.filename().string()),
                         {}});
        return;
    }
    request.name = project.stem().string();
    request.rig = typedHere(draft.rig);
    request.range = ui::rangeForOthers(draft);
    request.frames = 0;
    const std::filesystem::path beside = request.folder.empty() ? project : exportFolder();
    request.folder = folderBeside(beside, project, exports_->jobs());
    exports_->addFile(std::move(request), project);
    if (left_out.empty()) return;
    questions_.tell({false,
                     "Some modalities are left out",
                     fmt::format("{} is exported without {}, because its render mode is fast.\n"
                                 "Set it to traced or reference to write them.",
                                 project.filename().string(), left_out),
                     {}});
}

void Editor::drawSheet() {
    const ui::ImageViewerView view = sheet_.view();
    if (!sheet_.isOpen()) return;
    const ImGuiViewport* screen = ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(screen->WorkPos);
    ImGui::SetNextWindowSize(screen->WorkSize);
    ImGui::SetNextWindowFocus();
    ImGui::Begin(
        "contact sheet", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    const bool closed = ui::drawImageViewer(view, panels_.sheet).close;
    ImGui::End();
    if (closed || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) sheet_.close();
}

}  // namespace dollytrack::editor
