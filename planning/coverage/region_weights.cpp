#include "planning/coverage/region_weights.h"

#include <algorithm>

namespace dollytrack::planning {

std::vector<double> objectWeights(const Scene& scene, const std::vector<Region>& regions) {
    std::vector<double> weights;
    bool any = false;
    for (const Object& object : scene.objects) {
        double weight = 1.0;
        bool inside = false;
        for (const Region& region : regions) {
            if (!region.box.contains(object.box.center)) continue;
            weight = inside ? std::max(weight, region.weight) : region.weight;
            inside = true;
        }
        any = any || weight != 1.0;
        weights.push_back(weight);
    }
    if (!any) weights.clear();
    return weights;
}

std::vector<double> pointWeights(const std::vector<PositionPoint>& points,
                                 const std::vector<double>& object_weights) {
    std::vector<double> weights;
    if (object_weights.empty()) return weights;
    for (const PositionPoint& point : points) {
        double weight = point.captured.empty() ? 1.0 : 0.0;
        for (const int id : point.captured) {
            weight = std::max(weight, object_weights[id - 1]);
        }
        weights.push_back(weight);
    }
    return weights;
}

}  // namespace dollytrack::planning
