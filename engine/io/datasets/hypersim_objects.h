#pragma once

#include "engine/core/result.h"
#include "engine/io/datasets/hypersim_annotations.h"
#include "engine/io/import/raw_scene.h"

#include <filesystem>

namespace dollytrack::io {

/// The folder of annotations that belongs to an OBJ file: in its own folder or the one above it.
std::filesystem::path findHypersimBeside(const std::filesystem::path& scene_file);

/// Makes objects of a model's nodes by their names: the meshes of a semantic instance become one,
/// of its NYU40 class; all others stay as they are named. The unit is the asset's, z is up. The
/// annotated boxes are compared with those of the meshes, for the report.
void applyHypersim(const HypersimAnnotations& annotations, RawScene& scene);

}  // namespace dollytrack::io
