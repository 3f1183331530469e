#include "planning/remedies/proposal_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {

double promise(const ViewEstimator::Estimate& seen, bool well) {
    const CaptureRules rules;
    double share = std::min(1.0, seen.visible_fraction / rules.min_visible_fraction);
    share = std::min(share, seen.visible_px / rules.min_visible_px);
    return well ? std::min(share, seen.box_share / rules.min_box_share) : share;
}

std::vector<const HypotheticalPosition*> bestFirst(
    const std::vector<HypotheticalPosition>& places,
    const std::function<bool(const HypotheticalPosition&)>& fits,
    const std::function<double(const HypotheticalPosition&)>& order) {
    std::vector<const HypotheticalPosition*> chosen;
    for (const HypotheticalPosition& place : places) {
        if (fits(place)) chosen.push_back(&place);
    }
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](const auto* a, const auto* b) { return order(*a) > order(*b); });
    return chosen;
}

double goodness(const ViewEstimator::Estimate& seen) {
    return promise(seen, false) + 2.0 * promise(seen, true) + 0.5 * seen.visible_fraction +
           0.2 * seen.box_share;
}

Pose poseAt(const ProposalContext& context, const HypotheticalPosition& place) {
    return aim(place.position, context.subject.center, pitchBand(context.params.constraints));
}

Proposal unchanged(const ProposalContext& context, const std::optional<Pose>& view) {
    Proposal made;
    made.change.params = context.params;
    made.change.edits = context.edits;
    made.view = view;
    return made;
}

namespace {

std::string instead(const std::string& name, double value, double before) {
    return fmt::format("{} {:.6g} instead of {:.6g}", name, value, before);
}

}  // namespace

void changeTo(Proposal& made, const std::string& name, double& field, double value) {
    made.remedy.settings.push_back(fmt::format("{}={:.6g}", name, value));
    if (!made.remedy.text.empty()) made.remedy.text += " and ";
    made.remedy.text += instead(name, value, field);
    field = value;
}

bool keepNearInSphere(Proposal& made) {
    constexpr double kLeast_m = 0.001;
    CameraParams& camera = made.change.params.camera;
    // Distance of the near plane's corners at a near distance of 1.
    const double corner = makeIntrinsics(camera).unproject(0.0, 0.0).norm();
    const double farthest = camera.camera_radius_m / corner;
    if (farthest >= camera.near_m) return true;
    const double near = std::floor(farthest * 1000.0) / 1000.0;
    if (near < kLeast_m) return false;
    changeTo(made, "near_m", camera.near_m, near);
    return true;
}

}  // namespace dollytrack::planning
