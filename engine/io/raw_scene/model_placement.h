#pragma once

#include "engine/io/raw_scene/raw_scene.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace dollytrack {

/// Places a model any number of times in a scene; its materials and textures are added once.
class ModelPlacement {
  public:
    /// `model` and `scene` must outlive this object.
    ModelPlacement(const RawScene& model, RawScene& scene) : model_(model), scene_(scene) {}

    /// Adds the model's parts, transformed to the scene's axes and unit, under a new node of this
    /// name. Under a mirroring transform, faces keep their outside. Returns the new parts' indices.
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
