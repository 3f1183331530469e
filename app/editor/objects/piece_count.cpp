#include "app/editor/objects/piece_count.h"

#include "engine/document/regroup.h"

namespace dollytrack::editor {

const std::vector<double>* PieceCount::of(const std::shared_ptr<const Scene>& scene, int object) {
    if (!scene || object < 1 || static_cast<std::size_t>(object) > scene->objects.size()) {
        return nullptr;
    }
    if (auto answer = answer_->take()) counted_ = std::move(*answer);
    if (scene != asked_scene_ || object != asked_object_) {
        asked_scene_ = scene;
        asked_object_ = object;
        counter_.start([scene, object, latest = answer_](const JobContext&) {
            latest->put({scene, object, pieceSizes(*scene, scene->object(object))});
        });
    }
    if (!counted_ || counted_->scene != scene || counted_->object != object) return nullptr;
    return &counted_->sizes_m;
}

}  // namespace dollytrack::editor
