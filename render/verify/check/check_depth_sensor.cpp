// Compares a depth camera's images with exact depth: noise within the model, holes only where
// allowed. The models are implemented independently, from their description in dataset.json.
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace dollytrack::verify {
namespace {

constexpr double kDeviations = 6.5;  // of about 10^9 pixels none lies beyond
constexpr double kStep_m = 0.1;      // depth step that becomes a hole, and
constexpr double kStepShare = 0.05;  // the same relative to depth
constexpr double kLeastLight = 0.05 / (5.46 * 5.46);
// Share of a frame that may be too dark if the dataset lacks reflectance and slope.
constexpr double kMostDark = 0.9;

double linear(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

struct Model {
    std::string name;
    double strength = 1.0;
    double nearest_m = 0.0;
    double farthest_m = 0.0;

    [[nodiscard]] bool none() const { return name == "none"; }
    [[nodiscard]] bool redwood() const { return name == "redwood"; }

    /// Largest depth error, without the pixel jitter.
    [[nodiscard]] double reach(double depth) const {
        if (none()) return 0.0;
        if (redwood()) {
            const double disparity = 35.130 / depth;
            const double off = 0.5 / 8.0 + kDeviations * strength * 0.027778;
            return off < disparity ? 35.130 / (disparity - off) - depth : 1e9;
        }
        return 4.0 * kDeviations * strength * (0.0005 + 0.001 * std::max(depth - 0.5, 0.0));
    }
    /// Largest jitter, px.
    [[nodiscard]] int aside() const {
        if (none()) return 0;
        return static_cast<int>(std::ceil(0.25 * kDeviations * strength)) + (redwood() ? 1 : 0);
    }
};

/// Largest depth step from the pixel to its neighbours, relative to the step that becomes a hole; 2
/// beside a pixel without depth.
double stepAt(const ImageF& depth, int x, int y) {
    double most = 0.0;
    const double here = depth.at(x, y);
    for (const auto& [dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}}) {
        if (!depth.holds(x - dx, y - dy) || !depth.holds(x + dx, y + dy)) continue;
        const double a = depth.at(x - dx, y - dy), b = depth.at(x + dx, y + dy);
        if (!(a > 0.0 && b > 0.0)) return 2.0;
        const double nearest = std::min({a, b, here}), farthest = std::max({a, b, here});
        const double step = std::abs(1 / a + 1 / b - 2 / here) * nearest * farthest;
        most = std::max(most, step / std::max(kStep_m, kStepShare * nearest));
    }
    return most;
}

/// One frame of a depth camera.
class DepthSensorFrame {
  public:
    DepthSensorFrame(const StoredDataset& dataset, const Model& model, FrameImages& images)
        : dataset_(dataset), model_(model), images_(images) {}

    void check(Findings& findings) {
        const Image16* seen = images_.image16("depth_sensor");
        const FrameImages::Depth* depth = images_.depth();
        if (!seen || !depth) return;
        rounding_ = depth->rounding_m + 0.0006;  // and that of the sensor's millimetres
        WrongPixels far_off, full, holes;
        std::size_t dark = 0;
        for (int y = 0; y < seen->height; ++y) {
            for (int x = 0; x < seen->width; ++x) {
                const double metres = seen->at(x, y) * 0.001;
                const double exact = depth->metres.at(x, y);
                if (metres > 0.0) {
                    checkValue(depth->metres, x, y, metres, far_off, full);
                } else if (exact > 0.0 && !mayBeHole(depth->metres, x, y)) {
                    if (maybeDark(x, y, exact)) {
                        ++dark;
                        continue;
                    }
                    holes.add(x, y, [&] {
                        return WrongPixels::Text{"a hole", fmt::format("about {:.3f} m", exact)};
                    });
                }
            }
        }
        const std::string file = imageFile("depth_sensor", images_.frame());
        far_off.report(file, images_.frame(), findings);
        full.report(file, images_.frame(), findings);
        holes.report(file, images_.frame(), findings);
        if (static_cast<double>(dark) > kMostDark * static_cast<double>(seen->values.size())) {
            findings.add({file,
                          images_.frame(),
                          {},
                          fmt::format("{} of {} px are holes", dark, seen->values.size()),
                          "holes at depth steps and on dark surfaces"});
        }
    }

  private:
    /// Nearest and farthest depth that the pixel may read, including jitter.
    [[nodiscard]] std::pair<double, double> around(const ImageF& depth, int x, int y) const {
        const double exact = depth.at(x, y);
        double least = exact, most = exact;
        const int aside = model_.aside();
        for (int dy = -aside; dy <= aside; ++dy) {
            for (int dx = -aside; dx <= aside; ++dx) {
                if (!depth.holds(x + dx, y + dy)) continue;
                const double one = depth.at(x + dx, y + dy);
                // Depth beyond a step is never read.
                if (std::abs(one - exact) > 1.01 * std::max(kStep_m, kStepShare * exact)) continue;
                least = std::min(least, one);
                most = std::max(most, one);
            }
        }
        return {least, most};
    }

    void checkValue(const ImageF& depth, int x, int y, double metres, WrongPixels& far_off,
                    WrongPixels& full) const {
        const double exact = depth.at(x, y);
        const auto [least, most] = around(depth, x, y);
        const double reach = model_.reach(most) + rounding_;
        if (!(exact > 0.0) || metres < least - reach || metres > most + reach) {
            far_off.add(x, y, [&] {
                return WrongPixels::Text{
                    fmt::format("{:.3f} m", metres),
                    exact > 0.0 ? fmt::format("{:.3f} to {:.3f} m", least - reach, most + reach)
                                : std::string("a hole, because no surface is there")};
            });
        } else if (!model_.none() &&
                   (metres > model_.farthest_m + rounding_ ||
                    metres < model_.nearest_m - rounding_ || stepAt(depth, x, y) > 1.5)) {
            full.add(x, y, [&] {
                return WrongPixels::Text{fmt::format("{:.3f} m", metres),
                                         "a hole: out of the camera's range, or at a depth step"};
            });
        }
    }

    [[nodiscard]] bool mayBeHole(const ImageF& depth, int x, int y) const {
        const double exact = depth.at(x, y);
        if (model_.none()) return exact > 65.5;
        const auto [least, most] = around(depth, x, y);
        const double reach = model_.reach(most) + rounding_;
        return least - reach < model_.nearest_m || most + reach > model_.farthest_m ||
               stepAt(depth, x, y) > 0.7;
    }

    /// For time of flight: whether too little light may return.
    [[nodiscard]] bool maybeDark(int x, int y, double exact) const {
        if (model_.none() || model_.redwood()) return false;
        const Image16* normals = images_.image16("normal_camera");
        const Image8* albedo = images_.image8("albedo");
        if (!normals || !albedo) return true;
        const std::uint16_t* of = normals->pixel(x, y);
        const Eigen::Vector3d normal =
            Eigen::Vector3d(of[0], of[1], of[2]) * (2.0 / 65535.0) - Eigen::Vector3d::Ones();
        const Eigen::Vector3d ray = dataset_.lens.unproject(x + 0.5, y + 0.5);
        double reflectance = 0.0;
        for (int c = 0; c < 3; ++c) reflectance += linear(albedo->pixel(x, y)[c] / 255.0) / 3.0;
        const double light =
            reflectance * std::abs(ray.normalized().dot(normal)) / (exact * ray).squaredNorm();
        // Margin for depth one or two pixels aside.
        return light < 1.25 * kLeastLight;
    }

    const StoredDataset& dataset_;
    const Model& model_;
    FrameImages& images_;
    double rounding_ = 0.0;
};

}  // namespace

CheckWork beginDepthSensor(const Subject& subject, Findings& findings) {
    const auto convention = subject.dataset.convention("depth_sensor");
    auto model = std::make_shared<Model>();
    const auto add = [&](const std::string& what) {
        findings.add({"dataset.json", {}, {}, "conventions.depth_sensor " + what, {}});
    };
    try {
        model->name = convention.at("model").get<std::string>();
        model->strength = convention.at("strength").get<double>();
        model->nearest_m = convention.at("nearest_m").get<double>();
        model->farthest_m = convention.at("farthest_m").get<double>();
    } catch (const nlohmann::json::exception&) {
        add("lacks model, strength, nearest_m or farthest_m");
        return {};
    }
    if (!model->none() && !model->redwood() && model->name != "kinect_azure") {
        add("names the model '" + model->name + "', which this program does not know");
        return {};
    }
    const auto& parameters = subject.dataset.card.at("parameters");
    if (parameters.contains("sensor")) {
        const auto& asked = parameters["sensor"];
        for (const auto& [key, name] : {std::pair("depth_noise", "model"),
                                        {"depth_noise_strength", "strength"},
                                        {"sensor_seed", "sensor_seed"}}) {
            if (asked.value(key, nlohmann::ordered_json()) ==
                convention.value(name, nlohmann::ordered_json())) {
                continue;
            }
            add(fmt::format("{} is not parameters.sensor's {}", name, key));
        }
    }
    CheckWork work;
    work.frame = [&dataset = subject.dataset, model](FrameImages& images, Findings& found) {
        DepthSensorFrame(dataset, *model, images).check(found);
    };
    return work;
}

}  // namespace dollytrack::verify
