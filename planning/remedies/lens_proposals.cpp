#include "planning/remedies/proposal_parts.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/coarse_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

constexpr double kNarrowest = 10.0;
constexpr double kWidest = 120.0;  // wider pinhole images are strongly stretched at the border
constexpr double kWhole = 0.92;    // largest share of the image's length for an object

/// A proposal with another lens; empty if no near plane fits in the camera's sphere.
std::optional<Proposal> withLens(const ProposalContext& context, double hfov_deg) {
    Proposal made = unchanged(context, std::nullopt);
    changeTo(made, "hfov_deg", made.change.params.camera.hfov_deg, hfov_deg);
    if (!keepNearInSphere(made)) return std::nullopt;
    return made;
}

/// View estimators for other lenses, by angle of view, created on demand.
class Lenses {
  public:
    explicit Lenses(const ProposalContext& context) : context_(context) {}

    /// The view estimator for a lens; null if no camera can have it.
    [[nodiscard]] const ViewEstimator* at(double hfov_deg) {
        const auto known = made_.find(hfov_deg);
        if (known != made_.end()) return &known->second;
        const auto lens = withLens(context_, hfov_deg);
        if (!lens) return nullptr;
        const ViewEstimator& views = context_.environment.views;
        return &made_.try_emplace(hfov_deg, views.scene(), views.rays(), lens->change.params.camera)
                    .first->second;
    }

    [[nodiscard]] bool show(double hfov_deg, const Pose& view) {
        const ViewEstimator* views = at(hfov_deg);
        return views != nullptr && showsEnough(*views, view, context_.object_id, context_.well);
    }

    [[nodiscard]] std::size_t count() const { return made_.size(); }

    /// A proposal with a lens for which at() returned an estimator.
    [[nodiscard]] Proposal propose(double hfov_deg, const Pose& view) const {
        Proposal made = *withLens(context_, hfov_deg);
        made.view = view;
        return made;
    }

  private:
    const ProposalContext& context_;
    std::map<double, ViewEstimator> made_;
};

/// The horizontal angle of view that enlarges the image by `scale`, deg.
double scaled(double hfov_deg, double scale) {
    const double half = std::tan(hfov_deg * std::numbers::pi / 360.0);
    return 2.0 * std::atan(half / scale) * 180.0 / std::numbers::pi;
}

/// Longer lenses for an object that is too small: the mildest that enlarges it enough.
std::vector<Proposal> narrower(const ProposalContext& context, Lenses& lenses) {
    const double before = context.params.camera.hfov_deg;
    const auto lensFor = [&](const HypotheticalPosition& p) {
        if (p.seen.occluder != 0 || !(p.fill > 0.0) || p.fill > kWhole) return before;
        const CaptureRules rules;
        double grow = rules.min_visible_px / std::max(p.seen.visible_px, 1.0);
        if (context.well) {
            grow = std::max(grow, rules.min_box_share / std::max(p.seen.box_share, 1e-6));
        }
        const double scale = std::max(1.0, 1.02 * std::sqrt(grow));
        return scale * p.fill > kWhole ? before : std::floor(scaled(before, scale));
    };
    const auto places = bestFirst(
        context.places,
        [&](const HypotheticalPosition& p) {
            const double hfov = lensFor(p);
            return p.legal() && hfov < before && hfov >= kNarrowest &&
                   p.seen.visible_fraction >= kAlmost * CaptureRules{}.min_visible_fraction;
        },
        [&](const HypotheticalPosition& p) { return lensFor(p); });
    std::vector<Proposal> proposals;
    std::map<double, std::size_t> looked;
    for (const HypotheticalPosition* place : places) {
        if (proposals.size() >= kMostOfAKind || lenses.count() > 3 * kMostOfAKind) break;
        const double hfov = lensFor(*place);
        const bool known =
            !proposals.empty() && proposals.back().change.params.camera.hfov_deg == hfov;
        if (known || ++looked[hfov] > kLookedAt / 2) continue;
        const Pose view = poseAt(context, *place);
        if (lenses.show(hfov, view)) proposals.push_back(lenses.propose(hfov, view));
    }
    return proposals;
}

/// Wider lenses for an object that does not fit: the mildest that shows enough of it.
std::vector<Proposal> wider(const ProposalContext& context, Lenses& lenses) {
    const double before = context.params.camera.hfov_deg;
    const auto fits = [&](const HypotheticalPosition& p) {
        return std::min(std::ceil(scaled(before, kWhole / p.fill)), kWidest);
    };
    const auto cropped = bestFirst(
        context.places,
        [](const HypotheticalPosition& p) {
            return p.legal() && std::isfinite(p.fill) && p.fill > kWhole;
        },
        [](const HypotheticalPosition& p) { return -p.fill; });
    if (cropped.empty() || before >= kWidest) return {};
    // The widest lens shows whether the object is hidden; a cropped view says little about that.
    const ViewEstimator* widest = lenses.at(kWidest);
    if (widest == nullptr) return {};
    std::vector<double> promises(cropped.size());
    parallelFor(cropped.size(), [&](std::size_t i) {
        const auto seen =
            widest->estimate(poseAt(context, *cropped[i]), context.object_id, kCoarseGrid);
        promises[i] = promise(seen, context.well);
    });
    double least = kWidest + 1.0;
    Pose view;
    const auto lookFrom = [&](std::size_t i) {
        // A wider lens shows more of it, so bisection finds the least angle.
        const Pose here = poseAt(context, *cropped[i]);
        double enough = std::min(least - 1.0, fits(*cropped[i]));
        if (enough <= before || !lenses.show(enough, here)) return;
        double short_of = before;
        while (enough - short_of > 1.0) {
            const double middle = std::ceil(0.5 * (enough + short_of));
            if (middle >= enough) break;
            (lenses.show(middle, here) ? enough : short_of) = middle;
        }
        least = enough;
        view = here;
    };
    // Most candidates that nearly meet the requirement fail the exact estimate.
    for (const double asked : {1.0, kAlmost}) {
        std::size_t looked = 0;
        for (std::size_t i = 0; i < cropped.size() && looked < kLookedAt; ++i) {
            if (promises[i] < asked) continue;
            ++looked;
            lookFrom(i);
        }
        if (least <= kWidest) break;
    }
    if (least > kWidest) return {};
    std::vector<Proposal> proposals = {lenses.propose(least, view)};
    // A slightly wider lens gives the search more candidates.
    const double more = std::min(std::ceil(least / 5.0 + 0.5) * 5.0, kWidest);
    if (more > least && lenses.show(more, view)) proposals.push_back(lenses.propose(more, view));
    return proposals;
}

}  // namespace

std::vector<Proposal> proposeLenses(const ProposalContext& context) {
    Lenses lenses(context);
    std::vector<Proposal> proposals = narrower(context, lenses);
    for (Proposal& made : wider(context, lenses)) proposals.push_back(std::move(made));
    return proposals;
}

std::vector<Proposal> proposeWiderUnseen(const ProposalContext& context) {
    constexpr double kStep = 5.0;
    const double before = context.params.camera.hfov_deg;
    std::vector<Proposal> proposals;
    for (double hfov = std::floor(before / kStep + 1.0) * kStep; hfov <= kWidest; hfov += kStep) {
        if (auto made = withLens(context, hfov)) proposals.push_back(std::move(*made));
    }
    return proposals;
}

}  // namespace dollytrack::planning
