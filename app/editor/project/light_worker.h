#pragma once

#include "app/editor/project/live_planner.h"
#include "engine/jobs/background_worker.h"
#include "engine/scene/light_params.h"
#include "render/light/light_volume.h"

#include <Eigen/Geometry>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace dollytrack::editor {

/// Bakes the light of the displayed scene in the background: in large scenes first on a coarse
/// grid, then as for export. Baking pauses while plans are being made. All functions are called
/// from one thread and return at once.
class LightWorker {
  public:
    explicit LightWorker(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Starts to bake the light of a measured plan, unless it is baked, being baked or stopped.
    void follow(const PlanOutcome& shown);
    /// While set, baking waits after its current piece of work, because plans take precedence.
    void setWaiting(bool waiting) { *waiting_ = waiting; }
    /// Takes what has been baked since the last call.
    void poll();
    /// Drops the light of a scene that is no longer shown, also if it is still being baked.
    void drop();
    /// Stops baking; light() stays as it is until start(), or until follow() gets a plan with
    /// another light.
    void stop();
    /// Bakes the light again after stop(), from the beginning.
    void start();

    /// Null: not baked yet.
    [[nodiscard]] std::shared_ptr<const render::LightVolume> light() const { return light_; }
    /// Whether light() is as for export.
    [[nodiscard]] bool isFinal() const { return light_ != nullptr && is_final_; }
    [[nodiscard]] bool stopped() const { return stopped_; }
    [[nodiscard]] BackgroundWorker::State state() const { return worker_.state(); }

  private:
    struct Order {
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<const RayCaster> rays;
        std::uint64_t geometry = 0;
        std::vector<Eigen::AlignedBox3d> rooms;
        LightParams params;

        /// Whether both orders lead to the same light. `geometry` stands for the scene.
        [[nodiscard]] bool hasSameLightAs(const Order& other) const;
    };
    struct Baked {
        int number = 0;  // of the order
        render::LightVolume light;
        bool is_final = false;
    };

    void bake();

    Order order_;  // the newest one; without a scene: none
    int number_ = 0;
    bool stopped_ = false;
    std::shared_ptr<const render::LightVolume> light_;
    bool is_final_ = false;  // light_ is the final one for order_
    std::shared_ptr<std::atomic<bool>> waiting_ = std::make_shared<std::atomic<bool>>(false);
    std::shared_ptr<LatestValue<Baked>> baked_ = std::make_shared<LatestValue<Baked>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack::editor
