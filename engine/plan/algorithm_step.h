#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace dollytrack {

/// One step of the way from key frames to a path (paper, Algorithm 1 and 3.2.3), in the order in
/// which it was taken. `a`, `b` are position points; -1 where they have no meaning.
struct AlgorithmStep {
    enum class Kind : std::uint8_t {
        Sample,      // a: the key frame drawn at random
        Near,        // a: the sample, b: the vertex of least cost; the three terms of its cost
        Skip,        // a, b: a pair already joined or refused
        Edge,        // a, b: the straight move between them is tried
        Accepted,    // a, b: it is free; index: of the edge
        Refused,     // a, b: it collides; index: of the refused edge; point: where
        Leave,       // a: the sample has had all it gets; index: how many edges were refused
        Link,        // a, b: RRT* begins, from a to b
        LinkSample,  // index: of the sample in Roadmap::samples; parent: the one it grows from,
                     // -1: a itself; point, from: their places
        LinkFound,   // a, b: joined; index: of the edge
        LinkFailed,  // a, b: not joined; index: how many samples were spent
        Prune,       // a, b: their edge closes a cycle and is dropped; index: of the edge
        Visit,       // a: comes next on the path, after b (-1: begins); index: which path
    };
    Kind kind = Kind::Sample;
    std::int32_t a = -1;
    std::int32_t b = -1;
    std::int32_t index = -1;
    std::int32_t parent = -1;
    Eigen::Vector3f point = Eigen::Vector3f::Zero();
    Eigen::Vector3f from = Eigen::Vector3f::Zero();
    // Near: the terms of the cost and what the first is made of.
    float distance_m = 0.0F;
    float distance_cost = 0.0F;
    float size_cost = 0.0F;
    float turn_cost = 0.0F;

    [[nodiscard]] float cost() const { return distance_cost + size_cost + turn_cost; }
};

/// The steps of a plan. Bounded: what comes after the limit is only counted.
struct AlgorithmSteps {
    static constexpr std::size_t kLimit = 200'000;

    std::vector<AlgorithmStep> steps;
    std::uint64_t left_out = 0;

    void add(const AlgorithmStep& step) {
        if (steps.size() < kLimit) {
            steps.push_back(step);
        } else {
            ++left_out;
        }
    }
};

}  // namespace dollytrack
