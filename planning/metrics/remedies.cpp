#include "planning/metrics/remedies.h"

#include "planning/collision/swept_sphere.h"
#include "planning/metrics/candidate_tally.h"
#include "planning/metrics/plan_trials.h"
#include "planning/metrics/remedy_proposals.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

bool has(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool names(const std::vector<ObjectRef>& objects, int id) {
    return std::any_of(objects.begin(), objects.end(),
                       [&](const ObjectRef& ref) { return ref.id == id; });
}

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// As pinText() has it: who pins what it says gets what was tried.
Pose asWritten(const Pose& view) {
    const auto rounded = [](double value, double step) { return std::round(value / step) * step; };
    const Eigen::Vector3d ahead = view.forward();
    const double pitch = rounded(std::asin(std::clamp(ahead.z(), -1.0, 1.0)), 0.1 / kDegrees);
    Pose pose = view;
    for (double& value : pose.position) value = rounded(value, 1e-3);
    if (std::abs(pitch) > 89.0 / kDegrees) return pose;  // next to no heading
    const double yaw = rounded(std::atan2(ahead.y(), ahead.x()), 0.1 / kDegrees);
    pose.rotation = lookAlong(Eigen::Vector3d(std::cos(yaw) * std::cos(pitch),
                                              std::sin(yaw) * std::cos(pitch), std::sin(pitch)));
    return pose;
}

std::string pinText(const Pose& view) {
    const Eigen::Vector3d& p = view.position;
    const Eigen::Vector3d ahead = view.forward();
    return fmt::format("pin a point at ({:.3f}, {:.3f}, {:.3f}), yaw_deg {:.1f}, pitch_deg {:.1f}",
                       p.x(), p.y(), p.z(), std::atan2(ahead.y(), ahead.x()) * kDegrees,
                       std::asin(std::clamp(ahead.z(), -1.0, 1.0)) * kDegrees);
}

bool lostInSearch(const LedgerRow& row) {
    return row.loss == Loss::NoFreePose || row.loss == Loss::Occluded ||
           row.loss == Loss::TooSmall || row.loss == Loss::DoesNotFit;
}

/// What became of all the places around an object, in the words that candidates have.
CandidateTally tallyOf(const std::vector<WhatIfPlace>& places) {
    CandidateTally tally;
    for (const WhatIfPlace& place : places) {
        Candidate candidate;
        candidate.position = place.position;
        candidate.fill = place.fill;
        candidate.visible_fraction = place.seen.visible_fraction;
        const ObjectView view = makeView(place.seen, 0, 0);
        if (!place.roomy) {
            candidate.verdict = Verdict::InObstacle;
        } else if (!place.legal()) {
            candidate.verdict = place.allowed;
        } else if (place.seen.occluder != 0 &&
                   view.visible_fraction < CaptureRules{}.min_visible_fraction) {
            candidate.verdict = Verdict::OccludedBy;
            candidate.occluder = place.seen.occluder;
        } else if (!isCaptured(view)) {
            candidate.verdict = place.seen.cropped ? Verdict::Cropped : Verdict::TooSmall;
        }
        tally.add(candidate);
    }
    return tally;
}

class Finder {
  public:
    Finder(const std::shared_ptr<const Scene>& scene, const PlanParams& params,
           const PlanEdits& edits, const Plan& plan, const Surroundings& around, PlanTrials& trials,
           const JobContext& job)
        : scene_(*scene),
          params_(params),
          edits_(edits),
          plan_(plan),
          around_(around),
          trials_(trials),
          job_(job) {}

    void find(LedgerRow& row) {
        if (lostInSearch(row)) {
            findElsewhere(row);
        } else {
            giveBack(row);
        }
    }

  private:
    [[nodiscard]] PlanChange unchanged() const { return {params_, edits_}; }

    /// Plans with the proposal. True when it does what is asked for; its remedy is then complete.
    bool works(Proposal& made, const LedgerRow& row) {
        const auto keeps = [&](const std::shared_ptr<const Plan>& plan) {
            if (!plan) return false;
            const auto now = std::find_if(
                plan->captures.begin(), plan->captures.end(),
                [&](const ObjectCapture& capture) { return capture.object_id == row.object_id; });
            if (now == plan->captures.end()) return false;
            made.remedy.well = now->well_captured;
            return row.captured ? now->well_captured : now->captured;
        };
        if (!made.needs_pin && keeps(trials_.run(made.change, job_))) return true;
        if (!made.view) return false;
        PinnedPoint pin;
        pin.name = "remedy";
        pin.pose = asWritten(*made.view);
        // Where everything hangs on a pixel, to the last bit.
        if (!showsEnough(around_.views, pin.pose, row.object_id, row.captured)) {
            pin.pose = *made.view;
        }
        pin.objects = {{row.object_id, scene_.object(row.object_id).name}};
        std::erase_if(made.change.edits.pinned,
                      [&](const PinnedPoint& other) { return other.objects == pin.objects; });
        made.change.edits.pinned.push_back(pin);
        if (!keeps(trials_.run(made.change, job_))) return false;
        made.remedy.pin = pin.pose;
        made.remedy.text += (made.remedy.text.empty() ? "" : ", and ") + pinText(pin.pose);
        return true;
    }

    bool takeFirst(std::vector<Proposal> proposals, LedgerRow& row) {
        for (Proposal& made : proposals) {
            if (job_.cancelled()) return false;
            if (!works(made, row)) continue;
            if (!row.captured && !made.remedy.well) {
                made.remedy.text += "; it is then captured, but not well";
            }
            row.remedy = std::move(made.remedy);
            return true;
        }
        return false;
    }

    /// No view of it was found: is there one, or would there be?
    void findElsewhere(LedgerRow& row) {
        const Subject subject = makeSubject(around_.views, {row.object_id});
        const auto places = whatIfPlaces(around_, subject, row.object_id, params_.seed, job_);
        const WhatIf what{around_, params_, edits_, subject, places, row.object_id, row.captured};
        if (takeFirst(proposePins(what), row)) {
            row.loss = Loss::SearchMissed;
            row.occluder = 0;
            row.reason = "There is a legal view of it that the search did not find.";
            return;
        }
        lookDenser(places, row);
        std::vector<Proposal> pitches = proposePitches(what);
        if (!pitches.empty()) blamePitchBand(row);
        if (takeFirst(std::move(pitches), row) || takeFirst(proposeRegions(what), row) ||
            takeFirst(proposeSmallerCameras(what), row) || takeFirst(proposeLenses(what), row)) {
            return;
        }
        if (row.loss == Loss::DoesNotFit && takeFirst(proposeWiderUnseen(what), row)) return;
        takeFirst(proposeMoves(what, trials_), row);
    }

    /// The dense look knows better than the few places of the search.
    void lookDenser(const std::vector<WhatIfPlace>& places, LedgerRow& row) const {
        if (row.captured || job_.cancelled() || places.empty()) return;
        const CandidateTally tally = tallyOf(places);
        if (tally.legal() > 0) return;
        row.loss = tally.loss();
        row.occluder = tally.loss() == Loss::Occluded ? tally.occluder() : 0;
        row.reason = tally.reason(scene_);
    }

    /// There are views of it where the camera may be, but it may not look at them.
    void blamePitchBand(LedgerRow& row) const {
        const ConstraintParams& band = params_.constraints;
        const std::string range =
            fmt::format("{:.6g} .. {:.6g} deg", band.min_pitch_deg, band.max_pitch_deg);
        if (row.captured) {
            row.reason += " The pitch band of " + range + " keeps out views that show it larger.";
            return;
        }
        row.loss = Loss::PitchBand;
        row.occluder = 0;
        row.reason = "The pitch band of " + range +
                     " keeps it out of the image at places where the camera may be and would "
                     "capture it.";
    }

    /// A view was found and lost on the way: undo what lost it.
    void giveBack(LedgerRow& row) {
        std::vector<Proposal> proposals;
        switch (*row.loss) {
            case Loss::OverBudget:
                proposals = proposeBudgets(row);
                break;
            case Loss::OtherComponent:
            case Loss::DroppedByPath:
                proposals = proposeTour();
                break;
            case Loss::LostInSmoothing:
                proposals = proposeCorners();
                break;
            case Loss::ByHand:
                proposals = proposeUndoing(row);
                break;
            default:
                break;
        }
        if (takeFirst(std::move(proposals), row)) return;
        // A pinned point is gone through at its very pose.
        std::vector<Proposal> pins;
        for (const PositionPoint& point : plan_.position_points) {
            const auto& shown = row.captured ? point.well_captured : point.captured;
            if (!has(shown, row.object_id)) continue;
            Proposal made{unchanged(), {}, point.pose, true};
            pins.push_back(std::move(made));
        }
        takeFirst(std::move(pins), row);
    }

    /// Proposals without a view of their own: planning again finds it, or they are no use.
    [[nodiscard]] Proposal setting(const std::string& assignment, std::string text) const {
        Proposal made{unchanged(), {}, std::nullopt, false};
        made.remedy.settings = {assignment};
        made.remedy.text = std::move(text);
        FieldList fields = listFields(made.change.params);
        if (!setField(fields, assignment)) made.change = unchanged();
        return made;
    }

    /// Key frames come in order of what they add; up to this object's first, and all of them.
    [[nodiscard]] std::vector<Proposal> proposeBudgets(const LedgerRow& row) const {
        const std::vector<int> keys = chooseKeyFrames(plan_.position_points);
        std::vector<Proposal> proposals;
        const auto propose = [&](std::size_t frames) {
            proposals.push_back(setting(
                fmt::format("max_frames={}", frames),
                fmt::format("max_frames {} instead of {}", frames, params_.timing.max_frames)));
        };
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const PositionPoint& point = plan_.position_points[static_cast<std::size_t>(keys[k])];
            if (!has(row.captured ? point.well_captured : point.captured, row.object_id)) continue;
            propose(k + 1);
            break;
        }
        propose(keys.size());
        return proposals;
    }

    [[nodiscard]] std::vector<Proposal> proposeTour() const {
        if (params_.path.path_mode == PathMode::LongestBranch) {
            return {setting("path_mode=tour", "path_mode tour instead of longest_branch")};
        }
        std::vector<Proposal> proposals;
        const double limit = params_.path.max_length_m;
        for (const double times : {1.25, 1.5, 2.0, 4.0}) {
            if (limit <= 0.0) break;
            const double longer = std::ceil(times * limit);
            proposals.push_back(
                setting(fmt::format("max_length_m={}", longer),
                        fmt::format("max_length_m {} instead of {}", longer, limit)));
        }
        return proposals;
    }

    [[nodiscard]] std::vector<Proposal> proposeCorners() const {
        std::vector<Proposal> proposals;
        const double before = params_.smoothing.corner_distance_m;
        for (const double share : {0.75, 0.5, 0.25, 0.0}) {
            const double corner = std::floor(share * before * 100.0) / 100.0;
            proposals.push_back(
                setting(fmt::format("corner_distance_m={}", corner),
                        fmt::format("corner_distance_m {} instead of {}", corner, before)));
        }
        return proposals;
    }

    [[nodiscard]] std::vector<Proposal> proposeUndoing(const LedgerRow& row) const {
        std::vector<Proposal> proposals;
        Proposal restored{unchanged(), {}, std::nullopt, false};
        std::erase_if(restored.change.edits.removed, [&](const RemovedPoint& removed) {
            if (!names(removed.objects, row.object_id)) return false;
            std::vector<int>& ids = restored.remedy.restore_points.emplace_back();
            for (const ObjectRef& ref : removed.objects) ids.push_back(ref.id);
            return true;
        });
        if (!(restored.change.edits == edits_)) {
            restored.remedy.text = "restore its position point";
            proposals.push_back(std::move(restored));
        }
        for (const PinnedPoint& pin : edits_.pinned) {
            if (!names(pin.objects, row.object_id)) continue;
            Proposal unpinned{unchanged(), {}, std::nullopt, false};
            std::erase_if(unpinned.change.edits.pinned,
                          [&](const PinnedPoint& other) { return other.name == pin.name; });
            unpinned.remedy.unpin = pin.name;
            unpinned.remedy.text = "unpin '" + pin.name + "'";
            proposals.push_back(std::move(unpinned));
        }
        return proposals;
    }

    const Scene& scene_;
    const PlanParams& params_;
    const PlanEdits& edits_;
    const Plan& plan_;
    const Surroundings& around_;
    PlanTrials& trials_;
    const JobContext& job_;
};

}  // namespace

Result<std::vector<LedgerRow>> findRemedies(const std::shared_ptr<const Scene>& scene,
                                            const PlanParams& params, const PlanEdits& edits,
                                            const Plan& plan, std::vector<LedgerRow> rows,
                                            const JobContext& job) {
    std::vector<LedgerRow*> lost;
    for (LedgerRow& row : rows) {
        if (row.loss) lost.push_back(&row);
    }
    if (lost.empty()) return rows;
    PlanTrials trials(scene);
    Pipeline& pipeline = trials.pipeline();
    const auto as_it_is = pipeline.run(params, edits, job.stage(0.0, 0.1, "planning again"));
    if (!as_it_is) return tl::unexpected<Error>(as_it_is.error());
    const auto rays = pipeline.rays();
    const auto free_space = pipeline.freeSpace();
    const auto region = pipeline.region();
    const ViewEstimator views(*scene, *rays, params.camera);
    const SweptSphere sphere(*rays, *free_space, params.camera.camera_radius_m, region.get());
    const Surroundings around{views, *free_space, sphere, pitchBand(params.constraints)};
    for (std::size_t i = 0; i < lost.size(); ++i) {
        const double done = 0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(lost.size());
        job.report(done);
        const JobContext quiet = job.stage(done, done, "remedies");
        Finder(scene, params, edits, plan, around, trials, quiet).find(*lost[i]);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    }
    return rows;
}

}  // namespace dollytrack::planning
