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
    int observation_point = -1;  // index; -1: nothing is shown
    double cone_half_angle_deg = 40.0;
    bool cone = true;
    bool cone_filled = true;  // else only its edges
    int selected_candidate = -1;
    ShownVerdicts shown = allVerdicts();
    bool operator==(const CandidatesOverlayOptions&) const = default;
};

/// Why an observation point is seen from where it is, or from nowhere: the cone that was searched,
/// every place tried there and elsewhere by the reason it was not taken, and the one that was.
[[nodiscard]] PlanLayer candidatesLayer(const Plan& plan, const CandidatesOverlayOptions& options);

/// Whether an eye is in the cone or before its mouth: from there its sides are all around what one
/// looks at, and would tint the whole picture.
[[nodiscard]] bool isInCone(const Plan& plan, const CandidatesOverlayOptions& options,
                            const Eigen::Vector3d& eye);

/// A verdict in words: "in an obstacle".
[[nodiscard]] std::string_view inWords(Verdict verdict);
[[nodiscard]] Eigen::Vector4f colorOf(Verdict verdict);

}  // namespace dollytrack::ui
