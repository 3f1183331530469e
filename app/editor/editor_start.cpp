#include "app/editor/editor.h"
#include "engine/core/program_file.h"

#include <imgui.h>
#include <nlohmann/json.hpp>

namespace dollytrack::editor {

std::string Editor::exampleScene() {
    const std::filesystem::path file =
        (ownFile().parent_path() / "../share/dollytrack/scenes/apartment.glb").lexically_normal();
    std::error_code error;
    return std::filesystem::exists(file, error) ? file.string() : std::string();
}

void Editor::keepPicture() {
    if (has_picture_ && !noted_file_.empty()) recent_.keepPicture(noted_file_, drawing_.view());
}

void Editor::drawStart() {
    ui::ViewportView background;
    background.covered = true;
    const ImVec2 at = ImGui::GetCursorPos();
    pane_ = ui::drawViewport(background, panels_.viewport);
    std::vector<std::string> paths = settings_.recent;
    if (!example_.empty()) paths.push_back(example_);
    ui::StartView view;
    view.recent = recent_.of(paths);
    if (!example_.empty()) {
        view.example = view.recent.back();
        view.recent.pop_back();
    }
    ImGui::SetCursorPos(at);
    const ui::StartActions actions = ui::drawStartPanel(view, panels_.start);
    if (!actions.remove.empty()) settings_.removeRecent(actions.remove);
    if (!actions.open.empty()) workspace_.open(actions.open);
    if (actions.choose_file) askForFile("open");
}

nlohmann::json Editor::startJson() const {
    nlohmann::json files = nlohmann::json::array();
    for (const ui::RecentFile& file : recent_.files()) {
        files.push_back(
            {{"path", file.path}, {"missing", file.missing}, {"picture", file.texture != 0}});
    }
    return {{"shown", panels_.start.frames > 0},
            {"ready", recent_.ready()},
            {"chosen", panels_.start.chosen},
            {"files", std::move(files)}};
}

}  // namespace dollytrack::editor
