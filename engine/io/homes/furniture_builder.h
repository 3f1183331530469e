#pragma once

#include "engine/io/homes/home.h"
#include "engine/io/homes/home_materials.h"
#include "engine/io/homes/model_library.h"
#include "engine/io/import/raw_scene.h"
#include "engine/jobs/job.h"
#include "engine/scene/label_table.h"

namespace dollytrack::homes {

/// Puts every piece of a home into the scene as an object of its own: its model, sized, turned and
/// coloured and named by the table; where the model is missing, a box of its size, which a note
/// says. BadInput when the pieces together have more than 50 million triangles.
Status addFurniture(const Home& home, ModelLibrary& library, HomeMaterials& materials,
                    const LabelTable& labels, RawScene& scene, const JobContext& job);

}  // namespace dollytrack::homes
