#include "render/verify/compare/stereo_pair.h"

namespace dollytrack::verify {

std::optional<double> baselineOf(const StoredDataset& dataset) {
    for (const char* const modality : {"disparity", "rgb_right", "depth_right"}) {
        const auto convention = dataset.convention(modality);
        if (dataset.has(modality) && convention.is_object() && convention.contains("baseline_m")) {
            return convention["baseline_m"].get<double>();
        }
    }
    return std::nullopt;
}

Pose rightOf(const Pose& left, double baseline_m) {
    return {left.position + baseline_m * (left.rotation * Eigen::Vector3d::UnitX()), left.rotation};
}

}  // namespace dollytrack::verify
