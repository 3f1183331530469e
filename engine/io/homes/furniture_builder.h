#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/model_library.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"
#include "engine/scene/label_table.h"

namespace dollytrack::homes {

/// Adds every piece of a home to the scene as an object: its model with the piece's size, rotation
/// and colours, and a class by `labels`. A missing model is replaced by a box, with a note. Errors:
/// BadInput for more than 50 million triangles in all; Cancelled.
Status addFurniture(const Home& home, ModelLibrary& library, HomeMaterials& materials,
                    const LabelTable& labels, RawScene& scene, const JobContext& job);

}  // namespace dollytrack::homes
