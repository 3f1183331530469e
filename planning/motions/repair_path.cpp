#include "planning/motions/repair_path.h"

#include "engine/jobs/parallel.h"
#include "planning/collision/mapped_scene.h"
#include "planning/motions/free_runs.h"
#include "planning/motions/repair_stretch.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

// A run with a smaller share of the frames of its path is given up if it takes a detour.
constexpr double kVisitShare = 0.05;

bool isSame(const Stretch& a, const Stretch& b) {
    return a.first == b.first && a.last == b.last && a.start == b.start && a.end == b.end;
}

/// Joins the runs of a path by free ways.
class PathRepair {
  public:
    PathRepair(const MappedScene& scene, std::span<const TrajectoryFrame> frames,
               std::vector<FreeRun> runs, const JobContext& job)
        : scene_(scene), frames_(frames), runs_(std::move(runs)), job_(job) {}

    std::vector<std::vector<PathPoint>> run() {
        do {
            findStretches();
        } while (!job_.cancelled() && giveUpVisit());
        std::vector<std::vector<PathPoint>> replaced(stretches_.size());
        parallelFor(stretches_.size(), [&](std::size_t i) {
            replaced[i] = pointsOf(scene_, frames_, stretches_[i], job_);
        });
        return joined(replaced);
    }

  private:
    /// The stretches between, before and after the runs. Where no way joins two runs, one at the
    /// end of the first and one at the start of the second, each with half of the frames between.
    void findStretches() {
        std::vector<Stretch> joins;
        if (runs_.front().first > 0)
            joins.push_back({0, runs_.front().first, {}, runs_.front().start});
        for (std::size_t k = 0; k + 1 < runs_.size(); ++k) {
            if (runs_[k].component != runs_[k + 1].component) continue;
            joins.push_back({runs_[k].last, runs_[k + 1].first, runs_[k].end, runs_[k + 1].start});
        }
        const std::size_t end = runs_.size() - 1;
        if (runs_[end].last + 1 < frames_.size()) {
            joins.push_back({runs_[end].last, frames_.size() - 1, runs_[end].end, {}});
        }
        findWays(joins);
        std::vector<Stretch> halves;
        for (std::size_t k = 0; k + 1 < runs_.size(); ++k) {
            const std::size_t last = runs_[k].last;
            const std::size_t first = runs_[k + 1].first;
            const auto starts_here = [&](const Stretch& join) {
                return join.first == last && join.last == first;
            };
            if (std::any_of(joins.begin(), joins.end(), starts_here)) continue;
            const std::size_t middle = (last + first) / 2;
            if (middle > last) halves.push_back({last, middle, runs_[k].end, {}});
            if (middle + 1 < first) halves.push_back({middle + 1, first, {}, runs_[k + 1].start});
        }
        findWays(halves);
        stretches_ = std::move(joins);
        stretches_.insert(stretches_.end(), halves.begin(), halves.end());
        std::sort(stretches_.begin(), stretches_.end(),
                  [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    }

    /// Finds the ways of stretches, and removes those without one.
    void findWays(std::vector<Stretch>& stretches) {
        parallelFor(stretches.size(), [&](std::size_t i) {
            const auto known =
                std::find_if(known_.begin(), known_.end(),
                             [&](const Stretch& other) { return isSame(other, stretches[i]); });
            if (known != known_.end()) {
                stretches[i] = *known;
            } else {
                findWay(scene_, frames_, job_, stretches[i]);
            }
        });
        known_.insert(known_.end(), stretches.begin(), stretches.end());
        std::erase_if(stretches, [](const Stretch& stretch) { return !stretch.way; });
    }

    /// Removes the shortest run that is short and takes a detour; false if there is none.
    bool giveUpVisit() {
        std::size_t shortest = runs_.size();
        for (std::size_t k = 0; k < runs_.size() && runs_.size() > 1; ++k) {
            const FreeRun& run = runs_[k];
            const bool detour =
                std::any_of(stretches_.begin(), stretches_.end(), [&](const Stretch& stretch) {
                    return stretch.is_detour &&
                           (stretch.last == run.first || stretch.first == run.last);
                });
            if (!detour || static_cast<double>(run.size()) >
                               kVisitShare * static_cast<double>(frames_.size())) {
                continue;
            }
            if (shortest == runs_.size() || run.size() < runs_[shortest].size()) shortest = k;
        }
        if (shortest == runs_.size()) return false;
        runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(shortest));
        return true;
    }

    /// Runs and stretches in order. A new path begins at each run or stretch that does not start at
    /// the frame where the one before ends.
    [[nodiscard]] std::vector<std::vector<PathPoint>> joined(
        const std::vector<std::vector<PathPoint>>& replaced) const {
        std::vector<std::vector<PathPoint>> paths;
        const auto add = [&](std::vector<PathPoint> points) {
            if (paths.empty() || paths.back().back().frame != points.front().frame) {
                paths.push_back(std::move(points));
                return;
            }
            // Both have this frame; the second knows what follows.
            paths.back().pop_back();
            paths.back().insert(paths.back().end(), points.begin(), points.end());
        };
        std::size_t stretch = 0;
        for (const FreeRun& run : runs_) {
            for (; stretch < stretches_.size() && stretches_[stretch].first < run.first; ++stretch)
                add(replaced[stretch]);
            std::vector<PathPoint> points;
            for (std::size_t i = run.first; i <= run.last; ++i) {
                points.push_back({frames_[i].pose.position, static_cast<double>(i), false});
            }
            points.front().position = run.start;
            add(std::move(points));
        }
        for (; stretch < stretches_.size(); ++stretch) add(replaced[stretch]);
        return paths;
    }

    const MappedScene& scene_;
    std::span<const TrajectoryFrame> frames_;
    std::vector<FreeRun> runs_;
    std::vector<Stretch> stretches_;
    std::vector<Stretch> known_;  // found so far
    const JobContext& job_;
};

}  // namespace

std::vector<std::vector<PathPoint>> repairPath(const MappedScene& scene, const MotionCheck& check,
                                               std::span<const TrajectoryFrame> frames,
                                               const FreeParts& parts, const JobContext& job) {
    std::vector<FreeRun> runs = findRunsToKeep(scene, check, frames, parts, job);
    if (runs.empty() || job.cancelled()) return {};
    auto paths = PathRepair(scene, frames, std::move(runs), job).run();
    if (job.cancelled()) return {};
    return paths;
}

}  // namespace dollytrack::planning
