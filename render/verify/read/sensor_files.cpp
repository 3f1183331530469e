#include "render/verify/read/sensor_files.h"

#include <fmt/format.h>

namespace dollytrack::verify {

std::string storedFile(const StoredDataset& dataset, const ImageKind& kind, int frame) {
    if (std::string_view(kind.modality) == "rgb_sensor") {
        const auto convention = dataset.convention(kind.modality);
        if (convention.is_object() && convention.value("ending", "") == ".jpg") {
            return fmt::format("{}/{:06}.jpg", kind.modality, frame);
        }
    }
    return imageFile(kind, frame);
}

Eigen::Vector2d StoredDistortion::inSensor(const Intrinsics& lens, double x, double y) const {
    const double u = (x - lens.cx) / lens.fx, v = (y - lens.cy) / lens.fy;
    const double r2 = u * u + v * v;
    const double radial = 1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
    return {lens.fx * (u * radial + 2 * p1 * u * v + p2 * (r2 + 2 * u * u)) + lens.cx,
            lens.fy * (v * radial + p1 * (r2 + 2 * v * v) + 2 * p2 * u * v) + lens.cy};
}

std::optional<StoredDistortion> distortionOf(const StoredDataset& dataset) {
    const auto convention = dataset.convention("rgb_sensor");
    if (!convention.is_object() || !convention.contains("distortion")) return std::nullopt;
    const auto& said = convention["distortion"];
    StoredDistortion result;
    for (const auto& [key, value] : {std::pair("k1", &result.k1),
                                     {"k2", &result.k2},
                                     {"p1", &result.p1},
                                     {"p2", &result.p2},
                                     {"k3", &result.k3}}) {
        if (!said.is_object() || !said.contains(key) || !said[key].is_number()) return std::nullopt;
        *value = said[key].get<double>();
    }
    return result;
}

StoredDistortion distortionOfPictures(const StoredDataset& dataset) {
    if (dataset.has("rgb") || !dataset.has("rgb_sensor")) return {};
    return distortionOf(dataset).value_or(StoredDistortion{});
}

}  // namespace dollytrack::verify
