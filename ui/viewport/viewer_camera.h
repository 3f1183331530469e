#pragma once

#include "engine/math/pose.h"
#include "render/view/view.h"

#include <Eigen/Geometry>

namespace dollytrack::ui {

/// The viewport's camera: an orbit camera around a pivot with a fixed up direction. Angles in
/// radians, lengths in metres, mouse movements in viewport pixels.
struct ViewerCamera {
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
    double azimuth = 4.3;    // of the eye as seen from the pivot, from +x towards +y
    double elevation = 0.8;  // above the horizon, -pi/2 .. pi/2
    double distance = 8.0;
    double hfov_deg = 50.0;
    bool orthographic = false;

    enum class Axis { Front, Back, Right, Left, Top, Bottom };

    [[nodiscard]] Eigen::Vector3d towardsViewer() const;
    [[nodiscard]] Pose pose() const;
    [[nodiscard]] render::View view(int width, int height) const;

    void orbit(double dx, double dy);
    void pan(double dx, double dy, int width);
    /// Multiplies the distance to the pivot by `factor` (clamped to 0.05 .. 2000 m); the world
    /// point `at` stays under the cursor.
    void zoom(double factor, const Eigen::Vector3d& at);
    /// Moves eye and pivot together, in m: right (the camera's axis), up (world z) and forward (the
    /// camera's axis).
    void fly(const Eigen::Vector3d& right_up_forward);
    /// Rotates about the eye, which stays in place.
    void look(double dx, double dy);
    void frame(const Eigen::AlignedBox3d& box, double aspect);
    void lookFrom(Axis axis);
    /// Moves the eye around the pivot by steps of 15 degrees.
    void orbitBySteps(int to_the_right, int upwards);
    /// Looks from the opposite side: turned by 180 degrees about the vertical, or, in a view along
    /// the vertical, from its other end.
    void lookFromOpposite();
    /// "Front", "Top" …; "User" if the view is along no axis.
    [[nodiscard]] const char* axisName() const;
    /// Takes the position and direction of a camera of the plan; the pivot lies `pivot_distance` m
    /// ahead.
    void standAt(const Pose& pose, double pivot_distance);
};

}  // namespace dollytrack::ui
