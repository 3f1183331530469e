#pragma once

#include "engine/io/import/raw_scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace dollytrack {

/// Puts one model into scenes that are made of models, as often as it is needed: its materials and
/// textures are added to the scene once.
class ModelPlacement {
  public:
    /// `model` and `scene` have to outlive this object.
    ModelPlacement(const RawScene& model, RawScene& scene) : model_(model), scene_(scene) {}

    /// Adds the model's parts under a new node of this name, moved into the scene's axes and unit;
    /// a mirroring transform turns the faces back. Returns the new parts' indices.
    std::vector<std::size_t> place(const std::string& name,
                                   const Eigen::Affine3d& scene_from_model);
    /// Places only the parts of the model with these indices.
    std::vector<std::size_t> place(const std::string& name, const Eigen::Affine3d& scene_from_model,
                                   const std::vector<std::size_t>& parts);

  private:
    void addMaterials();

    const RawScene& model_;
    RawScene& scene_;
    bool added_ = false;
    std::size_t first_material_ = 0;
};

}  // namespace dollytrack
