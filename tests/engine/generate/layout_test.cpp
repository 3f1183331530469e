#include "engine/generate/room_layout.h"
#include "engine/generate/support_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::generate::layout_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double between(double low, double high) {
    return low + (high - low) * *rc::gen::inRange(0, 10'001) / 10'000.0;
}

UprightBox anyBox() {
    UprightBox box;
    box.centre = {between(-3, 3), between(-3, 3)};
    box.half = {between(0.2, 2), between(0.2, 2)};
    box.angle = between(0, 7);
    box.low = between(-2, 1);
    box.high = box.low + between(0.2, 2);
    return box;
}

bool contains(const UprightBox& box, const Vector3d& p) {
    const Vector2d local = Eigen::Rotation2Dd(-box.angle) * (p.head<2>() - box.centre);
    return std::abs(local.x()) <= box.half.x() && std::abs(local.y()) <= box.half.y() &&
           p.z() >= box.low && p.z() <= box.high;
}

CatalogPiece pieceOf(double width, double depth, double height) {
    CatalogPiece piece;
    piece.id = "test#piece";
    piece.name = "Piece";
    piece.width = width;
    piece.depth = depth;
    piece.height = height;
    return piece;
}

PlacedPiece placedAt(const CatalogPiece& piece, const Vector2d& at) {
    PlacedPiece placed;
    placed.piece = &piece;
    placed.at = at;
    return placed;
}

/// Adds a box to a model of size 1 in the importer's axes: y up, front +z.
void addBox(homes::FurnitureModel& model, const Vector3d& low, const Vector3d& high) {
    MeshPart part;
    for (int i = 0; i < 8; ++i) {
        part.positions.emplace_back(static_cast<float>(i & 1 ? high.x() : low.x()),
                                    static_cast<float>(i & 2 ? high.y() : low.y()),
                                    static_cast<float>(i & 4 ? high.z() : low.z()));
    }
    for (const std::array<std::uint32_t, 4>& q : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                                  {4, 6, 7, 5},
                                                  {0, 4, 5, 1},
                                                  {2, 3, 7, 6},
                                                  {0, 2, 6, 4},
                                                  {1, 5, 7, 3}}) {
        part.triangles.push_back({q[0], q[1], q[2]});
        part.triangles.push_back({q[0], q[2], q[3]});
    }
    model.bounds.extend(low).extend(high);
    model.raw.parts.push_back(std::move(part));
}

/// A cupboard of 100 x 40 x 100 with back, sides, top, bottom and, if closed, a door.
homes::FurnitureModel cupboard(bool closed) {
    homes::FurnitureModel model;
    addBox(model, {0, 0, 0}, {100, 2, 40});
    addBox(model, {0, 98, 0}, {100, 100, 40});
    addBox(model, {0, 0, 0}, {2, 100, 40});
    addBox(model, {98, 0, 0}, {100, 100, 40});
    addBox(model, {0, 0, 0}, {100, 100, 2});
    if (closed) addBox(model, {0, 0, 38}, {100, 100, 40});
    return model;
}

std::set<int> restingHeights(bool closed) {
    const homes::FurnitureModel model = cupboard(closed);
    const CatalogPiece shelf = pieceOf(100, 40, 100);
    const CatalogPiece cup = pieceOf(10, 10, 12);
    PlacedPiece supporter = placedAt(shelf, {200, 100});
    supporter.angle = 0.5 * std::numbers::pi;
    const SupportSurface surface(model, supporter);
    std::set<int> heights;
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        PlacedPiece thing = placedAt(cup, {200, 100 + random.uniform(-30.0, 30.0)});
        thing.angle = random.uniform(0.0, 6.0);
        const auto rest = surface.placementFor(thing, random);
        heights.insert(rest ? static_cast<int>(std::lround(rest->height)) : -1);
    }
    return heights;
}

}  // namespace

// A triangle with a point in the box intersects it; one separated by a plane does not.
RC_GTEST_PROP(UprightBoxes, TellWhatReachesIntoThem, ()) {
    const UprightBox box = anyBox();
    TriangleInRoom t;
    for (Vector3d& corner : t) corner = {between(-4, 4), between(-4, 4), between(-4, 4)};
    bool inside = false;
    for (int i = 0; i <= 40; ++i) {
        for (int k = 0; k + i <= 40; ++k) {
            inside |= contains(box, t[0] + (t[1] - t[0]) * i / 40.0 + (t[2] - t[0]) * k / 40.0);
        }
    }
    if (inside) RC_ASSERT(reachesInto(t, box));
    UprightBox wider =
        box;  // if no sample is in a wider box, the triangle cannot intersect the narrow one
    wider.half += Vector2d::Constant(0.4);
    wider.low -= 0.4;
    wider.high += 0.4;
    bool near_by = false;
    for (int i = 0; i <= 40; ++i) {
        for (int k = 0; k + i <= 40; ++k) {
            near_by |= contains(wider, t[0] + (t[1] - t[0]) * i / 40.0 + (t[2] - t[0]) * k / 40.0);
        }
    }
    if (!near_by) RC_ASSERT(!reachesInto(t, box));
}

RC_GTEST_PROP(UprightBoxes, AreNearWhenTheyShareAPoint, ()) {
    const UprightBox a = anyBox();
    const UprightBox b = anyBox();
    bool shared = false;
    for (int i = 0; i < 8000 && !shared; ++i) {
        const Vector2d local((i % 20) / 9.5 - 1.0, (i / 20 % 20) / 9.5 - 1.0);
        const Vector2d at =
            a.centre + Eigen::Rotation2Dd(a.angle) * Vector2d(local.cwiseProduct(a.half));
        shared = contains(b, {at.x(), at.y(), a.low + (a.high - a.low) * (i / 400) / 19.0});
    }
    if (shared) RC_ASSERT(near(a, b, 0.0));
    RC_ASSERT(near(a, b, 0.0) == near(b, a, 0.0));
}

TEST(RoomLayout, RefusesWhatOverlaps) {
    RoomLayout layout(400, 300, 250);
    const CatalogPiece piece = pieceOf(100, 60, 80);
    EXPECT_TRUE(layout.add(placedAt(piece, {60, 40})));
    EXPECT_FALSE(layout.add(placedAt(piece, {159, 40})));
    EXPECT_FALSE(layout.add(placedAt(piece, {160.4, 40})));
    EXPECT_TRUE(layout.add(placedAt(piece, {160.6, 40})));
    EXPECT_FALSE(layout.add(placedAt(piece, {360, 40}))) << "in the wall";
    PlacedPiece above = placedAt(piece, {60, 40});
    above.elevation = 100;
    EXPECT_TRUE(layout.add(above));
    above.elevation = 175;
    EXPECT_FALSE(layout.add(above)) << "in the ceiling, and in what is below";
    EXPECT_EQ(layout.furnished(), 3);
}

TEST(RoomLayout, KeepsTheFloorInOnePiece) {
    const CatalogPiece wall = pieceOf(240, 20, 100);
    RoomLayout layout(300, 400, 250);
    EXPECT_TRUE(layout.add(placedAt(wall, {120.5, 200}))) << "59 cm are left beside it";
    EXPECT_FALSE(RoomLayout(300, 400, 250).add(placedAt(pieceOf(280, 20, 100), {150, 200})));
    // A narrower passage counts as blocked, unless it only leads to a niche.
    const CatalogPiece broad = pieceOf(262, 20, 100);
    EXPECT_FALSE(RoomLayout(300, 400, 250).add(placedAt(broad, {131.5, 200})));
    EXPECT_TRUE(RoomLayout(300, 400, 250).add(placedAt(broad, {131.5, 11})));
}

TEST(RoomLayout, KeepsTheEntranceReachable) {
    RoomLayout layout(300, 400, 250);
    layout.reach({150, 45});
    const CatalogPiece block = pieceOf(100, 100, 100);
    EXPECT_FALSE(layout.add(placedAt(block, {150, 90})));
    EXPECT_TRUE(layout.add(placedAt(block, {150, 250})));
}

TEST(SupportSurface, PutsThingsOntoAndIntoAnOpenCupboard) {
    EXPECT_EQ(restingHeights(false), (std::set<int>{2, 100}));
}

TEST(SupportSurface, PutsNothingIntoAClosedCupboard) {
    EXPECT_EQ(restingHeights(true), std::set<int>{100});
}

TEST(SupportSurface, LetsNothingHangOverAnEdge) {
    const homes::FurnitureModel model = cupboard(true);
    const CatalogPiece shelf = pieceOf(100, 40, 100);
    const CatalogPiece tray = pieceOf(30, 30, 5);
    const SupportSurface surface(model, placedAt(shelf, {200, 100}));
    Random random(1);
    EXPECT_TRUE(surface.placementFor(placedAt(tray, {200, 100}), random));
    EXPECT_FALSE(surface.placementFor(placedAt(tray, {245, 100}), random));
}

}  // namespace dollytrack::generate::layout_test
