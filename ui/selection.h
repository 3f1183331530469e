#pragma once

#include <Eigen/Core>

#include <vector>

namespace dollytrack::ui {

/// The selected elements, chosen in the viewport or in a panel. Indices refer to the plan on the
/// screen and may be invalid after replanning; ids are those of its scene.
struct Selection {
    enum class Kind {
        None,
        Object,
        Objects,  // two or more
        ObservationPoint,
        PositionPoint,
        Edge,         // an edge of the roadmap
        RefusedEdge,  // a refused edge of the roadmap
        Frame,
        Voxel,
        NoGoBox,
        Region,
        Candidate,
        CameraKey,  // a key of the given camera motion
    };
    Kind kind = Kind::None;
    std::vector<int> objects;  // object ids, for Object and Objects
    int index = -1;            // index in the plan's list; for NoGoBox in PlanEdits::no_go, for
                               // Region in PlanEdits::regions, for Candidate in its search, for
                               // CameraKey in GivenMotion::keys
    int search = -1;           // Candidate only: the observation point it was tested for
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // Voxel only: its centre, m, world

    bool operator==(const Selection&) const = default;

    [[nodiscard]] static Selection ofObject(int id) { return {Kind::Object, {id}}; }
    [[nodiscard]] static Selection ofItem(Kind kind, int index) { return {kind, {}, index}; }
    [[nodiscard]] static Selection ofCandidate(int search, int candidate) {
        return {Kind::Candidate, {}, candidate, search};
    }
};

}  // namespace dollytrack::ui
