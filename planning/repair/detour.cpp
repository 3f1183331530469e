#include "planning/repair/detour.h"

#include "planning/collision/shortcut.h"
#include "planning/collision/swept_sphere.h"
#include "planning/linking/rrt_star.h"
#include "planning/repair/low_runs.h"
#include "planning/viewpoints/viewpoint_search.h"
#include "planning/visibility/image_boxes.h"

#include <algorithm>

namespace dollytrack::planning {
namespace {

constexpr int kWaysTried = 4;
constexpr int kIterations = 400;
constexpr double kLongest = 1.5;    // factor of the present length
constexpr double kLongest_m = 0.5;  // added to that

std::vector<Eigen::Vector3d> cornersBetween(const CameraPath& path, std::size_t from,
                                            std::size_t to) {
    std::vector<Eigen::Vector3d> corners;
    for (std::size_t i = from + 1; i < to; ++i) corners.push_back(path.vertices[i].position);
    return corners;
}

/// The part of the path between the two vertices, with other corners.
CameraPath partBy(const CameraPath& path, std::size_t from, std::size_t to,
                  const std::vector<Eigen::Vector3d>& corners) {
    CameraPath part;
    part.component = path.component;
    part.room = path.room;
    part.vertices.push_back(path.vertices[from]);
    for (const Eigen::Vector3d& corner : corners) part.vertices.push_back({corner, -1});
    part.vertices.push_back(path.vertices[to]);
    return part;
}

}  // namespace

std::optional<CameraPath> findDetour(const RepairContext& context, const CameraPath& path,
                                     std::size_t from, std::size_t to, double low_share,
                                     std::uint64_t stream) {
    const PlanningEnvironment& environment = context.environment;
    const Eigen::Vector3d& start = path.vertices[from].position;
    const Eigen::Vector3d& goal = path.vertices[to].position;
    const auto& cells = environment.sphere.cells(path.component);
    const double longest =
        kLongest * wayLength(cornersBetween(path, from, to), start, goal) + kLongest_m;
    if (cells.empty()) return std::nullopt;
    std::optional<CameraPath> best;
    for (int trial = 0; trial < kWaysTried; ++trial) {
        RrtStarProblem problem;
        problem.start = start;
        problem.goal = goal;
        problem.max_iterations = kIterations;
        problem.improve_at_least = 0;
        problem.detour = true;
        problem.sample = [&](Random& r) {
            return cells[r.below(static_cast<std::uint32_t>(cells.size()))].cast<double>();
        };
        problem.is_free = [&](const Eigen::Vector3d& place) {
            return environment.sphere.fits(place);
        };
        problem.is_move_free = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
            return environment.sphere.segment(a, b).free;
        };
        const RrtStarResult way =
            rrtStar(problem, Random(static_cast<std::uint64_t>(context.seed),
                                    stream + static_cast<std::uint64_t>(trial)));
        if (!way.found || wayLength(way.corners, start, goal) > longest) continue;
        const CameraPath part = partBy(path, from, to, way.corners);
        const Result<SmoothPath> smooth = context.maker.smooth(part);
        if (!smooth || smooth->collisions > 0) continue;
        const Result<Trajectory> trajectory = context.maker.time_part(*smooth);
        if (!trajectory) continue;
        std::vector<std::vector<Eigen::AlignedBox2d>> boxes;
        for (const TrajectoryFrame& frame : trajectory->frames) {
            boxes.push_back(imageBoxes(environment.views, frame.pose));
        }
        const ScoreTally score =
            tally(imageScores(*trajectory, boxes, context.weights), context.threshold);
        const double share = static_cast<double>(score.low) / std::max(1, score.frames);
        if (share >= low_share) continue;
        low_share = share;
        best = part;
    }
    return best;
}

}  // namespace dollytrack::planning
