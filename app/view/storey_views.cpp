#include "app/view/storey_views.h"

#include "engine/math/quantile.h"

#include <algorithm>

namespace dollytrack::view {
namespace {

constexpr double kBelowCeiling_m = 0.02;
constexpr std::size_t kMostRays = 2000;

/// Heights at which rays straight up from cameras between two heights hit structure.
std::vector<double> ceilingsAbove(const Scene& scene, const RayCaster& rays,
                                  const verify::StoredDataset& dataset, double low, double high) {
    std::vector<double> heights;
    const std::size_t step = dataset.frames.size() / kMostRays + 1;
    for (std::size_t i = 0; i < dataset.frames.size(); i += step) {
        const Eigen::Vector3d& from = dataset.frames[i].pose.position;
        if (from.z() < low || from.z() > high) continue;
        const RayHit hit = rays.cast(from, Eigen::Vector3d::UnitZ());
        if (hit.object_id == 0 || !scene.object(hit.object_id).structure) continue;
        heights.push_back(from.z() + hit.distance);
    }
    return heights;
}

}  // namespace

std::vector<PageStorey> storeysFor(const Scene& scene, const RayCaster& rays,
                                   const verify::StoredDataset& dataset) {
    std::vector<PageStorey> storeys;
    for (render::StoreyView view : render::storeysOf(scene, {})) {
        std::vector<double> heights =
            ceilingsAbove(scene, rays, dataset, view.floor_z, view.ceiling_z);
        if (!heights.empty()) {
            view.ceiling_z =
                std::min(view.ceiling_z, upperMedian(std::move(heights)) - kBelowCeiling_m);
        }
        storeys.push_back({view, render::withinStorey(render::buildingOf(scene, {}), view)});
    }
    return storeys;
}

}  // namespace dollytrack::view
