#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>

namespace dollytrack::ui {

/// The parts of the scene that the viewport hides: above a height, and outside a box. The plan does
/// not change. World frame, m.
struct ClipSettings {
    bool hides_above = false;
    double height_m = 0.0;
    bool has_box = false;
    Eigen::AlignedBox3d box;  // empty: not set yet

    /// Sets the box to the scene's bounds and the height to their middle, if they are not set yet.
    void begin(const Eigen::AlignedBox3d& scene) {
        if (!box.isEmpty() || scene.isEmpty()) return;
        const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.01);
        box = Eigen::AlignedBox3d(scene.min() - margin, scene.max() + margin);
        height_m = scene.center().z();
    }

    /// What is shown; nullopt: everything.
    [[nodiscard]] std::optional<Eigen::AlignedBox3d> shown() const {
        if (!hides_above && !has_box) return std::nullopt;
        constexpr double kFar_m = 1e9;
        Eigen::AlignedBox3d within(Eigen::Vector3d::Constant(-kFar_m),
                                   Eigen::Vector3d::Constant(kFar_m));
        if (has_box) within = box;
        if (hides_above) within.max().z() = std::min(within.max().z(), height_m);
        return within;
    }
};

}  // namespace dollytrack::ui
