#pragma once

#include "engine/jobs/background_worker.h"
#include "engine/scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::editor {

/// Computes the connected pieces of the selected object in the background; a million triangles take
/// a while. Main thread only.
class PieceCount {
  public:
    explicit PieceCount(std::function<void()> wake) : counter_(std::move(wake)) {}

    /// The sizes of the object's pieces, see pieceSizes(); null while they are being computed. To
    /// be called every frame while the object is selected.
    const std::vector<double>* of(const std::shared_ptr<const Scene>& scene, int object);

  private:
    struct Counted {
        std::shared_ptr<const Scene> scene;
        int object = 0;
        std::vector<double> sizes_m;
    };
    std::shared_ptr<const Scene> asked_scene_;
    int asked_object_ = 0;
    std::optional<Counted> counted_;
    std::shared_ptr<LatestValue<Counted>> answer_ = std::make_shared<LatestValue<Counted>>();
    BackgroundWorker counter_;
};

}  // namespace dollytrack::editor
