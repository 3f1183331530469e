#include "ui/viewport/key_transform.h"

#include "ui/viewport/viewer_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::ui::key_transform_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A view without perspective, so that lines of sight are parallel.
GizmoView viewFrom(ViewerCamera::Axis axis) {
    ViewerCamera camera;
    camera.orthographic = true;
    camera.lookFrom(axis);
    GizmoView view;
    view.view = camera.view(800, 600);
    view.heading_rad = 0.5;
    return view;
}

KeyTransform moved(const std::string& characters) {
    KeyTransform keys;
    keys.part = GizmoPart::MoveFree;
    keys.begin = Pose();
    for (const char character : characters) typeCharacter(keys, character, true);
    return keys;
}

TEST(KeyTransform, TypedNumbersAreEdited) {
    EXPECT_FALSE(typedNumber(moved("")).has_value());
    EXPECT_EQ(*typedNumber(moved("0.5")), 0.5);
    EXPECT_EQ(*typedNumber(moved("-.5")), -0.5);
    EXPECT_EQ(*typedNumber(moved("2-")), -2.0);
    EXPECT_EQ(*typedNumber(moved("2--")), 2.0);
    EXPECT_EQ(*typedNumber(moved("-")), 0.0);
    EXPECT_EQ(*typedNumber(moved("1,5")), 1.5) << "a comma is a decimal point";
    EXPECT_EQ(*typedNumber(moved("1.5.2q")), 1.52) << "a second point is ignored";
    EXPECT_EQ(*typedNumber(moved("12345")), 123.0) << "at most 1000";
    KeyTransform keys = moved("12");
    eraseCharacter(keys);
    EXPECT_EQ(*typedNumber(keys), 1.0);
    eraseCharacter(keys);
    eraseCharacter(keys);
    EXPECT_FALSE(typedNumber(keys).has_value());
}

TEST(KeyTransform, AnAxisKeyGoesFromTheWorldToTheElementToFree) {
    const GizmoView view = viewFrom(ViewerCamera::Axis::Top);
    const auto offset = [&](const std::string& characters) {
        return changeOf(moved(characters), view, {0, 0}).offset_m;
    };
    EXPECT_EQ(offset("2"), Eigen::Vector3d(2, 0, 0)) << "without an axis along x";
    EXPECT_EQ(offset("y2"), Eigen::Vector3d(0, 2, 0));
    EXPECT_EQ(offset("2yz"), Eigen::Vector3d(0, 0, 2));
    EXPECT_TRUE(offset("xx2").isApprox(Eigen::Vector3d(2 * std::cos(0.5), 2 * std::sin(0.5), 0)));
    EXPECT_TRUE(offset("yy2").isApprox(Eigen::Vector3d(-2 * std::sin(0.5), 2 * std::cos(0.5), 0)));
    EXPECT_EQ(offset("zz2"), Eigen::Vector3d(0, 0, 2));
    EXPECT_EQ(moved("xxx").part, GizmoPart::MoveFree);
    EXPECT_EQ(moved("xxy").own_axes, false);
}

TEST(KeyTransform, AnAxisKeyWithShiftLocksTheAxis) {
    const GizmoView view = viewFrom(ViewerCamera::Axis::Top);
    const auto offset = [&](char axis, const std::string& characters) {
        KeyTransform keys = moved("");
        typeCharacter(keys, axis, true, true);
        for (const char character : characters) typeCharacter(keys, character, true);
        return changeOf(keys, view, {0, 0}).offset_m;
    };
    EXPECT_EQ(offset('Z', "2\t3"), Eigen::Vector3d(2, 3, 0));
    EXPECT_EQ(offset('Y', "2\t-3"), Eigen::Vector3d(2, 0, -3));
    EXPECT_EQ(offset('X', "2\t3\t1"), Eigen::Vector3d(0, 21, 3)) << "back to the first number";
    EXPECT_EQ(offset('z', "\t4"), Eigen::Vector3d(0, 4, 0)) << "with caps lock";
    EXPECT_EQ(offset('Z', "2\t3x"), Eigen::Vector3d(2, 0, 0)) << "an axis has one number";
    EXPECT_EQ(changeOf(moved("1\t2\t3"), view, {0, 0}).offset_m, Eigen::Vector3d(1, 2, 3));
    KeyTransform keys = moved("");
    for (const bool own : {false, true}) {
        typeCharacter(keys, 'Z', true, true);
        EXPECT_EQ(keys.part, GizmoPart::MoveXY);
        EXPECT_EQ(keys.own_axes, own);
    }
    typeCharacter(keys, 'Z', true, true);
    EXPECT_EQ(keys.part, GizmoPart::MoveFree);
}

TEST(KeyTransform, TheMouseMovesTheElementInThePlane) {
    ViewerCamera camera;
    GizmoView view;
    view.view = camera.view(800, 600);
    const auto pixel = [&](const Eigen::Vector3d& point) {
        return view.view.project(view.view.pose.toCamera(point));
    };
    for (int axis = 0; axis < 3; ++axis) {
        KeyTransform keys = moved("");
        keys.cursor_at_begin = pixel({0, 0, 0});
        typeCharacter(keys, static_cast<char>('x' + axis), true, true);
        Eigen::Vector3d to(0.4, 0.3, 0.2);
        to[axis] = 0.0;
        EXPECT_NEAR((changeOf(keys, view, pixel(to)).offset_m - to).norm(), 0.0, 1e-9);
    }
    view.view = viewFrom(ViewerCamera::Axis::Front).view;
    KeyTransform keys = moved("");
    typeCharacter(keys, 'z', true, true);
    EXPECT_EQ(changeOf(keys, view, {10, 20}).offset_m, Eigen::Vector3d(0, 0, 0)) << "edge-on";
}

TEST(KeyTransform, TheMouseMovesTheElementWithIt) {
    const GizmoView view = viewFrom(ViewerCamera::Axis::Top);
    const auto pixel = [&](const Eigen::Vector3d& point) {
        return view.view.project(view.view.pose.toCamera(point));
    };
    KeyTransform keys = moved("");
    keys.cursor_at_begin = pixel({0, 0, 0});
    const Eigen::Vector3d to(0.4, 0.3, 0);
    EXPECT_TRUE(changeOf(keys, view, pixel(to)).offset_m.isApprox(to, 1e-9));
    typeCharacter(keys, 'x', true);
    EXPECT_TRUE(
        changeOf(keys, view, pixel(to)).offset_m.isApprox(Eigen::Vector3d(0.4, 0, 0), 1e-6));
}

TEST(KeyTransform, TheMouseTurnsTheSameWayFromAboveAndBelow) {
    for (const auto axis : {ViewerCamera::Axis::Top, ViewerCamera::Axis::Bottom}) {
        const GizmoView view = viewFrom(axis);
        const auto pixel = [&](const Eigen::Vector3d& point) {
            return view.view.project(view.view.pose.toCamera(point));
        };
        KeyTransform keys;
        keys.part = GizmoPart::Yaw;
        keys.begin = Pose();
        keys.cursor_at_begin = pixel({1, 0, 0});
        EXPECT_NEAR(changeOf(keys, view, pixel({0, 1, 0})).yaw_rad, 0.5 * kPi, 1e-3);
        typeCharacter(keys, 'y', true);
        EXPECT_EQ(keys.part, GizmoPart::Yaw) << "nothing rolls";
        typeCharacter(keys, 'x', false);
        EXPECT_EQ(keys.part, GizmoPart::Yaw) << "objects do not tilt";
    }
}

TEST(PoseChange, RotatesHeadingAndPitchAndStopsBeforeTheVertical) {
    Pose begin;
    begin.rotation = lookAlong({1, 0, 0});
    const auto after = [&](double yaw, double pitch) {
        PoseChange change;
        change.yaw_rad = yaw;
        change.pitch_rad = pitch;
        return change.of(begin).forward();
    };
    EXPECT_TRUE(after(0.5 * kPi, 0).isApprox(Eigen::Vector3d(0, 1, 0), 1e-9));
    EXPECT_NEAR(after(0, 0.25 * kPi).z(), std::sqrt(0.5), 1e-9);
    EXPECT_LT(after(0, 2.0).z(), 1.0);
    EXPECT_GT(after(0, 2.0).x(), 0.0) << "it does not tip over";
    EXPECT_EQ(PoseChange().of(begin), begin);
}

TEST(PoseChange, SaysTheTiltThatIsApplied) {
    constexpr double kDegree = kPi / 180.0;
    Pose begin;
    begin.rotation = lookAlong({std::cos(30 * kDegree), 0, std::sin(30 * kDegree)});
    const auto text = [&](double pitch_deg) {
        PoseChange change;
        change.pitch_rad = pitch_deg * kDegree;
        change = change.appliedTo(begin);
        const double after = std::asin(change.of(begin).forward().z()) / kDegree;
        EXPECT_NEAR(after, std::clamp(30.0 + pitch_deg, -88.0, 88.0), 1e-6);
        return changeText(GizmoPart::Pitch, {}, change);
    };
    EXPECT_EQ(text(20), "Tilt: 20\u00b0");
    EXPECT_EQ(text(90), "Tilt: 58\u00b0");
    EXPECT_EQ(text(-150), "Tilt: -118\u00b0");
}

TEST(PoseChange, SnapsToStepsOfTheHeldKeys) {
    PoseChange change;
    change.offset_m = {0.26, -0.34, 0.04};
    change.yaw_rad = 50.4 * kPi / 180.0;
    const auto snap = [&](GizmoPart part, bool ctrl, bool shift) {
        return snapped(part, {0.5, true}, change, snapSteps(ctrl, shift));
    };
    EXPECT_EQ(snap(GizmoPart::MoveFree, false, true).offset_m, change.offset_m);
    EXPECT_TRUE(snap(GizmoPart::MoveFree, true, false)
                    .offset_m.isApprox(Eigen::Vector3d(0.3, -0.3, 0.0), 1e-9));
    EXPECT_NEAR(snap(GizmoPart::Yaw, true, false).yaw_rad, 0.25 * kPi, 1e-9);
    EXPECT_NEAR(snap(GizmoPart::Yaw, true, true).yaw_rad, 50.0 * kPi / 180.0, 1e-9);
    // Along an axis of its own, the distance is in steps, not the coordinates.
    const Eigen::Vector3d way(std::cos(0.5), std::sin(0.5), 0.0);
    EXPECT_EQ(snapped(GizmoPart::MoveYZ, {}, change, snapSteps(true, false)).offset_m.x(), 0.0);
    change.offset_m = 0.74 * way;
    EXPECT_TRUE(snap(GizmoPart::MoveX, true, false).offset_m.isApprox(0.7 * way, 1e-9));
    EXPECT_EQ(changeText(GizmoPart::Yaw, {}, {}, snapSteps(true, false)),
              "Rotate about z: 0\u00b0 (steps of 15\u00b0)");
}

TEST(PoseChange, IsSaidInOneShortLine) {
    PoseChange change;
    change.offset_m = {0.5, 0.0, -1e-9};
    EXPECT_EQ(changeText(GizmoPart::MoveX, {}, change), "Move along x: 0.5 m");
    EXPECT_EQ(changeText(GizmoPart::MoveX, {0.0, true}, change), "Move along its own x: 0.5 m");
    EXPECT_EQ(changeText(GizmoPart::MoveFree, {}, change), "Move: x 0.5, y 0, z 0 m");
    EXPECT_EQ(changeText(GizmoPart::MoveXZ, {}, change), "Move in the xz plane: 0.5, 0 m");
    EXPECT_EQ(changeText(GizmoPart::MoveXY, {0.0, true}, change),
              "Move in its own xy plane: 0.5, 0 m");
    change.yaw_rad = -0.5 * kPi;
    EXPECT_EQ(changeText(GizmoPart::Yaw, {}, change), "Rotate about z: -90\u00b0");
}

}  // namespace
}  // namespace dollytrack::ui::key_transform_test
