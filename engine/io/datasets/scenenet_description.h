#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::io {

/// A ShapeNet model in a SceneNet RGB-D scene.
struct SceneNetObject {
    std::string wnid;       // WordNet number of its category
    std::string hash;       // of the model
    double height_m = 0.0;  // it is scaled to
    Eigen::Affine3d scene_from_object = Eigen::Affine3d::Identity();
    int line = 0;
};

/// The text file of a SceneNet RGB-D scene. y up, metres.
struct SceneNetDescription {
    std::string layout_file;  // as it is written
    std::vector<SceneNetObject> objects;
};

/// Reads both forms: that of the scene generator (a path, the number, the height, three rows a
/// model), and that of the trajectory generator, where each is announced by a word and the poses
/// may follow. Errors: BadInput, with the line.
Result<SceneNetDescription> parseSceneNet(std::string_view text, const std::string& file);

}  // namespace dollytrack::io
