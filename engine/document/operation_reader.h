#pragma once

#include "engine/document/edits.h"
#include "engine/document/json_reader.h"
#include "engine/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Reads the fields of one operation against the scene it is meant for. The first thing wrong is
/// kept in `status`, as with JsonReader.
class OperationReader {
  public:
    OperationReader(const nlohmann::json& operation, const Scene& scene, Status& status)
        : fields_(operation, {}, status), scene_(scene) {}

    [[nodiscard]] JsonReader field(const std::string& name) const { return fields_.at(name); }
    [[nodiscard]] bool has(const std::string& name) const { return !field(name).absent(); }
    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] bool good() const { return fields_.good(); }

    /// By number or by a name that only one object has.
    [[nodiscard]] ObjectRef object(const std::string& name) const;
    /// One or a list of them, by rising id. An entry that no object has as its name may be a class
    /// or a name with * and ? (isNamedBy()), and stands for all objects that it names.
    [[nodiscard]] std::vector<ObjectRef> objects(const std::string& name) const;
    /// The same, or all objects of the class in the field "class"; one of the two must be given.
    [[nodiscard]] std::vector<ObjectRef> objectsOrClass(const std::string& name) const;
    /// 1..40, from a name or a number.
    [[nodiscard]] int nyu40(const std::string& name) const;
    /// Horizontal unit vector, from degrees (0: x, 90: y) or [x, y].
    [[nodiscard]] Eigen::Vector3d front(const std::string& name) const;
    /// From position and one of target, yaw_deg with pitch_deg, and quaternion_xyzw. What is not
    /// given is taken from `before`; without it position and direction must be given.
    [[nodiscard]] Pose pose(const std::optional<Pose>& before) const;
    /// From center, size and yaw_deg, likewise.
    [[nodiscard]] OrientedBox box(const std::optional<OrientedBox>& before) const;
    /// Those of visitSplitLimits() that are given; the others are off.
    [[nodiscard]] SplitLimits splitLimits() const;

  private:
    [[nodiscard]] ObjectRef readObject(const JsonReader& from) const;
    [[nodiscard]] std::vector<ObjectRef> named(std::string_view pattern) const;

    JsonReader fields_;
    const Scene& scene_;
};

/// "lamp_3", "lamp_3 and mug", "lamp_3 and 4 more".
std::string inWords(const std::vector<ObjectRef>& objects);

}  // namespace dollytrack
