#pragma once

#include "engine/core/random.h"
#include "engine/document/edits.h"
#include "tests/support/scene_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <vector>

namespace dollytrack::planning::test_support {

/// Rooms of 3 x 3 x 2.5 m in a row along x, with a doorway from each to the next, a door leaf that
/// stands beside the first one, and furniture at random positions.
inline Scene anyFlat(Random& random, int rooms, bool with_ceiling = true) {
    test::SceneBuilder builder;
    builder.room({0, 0, 0}, {3.1 * rooms, 3, 2.5}, with_ceiling);
    const auto between = [&](double low, double high) { return random.uniform(low, high); };
    for (int i = 1; i < rooms; ++i) {
        builder.object(fmt::format("wall_{}", i), {kNyuWall, Role::Structure, {0.8F, 0.8F, 0.8F}})
            .box({3.1 * i, 0.55, 1.25}, {0.1, 1.1, 2.5})
            .box({3.1 * i, 2.45, 1.25}, {0.1, 1.1, 2.5})
            .box({3.1 * i, 1.5, 2.25}, {0.1, 0.8, 0.5});
    }
    builder.object("leaf", {kNyuDoor, Role::Structure, {0.5F, 0.4F, 0.3F}})
        .box({2.9, 2.4, 1.0}, {0.04, 0.8, 2.0});
    for (int i = 0; i < rooms; ++i) {
        const std::string in = fmt::format("_{}", i);
        const double x = 3.1 * i;
        const double table_x = x + between(0.9, 2.2);
        const double table_y = between(0.6, 2.4);
        builder.object("table" + in, {7, Role::Target, {0.5F, 0.4F, 0.2F}})
            .box({table_x, table_y, 0.71}, {0.9, 0.6, 0.04})
            .box({table_x, table_y, 0.345}, {0.1, 0.1, 0.69});
        builder.object("mug" + in).box({table_x + 0.2, table_y, 0.78}, {0.08, 0.08, 0.1});
        builder.object("book" + in).box({table_x - 0.2, table_y + 0.1, 0.75}, {0.2, 0.15, 0.04});
        builder.object("crate" + in)
            .box({x + between(0.4, 2.6), between(0.4, 2.6), 0.25}, {0.5, 0.4, 0.5},
                 between(0.0, 1.5));
        builder.object("lamp" + in)
            .box({x + between(0.6, 2.4), between(0.6, 2.4), 2.3}, {0.25, 0.25, 0.2});
        builder.object("picture" + in).box({x + between(0.7, 2.3), 2.98, 1.5}, {0.5, 0.03, 0.4});
    }
    return builder.build();
}

inline ObjectChange moveOf(const Scene& scene, const std::string& name, const ObjectMove& move) {
    ObjectChange change;
    const auto found = std::ranges::find(scene.objects, name, &Object::name);
    change.object = {found->id, name};
    change.move = move;
    return change;
}

inline void setMove(SceneEdits& edits, const ObjectChange& change) {
    std::erase_if(edits.changes, [&](const auto& one) { return one.object == change.object; });
    edits.changes.push_back(change);
    std::ranges::sort(edits.changes, {}, [](const auto& one) { return one.object.id; });
}

/// A random move of a random object to somewhere near; the door leaf moves into its doorway or out
/// of it.
inline ObjectChange anyMove(const Scene& scene, Random& random) {
    std::vector<std::string> names;
    for (const Object& object : scene.objects) {
        if (!object.structure || object.name == "leaf") names.push_back(object.name);
    }
    const std::string& name = names[random.below(static_cast<std::uint32_t>(names.size()))];
    if (name == "leaf") {
        return moveOf(scene, name,
                      random.below(2) == 0 ? ObjectMove{{0.2, -0.9, 0.0}, 0.0} : ObjectMove{});
    }
    // Sometimes into or onto another object.
    if (random.below(4) == 0) {
        const auto place = [&](const std::string& of) {
            return std::ranges::find(scene.objects, of, &Object::name)->box.center;
        };
        const std::string& other = names[random.below(static_cast<std::uint32_t>(names.size()))];
        return moveOf(scene, name, {place(other) - place(name), 0.0});
    }
    // Sometimes by only 1 cm, or to the far side of the flat, into a wall or out of all rooms.
    const double reach = std::array{0.01, 0.3, 4.0, 15.0}[random.below(4)];
    const auto any = [&] { return reach * (2.0 * random.uniform() - 1.0); };
    const double turn = random.below(2) == 0 ? 0.0 : std::numbers::pi * random.uniform();
    return moveOf(scene, name,
                  {{any(), 0.5 * any(), random.below(4) == 0 ? 0.2 * any() : 0.0}, turn});
}

/// Random moves of several objects at a time.
inline std::vector<ObjectChange> anyMoves(const Scene& scene, Random& random) {
    std::vector<ObjectChange> changes;
    for (std::uint32_t left = 1 + random.below(3); left > 0; --left) {
        changes.push_back(anyMove(scene, random));
    }
    return changes;
}

}  // namespace dollytrack::planning::test_support
