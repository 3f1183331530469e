#pragma once

#include "engine/document/given_motion.h"
#include "engine/document/split_limits.h"
#include "engine/math/pose.h"
#include "engine/scene/object.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// How an edit refers to an object. If the scene file has changed and the object has another
/// number, it is found by its name.
struct ObjectRef {
    int id = 0;  // in the scene that the edit was made in; 0: only the name is known
    std::string name;
    bool operator==(const ObjectRef&) const = default;
};

/// Objects merged into a new one, or one object split into its pieces.
struct ObjectDefinition {
    enum class Kind {
        Merge,  // all objects become one, at the place of the first
        Split,  // the one object becomes its connected pieces, at its place
    };
    Kind kind = Kind::Merge;
    std::vector<ObjectRef> objects;  // by rising id, as the definitions before this one number them
    std::string name;                // of the new object; of pieces: followed by a number
    int nyu40 = 0;                   // of the merged object; 0: that of its largest part
    SplitLimits limits;              // of a split
    bool operator==(const ObjectDefinition&) const = default;
};

/// An object's displacement: a turn about the vertical axis through the centre of its box, then a
/// translation.
struct ObjectMove {
    Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
    double turn_rad = 0.0;  // counter-clockwise seen from above
    bool operator==(const ObjectMove&) const = default;

    [[nodiscard]] bool isNone() const { return offset_m.isZero(0.0) && turn_rad == 0.0; }
};

/// A key of an object's track: its displacement at one time.
struct TrackKey {
    double time_s = 0.0;
    ObjectMove move;  // from where the file has it
    bool operator==(const TrackKey&) const = default;
};

/// A user's changes to one object. Fields that are not set keep what the import found.
struct ObjectChange {
    ObjectRef object;                      // in the scene with all definitions applied
    std::optional<Role> role;              // Target or Excluded
    std::optional<int> nyu40;              // 0..40
    std::optional<Eigen::Vector3d> front;  // horizontal, unit; of the object where the file has it
    std::optional<bool> large;
    std::optional<ObjectMove> move;  // from where the file has it
    std::vector<TrackKey> track;     // by rising time; moves nothing until a time is chosen
    bool operator==(const ObjectChange&) const = default;

    [[nodiscard]] bool saysNothing() const {
        return !role && !nyu40 && !front && !large && !move && track.empty();
    }
};

/// Everything that the user changed in a scene. Applied in this order: definitions; the lists
/// `ignore` and `only`; changes of single objects, which therefore override the lists.
struct SceneEdits {
    std::vector<ObjectDefinition> definitions;
    std::vector<std::string> ignore;    // classes and names of non-targets; see isNamedBy()
    std::vector<std::string> only;      // if not empty: classes and names of the only targets
    std::vector<ObjectChange> changes;  // by rising id, one for each object
    bool operator==(const SceneEdits&) const = default;
};

/// A position point that the user placed, moved, turned or locked. Planning keeps its pose
/// unchanged, to the last bit, and visits it unless the pose is inadmissible.
struct PinnedPoint {
    std::string name;                // unique among the pinned points
    Pose pose;                       // world_from_camera, roll 0
    std::vector<ObjectRef> objects;  // of the observation point it stands for, by rising id; empty:
                                     // placed from a view, stands for what it captures
    bool operator==(const PinnedPoint&) const = default;
};

/// An observation point that gets no position point of its own.
struct RemovedPoint {
    std::vector<ObjectRef> objects;  // by rising id
    bool operator==(const RemovedPoint&) const = default;
};

/// A box that no part of the camera's sphere may enter.
struct NoGoBox {
    std::string name;  // unique among the boxes
    OrientedBox box;
    bool operator==(const NoGoBox&) const = default;
};

constexpr double kSmallestWeight = 0.01;
constexpr double kLargestWeight = 1000.0;

/// A box that weights the objects in it. Where regions overlap the largest weight counts.
struct Region {
    std::string name;  // unique among the regions
    OrientedBox box;
    double weight = 1.0;    // of objects whose box centre is inside; those outside have 1
    bool must_see = false;  // all surface inside must be seen, whichever object it belongs to
    bool operator==(const Region&) const = default;
};

/// Largest number of pinned points in a plan; also of no-go boxes, and of regions.
constexpr std::size_t kMostPlanEntries = 1000;

/// Everything that the user changed in a plan. Objects are those of the edited scene.
struct PlanEdits {
    std::vector<PinnedPoint> pinned;
    std::vector<RemovedPoint> removed;
    std::vector<NoGoBox> no_go;
    std::vector<Region> regions;
    std::string start;    // name of the pinned point where the trajectory begins; empty: anywhere
    std::string end;      // and where it ends
    SharedMotion motion;  // if given, the trajectory: nothing is planned
    bool operator==(const PlanEdits&) const = default;
};

/// All changes by the user that a project stores.
struct Edits {
    SceneEdits scene;
    PlanEdits plan;
    bool operator==(const Edits&) const = default;
};

}  // namespace dollytrack
