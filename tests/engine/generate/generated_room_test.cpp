#include "engine/generate/room_generator.h"
#include "engine/geometry/ray_caster.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/labels.h"
#include "tests/engine/generate/mesh_collision.h"
#include "tests/support/temp_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <set>

namespace dollytrack::generate::generated_room_test {
namespace {

using Eigen::Vector3d;
using nlohmann::ordered_json;

Vector3d pointOf(const ordered_json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

/// A generated room that was written and read again.
struct ReadRoom {
    std::string name;
    ordered_json truth;
    Scene scene;
    [[nodiscard]] const Object* named(const std::string& wanted) const {
        for (const Object& object : scene.objects) {
            if (object.name == wanted) return &object;
        }
        return nullptr;
    }
    [[nodiscard]] double length() const { return truth["size_m"][0].get<double>(); }
    [[nodiscard]] double width() const { return truth["size_m"][1].get<double>(); }
    [[nodiscard]] double height() const { return truth["size_m"][2].get<double>(); }
};

bool isOpening(const Object& object) {
    return object.nyu40 == kNyuDoor || object.nyu40 == kNyuWindow;
}

/// Rooms with furniture of Debian's package; DOLLYTRACK_GENERATED_ROOMS sets their number.
class GeneratedRooms : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        auto opened = FurnitureCatalog::open({});
        if (!opened) {
            missing = describe(opened.error());
            return;
        }
        catalog = std::make_unique<FurnitureCatalog>(std::move(*opened));
        RoomGenerator generator(*catalog);
        const char* wanted = std::getenv("DOLLYTRACK_GENERATED_ROOMS");
        const int count = wanted ? std::atoi(wanted) : 9;
        const test::TempFolder folder;
        for (int i = 0; i < count; ++i) {
            const auto number = static_cast<std::uint64_t>(i);
            const RoomPreset& preset = roomPresets()[static_cast<std::size_t>(i) % 9];
            auto made = generator.make(varied(preset.spec, 11, number), 11, number, {});
            ASSERT_TRUE(made) << describe(made.error());
            ImportOptions options;
            options.read_textures = false;
            auto scene = importScene(
                folder.write("room.sh3d", std::string(made->home.begin(), made->home.end())),
                options);
            ASSERT_TRUE(scene) << describe(scene.error());
            rooms.push_back(
                {fmt::format("room {} ({})", i, preset.name), made->truth, std::move(*scene)});
        }
    }
    static void TearDownTestSuite() {
        rooms.clear();
        catalog.reset();
    }
    void SetUp() override {
        if (!missing.empty()) GTEST_SKIP() << missing;
        ASSERT_FALSE(rooms.empty());
    }
    static inline std::string missing;
    static inline std::unique_ptr<FurnitureCatalog> catalog;
    static inline std::vector<ReadRoom> rooms;
};

/// Bounds of an object's vertices in the axes of its true box, relative to its centre.
Eigen::AlignedBox3d boundsInTruth(const ReadRoom& room, const Object& object,
                                  const ordered_json& truth) {
    const double yaw = truth["yaw_deg"].get<double>() * std::numbers::pi / 180.0;
    const Eigen::AngleAxisd turn(-yaw, Vector3d::UnitZ());
    const Vector3d centre = pointOf(truth["center_m"]);
    Eigen::AlignedBox3d bounds;
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        bounds.extend(turn *
                      (room.scene.positions[object.first_vertex + i].cast<double>() - centre));
    }
    return bounds;
}

/// Free cells of 10 cm at a camera's height with a clearance of 20 cm, connected with the entrance.
class Ways {
  public:
    Ways(const ReadRoom& room, const RayCaster& rays, double height) : height_(height) {
        columns_ = static_cast<int>(room.length() / kCell);
        rows_ = static_cast<int>(room.width() / kCell);
        for (int i = 0; i < columns_ * rows_; ++i) {
            open_.push_back(rays.isClear(pointAt(i), 0.2));
        }
    }
    [[nodiscard]] Vector3d pointAt(int cell) const {
        return {(cell % columns_ + 0.5) * kCell, -(cell / columns_ + 0.5) * kCell, height_};
    }
    /// The cells connected with the cell nearest to a point.
    [[nodiscard]] std::vector<int> from(const Vector3d& start) const {
        int best = -1;
        for (int i = 0; i < columns_ * rows_; ++i) {
            const auto gap = [&](int cell) { return (pointAt(cell) - start).head<2>().norm(); };
            if (open_[i] && (best < 0 || gap(i) < gap(best))) best = i;
        }
        if (best < 0) return {};
        std::set<int> reached = {best};
        std::vector<int> stack = {best};
        while (!stack.empty()) {
            const int cell = stack.back();
            stack.pop_back();
            const int column = cell % columns_;
            for (const int next :
                 {column > 0 ? cell - 1 : -1, column + 1 < columns_ ? cell + 1 : -1,
                  cell - columns_, cell + columns_}) {
                if (next < 0 || next >= columns_ * rows_) continue;
                if (!open_[next]) continue;
                if (reached.insert(next).second) stack.push_back(next);
            }
        }
        return {reached.begin(), reached.end()};
    }
    [[nodiscard]] double cells() const { return columns_ * rows_; }

  private:
    static constexpr double kCell = 0.1;
    double height_;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<bool> open_;
};

/// Whether the supporting object is also above the object.
bool isCovered(const RayCaster& rays, const Object& carrier, const Object& thing) {
    Vector3d from = thing.box.center;
    for (int i = 0; i < 40; ++i) {
        const RayHit hit = rays.cast(from, Vector3d::UnitZ(), 5.0);
        if (hit.object_id == 0) return false;
        if (hit.object_id == carrier.id) return true;
        from += (hit.distance + 1e-5) * Vector3d::UnitZ();
    }
    return false;
}

/// The first hit of a ray after it has left the object; object 0 if there is none.
RayHit nextAfter(const RayCaster& rays, const Object& thing, Vector3d from, const Vector3d& way) {
    RayHit hit = rays.cast(from, way, 1.0);
    for (int i = 0; i < 40 && hit.object_id == thing.id; ++i) {
        from += (hit.distance + 1e-5) * way;
        hit = rays.cast(from, way, 1.0);
    }
    return hit;
}

}  // namespace

TEST_F(GeneratedRooms, HoldWhatTheTruthSays) {
    for (const ReadRoom& room : rooms) {
        SCOPED_TRACE(room.name);
        std::size_t shell = 0;
        for (const Object& object : room.scene.objects) {
            shell += object.structure && !isOpening(object) ? 1 : 0;
        }
        EXPECT_EQ(shell, 6U) << "four walls, floor and ceiling";
        EXPECT_EQ(room.scene.objects.size() - shell, room.truth["objects"].size());
        int targets = 0;
        for (const ordered_json& truth : room.truth["objects"]) {
            const std::string name = truth["name"];
            const Object* object = room.named(name);
            ASSERT_NE(object, nullptr) << name;
            EXPECT_EQ(truth["class"].get<std::string>(), nyu40Name(object->nyu40)) << name;
            EXPECT_NE(object->nyu40, 0) << name;
            EXPECT_EQ(truth["structure"].get<bool>(), object->structure) << name;
            const Eigen::AlignedBox3d bounds = boundsInTruth(room, *object, truth);
            EXPECT_LT(bounds.center().norm(), 2e-4) << name;
            EXPECT_LT((bounds.sizes() - pointOf(truth["size_m"])).norm(), 2e-4) << name;
            EXPECT_LT((object->front - pointOf(truth["front"])).norm(), 1e-4) << name;
            targets += object->structure ? 0 : 1;
        }
        EXPECT_EQ(targets, room.truth["objects_placed"].get<int>());
        // Small presets are hard to fill; at least 90 % of the requested objects must be there.
        EXPECT_GE(targets, 0.9 * room.truth["objects_asked"].get<int>());
    }
}

TEST_F(GeneratedRooms, HaveNoMeshesInOneAnother) {
    for (const ReadRoom& room : rooms) {
        const auto collisions =
            test::collisionsIn(room.scene, [](const Object& a, const Object& b) {
                // Objects on the floor touch it; frames are inside walls.
                const bool floor = a.nyu40 == kNyuFloor || b.nyu40 == kNyuFloor;
                return floor || (a.structure && b.structure);
            });
        EXPECT_TRUE(collisions.empty()) << room.name << ": " << fmt::format("{}", collisions);
        for (const Object& object : room.scene.objects) {
            if (object.structure) continue;
            const double low = object.box.center.z() - object.box.half_size.z();
            EXPECT_GE(low, -1e-5) << room.name << ": " << object.name;
        }
    }
}

TEST_F(GeneratedRooms, StandOnWhatTheTruthSays) {
    for (const ReadRoom& room : rooms) {
        SCOPED_TRACE(room.name);
        const RayCaster rays(room.scene);
        for (const ordered_json& truth : room.truth["objects"]) {
            if (truth["structure"].get<bool>()) continue;
            const std::string name = truth["name"];
            const std::string supporter = truth["supporter"];
            const Vector3d centre = pointOf(truth["center_m"]);
            const Vector3d size = pointOf(truth["size_m"]);
            const double low = centre.z() - 0.5 * size.z();
            if (supporter == "floor") {
                EXPECT_NEAR(low, 0.0, 1e-6) << name;
            } else if (supporter == "ceiling") {
                EXPECT_NEAR(centre.z() + 0.5 * size.z(), room.height(), 5e-3) << name;
            } else if (supporter == "wall") {
                const Vector3d back = centre - 0.5 * size.y() * pointOf(truth["front"]);
                const double gap = std::min(
                    {back.x(), room.length() - back.x(), -back.y(), room.width() + back.y()});
                EXPECT_NEAR(gap, 0.0, 5e-3) << name;
            } else {
                const Object* carrier = room.named(supporter);
                ASSERT_NE(carrier, nullptr) << supporter;
                const Vector3d bottom(centre.x(), centre.y(), low);
                const ClosestPoint below = rays.closestOn(carrier->id, bottom, 0.05);
                EXPECT_EQ(below.object_id, carrier->id) << name << " floats over " << supporter;
                EXPECT_LT(below.distance, 7e-3) << name << " floats over " << supporter;
            }
        }
    }
}

// Objects are visible from above or from the front, not behind the doors of a cupboard.
TEST_F(GeneratedRooms, HideNothingInFurniture) {
    for (const ReadRoom& room : rooms) {
        SCOPED_TRACE(room.name);
        const RayCaster rays(room.scene);
        for (const ordered_json& truth : room.truth["objects"]) {
            const Object* carrier = room.named(truth["supporter"]);
            if (!carrier) continue;
            const Object* thing = room.named(truth["name"]);
            const Vector3d centre = pointOf(truth["center_m"]);
            const Vector3d front = carrier->front;
            bool free = false;
            for (const Vector3d& way : {Vector3d(0, 0, 1), front}) {
                Vector3d from = centre;
                for (int i = 0; i < 40 && !free; ++i) {
                    // The ray may pass through the object and its neighbours, but not through the
                    // supporting object.
                    const RayHit hit = rays.cast(from, way, 3.0);
                    if (hit.object_id == carrier->id) break;
                    const bool out =
                        hit.object_id == 0 || room.scene.object(hit.object_id).structure;
                    free = out;
                    from += (hit.distance + 1e-5) * way;
                }
            }
            EXPECT_TRUE(free) << thing->name << " is shut in " << carrier->name;
        }
    }
}

// Objects under the open top are visible from above; in shelves the space in front of each object
// is free.
TEST_F(GeneratedRooms, PutNothingBehindAnotherInAShelf) {
    int in_shelves = 0;
    for (const ReadRoom& room : rooms) {
        const RayCaster rays(room.scene);
        std::map<std::string, std::string> supporters;
        for (const ordered_json& truth : room.truth["objects"]) {
            supporters[truth["name"]] = truth["supporter"];
        }
        for (const ordered_json& truth : room.truth["objects"]) {
            const Object* carrier = room.named(truth["supporter"]);
            const Object* thing = room.named(truth["name"]);
            if (!carrier || !isCovered(rays, *carrier, *thing)) continue;
            ++in_shelves;
            const OrientedBox& box = thing->box;
            for (const double across : {-0.9, 0.0, 0.9}) {
                for (const double up : {-0.9, 0.0, 0.9}) {
                    const Vector3d side = carrier->front.cross(Vector3d::UnitZ());
                    const double half = 0.5 * pointOf(truth["size_m"]).x();
                    const Vector3d from = box.center + across * half * side +
                                          up * box.half_size.z() * Vector3d::UnitZ();
                    const RayHit hit = nextAfter(rays, *thing, from, carrier->front);
                    if (hit.object_id == 0) continue;
                    const std::string before = room.scene.object(hit.object_id).name;
                    EXPECT_NE(supporters[before], carrier->name)
                        << room.name << ": " << before << " hides " << thing->name;
                }
            }
        }
    }
    EXPECT_GT(in_shelves, 20);
}

// Decorations occur once, small objects up to three times; chairs and cupboards may occur in rows.
TEST_F(GeneratedRooms, RepeatLittle) {
    const std::set<std::string> once = {"floor_lamp", "floor_plant", "wall_thing", "floor_thing",
                                        "work_floor_thing"};
    for (const ReadRoom& room : rooms) {
        std::map<std::string, int> count;
        for (const ordered_json& truth : room.truth["objects"]) {
            const std::string role = truth["role"];
            const bool thing = role.ends_with("_thing") || role == "table_lamp";
            if (!thing && !once.contains(role)) continue;
            const std::string model = truth["model"];
            EXPECT_LE(++count[model], once.contains(role) ? 1 : 3) << room.name << ": " << model;
        }
    }
}

TEST_F(GeneratedRooms, CanBePassedFromTheDoor) {
    for (const ReadRoom& room : rooms) {
        SCOPED_TRACE(room.name);
        const RayCaster rays(room.scene);
        const auto door = std::find_if(room.truth["objects"].begin(), room.truth["objects"].end(),
                                       [](const auto& truth) { return truth["role"] == "door"; });
        ASSERT_NE(door, room.truth["objects"].end());
        const Vector3d front = pointOf((*door)["front"]);
        const Vector3d inside = pointOf((*door)["center_m"]) + 0.55 * front;
        for (const double height : {0.4, 1.2, 1.8}) {
            EXPECT_TRUE(rays.isClear({inside.x(), inside.y(), height}, 0.25)) << height;
        }
        const Ways ways(room, rays, 1.2);
        const std::vector<int> reached = ways.from(inside);
        EXPECT_GE(static_cast<double>(reached.size()), 0.07 * ways.cells());
        for (const Object& object : room.scene.objects) {
            const double low = object.box.center.z() - object.box.half_size.z();
            if (object.structure || object.box.volume() < 0.2 || low > 1.8) continue;
            const double nearest = [&] {
                double least = 1e9;
                for (const int cell : reached) {
                    least = std::min(least, object.box.distance(ways.pointAt(cell)));
                }
                return least;
            }();
            EXPECT_LT(nearest, 1.0) << object.name;
        }
    }
}

TEST_F(GeneratedRooms, DoNotDependOnThoseBefore) {
    RoomGenerator first(*catalog);
    RoomGenerator second(*catalog);
    const RoomSpec spec{RoomKind::Studio, 3.2, 2.9, 2.7, 12};
    const auto a = first.make(spec, 5, 1, {});
    ASSERT_TRUE(second.make({RoomKind::Kitchen, 3.5, 3.2, 2.9, 10}, 5, 0, {}));
    const auto b = second.make(spec, 5, 1, {});
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->home, b->home);
    EXPECT_EQ(a->truth, b->truth);
    EXPECT_EQ(a->licenses, b->licenses);
    const auto other = second.make(spec, 6, 1, {});
    ASSERT_TRUE(other);
    EXPECT_NE(a->truth, other->truth);
}

TEST_F(GeneratedRooms, StopWhenAsked) {
    RoomGenerator generator(*catalog);
    const JobContext stopped(std::make_shared<const std::atomic<bool>>(true), {});
    const auto room = generator.make({}, 1, 1, stopped);
    ASSERT_FALSE(room);
    EXPECT_EQ(room.error().code, ErrorCode::Cancelled);
}

TEST_F(GeneratedRooms, EveryRoleHasModels) {
    FurniturePool pool(*catalog);
    for (int role = 0; role < kRoleCount; ++role) {
        const auto which = static_cast<FurnitureRole>(role);
        const auto& pieces = pool.piecesOf(which);
        EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const auto* piece) {
            return pool.isUsable(*piece, {});
        })) << roleName(which);
    }
    for (const RoleRule& rule : builtInRoles()) {
        for (const std::string& name : rule.names) {
            EXPECT_TRUE(std::any_of(catalog->pieces().begin(), catalog->pieces().end(),
                                    [&](const CatalogPiece& piece) {
                                        return piece.name == name && rule.admits(piece);
                                    }))
                << roleName(rule.role) << ": " << name;
        }
    }
}

}  // namespace dollytrack::generate::generated_room_test
