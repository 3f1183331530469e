#pragma once

#include "app/editor/project/light_worker.h"
#include "app/editor/project/live_planner.h"
#include "ui/viewport/render_thread.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace dollytrack::editor {

/// Keeps the render thread's scene up to date and sends only changes.
class RenderSceneSync {
  public:
    explicit RenderSceneSync(ui::RenderThread& drawing) : drawing_(drawing) {}

    /// Resets for another project, or none.
    void forget();
    /// Sends scene, light and texture filtering if one of them has changed.
    void send(const PlanOutcome& shown, const LightWorker& light);
    [[nodiscard]] bool isSent() const { return sent_; }
    /// Whether this is the first call for the project, so that the camera must be placed.
    [[nodiscard]] bool takeFirstView() { return !std::exchange(viewed_, true); }

  private:
    ui::RenderThread& drawing_;
    bool sent_ = false;
    bool viewed_ = false;
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const render::LightVolume> light_;
    bool light_is_coarse_ = false;
    int anisotropy_ = 0;
};

}  // namespace dollytrack::editor
