#pragma once

#include "engine/core/random.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace dollytrack::planning {

/// Input of RRT*. Positions in the world, m.
struct RrtStarProblem {
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    Eigen::Vector3d goal = Eigen::Vector3d::Zero();
    std::function<Eigen::Vector3d(Random&)> sample;  // draws a position; it need not be free
    std::function<bool(const Eigen::Vector3d&)> is_free;
    std::function<bool(const Eigen::Vector3d&, const Eigen::Vector3d&)> is_move_free;
    std::function<bool()> is_cancelled = {};      // ends the search early
    std::function<void(double)> on_shorter = {};  // called with the length, m, of each shorter path
    int max_iterations = 1500;
    // After the first path is found, the search goes on for half the iterations spent so far, but
    // at least this many (within max_iterations), to shorten the path.
    int improve_at_least = 60;
    bool detour = false;  // excludes the direct move from start to goal
};

struct RrtStarResult {
    bool found = false;
    std::vector<Eigen::Vector3d> corners;  // between start and goal, both excluded
    std::vector<Eigen::Vector3d> samples;  // nodes of the tree in the order in which they were
                                           // added, without the start
    std::vector<int> parents;              // by sample: index of its first parent in `samples`; -1:
                                           // the start
};

/// RRT* (Karaman and Frazzoli, 2011): grows a tree from the start and rewires it around each new
/// node. After the first path is found, samples that cannot shorten it are rejected (as in Informed
/// RRT*, Gammell et al., 2014).
RrtStarResult rrtStar(const RrtStarProblem& problem, Random random);

}  // namespace dollytrack::planning
