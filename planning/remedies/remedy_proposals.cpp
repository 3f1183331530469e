#include "planning/remedies/remedy_proposals.h"

#include "engine/geometry/ray_caster.h"
#include "planning/collision/allowed_region.h"
#include "planning/collision/swept_sphere.h"
#include "planning/remedies/proposal_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr double kLeastRadius_m = 0.01;

}  // namespace

bool showsEnough(const ViewEstimator& views, const Pose& pose, int object_id, bool well) {
    const ObjectView view = makeView(views.estimateExactly(pose, object_id), object_id, 0);
    return well ? isWellCaptured(view) : isCaptured(view);
}

std::vector<Proposal> proposePins(const ProposalContext& context) {
    const auto places = bestFirst(
        context.places,
        [&](const HypotheticalPosition& p) {
            return p.legal() && promise(p.seen, context.well) >= kAlmost;
        },
        [](const HypotheticalPosition& p) { return goodness(p.seen); });
    for (std::size_t i = 0; i < std::min(kLookedAt, places.size()); ++i) {
        const Pose view = poseAt(context, *places[i]);
        if (!showsEnough(context.environment.views, view, context.object_id, context.well))
            continue;
        Proposal made = unchanged(context, view);
        made.needs_pin = true;
        return {made};
    }
    return {};
}

std::vector<Proposal> proposeRegions(const ProposalContext& context) {
    const AllowedRegion* region = context.environment.sphere.region();
    std::vector<Proposal> proposals;
    // An exact height cannot be widened slightly.
    if (region == nullptr || region->hasLevels()) return proposals;
    const double reach = context.environment.sphere.radius() + SweptSphere::kMargin;
    const FreeSpaceParams& band = context.params.free_space;
    const auto beyond = [&](const HypotheticalPosition& p) {
        if (p.allowed != Verdict::HeightBand) return 0.0;
        const double height = region->heightOf(p.position);
        return std::max(height - band.max_height_m, band.min_height_m - height);
    };
    const auto places = bestFirst(
        context.places,
        [&](const HypotheticalPosition& p) {
            return p.roomy && p.allowed != Verdict::Legal &&
                   promise(p.seen, context.well) >= kAlmost;
        },
        [&](const HypotheticalPosition& p) { return -beyond(p); });
    std::set<std::string> proposed;
    for (std::size_t i = 0; i < std::min(4 * kLookedAt, places.size()); ++i) {
        if (proposals.size() >= kMostOfAKind) break;
        const Pose view = poseAt(context, *places[i]);
        Proposal made = unchanged(context, view);
        if (places[i]->allowed == Verdict::NoGo) {
            const NoGoBox* box = region->boxAt(view.position, reach);
            if (box == nullptr) continue;
            made.remedy.remove_no_go = box->name;
            made.remedy.text = "remove the no-go box '" + box->name + "', which blocks the view";
            std::erase_if(made.change.edits.no_go,
                          [&](const NoGoBox& other) { return other.name == box->name; });
        } else {
            const double height = region->heightOf(view.position);
            FreeSpaceParams& wider = made.change.params.free_space;
            if (height > band.max_height_m) {
                changeTo(made, "max_height_m", wider.max_height_m,
                         std::ceil(height * 100.0) / 100.0);
            } else {
                changeTo(made, "min_height_m", wider.min_height_m,
                         std::max(0.0, std::floor(height * 100.0) / 100.0));
            }
        }
        if (proposed.contains(made.remedy.text)) continue;
        if (!showsEnough(context.environment.views, view, context.object_id, context.well))
            continue;
        proposed.insert(made.remedy.text);
        proposals.push_back(std::move(made));
    }
    return proposals;
}

std::vector<Proposal> proposeSmallerCameras(const ProposalContext& context) {
    const auto radiusAt = [](const HypotheticalPosition& p) {
        // Subtract the margin, and round to centimetres.
        return std::floor((p.clearance_m - SweptSphere::kMargin) * 100.0 + 1e-6) / 100.0;
    };
    const CameraParams& camera = context.params.camera;
    const auto places = bestFirst(
        context.places,
        [&](const HypotheticalPosition& p) {
            return !p.roomy && p.allowed == Verdict::Legal && radiusAt(p) >= kLeastRadius_m &&
                   radiusAt(p) < camera.camera_radius_m && promise(p.seen, context.well) >= kAlmost;
        },
        [&](const HypotheticalPosition& p) { return 100.0 * radiusAt(p) + goodness(p.seen); });
    std::vector<Proposal> proposals;
    std::map<double, std::size_t> looked;
    for (const HypotheticalPosition* place : places) {
        if (proposals.size() >= kMostOfAKind) break;
        const double radius = radiusAt(*place);
        const bool known =
            !proposals.empty() && proposals.back().change.params.camera.camera_radius_m == radius;
        if (known || ++looked[radius] > kLookedAt) continue;
        const Pose view = poseAt(context, *place);
        if (!showsEnough(context.environment.views, view, context.object_id, context.well))
            continue;
        Proposal made = unchanged(context, view);
        CameraParams& smaller = made.change.params.camera;
        changeTo(made, "camera_radius_m", smaller.camera_radius_m, radius);
        if (!keepNearInSphere(made)) continue;
        proposals.push_back(std::move(made));
    }
    return proposals;
}

std::vector<Proposal> proposeMoves(const ProposalContext& context, PlanTrials& trials) {
    const Scene& scene = context.environment.views.scene();
    const auto shareWithout = [](const HypotheticalPosition& p) {
        return p.seen.visible_fraction + p.seen.occluder_share;
    };
    const auto places = bestFirst(
        context.places,
        [&](const HypotheticalPosition& p) {
            return p.legal() && p.seen.occluder != 0 && p.seen.occluder != context.object_id &&
                   !scene.object(p.seen.occluder).structure &&
                   shareWithout(p) >= CaptureRules{}.min_visible_fraction;
        },
        [&](const HypotheticalPosition& p) {
            return shareWithout(p) + 0.5 * p.seen.visible_fraction;
        });
    std::vector<Proposal> proposals;
    std::map<int, std::size_t> looked;
    std::map<int, RayCaster> rays;
    std::map<int, ViewEstimator> views;
    std::set<int> done;
    for (const HypotheticalPosition* place : places) {
        const int gone = place->seen.occluder;
        if (proposals.size() >= kMostOfAKind || done.contains(gone)) continue;
        if (!looked.contains(gone) && looked.size() == 2 * kMostOfAKind) continue;
        if (++looked[gone] > kLookedAt) continue;
        // Behind the removed object something else may hide the target: estimate without it.
        const auto scene_without = trials.scene(gone);
        const RayCaster& rays_without = rays.try_emplace(gone, *scene_without).first->second;
        const ViewEstimator& views_without =
            views.try_emplace(gone, *scene_without, rays_without, context.params.camera)
                .first->second;
        const Pose view = poseAt(context, *place);
        if (!showsEnough(views_without, view, context.object_id, context.well)) continue;
        Proposal made = unchanged(context, view);
        made.change.without_object = gone;
        made.remedy.move_object = gone;
        made.remedy.text = fmt::format("move {} away, which hides {:.0f} % of it",
                                       scene.object(gone).name, 100.0 * place->seen.occluder_share);
        done.insert(gone);
        proposals.push_back(std::move(made));
    }
    return proposals;
}

}  // namespace dollytrack::planning
