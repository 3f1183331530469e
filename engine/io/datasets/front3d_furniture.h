#pragma once

#include "engine/core/result.h"
#include "engine/io/datasets/front3d_scene.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"
#include "engine/scene/label_table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack {

/// Places the furniture of a 3D-FRONT scene: models <jid>/raw_model.obj of 3D-FUTURE below the
/// folders, in metres, front +Z. Entries that are not valid are left out, as in the dataset's own
/// tools; if no entry has that flag, all are used. Warnings name furniture without a model, which
/// is left out. Errors: BadInput for too many triangles, Cancelled.
Status addFront3dFurniture(const Front3dScene& source, const LabelTable& labels,
                           const std::vector<std::filesystem::path>& model_folders,
                           const std::string& where, const JobContext& job, RawScene& scene);

}  // namespace dollytrack
