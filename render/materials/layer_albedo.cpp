#include "render/materials/layer_albedo.h"

#include "render/materials/ggx.h"

#include <algorithm>
#include <vector>

namespace dollytrack::render {
namespace {

constexpr int kAngles = 32;
constexpr int kWidths = 32;
constexpr int kSide = 24;  // facets per table cell: kSide squared

struct Table {
    std::vector<LayerAlbedo> cells;  // by roughness, then by the square root of the cosine
    std::vector<float> mean;         // by roughness

    Table() : cells(kAngles * kWidths), mean(kWidths) {
        for (int width = 0; width < kWidths; ++width) {
            const double roughness = width / (kWidths - 1.0);
            for (int angle = 0; angle < kAngles; ++angle) {
                const double root = std::max(angle, 1) / (kAngles - 1.0);
                cells[static_cast<std::size_t>(width) * kAngles + angle] =
                    integrate(angle == 0 ? 1e-4 : root * root, ggxWidth(roughness));
            }
            mean[width] = static_cast<float>(meanOf(width));
        }
    }

    static LayerAlbedo integrate(double cosine, double alpha) {
        const Eigen::Vector3d out(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
        double a = 0.0;
        double b = 0.0;
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const Eigen::Vector3d facet =
                    ggxVisibleFacet(out, alpha, {(i + 0.5) / kSide, (j + 0.5) / kSide});
                const double met = out.dot(facet);
                const Eigen::Vector3d in = 2.0 * met * facet - out;
                if (in.z() <= 0.0) continue;
                const double lambda_out = ggxLambda(out, alpha);
                const double weight =
                    (1.0 + lambda_out) / (1.0 + lambda_out + ggxLambda(in, alpha));
                b += weight * schlick(met);
                a += weight * (1.0 - schlick(met));
            }
        }
        return {static_cast<float>(a / (kSide * kSide)), static_cast<float>(b / (kSide * kSide))};
    }

    [[nodiscard]] LayerAlbedo at(double cosine, int width) const {
        const double place = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (kAngles - 1);
        const int low = std::min(static_cast<int>(place), kAngles - 2);
        const auto share = static_cast<float>(place - low);
        const LayerAlbedo* row = &cells[static_cast<std::size_t>(width) * kAngles];
        return {row[low].a + share * (row[low + 1].a - row[low].a),
                row[low].b + share * (row[low + 1].b - row[low].b)};
    }

    [[nodiscard]] double meanOf(int width) const {
        constexpr int kSteps = 512;
        double sum = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = (i + 0.5) / kSteps;
            const LayerAlbedo albedo = at(cosine, width);
            sum += albedo.at(kDielectricF0) * gain(albedo, kDielectricF0) * 2.0 * cosine;
        }
        return sum / kSteps;
    }
};

const Table& table() {
    static const Table made;
    return made;
}

struct Between {
    int low;
    float share;
};

Between widthAt(double roughness) {
    const double place = std::clamp(roughness, 0.0, 1.0) * (kWidths - 1);
    const int low = std::min(static_cast<int>(place), kWidths - 2);
    return {low, static_cast<float>(place - low)};
}

}  // namespace

LayerAlbedo layerAlbedo(double cosine, double roughness) {
    const auto [low, share] = widthAt(roughness);
    const LayerAlbedo below = table().at(cosine, low);
    const LayerAlbedo above = table().at(cosine, low + 1);
    return {below.a + share * (above.a - below.a), below.b + share * (above.b - below.b)};
}

float meanDielectricAlbedo(double roughness) {
    const auto [low, share] = widthAt(roughness);
    const std::vector<float>& mean = table().mean;
    return mean[low] + share * (mean[low + 1] - mean[low]);
}

}  // namespace dollytrack::render
