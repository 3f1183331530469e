#pragma once

#include "engine/camera/intrinsics.h"
#include "engine/core/result.h"
#include "engine/math/pose.h"
#include "engine/scene/class_table.h"
#include "engine/scene/object.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::verify {

/// An object as dataset.json lists it.
struct StoredObject {
    int id = 0;
    std::string name;
    int nyu40 = 0;
    std::string role;
    OrientedBox box;   // at rest
    int class_id = 0;  // of its pixels; in datasets of NYU40 the same as nyu40
};

/// Where an object is that is not at rest.
struct MovedObject {
    int object_id = 0;
    Eigen::Isometry3d now_from_rest = Eigen::Isometry3d::Identity();
};

struct StoredFrame {
    int source_frame = 0;
    double time_s = 0.0;
    Pose pose;                       // world_from_camera, unit quaternion
    double quaternion_length = 1.0;  // as it is written
    std::vector<MovedObject> moving;

    /// How the object has moved since rest; null when it has not.
    [[nodiscard]] const Eigen::Isometry3d* movement(int object_id) const;
};

/// A dataset as its dataset.json describes it; nothing else of it is read yet.
struct StoredDataset {
    std::filesystem::path folder;
    nlohmann::ordered_json card;  // dataset.json
    Intrinsics lens;
    double hfov_deg = 0.0;
    double near_m = 0.0;
    std::vector<std::string> modalities;
    std::vector<std::string> formats;
    std::vector<StoredObject> objects;
    std::shared_ptr<const ClassTable> own_classes;  // null: NYU40
    std::vector<StoredFrame> frames;
    std::set<int>
        unusable_frames;  // whose pictures are too dark, white or flat to capture anything
    std::map<std::string, std::string> sha256s;  // by relative path

    /// Whether it has a modality, a format, or "folds".
    [[nodiscard]] bool has(std::string_view what) const;
    /// Null for an id that is not in the list.
    [[nodiscard]] const StoredObject* object(int id) const;
    [[nodiscard]] const ClassTable& classes() const {
        return own_classes ? *own_classes : ClassTable::nyu40();
    }
    /// The class of an object's boxes; null where it gets none.
    [[nodiscard]] const DatasetClass* boxClass(const StoredObject& object) const {
        return classes().boxClassFor(object.name, object.nyu40);
    }
    /// The class of a pixel that shows this object, void for 0 and unknown ids.
    [[nodiscard]] int pixelClass(int object_id) const;
    /// conventions.<name>; null when it has none.
    [[nodiscard]] nlohmann::ordered_json convention(const std::string& name) const;
};

/// Where the object's box is in the frame's camera (x right, y down, z forward; m): from the box's
/// own axes around its middle.
Eigen::Isometry3d cameraFromBox(const StoredObject& object, const StoredFrame& frame);

/// Errors: BadInput where there is no dataset.json, or one that is not ours, or not complete.
Result<StoredDataset> readStoredDataset(const std::filesystem::path& folder);

}  // namespace dollytrack::verify
