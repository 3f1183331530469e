#pragma once

#include "engine/core/random.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace dollytrack::planning {

/// What RRT* is to do. Positions in m, world.
struct RrtStarProblem {
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    Eigen::Vector3d goal = Eigen::Vector3d::Zero();
    std::function<Eigen::Vector3d(Random&)> sample;  // places that may or may not be free
    std::function<bool(const Eigen::Vector3d&)> is_free;
    std::function<bool(const Eigen::Vector3d&, const Eigen::Vector3d&)> is_move_free;
    std::function<bool()> is_cancelled = {};      // ends the search early
    std::function<void(double)> on_shorter = {};  // a way of that length, m, was found
    int max_iterations = 1500;
    // Once there, half the work spent so far, and at least this many samples, go into shortening
    // the way.
    int improve_at_least = 60;
    bool detour = false;  // does without the straight way, where it is free
};

struct RrtStarResult {
    bool found = false;
    std::vector<Eigen::Vector3d> corners;  // between start and goal, without them
    std::vector<Eigen::Vector3d> samples;  // all that became part of the tree, as they came
    std::vector<int> parents;              // of each sample when it came; -1: the start
};

/// RRT* (Karaman and Frazzoli, 2011): grows a tree from the start, rewires it around each new
/// node, and stops some time after it reached the goal. Once there, only places that can shorten
/// the way are tried (Gammell et al., Informed RRT*, 2014, by rejection).
RrtStarResult rrtStar(const RrtStarProblem& problem, Random random);

}  // namespace dollytrack::planning
