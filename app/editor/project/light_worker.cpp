#include "app/editor/project/light_worker.h"

#include "engine/geometry/ray_caster.h"
#include "engine/scene/resolved_light.h"
#include "render/light/light_cache.h"
#include "render/light/light_rig.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

namespace dollytrack::editor {
namespace {

/// A context that waits at each progress report while `waiting` is set. Cancelling also takes
/// effect only at progress reports.
JobContext waitingContext(const JobContext& job, std::shared_ptr<const std::atomic<bool>> waiting) {
    auto cancelled = std::make_shared<std::atomic<bool>>(false);
    const auto report = [job, cancelled, waiting = std::move(waiting)](double fraction,
                                                                       std::string_view) {
        constexpr std::chrono::milliseconds kPollInterval{20};
        job.report(fraction);
        while (*waiting && !job.cancelled()) std::this_thread::sleep_for(kPollInterval);
        if (job.cancelled()) *cancelled = true;
    };
    return {cancelled, report};
}

/// The number of cells of a light volume without the limit LightVolumeParams::max_cells.
double cellsOf(const Scene& scene, const render::LightVolumeParams& params) {
    return scene.room_bounds.sizes().prod() / std::pow(params.cell_m, 3.0);
}

}  // namespace

bool LightWorker::Order::hasSameLightAs(const Order& other) const {
    const auto equal = [](const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
        return a.min() == b.min() && a.max() == b.max();
    };
    return scene && geometry == other.geometry && params == other.params &&
           std::ranges::equal(rooms, other.rooms, equal);
}

void LightWorker::follow(const PlanOutcome& shown) {
    Order order{shown.scene, shown.rays, shown.geometry, shown.plan->rooms, shown.params.light};
    if (order_.hasSameLightAs(order)) return;
    order_ = std::move(order);
    stopped_ = false;
    bake();
}

void LightWorker::bake() {
    is_final_ = false;
    worker_.start([order = order_, number = ++number_, latest = baked_,
                   waiting = waiting_](const JobContext& job) {
        // Baking on the coarse grid takes about a tenth of the time.
        constexpr render::LightVolumeParams kCoarse = {.max_cells = 40'000};
        constexpr double kLarge = 3.0 * kCoarse.max_cells;  // cells of a large scene
        const JobContext context = waitingContext(job, waiting);
        const render::LightRig rig =
            render::makeLightRig(*order.scene, *order.rays, order.rooms, resolved(order.params));
        const auto put = [&](render::LightVolume light, bool is_final) {
            if (!context.cancelled()) latest->put({number, std::move(light), is_final});
        };
        context.report(0.0);
        double begun = 0.0;
        if (cellsOf(*order.scene, {}) > kLarge &&
            !render::isLightVolumeKept(*order.scene, rig, {})) {
            begun = 0.1;
            put(render::lightVolumeOf(*order.scene, *order.rays, rig, kCoarse,
                                      context.stage(0.0, begun, "light")),
                false);
        }
        if (context.cancelled()) return;
        put(render::lightVolumeOf(*order.scene, *order.rays, rig, {},
                                  context.stage(begun, 1.0, "light")),
            true);
    });
}

void LightWorker::poll() {
    std::optional<Baked> baked = baked_->take();
    if (!baked || baked->number != number_) return;
    light_ = std::make_shared<const render::LightVolume>(std::move(baked->light));
    is_final_ = baked->is_final;
    // The final light may arrive just before it is stopped.
    if (is_final_) stopped_ = false;
}

void LightWorker::drop() {
    worker_.cancel();
    ++number_;
    order_ = {};
    light_.reset();
    stopped_ = false;
}

void LightWorker::stop() {
    worker_.cancel();
    stopped_ = order_.scene && !isFinal();
}

void LightWorker::start() {
    if (!std::exchange(stopped_, false)) return;
    bake();
}

}  // namespace dollytrack::editor
