#include "planning/linking/rrt_star.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::planning::rrt_star_test {
namespace {

using Eigen::Vector3d;

constexpr double kHalfWall = 0.1;  // a wall along y at x = 0
constexpr double kGapLow = 0.8;
constexpr double kGapHigh = 1.4;

/// Two positions in a plane of 6 x 4 m with a wall between them, which may have a gap.
struct Plane {
    bool has_gap = true;

    [[nodiscard]] bool isFree(const Vector3d& p) const {
        if (std::abs(p.x()) > 3.0 || std::abs(p.y()) > 2.0) return false;
        return std::abs(p.x()) >= kHalfWall || (has_gap && p.y() >= kGapLow && p.y() <= kGapHigh);
    }

    /// Exact: within the wall's thickness the move must stay in the gap.
    [[nodiscard]] bool isMoveFree(const Vector3d& a, const Vector3d& b) const {
        if (!isFree(a) || !isFree(b)) return false;
        if (std::max(a.x(), b.x()) <= -kHalfWall || std::min(a.x(), b.x()) >= kHalfWall) {
            return true;
        }
        if (!has_gap) return false;
        const auto inGap = [&](double x) {
            const double run = b.x() - a.x();
            const double t = std::abs(run) < 1e-12 ? 0.0 : std::clamp((x - a.x()) / run, 0.0, 1.0);
            const double y = a.y() + t * (b.y() - a.y());
            return y >= kGapLow && y <= kGapHigh;
        };
        return inGap(-kHalfWall) && inGap(kHalfWall) &&
               (std::abs(b.x() - a.x()) > 1e-12 || (b.y() >= kGapLow && b.y() <= kGapHigh));
    }

    [[nodiscard]] RrtStarProblem problem() const {
        RrtStarProblem problem;
        problem.start = {-2, -1, 0};
        problem.goal = {2, -1, 0};
        problem.sample = [](Random& random) {
            const double x = random.uniform(-3, 3);
            return Vector3d(x, random.uniform(-2, 2), 0);
        };
        problem.is_free = [*this](const Vector3d& p) { return isFree(p); };
        problem.is_move_free = [*this](const Vector3d& a, const Vector3d& b) {
            return isMoveFree(a, b);
        };
        return problem;
    }
};

std::vector<Vector3d> wholeWay(const RrtStarProblem& problem, const RrtStarResult& result) {
    std::vector<Vector3d> way = {problem.start};
    way.insert(way.end(), result.corners.begin(), result.corners.end());
    way.push_back(problem.goal);
    return way;
}

double lengthOf(const std::vector<Vector3d>& way) {
    double length = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
    return length;
}

}  // namespace

TEST(RrtStar, FindsAShortFreeWayThroughTheGap) {
    const Plane plane;
    const RrtStarProblem problem = plane.problem();
    // Around the gap's two lower edges, each 1.9 m across and 1.8 m up from its end.
    const double shortest = 2.0 * std::hypot(1.9, 1.8) + 2.0 * kHalfWall;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RrtStarResult result = rrtStar(problem, Random(seed));
        ASSERT_TRUE(result.found) << "seed " << seed;
        const std::vector<Vector3d> way = wholeWay(problem, result);
        for (std::size_t i = 1; i < way.size(); ++i) {
            const int steps = static_cast<int>((way[i] - way[i - 1]).norm() / 0.002) + 1;
            for (int s = 0; s <= steps; ++s) {
                const Vector3d p = way[i - 1] + (way[i] - way[i - 1]) * s / steps;
                const bool in_wall = std::abs(p.x()) < kHalfWall - 1e-9 &&
                                     (p.y() < kGapLow - 1e-9 || p.y() > kGapHigh + 1e-9);
                ASSERT_FALSE(in_wall) << "seed " << seed << " at " << p.transpose();
            }
        }
        EXPECT_LE(lengthOf(way), 1.5 * shortest) << "seed " << seed;
        EXPECT_GE(lengthOf(way), shortest - 1e-9) << "seed " << seed;
    }
}

TEST(RrtStar, EqualSeedsGiveEqualWays) {
    const RrtStarProblem problem = Plane{}.problem();
    const RrtStarResult a = rrtStar(problem, Random(7));
    const RrtStarResult b = rrtStar(problem, Random(7));
    ASSERT_TRUE(a.found);
    EXPECT_EQ(a.corners, b.corners);
    EXPECT_EQ(a.samples, b.samples);
    EXPECT_NE(a.samples, rrtStar(problem, Random(8)).samples);
}

TEST(RrtStar, ASealedGoalIsNotFoundWithinTheIterations) {
    RrtStarProblem problem = Plane{.has_gap = false}.problem();
    int sampled = 0;
    problem.max_iterations = 400;
    problem.sample = [&sampled, inner = problem.sample](Random& random) {
        ++sampled;
        return inner(random);
    };
    const RrtStarResult result = rrtStar(problem, Random(3));
    EXPECT_FALSE(result.found);
    EXPECT_TRUE(result.corners.empty());
    EXPECT_EQ(sampled, 400);
    for (const Vector3d& sample : result.samples) EXPECT_LT(sample.x(), 0.0);
}

TEST(RrtStar, AGoalInPlainSightNeedsNoCorner) {
    RrtStarProblem problem = Plane{}.problem();
    problem.goal = {-1, 1, 0};
    const RrtStarResult result = rrtStar(problem, Random(1));
    EXPECT_TRUE(result.found);
    EXPECT_TRUE(result.corners.empty());
}

// A bent tube 12 cm wide, out of which no straight move leads. Samples are spread as widely as
// those of links, so that nearly all of them lie behind its walls.
TEST(RrtStar, FindsItsWayOutOfANook) {
    const std::vector<Eigen::AlignedBox3d> free = {
        {Vector3d(-0.06, -0.06, -0.06), Vector3d(0.06, 0.06, 0.26)},
        {Vector3d(-0.06, -0.06, 0.14), Vector3d(0.5, 0.06, 0.26)},
        {Vector3d(0.45, -2, -2), Vector3d(3, 2, 2)}};
    RrtStarProblem problem;
    problem.goal = {1, 1, 0.5};
    problem.max_iterations = 300;
    problem.sample = [](Random& random) {
        const double x = 0.5 * random.normal();
        const double y = 0.5 * random.normal();
        return Vector3d(x, y, 0.5 * random.normal());
    };
    problem.is_free = [&](const Vector3d& p) {
        return std::ranges::any_of(free, [&](const auto& box) { return box.contains(p); });
    };
    problem.is_move_free = [&](const Vector3d& a, const Vector3d& b) {
        const int steps = 1 + static_cast<int>((b - a).norm() / 0.002);
        for (int i = 0; i <= steps; ++i) {
            if (!problem.is_free(a + (b - a) * (static_cast<double>(i) / steps))) return false;
        }
        return true;
    };
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RrtStarResult result = rrtStar(problem, Random(seed));
        found += result.found ? 1 : 0;
        const std::vector<Vector3d> way = wholeWay(problem, result);
        for (std::size_t i = 1; result.found && i < way.size(); ++i) {
            EXPECT_TRUE(problem.is_move_free(way[i - 1], way[i]));
        }
    }
    EXPECT_GE(found, 18);
}

}  // namespace dollytrack::planning::rrt_star_test
