#include "app/editor/viewport/render_scene_sync.h"

namespace dollytrack::editor {

void RenderSceneSync::forget() {
    sent_ = false;
    viewed_ = false;
    scene_.reset();
    light_.reset();
}

void RenderSceneSync::send(const PlanOutcome& shown, const LightWorker& lighter) {
    const int anisotropy = shown.params.picture.anisotropy;
    const std::shared_ptr<const render::LightVolume> light = lighter.light();
    const bool coarse = light != nullptr && !lighter.isFinal();
    if (sent_ && scene_ == shown.scene && light_ == light && light_is_coarse_ == coarse &&
        anisotropy_ == anisotropy) {
        return;
    }
    drawing_.setScene({shown.scene, shown.rays, light, anisotropy, shown.geometry, coarse});
    anisotropy_ = anisotropy;
    scene_ = shown.scene;
    light_ = light;
    light_is_coarse_ = coarse;
    sent_ = true;
}

}  // namespace dollytrack::editor
