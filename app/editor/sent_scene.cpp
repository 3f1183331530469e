#include "app/editor/sent_scene.h"

namespace dollytrack::editor {

void SentScene::forget() {
    sent_ = false;
    looked_at_ = false;
    geometry_ = 0;
    scene_.reset();
    light_.reset();
}

bool SentScene::send(const PlanOutcome& shown,
                     const std::shared_ptr<const render::LightVolume>& light) {
    if (sent_ && scene_ == shown.scene && light_ == light) return false;
    drawing_.setScene(shown.scene, light, shown.geometry);
    scene_ = shown.scene;
    light_ = light;
    sent_ = true;
    return std::exchange(geometry_, shown.geometry) != shown.geometry;
}

}  // namespace dollytrack::editor
