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

/// An object listed in dataset.json.
struct StoredObject {
    int id = 0;
    std::string name;
    int nyu40 = 0;
    std::string role;
    OrientedBox box;   // without motion
    int class_id = 0;  // class of its pixels; equals nyu40 if the dataset uses NYU40
};

/// Current transform of a moved object, world frame.
struct MovedObject {
    int object_id = 0;
    Eigen::Isometry3d now_from_rest = Eigen::Isometry3d::Identity();
};

struct StoredFrame {
    int source_frame = 0;
    double time_s = 0.0;
    Pose pose;                       // world_from_camera, unit quaternion
    double quaternion_length = 1.0;  // as stored
    std::vector<MovedObject> moving;

    /// The object's motion from its position in the scene; null if it has not moved.
    [[nodiscard]] const Eigen::Isometry3d* movement(int object_id) const;
};

/// A dataset as described by its dataset.json; no other files have been read.
struct StoredDataset {
    std::filesystem::path folder;
    nlohmann::ordered_json card;  // dataset.json with "files" emptied
    std::string card_sha256;      // of dataset.json
    Intrinsics lens;
    double hfov_deg = 0.0;
    double near_m = 0.0;
    std::vector<std::string> modalities;
    std::vector<std::string> formats;
    std::vector<StoredObject> objects;
    std::shared_ptr<const ClassTable> own_classes;  // null: NYU40
    std::vector<StoredFrame> frames;
    std::set<int> unusable_frames;  // their images are too dark, white or flat to capture anything
    std::map<std::string, std::string> sha256s;  // by relative path

    /// Whether the dataset has this modality or format, or "folds".
    [[nodiscard]] bool has(std::string_view what) const;
    /// Null for an unknown id.
    [[nodiscard]] const StoredObject* object(int id) const;
    [[nodiscard]] const ClassTable& classes() const {
        return own_classes ? *own_classes : ClassTable::nyu40();
    }
    /// Class of an object's boxes; null if it gets none.
    [[nodiscard]] const DatasetClass* boxClass(const StoredObject& object) const {
        return classes().boxClassFor(object.name, object.nyu40);
    }
    /// Class of pixels that show this object; void for 0 and unknown ids.
    [[nodiscard]] int pixelClass(int object_id) const;
    /// conventions.<name>; null if missing.
    [[nodiscard]] nlohmann::ordered_json convention(const std::string& name) const;
};

/// Pose of an object's box (origin at its centre) in the frame's camera: x right, y down, z
/// forward; m.
Eigen::Isometry3d cameraFromBox(const StoredObject& object, const StoredFrame& frame);

/// Reads dataset.json in a folder. Returns BadInput if it is missing, incomplete, or not written by
/// Dollytrack.
Result<StoredDataset> readStoredDataset(const std::filesystem::path& folder);

}  // namespace dollytrack::verify
