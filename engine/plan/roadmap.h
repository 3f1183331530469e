#pragma once

#include "engine/plan/algorithm_step.h"
#include "engine/plan/viewpoint.h"

#include <Eigen/Core>

#include <vector>

namespace dollytrack {

/// A collision-free way between two position points. Straight when `via` is empty.
struct RoadmapEdge {
    int a = 0;  // indices of position points
    int b = 0;
    std::vector<Eigen::Vector3d> via;  // corners from a to b, found by RRT*
    double length_m = 0.0;
    bool in_tree = true;   // false: dropped because it closes a cycle
    bool is_link = false;  // found by RRT*, between parts that straight moves did not join
};

/// A straight move that was refused, and where it would have hit.
struct RefusedEdge {
    int a = 0;
    int b = 0;
    Eigen::Vector3d collision = Eigen::Vector3d::Zero();
    int object_id = 0;                     // 0: no surface, see reason
    Verdict reason = Verdict::InObstacle;  // or OutsideRoom, NoGo, HeightBand
};

/// H in the paper: position points and the moves between them.
struct Roadmap {
    std::vector<RoadmapEdge> edges;
    std::vector<RefusedEdge> refused;
    std::vector<Eigen::Vector3d> samples;  // of RRT*, for the image
    std::vector<int> sample_parents;       // index of the sample each grew from; -1: an end
    AlgorithmSteps steps;                  // how all this came about
    std::vector<int> group;                // connected part of each position point
    int group_count = 0;
};

}  // namespace dollytrack
