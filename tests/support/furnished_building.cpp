#include "tests/support/furnished_building.h"

#include "engine/core/random.h"
#include "tests/support/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dollytrack::test {
namespace {

constexpr int kPerRoom = 25;
const Eigen::Vector3d kRoom(5.0, 4.0, 2.6);
constexpr double kDoorHigh = 2.05;
constexpr double kWall = 0.1;

/// Furnishes one room after another until all objects are placed.
class Furnisher {
  public:
    Furnisher(SceneBuilder& builder, int objects, unsigned seed)
        : builder_(builder), left_(objects), seed_(seed) {}

    void furnish(const Eigen::Vector3d& corner, int room) {
        corner_ = corner;
        room_ = room;
        random_ = Random(seed_, static_cast<std::uint64_t>(room));
        add("bed", 4, [&] { box({1.0, 2.95, 0.25}, {1.6, 2.0, 0.5}); });
        add("wardrobe", 39, [&] { box({4.6, 3.3, 1.0}, {0.55, 1.1, 2.0}); });
        add("shelf", 10, [&] { shelf(); });
        add("sofa", 6, [&] {
            box({3.6, 0.5, 0.22}, {1.8, 0.8, 0.44});
            box({3.6, 0.2, 0.62}, {1.8, 0.2, 0.36});
        });
        add("table", 7, [&] { table(); });
        for (const auto& [x, y] : {std::pair{2.6, 1.95}, {3.2, 1.95}, {2.6, 3.25}, {3.2, 3.25}}) {
            add("chair", 5, [&] {
                box({x, y, 0.42}, {0.4, 0.4, 0.04});
                box({x, y + (y < 2.6 ? -0.18 : 0.18), 0.68}, {0.4, 0.04, 0.5});
                for (const double dx : {-0.17, 0.17}) {
                    for (const double dy : {-0.17, 0.17}) {
                        box({x + dx, y + dy, 0.2}, {0.04, 0.04, 0.4});
                    }
                }
            });
        }
        for (const double x : {0.9, 3.6}) {
            add("picture", 11, [&] { box({x, 3.93, 1.6 + vary(0.1)}, {0.6, 0.02, 0.45}); });
        }
        add("lamp", 35, [&] {
            box({2.5, 2.0, 2.2}, {0.4, 0.4, 0.25});
            box({2.5, 2.0, 2.46}, {0.02, 0.02, 0.27});
        });
        for (int i = 0; i < 5; ++i) small("cup", {2.45 + 0.22 * i, 2.6 + vary(0.25), 0.75});
        for (int i = 0; i < 4; ++i) small("book", {0.6 + 0.26 * i, 0.17, 0.42 + 0.4 * (i % 3)});
        for (const double x : {0.6, 1.4}) {
            add("pillow", 18, [&] { box({x, 3.65, 0.56}, {0.5, 0.35, 0.12}); });
        }
        small("carton", {4.6, 3.3 + vary(0.3), 2.0});
        small("plant", {4.6 + vary(0.1), 2.4, 0.0});
    }

  private:
    double vary(double by) { return random_.uniform(-by, by); }

    void add(const std::string& name, int nyu40, const std::function<void()>& shapes) {
        if (left_ == 0) return;
        --left_;
        builder_.object(name + "_" + std::to_string(room_), {nyu40, Role::Target});
        shapes();
    }

    void box(const Eigen::Vector3d& center, const Eigen::Vector3d& size) {
        builder_.box(corner_ + center, size);
    }

    /// A small object, given by the centre of its base.
    void small(const std::string& name, const Eigen::Vector3d& foot) {
        add(name, 40, [&] {
            const Eigen::Vector3d size(random_.uniform(0.07, 0.14), random_.uniform(0.07, 0.14),
                                       random_.uniform(0.1, 0.22));
            box(foot + Eigen::Vector3d(0, 0, 0.5 * size.z()), size);
        });
    }

    void shelf() {
        for (const double z : {0.01, 0.41, 0.81, 1.21, 1.61}) {
            box({1.0, 0.17, z}, {1.2, 0.3, 0.02});
        }
        for (const double x : {0.39, 1.61}) box({x, 0.17, 0.81}, {0.02, 0.3, 1.62});
        box({1.0, 0.03, 0.81}, {1.2, 0.02, 1.62});
    }

    void table() {
        box({2.9, 2.6, 0.73}, {1.2, 0.8, 0.04});
        for (const double x : {2.35, 3.45}) {
            for (const double y : {2.25, 2.95}) box({x, y, 0.355}, {0.05, 0.05, 0.71});
        }
    }

    SceneBuilder& builder_;
    int left_;
    unsigned seed_;
    Eigen::Vector3d corner_ = Eigen::Vector3d::Zero();
    int room_ = 0;
    Random random_{0};
};

/// A wall from a corner along an edge, with a door between two distances along it.
void wallWithDoor(SceneBuilder& builder, const Eigen::Vector3d& corner,
                  const Eigen::Vector3d& along, double length, double door_from, double door_to) {
    builder.object("wall", {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}});
    const Eigen::Vector3d across(along.y(), along.x(), 0.0);
    const auto piece = [&](double from, double to, double low, double high) {
        const Eigen::Vector3d center =
            corner + 0.5 * (from + to) * along + Eigen::Vector3d(0, 0, 0.5 * (low + high));
        builder.box(center,
                    (to - from) * along + kWall * across + Eigen::Vector3d(0, 0, high - low));
    };
    piece(0.0, door_from, 0.0, kRoom.z());
    piece(door_to, length, 0.0, kRoom.z());
    piece(door_from, door_to, kDoorHigh, kRoom.z());
}

}  // namespace

Scene furnishedBuilding(int objects, unsigned seed) {
    const int rooms = std::max(1, (objects + kPerRoom - 1) / kPerRoom);
    const int columns = static_cast<int>(std::ceil(std::sqrt(rooms)));
    const int rows = (rooms + columns - 1) / columns;
    SceneBuilder builder;
    builder.room({0, 0, 0}, {columns * kRoom.x(), rows * kRoom.y(), kRoom.z()});
    Furnisher furnisher(builder, objects, seed);
    for (int room = 0; room < columns * rows; ++room) {
        const int column = room % columns;
        const int row = room / columns;
        const Eigen::Vector3d corner(column * kRoom.x(), row * kRoom.y(), 0.0);
        if (column > 0) {
            wallWithDoor(builder, corner, Eigen::Vector3d::UnitY(), kRoom.y(), 1.0, 1.9);
        }
        if (row > 0) {
            wallWithDoor(builder, corner, Eigen::Vector3d::UnitX(), kRoom.x(), 1.75, 2.6);
        }
        furnisher.furnish(corner, room);
    }
    return builder.build();
}

}  // namespace dollytrack::test
