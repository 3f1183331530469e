#include "planning/repair/repair.h"

#include "engine/jobs/parallel.h"
#include "planning/metrics/estimate_captures.h"
#include "planning/plan_params.h"
#include "planning/repair/detour.h"
#include "planning/repair/look_aside.h"
#include "planning/repair/low_runs.h"
#include "planning/viewpoints/viewpoint_search.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr std::size_t kShortRun = 2;  // frames; too short for a detour
constexpr int kAttempts = 3;          // per round, each with fewer changes

/// The parts of a trajectory that repair can change.
struct Design {
    std::vector<CameraPath> paths;
    std::vector<SmoothPath> smooth;  // without look-aside views
    std::vector<LookAside> look_asides;
};

/// A design with its trajectory and scores.
struct Trial {
    std::vector<SmoothPath> smooth;  // with look-aside views
    Trajectory trajectory;
    CaptureEstimate estimate;
    std::vector<double> scores;
};

struct Change {
    SegmentId segment;
    std::optional<LookAside> look_aside;
    std::optional<CameraPath> detour;
};

/// Index of a path's vertex at its n-th key frame (from 0).
std::size_t vertexOfKey(const CameraPath& path, std::size_t n) {
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        if (path.vertices[i].position_point >= 0 && n-- == 0) return i;
    }
    return path.vertices.size();
}

std::map<SegmentId, ScoreTally> tallies(const Trial& trial, double threshold) {
    const std::vector<SegmentId> segments = segmentsOf(trial.trajectory);
    std::map<SegmentId, std::vector<double>> scores;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        scores[segments[i]].push_back(trial.scores[i]);
    }
    std::map<SegmentId, ScoreTally> result;
    for (const auto& [segment, segment_scores] : scores)
        result[segment] = tally(segment_scores, threshold);
    return result;
}

/// Frames that captures need: the best ones of each object.
std::set<int> neededFrames(const std::vector<ObjectCapture>& captures) {
    std::set<int> frames;
    for (const ObjectCapture& capture : captures) {
        if (capture.captured) frames.insert(capture.best.frame);
        if (capture.well_captured) frames.insert(capture.best_well.frame);
    }
    return frames;
}

/// The segments with objects that are no longer captured, or captured well.
std::set<SegmentId> lostOn(const Trial& before, const Trial& after) {
    const std::vector<SegmentId> segments = segmentsOf(before.trajectory);
    std::set<SegmentId> lost;
    for (std::size_t i = 0; i < before.estimate.captures.size(); ++i) {
        const ObjectCapture& was = before.estimate.captures[i];
        const ObjectCapture& is = after.estimate.captures[i];
        if (was.captured && !is.captured) {
            lost.insert(segments[was.best.frame]);
        }
        if (was.well_captured && !is.well_captured) {
            lost.insert(segments[was.best_well.frame]);
        }
    }
    return lost;
}

class Repair {
  public:
    Repair(const RepairContext& context, ViewCache* memo, const JobContext& job)
        : context_(context), memo_(memo), job_(job) {}

    [[nodiscard]] Result<Trial> carryOut(const Design& design) const {
        Trial trial;
        trial.smooth = withLookAsides(design.smooth, design.look_asides);
        Result<Trajectory> trajectory = context_.maker.time(trial.smooth);
        if (!trajectory) return tl::unexpected(std::move(trajectory.error()));
        trial.trajectory = std::move(*trajectory);
        return lookAt(std::move(trial));
    }

    /// Completes a trial that has its trajectory with captures and scores.
    [[nodiscard]] Result<Trial> lookAt(Trial trial) const {
        Result<CaptureEstimate> estimate =
            estimateCaptures(context_.environment.views, trial.trajectory, job_, memo_);
        if (!estimate) return tl::unexpected(std::move(estimate.error()));
        trial.estimate = std::move(*estimate);
        trial.scores = imageScores(trial.trajectory, trial.estimate.frame_boxes, context_.weights);
        return trial;
    }

    /// One change for each segment with low frames, unless given up.
    std::vector<Change> propose(const Design& design, const Trial& trial, int round) {
        std::map<SegmentId, LowRun> longest;
        for (const LowRun& run : lowRuns(trial.trajectory, trial.scores, context_.threshold)) {
            if (given_up_.contains(run.segment)) continue;
            const auto [at, fresh] = longest.try_emplace(run.segment, run);
            if (!fresh && run.size() > at->second.size()) at->second = run;
        }
        std::vector<LowRun> runs;
        for (const auto& [_, run] : longest) runs.push_back(run);
        const std::map<SegmentId, ScoreTally> scored = tallies(trial, context_.threshold);
        std::vector<Change> changes(runs.size());
        parallelFor(runs.size(), [&](std::size_t i) {
            if (!job_.cancelled()) {
                changes[i] = propose(design, trial, runs[i], scored.at(runs[i].segment), round);
            }
        });
        for (const Change& change : changes) {
            if (!change.look_aside && !change.detour) given_up_.insert(change.segment);
        }
        std::erase_if(changes, [](const Change& c) { return !c.look_aside && !c.detour; });
        return changes;
    }

    /// The design with these changes. Error: Cancelled.
    [[nodiscard]] Result<Design> apply(Design design, const std::vector<Change>& changes) const {
        std::set<std::size_t> rerouted;
        for (const Change& change : changes) {
            if (change.look_aside) design.look_asides.push_back(*change.look_aside);
            if (!change.detour) continue;
            CameraPath& path = design.paths[change.segment.path];
            const std::size_t from = vertexOfKey(path, change.segment.number);
            const std::size_t to = vertexOfKey(path, change.segment.number + 1);
            const auto& inner = change.detour->vertices;
            const auto at =
                path.vertices.erase(path.vertices.begin() + static_cast<std::ptrdiff_t>(from) + 1,
                                    path.vertices.begin() + static_cast<std::ptrdiff_t>(to));
            path.vertices.insert(at, inner.begin() + 1, inner.end() - 1);
            std::erase_if(design.look_asides,
                          [&](const LookAside& view) { return view.segment == change.segment; });
            rerouted.insert(change.segment.path);
        }
        for (const std::size_t path : rerouted) {
            Result<SmoothPath> smooth = context_.maker.smooth(design.paths[path]);
            if (!smooth) return tl::unexpected(std::move(smooth.error()));
            design.smooth[path] = std::move(*smooth);
        }
        return design;
    }

    /// The changes that improve their segment and lose no capture.
    std::vector<Change> keepGood(const std::vector<Change>& changes, const Trial& before,
                                 const Trial& after) {
        const auto was = tallies(before, context_.threshold);
        const auto is = tallies(after, context_.threshold);
        const std::set<SegmentId> lost = lostOn(before, after);
        std::vector<Change> good;
        for (const Change& change : changes) {
            const ScoreTally& b = was.at(change.segment);
            const auto a = is.find(change.segment);
            const bool mended = a != is.end() && a->second.low < b.low &&
                                a->second.mean >= b.mean && !lost.contains(change.segment);
            if (mended) {
                good.push_back(change);
            } else {
                refused_[change.segment] += 1;
            }
        }
        return good;
    }

    /// The first half of the changes; the others count as refused.
    std::vector<Change> keepHalf(std::vector<Change> changes) {
        const std::size_t half = changes.size() / 2;
        for (std::size_t i = half; i < changes.size(); ++i) refused_[changes[i].segment] += 1;
        changes.resize(half);
        return changes;
    }

  private:
    [[nodiscard]] Change propose(const Design& design, const Trial& trial, const LowRun& run,
                                 const ScoreTally& scored, int round) const {
        Change change{run.segment, {}, {}};
        const auto refused = refused_.find(run.segment);
        const int times = refused == refused_.end() ? 0 : refused->second;
        if (times == 0) {
            const auto looks_at =
                findLookAside(context_, trial.trajectory, trial.estimate.frame_boxes, run);
            if (looks_at)
                change.look_aside = LookAside{run.segment, shareOf(design, trial, run), *looks_at};
        }
        if (change.look_aside || times > 1 || run.size() <= kShortRun) return change;
        const CameraPath& path = design.paths[run.segment.path];
        const std::size_t from = vertexOfKey(path, run.segment.number);
        const std::size_t to = vertexOfKey(path, run.segment.number + 1);
        if (to >= path.vertices.size()) return change;
        const double low_share = static_cast<double>(scored.low) / scored.frames;
        const auto stream = static_cast<std::uint64_t>(round) * 1'000'000 +
                            run.segment.path * 100'000 + run.segment.number * 10;
        change.detour = findDetour(context_, path, from, to, low_share, stream);
        return change;
    }

    /// Position of the middle of a run between its key frames, as a share of arc length.
    [[nodiscard]] static double shareOf(const Design& design, const Trial& trial,
                                        const LowRun& run) {
        const SmoothPath& path = design.smooth[run.segment.path];
        const double begin = path.keys[run.segment.number].arc_m;
        const double end = path.keys[run.segment.number + 1].arc_m;
        const auto& frames = trial.trajectory.frames;
        const double arc = frames[run.first + (run.last - run.first) / 2].arc_m;
        return end > begin ? std::clamp((arc - begin) / (end - begin), 0.0, 1.0) : 0.5;
    }

    const RepairContext& context_;
    ViewCache* memo_;
    const JobContext& job_;
    std::set<SegmentId> given_up_;
    std::map<SegmentId, int> refused_;  // number of refused changes, by segment
};

/// Removes low frames that are neither key frames nor needed for a capture. Returns their number.
int dropLow(Trial& trial, double threshold) {
    const std::set<int> needed = neededFrames(trial.estimate.captures);
    std::vector<TrajectoryFrame> kept;
    std::vector<std::vector<Eigen::AlignedBox2d>> boxes;
    const auto& frames = trial.trajectory.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const bool drop = trial.scores[i] < threshold && frames[i].position_point < 0 &&
                          !needed.contains(static_cast<int>(i));
        if (drop) continue;
        kept.push_back(frames[i]);
        boxes.push_back(std::move(trial.estimate.frame_boxes[i]));
    }
    const int dropped = static_cast<int>(frames.size() - kept.size());
    trial.trajectory.frames = std::move(kept);
    trial.estimate.frame_boxes = std::move(boxes);
    return dropped;
}

int countSegments(const std::vector<LookAside>& look_asides) {
    std::set<SegmentId> segments;
    for (const LookAside& look_aside : look_asides) segments.insert(look_aside.segment);
    return static_cast<int>(segments.size());
}

}  // namespace

bool asksForRepair(const RepairParams& params) {
    return params.repair_rounds > 0 || params.drop_low_frames;
}

Result<RepairedTrajectory> repairTrajectory(const RepairedTrajectory& found,
                                            const TrajectoryMaker& maker,
                                            const PlanningEnvironment& environment,
                                            const RepairParams& params, int seed,
                                            const JobContext& job, ViewCache* memo) {
    RepairContext context{maker, environment, params.score, 0.0, seed};
    Repair repair(context, memo, job);
    Design design{found.paths, found.smooth_paths, {}};
    Result<Trial> first = repair.lookAt({found.smooth_paths, found.trajectory, {}, {}});
    if (!first) return tl::unexpected(std::move(first.error()));
    Trial best = std::move(*first);
    context.threshold = lowThreshold(best.scores, params.score_threshold);

    RepairedTrajectory result;
    RepairReport& report = result.report;
    report.threshold = context.threshold;
    report.before = tally(best.scores, context.threshold);
    std::set<SegmentId> rerouted;
    for (int round = 0; round < params.repair_rounds; ++round) {
        job.report(static_cast<double>(round) / params.repair_rounds);
        std::vector<Change> changes = repair.propose(design, best, round);
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        if (changes.empty()) break;
        report.rounds = round + 1;
        // Try all changes together, then again only the good ones.
        for (int attempt = 0; attempt < kAttempts && !changes.empty(); ++attempt) {
            const std::size_t tried = changes.size();
            const Result<Design> changed = repair.apply(design, changes);
            Result<Trial> trial =
                changed ? repair.carryOut(*changed) : tl::unexpected(changed.error());
            if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
            if (trial) changes = repair.keepGood(changes, best, *trial);
            const bool loses = !trial || !lostOn(best, *trial).empty();
            if (changes.size() < tried) continue;
            // The budget of frames may be too small for all changes, or a change elsewhere loses a
            // capture.
            if (loses) {
                changes = repair.keepHalf(std::move(changes));
                continue;
            }
            for (const Change& change : changes) {
                if (change.detour) rerouted.insert(change.segment);
            }
            design = *changed;
            best = std::move(*trial);
            break;
        }
    }
    if (params.drop_low_frames) {
        report.dropped = dropLow(best, context.threshold);
        best.scores = imageScores(best.trajectory, best.estimate.frame_boxes, context.weights);
    }
    report.after = tally(best.scores, context.threshold);
    report.look_asides = countSegments(design.look_asides);
    report.replanned = static_cast<int>(rerouted.size());
    result.paths = std::move(design.paths);
    result.smooth_paths = std::move(best.smooth);
    result.trajectory = std::move(best.trajectory);
    return result;
}

}  // namespace dollytrack::planning
