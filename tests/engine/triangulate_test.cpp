#include "engine/geometry/triangulate.h"
#include "engine/core/random.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace dollytrack::triangulate_test {
namespace {

using Corners = std::vector<Eigen::Vector3f>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Shoelace formula in the xy plane; positive counter-clockwise.
double shoelace(const Corners& p) {
    double area = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const auto& a = p[i];
        const auto& b = p[(i + 1) % p.size()];
        area += 0.5 * (double{a.x()} * double{b.y()} - double{b.x()} * double{a.y()});
    }
    return area;
}

double signedArea(const Corners& p, const Triangles& triangles) {
    double area = 0.0;
    for (const auto& t : triangles) area += shoelace({p[t[0]], p[t[1]], p[t[2]]});
    return area;
}

/// Winding number by summed angles, independent of the rule under test.
bool encloses(const Corners& p, const Eigen::Vector3f& at) {
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Eigen::Vector3f a = p[i] - at;
        const Eigen::Vector3f b = p[(i + 1) % p.size()] - at;
        sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
    }
    return std::abs(sum) > std::numbers::pi;
}

Corners star(Random& random, int count) {
    Corners corners;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i + random.uniform(0.1, 0.9)) / count;
        const double radius = random.uniform(0.2, 2.0);
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    return corners;
}

TEST(Triangulate, FillsRandomStarsExactly) {
    Random random(7);
    for (int round = 0; round < 300; ++round) {
        const Corners corners = star(random, 4 + static_cast<int>(random.below(40)));
        Triangles triangles;
        ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
        EXPECT_EQ(triangles.size(), corners.size() - 2);
        EXPECT_NEAR(signedArea(corners, triangles), shoelace(corners), 1e-5);
        for (const auto& t : triangles) {
            // Same winding as the polygon, and no triangle outside it.
            EXPECT_GT(shoelace({corners[t[0]], corners[t[1]], corners[t[2]]}), -1e-9);
            EXPECT_TRUE(encloses(corners, (corners[t[0]] + corners[t[1]] + corners[t[2]]) / 3.0F));
        }
    }
}

TEST(Triangulate, KeepsClockwiseWinding) {
    Random random(3);
    Corners corners = star(random, 9);
    std::reverse(corners.begin(), corners.end());
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
    EXPECT_LT(shoelace(corners), 0.0);
    EXPECT_NEAR(signedArea(corners, triangles), shoelace(corners), 1e-5);
}

TEST(Triangulate, TakesCollinearAndRepeatedCorners) {
    const Corners corners = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 1, 0},
                             {1, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
    EXPECT_NEAR(signedArea(corners, triangles), 3.0, 1e-9);
}

TEST(Triangulate, LeavesAHoleJoinedByABridgeOpen) {
    // A 4 x 4 square with a 2 x 2 hole; the outline enters and leaves the hole along the same edge.
    const Corners corners = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                             {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
    EXPECT_NEAR(signedArea(corners, triangles), 12.0, 1e-9);
}

TEST(Triangulate, CutsAConcaveQuadInside) {
    const Corners corners = {{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}};
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
    ASSERT_EQ(triangles.size(), 2U);
    for (const auto& t : triangles) {
        EXPECT_GT(shoelace({corners[t[0]], corners[t[1]], corners[t[2]]}), 0.0);
    }
}

TEST(Triangulate, TakesTheDelaunayDiagonalOfAQuad) {
    // A kite whose corners 1 and 3 are near each other: the diagonal 0-2 would make slivers.
    const Corners corners = {{-2, 0, 0}, {0, -0.5, 0}, {2, 0, 0}, {0, 0.5, 0}};
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Exact);
    for (const auto& t : triangles) {
        EXPECT_TRUE(std::count(t.begin(), t.end(), 1U) && std::count(t.begin(), t.end(), 3U));
    }
}

TEST(Triangulate, TakesTiltedAndSlightlyBentFaces) {
    Random random(5);
    const Eigen::Affine3f tilt(Eigen::AngleAxisf(0.9F, Eigen::Vector3f(1, 2, 3).normalized()));
    const Corners flat = star(random, 20);
    Corners bent;
    for (const auto& p : flat) {
        const auto lift = static_cast<float>(random.uniform(-1e-3, 1e-3));
        bent.push_back(tilt * Eigen::Vector3f(p.x(), p.y(), lift));
    }
    Triangles triangles;
    ASSERT_EQ(triangulatePolygon(bent, triangles), PolygonOutcome::Exact);
    EXPECT_NEAR(signedArea(flat, triangles), shoelace(flat), 1e-2);
}

TEST(Triangulate, RefusesWhatHasNoArea) {
    Triangles triangles;
    EXPECT_EQ(triangulatePolygon(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, triangles),
              PolygonOutcome::Degenerate);
    EXPECT_EQ(triangulatePolygon(Corners{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, triangles),
              PolygonOutcome::Degenerate);
    EXPECT_EQ(triangulatePolygon(Corners{{0, 0, 0}, {1, 0, 0}}, triangles),
              PolygonOutcome::Degenerate);
    EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, FillsACrossingOutlineAsAFan) {
    const Corners corners = {{0, 0, 0}, {3, 2, 0}, {3, 0, 0}, {0, 1, 0}, {-1, 0.2F, 0}};
    Triangles triangles;
    EXPECT_EQ(triangulatePolygon(corners, triangles), PolygonOutcome::Approximate);
    EXPECT_EQ(triangles.size(), 3U);
}

}  // namespace
}  // namespace dollytrack::triangulate_test
