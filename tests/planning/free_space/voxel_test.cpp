// The parts of the grid checked against brute force: the cells that a triangle touches, gaps,
// connected pieces.

#include "planning/free_space/components.h"
#include "planning/free_space/distance_field.h"
#include "planning/free_space/voxelize.h"

#include "engine/core/random.h"
#include "tests/support/scene_builder.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace dollytrack::planning::voxel_test {
namespace {

using Eigen::Vector3d;

VoxelGrid smallGrid(int nx, int ny, int nz, double resolution_m = 0.1) {
    VoxelGrid grid;
    grid.resolution_m = resolution_m;
    grid.first = {-3, 2, -7};
    grid.count = {nx, ny, nz};
    grid.room_end = grid.count;
    return grid;
}

/// Overlap of a triangle and a cube around `center` by the thirteen separating axes.
bool overlaps(const std::array<Vector3d, 3>& triangle, const Vector3d& center, double half) {
    std::array<Vector3d, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = triangle[i] - center;
    const auto separates = [&](const Vector3d& axis) {
        const double reach = half * axis.cwiseAbs().sum();
        const std::array<double, 3> at = {axis.dot(p[0]), axis.dot(p[1]), axis.dot(p[2])};
        return std::ranges::min(at) > reach || std::ranges::max(at) < -reach;
    };
    const std::array<Vector3d, 3> edges = {p[1] - p[0], p[2] - p[1], p[0] - p[2]};
    if (separates(edges[0].cross(edges[1]))) return false;
    for (int k = 0; k < 3; ++k) {
        if (separates(Vector3d::Unit(k))) return false;
        for (const Vector3d& edge : edges) {
            if (separates(edge.cross(Vector3d::Unit(k)))) return false;
        }
    }
    return true;
}

Scene sceneOf(const std::array<Vector3d, 3>& corners) {
    test::SceneBuilder builder;
    builder.object("triangle").quad(corners[0], corners[1] - corners[0], corners[2] - corners[1]);
    Scene scene = builder.build();
    scene.triangles.resize(1);
    scene.objects[0].triangle_count = 1;
    return scene;
}

}  // namespace

TEST(Voxelize, MarksExactlyTheCellsThatATriangleTouches) {
    const VoxelGrid grid = smallGrid(12, 11, 13);
    Random random(2);
    int touched = 0;
    for (int i = 0; i < 300; ++i) {
        std::array<Vector3d, 3> corners;
        const double reach = i % 3 == 0 ? 0.2 : 1.5;
        const Vector3d middle(random.uniform(-0.3, 0.9), random.uniform(0.2, 1.3),
                              random.uniform(-0.7, 0.6));
        for (Vector3d& corner : corners) {
            for (int k = 0; k < 3; ++k) corner[k] = middle[k] + random.uniform(-reach, reach);
            if (i % 4 == 0) corner.z() = middle.z();  // flat ones, and needles
            if (i % 8 == 0) corner.y() = middle.y();
        }
        const Scene scene = sceneOf(corners);
        for (unsigned k = 0; k < 3; ++k) corners[k] = scene.positions[k].cast<double>();
        const SurfaceCells found = voxelize(scene, grid, {});
        for (int z = 0; z < grid.count[2]; ++z) {
            for (int y = 0; y < grid.count[1]; ++y) {
                for (int x = 0; x < grid.count[0]; ++x) {
                    const Vector3d center = grid.centerOf(x, y, z);
                    const bool marked = found.cells[grid.indexOf(x, y, z)] != 0;
                    // The two sizes differ by the small margin by which cells are enlarged.
                    if (overlaps(corners, center, 0.05)) {
                        ASSERT_TRUE(marked) << i;
                    }
                    if (!overlaps(corners, center, 0.05 + 5e-5)) {
                        ASSERT_FALSE(marked) << i;
                    }
                    touched += marked ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(touched, 5000);
}

TEST(Voxelize, LeavesOutTrianglesThatAreNoNumbers) {
    Scene scene = sceneOf({Vector3d(0, 0.5, 0), {0.5, 0.5, 0}, {0, 1, 0}});
    scene.positions[1].x() = std::numeric_limits<float>::quiet_NaN();
    const SurfaceCells found = voxelize(scene, smallGrid(9, 9, 9), {});
    EXPECT_EQ(std::ranges::count(found.cells, 0), 9 * 9 * 9);
    scene.positions[1].x() = std::numeric_limits<float>::infinity();
    EXPECT_EQ(std::ranges::count(voxelize(scene, smallGrid(9, 9, 9), {}).cells, 0), 9 * 9 * 9);
}

TEST(DistanceField, GapsAreThoseBetweenCubes) {
    Random random(6);
    for (const int surfaces : {0, 1, 5, 200}) {
        const VoxelGrid grid = smallGrid(70, 17, 9);
        std::vector<std::uint8_t> cells(grid.size(), 0);
        std::vector<std::array<int, 3>> at;
        for (int i = 0; i < surfaces; ++i) {
            const std::array<int, 3> c = {static_cast<int>(random.below(70)),
                                          static_cast<int>(random.below(17)),
                                          static_cast<int>(random.below(9))};
            cells[grid.indexOf(c[0], c[1], c[2])] = 1;
            at.push_back(c);
        }
        const std::vector<std::uint16_t> gaps = squaredGaps(grid, cells, {});
        for (int z = 0; z < 9; ++z) {
            for (int y = 0; y < 17; ++y) {
                for (int x = 0; x < 70; ++x) {
                    int best = kMaxSquaredGap;
                    for (const auto& c : at) {
                        int squared = 0;
                        for (const int d : {c[0] - x, c[1] - y, c[2] - z}) {
                            const int gap = std::max(0, std::abs(d) - 1);
                            squared += gap * gap;
                        }
                        best = std::min(best, squared);
                    }
                    ASSERT_EQ(gaps[grid.indexOf(x, y, z)], best) << x << " " << y << " " << z;
                }
            }
        }
    }
}

TEST(Components, AgreeWithAFlood) {
    const VoxelGrid grid = smallGrid(20, 15, 10);
    Random random(8);
    std::vector<std::uint8_t> cells(grid.size());
    for (std::uint8_t& cell : cells) cell = random.uniform() < 0.35 ? 2 : 1;
    const CellComponents found = findComponents(grid, cells, 2);
    std::vector<int> label(grid.size(), -1);
    for (const CellRun& run : found.runs) {
        for (int x = run.x_begin; x < run.x_end; ++x) {
            label[grid.indexOf(x, run.y, run.z)] = run.component;
        }
    }
    std::vector<int> flood(grid.size(), -1);
    int pieces = 0;
    const std::array<std::array<int, 3>, 6> steps = {
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    for (std::size_t start = 0; start < grid.size(); ++start) {
        if (cells[start] != 2 || flood[start] >= 0) continue;
        std::vector<std::size_t> open = {start};
        flood[start] = pieces;
        while (!open.empty()) {
            const auto i = static_cast<int>(open.back());
            open.pop_back();
            for (const auto& step : steps) {
                const int x = i % 20 + step[0];
                const int y = i / 20 % 15 + step[1];
                const int z = i / 300 + step[2];
                if (x < 0 || x >= 20 || y < 0 || y >= 15 || z < 0 || z >= 10) continue;
                const std::size_t to = grid.indexOf(x, y, z);
                if (cells[to] != 2 || flood[to] >= 0) continue;
                flood[to] = pieces;
                open.push_back(to);
            }
        }
        ++pieces;
    }
    EXPECT_GT(pieces, 20);
    EXPECT_EQ(static_cast<int>(found.cells.size()), pieces);
    EXPECT_EQ(label, flood) << "numbered by their first cell";
}

}  // namespace dollytrack::planning::voxel_test
