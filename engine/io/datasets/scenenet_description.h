#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// A ShapeNet model in a SceneNet RGB-D scene.
struct SceneNetObject {
    std::string wnid;       // WordNet number of its category
    std::string hash;       // id of the model
    double height_m = 0.0;  // height to which it is scaled
    Eigen::Affine3d scene_from_object = Eigen::Affine3d::Identity();
    int line = 0;
};

/// The content of a SceneNet RGB-D scene file. y up, metres.
struct SceneNetDescription {
    std::string layout_file;  // as written in the file
    std::vector<SceneNetObject> objects;
};

/// Parses both variants: that of the scene generator (path, WordNet number, height and three matrix
/// rows per model), and that of the trajectory generator, in which each value has a keyword and
/// poses may follow. Error: BadInput, with the line.
Result<SceneNetDescription> parseSceneNet(std::string_view text, const std::string& file);

}  // namespace dollytrack
