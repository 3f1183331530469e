#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::io {

/// An entry of a 3D-FRONT scene's list of furniture. Texts are clean.
struct Front3dFurniture {
    std::string uid;
    std::string jid;  // of its 3D-FUTURE model
    std::string category;
    std::string title;
    std::string category_id;
    std::optional<bool> valid;  // nothing: the file does not say
    bool has_size = false;
};

/// One child of a room: a piece of furniture (or a mesh, whose placement means nothing) put there.
struct Front3dChild {
    std::string ref;          // the uid of what is placed
    std::string replace_jid;  // of the model that took its place; mostly empty
    Eigen::Affine3d scene_from_model = Eigen::Affine3d::Identity();
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    bool moved = false;  // it is not the identity
};

/// What a 3D-FRONT scene says apart from its meshes and materials: y up, metres, right-handed.
struct Front3dScene {
    std::vector<Front3dFurniture> furniture;
    std::vector<Front3dChild> children;
    std::vector<std::string> rooms;  // names, in the file's order
    std::size_t bad_children = 0;    // a number is missing or is none, or the turn is nothing
    std::size_t moved_rooms = 0;     // with a placement of their own, which is not applied
};

/// Error: BadInput when it is no such scene.
Result<Front3dScene> parseFront3d(const nlohmann::json& document, const std::string& where);

}  // namespace dollytrack::io
