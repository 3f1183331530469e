#pragma once

#include "engine/core/result.h"
#include "engine/io/datasets/hypersim_annotations.h"
#include "engine/io/raw_scene/raw_scene.h"

#include <filesystem>

namespace dollytrack {

/// The annotation folder of an OBJ file, in its folder or the one above; empty if there is none.
std::filesystem::path findHypersimBeside(const std::filesystem::path& scene_file);

/// Makes objects of a model's nodes by their names: the meshes of a semantic instance become one
/// object of its NYU40 class; all others keep their names. Sets the asset's unit and z up. The
/// notes compare the annotated boxes with those of the meshes.
void applyHypersim(const HypersimAnnotations& annotations, RawScene& scene);

}  // namespace dollytrack
