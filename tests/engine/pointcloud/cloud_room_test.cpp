#include "engine/core/random.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/pointcloud/cloud_depths.h"
#include "engine/io/pointcloud/hole_filler.h"
#include "engine/scene/labels.h"
#include "tests/support/temp_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

namespace dollytrack::cloud_room_test {
namespace {

using Color = std::array<int, 3>;
using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// A scan as text: a room of 3 x 4 x 2.5 m with a floor, three walls and two boxes, one point every
/// 2.5 cm with 1 mm of noise.
class RoomScan {
  public:
    explicit RoomScan(Map file_from_room, double noise_m = 0.001, double step_m = 0.025)
        : file_from_room_(std::move(file_from_room)), noise_m_(noise_m), step_m_(step_m) {
        rectangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0}, kFloor);
        rectangle({0, 0, 0}, {3, 0, 0}, {0, 0, 2.5}, kWall);
        rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 2.5}, kWall);
        rectangle({3, 0, 0}, {0, 4, 0}, {0, 0, 2.5}, kWall);
        box({0.5, 1.0, 0.0}, {0.6, 0.6, 0.7}, {200, 30, 30});
        box({1.8, 2.2, 0.0}, {0.5, 0.9, 0.5}, {30, 30, 200});
    }

    void box(const Eigen::Vector3d& low, const Eigen::Vector3d& size, const Color& color) {
        const Eigen::Vector3d x(size.x(), 0, 0);
        const Eigen::Vector3d y(0, size.y(), 0);
        const Eigen::Vector3d z(0, 0, size.z());
        rectangle(low + z, x, y, color);
        rectangle(low, x, z, color);
        rectangle(low + y, x, z, color);
        rectangle(low, y, z, color);
        rectangle(low + x, y, z, color);
    }

    /// Adds a ceiling; the fourth wall stays missing.
    RoomScan& ceiling() {
        rectangle({0, 0, 2.5}, {3, 0, 0}, {0, 4, 0}, kWall);
        return *this;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

    static constexpr Color kFloor = {120, 80, 40};
    static constexpr Color kWall = {230, 230, 220};

  private:
    void rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& along,
                   const Eigen::Vector3d& across, const Color& color) {
        const auto steps = [this](const Eigen::Vector3d& v) {
            return static_cast<int>(std::round(v.norm() / step_m_));
        };
        const Eigen::Vector3d normal = along.cross(across).normalized();
        for (int i = 0; i <= steps(along); ++i) {
            for (int j = 0; j <= steps(across); ++j) {
                const Eigen::Vector3d p =
                    file_from_room_(corner + along * i / steps(along) + across * j / steps(across) +
                                    noise_m_ * random_.normal() * normal);
                text_ += fmt::format("{:.5f} {:.5f} {:.5f} {} {} {}\n", p.x(), p.y(), p.z(),
                                     color[0], color[1], color[2]);
            }
        }
    }

    Map file_from_room_;
    double noise_m_;
    double step_m_;
    Random random_{3};
    std::string text_;
};

Eigen::Vector3d asItIs(const Eigen::Vector3d& p) {
    return p;
}

/// Converts to a camera's axes, x right, y down, z forward, tilted by 8 degrees.
Eigen::Vector3d seenByACamera(const Eigen::Vector3d& p) {
    const Eigen::Vector3d level(p.x(), -p.z() + 1.2, p.y() + 1.0);
    return Eigen::AngleAxisd(0.14, Eigen::Vector3d(1.0, 0.0, 0.3).normalized()) * level;
}

std::vector<const Object*> targetsOf(const Scene& scene) {
    std::vector<const Object*> targets;
    for (const Object& object : scene.objects) {
        if (!object.structure) targets.push_back(&object);
    }
    std::sort(targets.begin(), targets.end(), [](const Object* a, const Object* b) {
        return a->box.half_size.z() > b->box.half_size.z();
    });
    return targets;
}

/// The mean texture colour of an object, at its triangles' centres.
Eigen::Vector3d meanColor(const Scene& scene, const Object& object) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count;
         ++t) {
        const Texture& picture =
            scene.textures[scene.materials[scene.triangle_material[t]].texture];
        Eigen::Vector2f uv = Eigen::Vector2f::Zero();
        for (const std::uint32_t v : scene.triangles[t]) uv += scene.uvs[v] / 3.0F;
        const auto column = static_cast<std::size_t>(uv.x() * static_cast<float>(picture.width));
        const auto row =
            static_cast<std::size_t>((1.0F - uv.y()) * static_cast<float>(picture.height));
        for (std::size_t c = 0; c < 3; ++c) {
            sum[static_cast<Eigen::Index>(c)] +=
                picture.rgba[4 * (row * static_cast<std::size_t>(picture.width) + column) + c];
        }
    }
    return sum / object.triangle_count;
}

void expectTheRoom(const Scene& scene, double tolerance_m) {
    std::set<int> structure;
    for (const Object& object : scene.objects) {
        if (object.structure) structure.insert(object.nyu40);
    }
    EXPECT_TRUE(structure.contains(kNyuFloor));
    EXPECT_TRUE(structure.contains(kNyuWall));
    const auto targets = targetsOf(scene);
    ASSERT_EQ(targets.size(), 2U);
    EXPECT_NEAR(2.0 * targets[0]->box.half_size.z(), 0.7, 0.06);
    EXPECT_NEAR(2.0 * targets[1]->box.half_size.z(), 0.5, 0.06);
    // The distance of the two objects does not depend on the file's axes.
    const Eigen::Vector3d apart = targets[0]->box.center - targets[1]->box.center;
    EXPECT_NEAR(apart.head<2>().norm(), std::hypot(0.8 - 2.05, 1.3 - 2.65), tolerance_m);
    const Eigen::Vector3d red = meanColor(scene, *targets[0]);
    const Eigen::Vector3d blue = meanColor(scene, *targets[1]);
    EXPECT_GT(red.x(), 2.0 * red.z());
    EXPECT_GT(blue.z(), 2.0 * blue.x());
}

TEST(CloudRoom, IsARoomWithThingsInIt) {
    const test::TempFolder folder;
    const auto scene = importScene(folder.write("room.xyz", RoomScan(asItIs).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_EQ(scene->report.up_axis, "z");
    EXPECT_DOUBLE_EQ(scene->report.unit_m, 1.0);
    expectTheRoom(*scene, 0.05);
}

/// Share of an object's surface that is level or upright within 20 degrees.
double evenShare(const Scene& scene, const Object& object) {
    double even = 0.0;
    double all = 0.0;
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
        const Triangle& triangle = scene.triangles[object.first_triangle + t];
        const Eigen::Vector3f& a = scene.positions[triangle[0]];
        const Eigen::Vector3f across =
            (scene.positions[triangle[1]] - a).cross(scene.positions[triangle[2]] - a);
        const double rise = std::abs(across.normalized().z());
        all += across.norm();
        if (rise > std::cos(0.35) || rise < std::sin(0.35)) even += across.norm();
    }
    return even / all;
}

// Without smoothing, a floor of such points is a heap of fragments, only two fifths of it level.
TEST(CloudRoom, NoisyScansKeepTheirFloorsAndSaySo) {
    const test::TempFolder folder;
    const auto scene = importScene(folder.write("room.xyz", RoomScan(asItIs, 0.02, 0.0125).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    const auto floor = std::find_if(scene->objects.begin(), scene->objects.end(),
                                    [](const Object& o) { return o.nyu40 == kNyuFloor; });
    ASSERT_NE(floor, scene->objects.end());
    EXPECT_GT(evenShare(*scene, *floor), 0.9);
    EXPECT_EQ(targetsOf(*scene).size(), 2U);
    EXPECT_TRUE(std::any_of(
        scene->report.warnings.begin(), scene->report.warnings.end(),
        [](const std::string& line) { return line.find("mm of noise") != std::string::npos; }));
}

TEST(CloudRoom, SparseScansGetLargerCubesAndSaySo) {
    const test::TempFolder folder;
    const auto scene = importScene(folder.write("room.xyz", RoomScan(asItIs, 0.001, 0.07).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_EQ(targetsOf(*scene).size(), 2U);
    EXPECT_TRUE(std::any_of(
        scene->report.warnings.begin(), scene->report.warnings.end(),
        [](const std::string& line) { return line.find("mm apart") != std::string::npos; }));
}

// Surfaces of an upside-down room face against z, as those before a camera do.
TEST(CloudRoom, IsNoCamerasViewBehindTheCamera) {
    const test::TempFolder folder;
    const auto upsideDown = [](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(p.x(), -p.y(), -p.z());
    };
    const auto scene = importScene(folder.write("room.xyz", RoomScan(upsideDown).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_LT(scene->source_from_world.linear().col(2).z(), -0.9);
    expectTheRoom(*scene, 0.05);
}

// Floor and ceiling of a closed room look alike; the tops of what stands in it tell which way up.
TEST(CloudRoom, KnowsAClosedRoomThatIsUpsideDown) {
    const test::TempFolder folder;
    const auto upsideDown = [](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(p.x(), -p.y(), -p.z());
    };
    for (const bool turned : {false, true}) {
        RoomScan scan(turned ? Map(upsideDown) : Map(asItIs));
        const auto scene = importScene(folder.write("room.xyz", scan.ceiling().text()));
        ASSERT_TRUE(scene) << describe(scene.error());
        EXPECT_EQ(scene->source_from_world.linear().col(2).z() < 0.0, turned);
        expectTheRoom(*scene, 0.05);
    }
}

// The axes of OpenGL's cameras: y points up, and the camera looks against z.
TEST(CloudRoom, LevelsWhatAnOpenGlCameraSaw) {
    const test::TempFolder folder;
    const auto seen = [](const Eigen::Vector3d& p) {
        const Eigen::Vector3d q = seenByACamera(p);
        return Eigen::Vector3d(q.x(), -q.y(), -q.z());
    };
    const auto scene = importScene(folder.write("room.xyz", RoomScan(seen).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    expectTheRoom(*scene, 0.05);
    EXPECT_GT(scene->source_from_world.linear().col(2).y(), 0.9);
}

// The same room in a camera's tilted axes is levelled; the transform to the file's axes has the
// rotation.
TEST(CloudRoom, LevelsWhatACameraSaw) {
    const test::TempFolder folder;
    const auto scene = importScene(folder.write("room.xyz", RoomScan(seenByACamera).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    expectTheRoom(*scene, 0.05);
    const Eigen::Vector3d up = scene->source_from_world.linear().col(2);
    const Eigen::Vector3d truth =
        seenByACamera(Eigen::Vector3d::UnitZ()) - seenByACamera(Eigen::Vector3d::Zero());
    EXPECT_GT(up.dot(truth), std::cos(0.02));
    EXPECT_NEAR(scene->source_from_world.linear().determinant(), 1.0, 1e-9);
}

TEST(CloudRoom, FarAwayMillimetresComeOutInMetres) {
    const test::TempFolder folder;
    const auto far = [](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(1000.0 * p + Eigen::Vector3d(4.5e8, 5.4e9, 1e5));
    };
    const auto scene = importScene(folder.write("room.xyz", RoomScan(far).text()));
    ASSERT_TRUE(scene) << describe(scene.error());
    EXPECT_DOUBLE_EQ(scene->report.unit_m, 0.001);
    const auto& notes = scene->report.notes;
    EXPECT_NE(std::find(notes.begin(), notes.end(),
                        "1 unit of the cloud is 0.001 m, estimated by its size"),
              notes.end());
    expectTheRoom(*scene, 0.05);
    const auto targets = targetsOf(*scene);
    const Eigen::Vector3d at = scene->source_from_world * targets[0]->box.center;
    EXPECT_NEAR(at.x(), far({0.8, 1.3, 0.35}).x(), 60.0);
    EXPECT_NEAR(at.y(), far({0.8, 1.3, 0.35}).y(), 60.0);
}

// CGAL orders some data by addresses. Memory is fragmented between the runs, so that the second run
// has other addresses.
TEST(CloudRoom, GivesTheSameBytesTwice) {
    const test::TempFolder folder;
    const auto path = folder.write("room.xyz", RoomScan(asItIs).text());
    const auto once = importScene(path);
    Random random(5);
    std::vector<std::unique_ptr<char[]>> pieces;
    for (int i = 0; i < 200'000; ++i) {
        pieces.push_back(std::make_unique<char[]>(16 + random.below(300)));
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (random.below(2) == 0) pieces[i].reset();
    }
    const auto twice = importScene(path);
    ASSERT_TRUE(once && twice);
    EXPECT_EQ(once->positions, twice->positions);
    EXPECT_EQ(once->triangles, twice->triangles);
    EXPECT_EQ(once->textures[0].rgba, twice->textures[0].rgba);
}

/// A slanted wall seen by a depth camera of 160 points, 3 to 5 m away; inverse depths are quantized
/// to `step` (0: not quantized).
PointCloud pictureOfAWall(double step) {
    PointCloud cloud;
    for (int row = 0; row < 120; ++row) {
        for (int column = 0; column < 160; ++column) {
            const double u = (column - 80) / 140.0;
            const double v = (row - 60) / 140.0;
            double inverse = (1.0 + 0.4 * u - 0.1 * v) / 4.0;  // z = 4 - 0.4 x + 0.1 y
            if (step > 0.0) inverse = step * std::round(inverse / step);
            cloud.points.emplace_back(Eigen::Vector3d(u, v, 1.0) / inverse);
        }
    }
    return cloud;
}

double distanceFromTheWall(const PointCloud& cloud) {
    double sum = 0.0;
    for (const Eigen::Vector3d& p : cloud.points) {
        sum += std::abs(p.z() - (4.0 - 0.4 * p.x() + 0.1 * p.y()));
    }
    return sum / static_cast<double>(cloud.points.size());
}

TEST(CloudDepths, StepsOfADepthCameraBecomeTheWallTheyWere) {
    PointCloud cloud = pictureOfAWall(2.9e-3);
    const double before = distanceFromTheWall(cloud);
    EXPECT_GT(before, 0.009);  // a quarter of the step, 46 mm at 4 m
    EXPECT_NEAR(smoothDepths(cloud, {}), 2.9e-3, 1e-6);
    EXPECT_LT(distanceFromTheWall(cloud), 0.25 * before);
}

TEST(CloudDepths, WhatHasNoStepsStaysToTheLastBit) {
    PointCloud cloud = pictureOfAWall(0.0);
    const auto before = cloud.points;
    EXPECT_DOUBLE_EQ(smoothDepths(cloud, {}), 0.0);
    EXPECT_EQ(cloud.points, before);
}

// Only a wall: a level floor is added below it that extends to the scanner's position.
TEST(CloudRoom, HasAFloorWhereTheScanShowsNone) {
    std::string text;
    for (int i = 0; i <= 80; ++i) {
        for (int j = 0; j <= 80; ++j) {
            text += fmt::format("{:.4f} 3.0 {:.4f} 0 0 0 0 -1 0\n", 0.025 * i, 0.025 * j);
        }
    }
    const test::TempFolder folder;
    ImportOptions options;
    options.up_axis = 'z';
    const auto scene = importScene(folder.write("wall.xyz", text), options);
    ASSERT_TRUE(scene) << describe(scene.error());
    const auto floor =
        std::find_if(scene->objects.begin(), scene->objects.end(),
                     [](const Object& object) { return object.name == "floor_unseen"; });
    ASSERT_NE(floor, scene->objects.end());
    EXPECT_TRUE(floor->structure);
    EXPECT_LE(floor->box.center.z(), 0.03);
    EXPECT_GT(floor->box.center.z(), -0.1);
    EXPECT_GT(2.0 * std::min(floor->box.half_size.x(), floor->box.half_size.y()), 0.9);
    EXPECT_TRUE(std::any_of(scene->report.notes.begin(), scene->report.notes.end(),
                            [](const std::string& note) {
                                return note.find("\"floor_unseen\"") != std::string::npos;
                            }));
}

TEST(CloudRoom, WhatIsAskedForReachesTheReader) {
    const RoomScan scan([](const Eigen::Vector3d& p) { return p; });
    const test::TempFolder folder;
    const auto path = folder.write("scan.xyz", scan.text());
    const auto fine = importScene(path);
    ImportOptions options;
    options.cloud.voxel_m = 0.08;
    const auto coarse = importScene(path, options);
    ASSERT_TRUE(fine && coarse);
    EXPECT_LT(4 * coarse->triangles.size(), fine->triangles.size());
    EXPECT_GT(coarse->triangles.size(), 1000U);
}

TEST(CloudRoom, TooFewPointsAreRefused) {
    const test::TempFolder folder;
    const auto scene = importScene(folder.write("few.xyz", "0 0 0\n1 0 0\n0 1 0\n"));
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().code, ErrorCode::BadInput);
    EXPECT_NE(scene.error().message.find("no surface"), std::string::npos);
}

// A square of 6 x 6 cells without the middle 2 x 2: the hole is filled, but not the outline.
TEST(HoleFiller, FillsHolesAndLeavesTheOutline) {
    std::vector<Eigen::Vector3d> points;
    for (int y = 0; y <= 6; ++y) {
        for (int x = 0; x <= 6; ++x) points.emplace_back(0.1 * x, 0.1 * y, 0.0);
    }
    std::vector<Triangle> triangles;
    for (std::uint32_t y = 0; y < 6; ++y) {
        for (std::uint32_t x = 0; x < 6; ++x) {
            if (x / 2 == 1 && y / 2 == 1) continue;
            const std::uint32_t a = 7 * y + x;
            triangles.push_back({a, a + 1, a + 8});
            triangles.push_back({a, a + 8, a + 7});
        }
    }
    std::size_t holes = 0;
    const auto areaOf = [&](const std::vector<Triangle>& some) {
        double area = 0.0;
        for (const Triangle& t : some) {
            area += 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).z();
        }
        return area;
    };
    const auto filling = fillHoles(points, triangles, 0.3, holes);
    EXPECT_EQ(holes, 1U);
    EXPECT_NEAR(areaOf(filling), 0.04,
                1e-12);  // with the winding of the rest: the area is positive
    holes = 0;
    EXPECT_TRUE(fillHoles(points, triangles, 0.2, holes).empty());  // 0.28 m across
    EXPECT_EQ(holes, 0U);
}

}  // namespace
}  // namespace dollytrack::cloud_room_test
