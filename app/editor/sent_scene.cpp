#include "app/editor/sent_scene.h"

namespace dollytrack::editor {

void SentScene::forget() {
    sent_ = false;
    looked_at_ = false;
    objects_since_ = 0;
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
    return std::exchange(objects_since_, shown.objects_since) != shown.objects_since;
}

}  // namespace dollytrack::editor
