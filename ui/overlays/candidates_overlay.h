#pragma once

#include "engine/plan/plan.h"
#include "ui/overlays/legend.h"

#include <array>
#include <cstddef>
#include <string_view>

namespace dollytrack::ui {

constexpr std::size_t kVerdicts = static_cast<std::size_t>(Verdict::Unscanned) + 1;

/// Which candidates are drawn, by Verdict.
using ShownVerdicts = std::array<bool, kVerdicts>;
constexpr ShownVerdicts allVerdicts() {
    ShownVerdicts shown{};
    shown.fill(true);
    return shown;
}

struct CandidatesOverlayOptions {
    int observation_point = -1;  // index in Plan::observation_points; -1: the layer is empty
    double cone_half_angle_deg = 40.0;
    bool cone = true;
    bool cone_filled = true;  // false: only its edges
    int selected_candidate = -1;
    ShownVerdicts shown = allVerdicts();
    bool operator==(const CandidatesOverlayOptions&) const = default;
};

/// The viewpoint search of one observation point: the search cone, every tested candidate coloured
/// by its verdict, and the position point that was chosen.
[[nodiscard]] PlanLayer candidatesLayer(const Plan& plan, const CandidatesOverlayOptions& options);

/// Whether an eye (m, world) is within 0.15 m of the search cone, or in front of its base at less
/// than twice its length. From there the filled sides would cover most of the image.
[[nodiscard]] bool isInCone(const Plan& plan, const CandidatesOverlayOptions& options,
                            const Eigen::Vector3d& eye);

/// A verdict as text: "in an obstacle".
[[nodiscard]] std::string_view inWords(Verdict verdict);
[[nodiscard]] Eigen::Vector4f colorOf(Verdict verdict);

}  // namespace dollytrack::ui
