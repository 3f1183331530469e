#pragma once

#include "app/editor/project/live_planner.h"
#include "render/light/light_volume.h"
#include "ui/viewport/render_thread.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace dollytrack::editor {

/// Keeps the drawing thread's scene the one that is shown, sending only what is new.
class SentScene {
  public:
    explicit SentScene(ui::RenderThread& drawing) : drawing_(drawing) {}

    /// Another project is open, or none: nothing of it is sent yet.
    void forget();
    /// Sends the scene and its light where they are others than before.
    void send(const PlanOutcome& shown, const std::shared_ptr<const render::LightVolume>& light);
    [[nodiscard]] bool isSent() const { return sent_; }
    /// Whether the project was not looked at before; once.
    [[nodiscard]] bool takeFirstLook() { return !std::exchange(looked_at_, true); }

  private:
    ui::RenderThread& drawing_;
    bool sent_ = false;
    bool looked_at_ = false;
    std::shared_ptr<const Scene> scene_;
    std::shared_ptr<const render::LightVolume> light_;
    int anisotropy_ = 0;
};

}  // namespace dollytrack::editor
