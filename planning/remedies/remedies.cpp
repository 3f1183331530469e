#include "planning/remedies/remedies.h"

#include "planning/coverage/region_weights.h"
#include "planning/explanations/candidate_tally.h"
#include "planning/path/frame_budget.h"
#include "planning/pipeline/search_environment.h"
#include "planning/remedies/plan_trials.h"
#include "planning/remedies/remedy_proposals.h"
#include "planning/viewpoints/key_frames.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::planning {
namespace {

bool containsId(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool names(const std::vector<ObjectRef>& objects, int id) {
    return std::any_of(objects.begin(), objects.end(),
                       [&](const ObjectRef& ref) { return ref.id == id; });
}

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

/// The pose rounded as pinText() prints it, so that the printed pin is the one tried.
Pose asWritten(const Pose& view) {
    const auto rounded = [](double value, double step) { return std::round(value / step) * step; };
    const Eigen::Vector3d ahead = view.forward();
    const double pitch =
        rounded(std::asin(std::clamp(ahead.z(), -1.0, 1.0)), 0.1 / kDegreesPerRadian);
    Pose pose = view;
    for (double& value : pose.position) value = rounded(value, 1e-3);
    if (std::abs(pitch) > 89.0 / kDegreesPerRadian) return pose;  // almost no heading
    const double yaw = rounded(std::atan2(ahead.y(), ahead.x()), 0.1 / kDegreesPerRadian);
    pose.rotation = lookAlong(Eigen::Vector3d(std::cos(yaw) * std::cos(pitch),
                                              std::sin(yaw) * std::cos(pitch), std::sin(pitch)));
    return pose;
}

std::string pinText(const Pose& view) {
    const Eigen::Vector3d& p = view.position;
    const Eigen::Vector3d ahead = view.forward();
    return fmt::format("pin a point at ({:.3f}, {:.3f}, {:.3f}), yaw_deg {:.1f}, pitch_deg {:.1f}",
                       p.x(), p.y(), p.z(), std::atan2(ahead.y(), ahead.x()) * kDegreesPerRadian,
                       std::asin(std::clamp(ahead.z(), -1.0, 1.0)) * kDegreesPerRadian);
}

constexpr const char* kStage = "remedies";

bool lostInSearch(const LedgerRow& row) {
    return row.loss == Loss::NoFreePose || row.loss == Loss::Occluded ||
           row.loss == Loss::TooSmall || row.loss == Loss::DoesNotFit;
}

/// How long the search for its remedy takes, compared with others. Without a view, many kinds of
/// changes are planned, most of them from the map on.
double effortOf(const LedgerRow& row) {
    return lostInSearch(row) ? 20.0 : 1.0;
}

/// Tally of all positions around an object, with the verdicts of candidates.
CandidateTally tallyOf(const std::vector<HypotheticalPosition>& places) {
    CandidateTally tally;
    for (const HypotheticalPosition& place : places) {
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
           const PlanEdits& edits, const Plan& plan, const PlanningEnvironment& environment,
           PlanTrials& trials, const JobContext& share)
        : scene_(*scene),
          params_(params),
          edits_(edits),
          plan_(plan),
          environment_(environment),
          trials_(trials),
          share_(share),
          job_(share.stage(0.0, 0.0, kStage)) {}

    void find(LedgerRow& row) {
        if (lostInSearch(row)) {
            findElsewhere(row);
        } else {
            giveBack(row);
        }
    }

  private:
    [[nodiscard]] PlanChange unchanged() const { return {params_, edits_}; }

    /// Plans with a change. Each trial advances the progress by a part of what is left, because how
    /// many there will be is not known. Steps inside a trial do not.
    std::shared_ptr<const Plan> tryPlan(const PlanChange& change) {
        constexpr double kUsualTrials = 5.0;
        auto plan = trials_.run(change, job_);
        ++tried_;
        const double done = tried_ / (tried_ + kUsualTrials);
        share_.report(done);
        job_ = share_.stage(done, done, kStage);
        return plan;
    }

    /// Plans with the proposal. Returns whether it achieves what is asked for; its remedy is then
    /// complete.
    bool works(Proposal& made, const LedgerRow& row) {
        const auto keeps = [&](const std::shared_ptr<const Plan>& plan) {
            if (!plan) return false;
            const auto now = std::find_if(
                plan->captures.begin(), plan->captures.end(),
                [&](const ObjectCapture& capture) { return capture.object_id == row.object_id; });
            if (now == plan->captures.end()) return false;
            made.remedy.well = now->well_captured;
            weigh(*plan, row.object_id, made);
            return row.captured ? now->well_captured : now->captured;
        };
        if (!made.needs_pin && keeps(tryPlan(made.change))) return true;
        if (!made.view) return false;
        PinnedPoint pin;
        pin.name = "remedy";
        pin.objects = {{row.object_id, scene_.object(row.object_id).name}};
        std::vector<PinnedPoint>& pinned = made.change.edits.pinned;
        std::erase_if(pinned,
                      [&](const PinnedPoint& other) { return other.objects == pin.objects; });
        pinned.push_back(pin);
        // Try the rounded pose first, then the exact one: a capture may depend on single pixels.
        for (const Pose& pose : {asWritten(*made.view), *made.view}) {
            pinned.back().pose = pose;
            if (!keeps(tryPlan(made.change))) continue;
            made.remedy.pin = pose;
            made.remedy.text += (made.remedy.text.empty() ? "" : ", and ") + pinText(pose);
            return true;
        }
        return false;
    }

    /// Counts the other objects that the proposal loses and gains.
    void weigh(const Plan& with_it, int object_id, Proposal& made) const {
        made.lost = made.gained = 0;
        for (const ObjectCapture& before : plan_.captures) {
            const auto now =
                std::ranges::find(with_it.captures, before.object_id, &ObjectCapture::object_id);
            // A moved object is absent in the trial.
            if (before.object_id == object_id || now == with_it.captures.end()) continue;
            made.lost += before.captured && !now->captured ? 1 : 0;
            made.gained += !before.captured && now->captured ? 1 : 0;
        }
    }

    void keep(Proposal made, LedgerRow& row) {
        if (!row.captured && !made.remedy.well) {
            made.remedy.text += "; it is then captured, but not well";
        }
        if (made.lost > 0) {
            made.remedy.text += fmt::format("; {} other {} then not captured", made.lost,
                                            made.lost == 1 ? "object is" : "objects are");
        }
        row.remedy = std::move(made.remedy);
        kept_balance_ = made.gained - made.lost;
    }

    /// Returns true for a remedy that loses no other object. Otherwise keeps the one with the best
    /// balance while the search goes on.
    bool takeFirst(std::vector<Proposal> proposals, LedgerRow& row) {
        for (Proposal& made : proposals) {
            if (job_.cancelled()) return false;
            if (!works(made, row)) continue;
            const bool costs_nothing = made.lost == 0;
            if (!costs_nothing && row.remedy && made.gained - made.lost <= kept_balance_) continue;
            keep(std::move(made), row);
            if (costs_nothing) return true;
        }
        return false;
    }

    /// Finds the smallest length that works, to 0.1 m, by bisection.
    void takeLeastLength(LedgerRow& row) {
        const double limit = params_.path.max_length_m;
        const auto tenths = [](double metres) { return std::ceil(metres * 10.0 - 1e-6) / 10.0; };
        const auto longer = [&](double metres) {
            return setting(fmt::format("max_length_m={:.6g}", metres),
                           fmt::format("max_length_m {:.6g} instead of {:.6g}", metres, limit));
        };
        double fails = limit;
        for (const double times : {1.25, 1.5, 2.0, 4.0, 8.0}) {
            double works_at = tenths(times * limit);
            Proposal best = longer(works_at);
            if (job_.cancelled()) return;
            if (!works(best, row)) {
                fails = works_at;
                continue;
            }
            while (works_at - fails > 0.15 && !job_.cancelled()) {
                const double middle = tenths(0.5 * (fails + works_at));
                if (middle >= works_at) break;
                Proposal shorter = longer(middle);
                if (works(shorter, row)) {
                    best = std::move(shorter);
                    works_at = middle;
                } else {
                    fails = middle;
                }
            }
            return keep(std::move(best), row);
        }
    }

    /// No view was found: searches for a missed view, then for changes that would give one.
    void findElsewhere(LedgerRow& row) {
        const Subject subject = makeSubject(environment_.views, {row.object_id});
        const auto places =
            hypotheticalPositions(environment_, subject, row.object_id, params_.seed, job_);
        const ProposalContext context{environment_, params_,       edits_,      subject,
                                      places,       row.object_id, row.captured};
        if (takeFirst(proposePins(context), row) || row.remedy) {
            row.loss = Loss::SearchMissed;
            row.occluder = 0;
            row.reason = "There is a legal view of it that the search did not find.";
            return;
        }
        lookDenser(places, row);
        std::vector<Proposal> pitches = proposePitches(context);
        const bool held_by_pitch = !pitches.empty();
        if (takeFirst(std::move(pitches), row)) return blamePitchBand(row);
        if (takeFirst(proposeRegions(context), row) ||
            takeFirst(proposeSmallerCameras(context), row) ||
            takeFirst(proposeLenses(context), row)) {
            return;
        }
        if (row.loss == Loss::DoesNotFit && takeFirst(proposeWiderUnseen(context), row)) return;
        if (!takeFirst(proposeMoves(context, trials_), row) && held_by_pitch) blamePitchBand(row);
    }

    /// Corrects the reason with the result of dense sampling.
    void lookDenser(const std::vector<HypotheticalPosition>& places, LedgerRow& row) const {
        if (row.captured || job_.cancelled() || places.empty()) return;
        const CandidateTally tally = tallyOf(places);
        if (tally.legal() > 0) return;
        row.loss = tally.loss();
        row.occluder = tally.loss() == Loss::Occluded ? tally.occluder() : 0;
        row.reason = tally.reason(scene_);
    }

    /// Sets the reason of an object whose views at legal positions are all excluded by the pitch
    /// band.
    void blamePitchBand(LedgerRow& row) const {
        const ConstraintParams& band = params_.constraints;
        const std::string range =
            fmt::format("{:.6g} .. {:.6g} deg", band.min_pitch_deg, band.max_pitch_deg);
        if (row.captured) {
            row.reason += " The pitch band of " + range + " excludes views in which it is larger.";
            return;
        }
        row.loss = Loss::PitchBand;
        row.occluder = 0;
        row.reason = "The pitch band of " + range + " excludes the views that would capture it.";
    }

    /// For a view that was found but lost later: proposes to undo the cause.
    void giveBack(LedgerRow& row) {
        std::vector<Proposal> proposals;
        switch (*row.loss) {
            case Loss::OverBudget:
                proposals = proposeBudgets(row);
                break;
            case Loss::OtherComponent:
            case Loss::DroppedByPath:
                if (isHeldByLength()) {
                    takeLeastLength(row);
                    if (row.remedy) return;
                }
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
        if (takeFirst(std::move(proposals), row) || row.remedy) return;
        // The path passes through a pinned point at its exact pose.
        std::vector<Proposal> pins;
        for (const PositionPoint& point : plan_.position_points) {
            const auto& shown = row.captured ? point.well_captured : point.captured;
            if (!containsId(shown, row.object_id)) continue;
            Proposal made{unchanged(), {}, point.pose, true};
            pins.push_back(std::move(made));
        }
        takeFirst(std::move(pins), row);
    }

    /// A proposal without a view of its own: planning must find the view.
    [[nodiscard]] Proposal setting(const std::string& assignment, std::string text) const {
        Proposal made{unchanged(), {}, std::nullopt, false};
        made.remedy.settings = {assignment};
        made.remedy.text = std::move(text);
        FieldList fields = listFields(made.change.params);
        if (!setField(fields, assignment)) made.change = unchanged();
        return made;
    }

    /// Smallest budget of frames that keeps the first `count` of these key frames.
    [[nodiscard]] int framesFor(std::size_t count, const std::vector<int>& keys) const {
        PathEnds ends;
        ends.loop =
            params_.constraints.loop || (!edits_.start.empty() && edits_.start == edits_.end);
        ends.visits = static_cast<int>(count);
        while (withinBudget(keys, plan_.position_points, ends).size() < count) ++ends.visits;
        return ends.visits;
    }

    /// Key frames are sorted by what they add: propose a budget up to this object's first one, and
    /// one for all.
    [[nodiscard]] std::vector<Proposal> proposeBudgets(const LedgerRow& row) const {
        const std::vector<int> keys =
            chooseKeyFrames(plan_.position_points, objectWeights(scene_, edits_.regions));
        std::vector<Proposal> proposals;
        const auto propose = [&](std::size_t count) {
            const int frames = framesFor(count, keys);
            proposals.push_back(setting(
                fmt::format("max_frames={}", frames),
                fmt::format("max_frames {} instead of {}", frames, params_.timing.max_frames)));
        };
        for (std::size_t k = 0; k < keys.size(); ++k) {
            const PositionPoint& point = plan_.position_points[keys[k]];
            if (!containsId(row.captured ? point.well_captured : point.captured, row.object_id))
                continue;
            propose(k + 1);
            break;
        }
        propose(keys.size());
        return proposals;
    }

    [[nodiscard]] bool isHeldByLength() const {
        return params_.path.path_mode == PathMode::Tour && params_.path.max_length_m > 0.0;
    }

    /// The other limits that keep key frames off a path.
    [[nodiscard]] std::vector<Proposal> proposeTour() const {
        if (params_.path.path_mode == PathMode::LongestBranch) {
            return {setting("path_mode=tour", "path_mode tour instead of longest_branch")};
        }
        const auto keys = static_cast<int>(plan_.key_frames.size());
        if (!isHeldByLength() || params_.timing.max_frames <= 0 ||
            params_.timing.max_frames >= keys) {
            return {};
        }
        return {
            setting(fmt::format("max_frames={}", keys),
                    fmt::format("max_frames {} instead of {}", keys, params_.timing.max_frames))};
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
    const PlanningEnvironment& environment_;
    PlanTrials& trials_;
    const JobContext& share_;  // this object's part of the progress
    JobContext job_;           // reports only that part's present state
    int tried_ = 0;
    int kept_balance_ = 0;  // objects that the kept remedy gains minus those it loses
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
    if (lost.empty() || edits.motion) return rows;  // a given motion would not change
    constexpr double kPlanningAgain = 0.05;         // its share of the progress
    PlanTrials trials(scene);
    Pipeline& pipeline = trials.pipeline();
    const auto as_it_is =
        pipeline.run(params, edits, job.stage(0.0, kPlanningAgain, "planning again"));
    if (!as_it_is) return tl::unexpected(as_it_is.error());
    const SearchEnvironment search(mapsOf(pipeline, scene), params);
    double total = 0.0;
    for (const LedgerRow* row : lost) total += effortOf(*row);
    const JobContext rest = job.stage(kPlanningAgain, 1.0, kStage);
    double before = 0.0;
    for (LedgerRow* row : lost) {
        const double after = before + effortOf(*row) / total;
        const JobContext share = rest.stage(before, after, kStage);
        Finder(scene, params, edits, plan, search.environment(), trials, share).find(*row);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        share.report(1.0);
        before = after;
    }
    return rows;
}

}  // namespace dollytrack::planning
