#pragma once

#include "app/editor/autosave.h"
#include "app/editor/settings.h"
#include "app/editor/window.h"
#include "app/editor/workspace.h"
#include "ui/panels/log_panel.h"
#include "ui/panels/objects_panel.h"
#include "ui/viewport/render_thread.h"
#include "ui/viewport/viewport_pane.h"
#include "ui/widgets/command_table.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>

namespace dollytrack::editor {

/// The shell: puts the panels into the window and turns what they report into changes of the
/// workspace. Whatever takes time happens elsewhere.
class Editor {
  public:
    Editor(Window& window, std::unique_ptr<gl::Context> drawing, ui::LogBook& log,
           EditorSettings settings);
    ~Editor();

    void open(const std::filesystem::path& path) { workspace_.open(path); }

    /// Draws one frame; false ends the program.
    bool frame();

    /// What is shown and where, for Inspector.
    [[nodiscard]] nlohmann::json stateJson();

  private:
    void addCommands();
    void refreshScene();
    void refreshPicture(const ui::ViewportActions& pane);
    void drawMenus();
    void drawLeft();
    void drawRight();
    void drawBottom();
    void drawCentre();
    void drawStatus();
    void drawDialogs();
    void editParameters();
    void autosave();
    void select(int object, bool add);
    void setTheme();
    [[nodiscard]] Eigen::AlignedBox3d selectedBox() const;

    Window& window_;
    ui::LogBook& log_;
    EditorSettings settings_;
    Workspace workspace_;
    Autosave autosave_;
    ui::RenderThread drawing_;
    ui::CommandTable commands_;

    // What the widgets remember.
    ui::ViewportState viewport_;
    ui::ObjectsPanelState objects_;
    ui::LogPanelState log_state_;
    std::string parameter_filter_;
    planning::PlanParams draft_;
    planning::PlanParams standard_;
    FieldList draft_fields_;
    FieldList standard_fields_;
    std::vector<int> selected_;  // ids
    std::vector<bool> hidden_;   // by id
    bool cut_open_ = true;       // ceilings and near walls left away from outside
    std::uint64_t drawn_geometry_ = 0;
    const void* drawn_light_ = nullptr;
    bool scene_sent_ = false;
    ui::ViewportActions pane_;
    CommandStack::State autosaved_;
    bool quitting_ = false;
};

}  // namespace dollytrack::editor
