#pragma once

#include <Eigen/Core>

#include <vector>

namespace dollytrack::ui {

/// What the user clicked, in the viewport or in a panel. Indices are those of the plan on the
/// screen, so a new plan makes them doubtful; ids are those of its scene.
struct Selection {
    enum class Kind {
        None,
        Object,
        Objects,  // two or more
        ObservationPoint,
        PositionPoint,
        Edge,         // of the roadmap
        RefusedEdge,  // of the roadmap
        Frame,
        Voxel,
        NoGoBox,
        Region,
        Candidate,
    };
    Kind kind = Kind::None;
    std::vector<int> objects;  // ids, with Object and Objects
    int index = -1;            // in the plan's list; of a box: in PlanEdits::no_go; of a
                               // region: in PlanEdits::regions; of a candidate: in its search
    int search = -1;           // of a candidate: the observation point it was tried for
    Eigen::Vector3d place = Eigen::Vector3d::Zero();  // of a voxel, m, world

    bool operator==(const Selection&) const = default;

    [[nodiscard]] static Selection ofObject(int id) { return {Kind::Object, {id}}; }
    [[nodiscard]] static Selection ofItem(Kind kind, int index) { return {kind, {}, index}; }
    [[nodiscard]] static Selection ofCandidate(int search, int candidate) {
        return {Kind::Candidate, {}, candidate, search};
    }
};

}  // namespace dollytrack::ui
