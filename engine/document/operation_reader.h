#pragma once

#include "engine/document/edits.h"
#include "engine/document/json_reader.h"
#include "engine/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack {

/// Reads the fields of one operation and looks up objects in the scene. Records the first error in
/// `status`, as JsonReader does.
class OperationReader {
  public:
    OperationReader(const nlohmann::json& operation, const Scene& scene, Status& status)
        : fields_(operation, {}, status), scene_(scene) {}

    [[nodiscard]] JsonReader field(const std::string& name) const { return fields_.at(name); }
    [[nodiscard]] bool has(const std::string& name) const { return !field(name).absent(); }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] bool good() const { return fields_.good(); }
    void refuse(std::string message) const { fields_.refuse(std::move(message)); }

    /// The object named by its number or by a unique name, in a field or in a part of one.
    [[nodiscard]] ObjectRef object(const std::string& name) const { return object(field(name)); }
    [[nodiscard]] ObjectRef object(const JsonReader& from) const;
    /// One object or a list of objects, by rising id. An entry that is no object's name may be a
    /// class, or a pattern with * and ? (see isNamedBy()): it stands for all objects that match.
    [[nodiscard]] std::vector<ObjectRef> objects(const std::string& name) const;
    /// The objects in this field, or all objects of the class in the field "class". Exactly one of
    /// the two must be given.
    [[nodiscard]] std::vector<ObjectRef> objectsOrClass(const std::string& name) const;
    /// An NYU40 class, 1..40, given as its name or number.
    [[nodiscard]] int nyu40(const std::string& name) const;
    /// A horizontal unit vector, given as degrees (0: x, 90: y) or as [x, y].
    [[nodiscard]] Eigen::Vector3d front(const std::string& name) const;
    /// A pose, given by position and one of: target; yaw_deg and pitch_deg; quaternion_xyzw.
    /// Missing parts are taken from `before`; without `before` both position and direction are
    /// required.
    [[nodiscard]] Pose pose(const std::optional<Pose>& before) const;
    /// A box, given by center, size and yaw_deg. Missing parts are taken from `before`, if given.
    [[nodiscard]] OrientedBox box(const std::optional<OrientedBox>& before) const;
    /// The fields of visitSplitLimits(). A missing one means no limit.
    [[nodiscard]] SplitLimits splitLimits() const;
    /// The fields that readMotion() reads.
    [[nodiscard]] GivenMotion motion() const;

  private:
    [[nodiscard]] std::vector<ObjectRef> named(std::string_view pattern) const;

    JsonReader fields_;
    const Scene& scene_;
};

/// "lamp_3", "lamp_3 and mug", "lamp_3 and 4 more".
std::string inWords(const std::vector<ObjectRef>& objects);

}  // namespace dollytrack
