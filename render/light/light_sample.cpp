#include "render/light/light_sample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

/// The eight cells around a position with trilinear weights, as in texture filtering.
class Around {
  public:
    Around(const LightVolume& light, const Eigen::Vector3d& position) {
        std::array<std::array<int, 2>, 3> cells;
        std::array<float, 3> toward;
        for (int axis = 0; axis < 3; ++axis) {
            const double place = (position[axis] - light.low[axis]) / light.cell_m - 0.5;
            const double whole = std::floor(place);
            const int last = light.cells[axis] - 1;
            const std::size_t i = axis;
            toward[i] = static_cast<float>(place - whole);
            cells[i][0] = static_cast<int>(std::clamp(whole, 0.0, static_cast<double>(last)));
            cells[i][1] = static_cast<int>(std::clamp(whole + 1.0, 0.0, static_cast<double>(last)));
        }
        for (std::size_t k = 0; k < 8; ++k) {
            index_[k] = light.index(cells[0][k & 1], cells[1][(k >> 1) & 1], cells[2][k >> 2]);
            weight_[k] = ((k & 1) != 0 ? toward[0] : 1.0F - toward[0]) *
                         ((k & 2) != 0 ? toward[1] : 1.0F - toward[1]) *
                         ((k & 4) != 0 ? toward[2] : 1.0F - toward[2]);
        }
    }

    [[nodiscard]] Eigen::Vector3f mean(const std::vector<Eigen::Vector3f>& values) const {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        if (values.empty()) return sum;
        for (std::size_t k = 0; k < 8; ++k) sum += weight_[k] * values[index_[k]];
        return sum;
    }
    [[nodiscard]] float mean(const std::vector<float>& values) const {
        float sum = 0.0F;
        if (values.empty()) return sum;
        for (std::size_t k = 0; k < 8; ++k) sum += weight_[k] * values[index_[k]];
        return sum;
    }

  private:
    std::array<std::size_t, 8> index_{};
    std::array<float, 8> weight_{};
};

}  // namespace

Eigen::Vector3f irradianceAt(const LightVolume& light, const Eigen::Vector3d& position,
                             const Eigen::Vector3d& normal) {
    // Offset out of the cell behind the surface.
    const Around cells(light, position + light.cell_m * normal);
    const Eigen::Vector3f n = normal.cast<float>();
    const Eigen::Vector3f lamps = cells.mean(light.lamps);
    const float own = cells.mean(light.scene_lamp_share);
    const Eigen::Vector3f lamp_light =
        (1.0F - own) * light.lamp_color + own * light.scene_lamp_color;
    return cells.mean(light.ambient) * (1.0F + cells.mean(light.slope).dot(n)) +
           lamp_light * std::max(lamps.dot(n), 0.0F);
}

Eigen::Vector3f lightFrom(const LightVolume& light, const Eigen::Vector3d& position,
                          const Eigen::Vector3d& way) {
    const Around cells(light, position + light.cell_m * way);
    const float slope = cells.mean(light.slope).dot(way.cast<float>());
    return cells.mean(light.ambient) * std::max(0.0F, 1.0F + 1.5F * slope);
}

}  // namespace dollytrack::render
