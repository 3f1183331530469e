#pragma once

#include "engine/core/result.h"

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// An entry in the furniture list of a 3D-FRONT scene. Texts are clean.
struct Front3dFurniture {
    std::string uid;
    std::string jid;  // id of its 3D-FUTURE model
    std::string category;
    std::string title;
    std::string category_id;
    std::optional<bool> valid;  // nullopt: not in the file
    bool has_size = false;
};

/// A child of a room: a placed piece of furniture, or a mesh, whose placement is ignored.
struct Front3dChild {
    std::string ref;          // uid of the furniture or mesh
    std::string replace_jid;  // id of a model that replaces it; mostly empty
    Eigen::Affine3d scene_from_model = Eigen::Affine3d::Identity();
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    bool moved = false;  // whether the placement is not the identity
};

/// A 3D-FRONT scene without its meshes and materials. Right-handed, y up, metres.
struct Front3dScene {
    std::vector<Front3dFurniture> furniture;
    std::vector<Front3dChild> children;
    std::vector<std::string> rooms;  // names, in the file's order
    std::size_t bad_children = 0;    // children with a missing or invalid number or rotation
    std::size_t moved_rooms = 0;     // rooms with a placement, which is not applied
};

/// Parses a scene. `where` is the file, for errors. Error: BadInput if it is not a 3D-FRONT scene.
Result<Front3dScene> parseFront3d(const nlohmann::json& document, const std::string& where);

}  // namespace dollytrack
