#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/semantics/label_files.h"
#include "engine/jobs/job.h"

#include <filesystem>

namespace dollytrack::semantics {

/// Reads a labelled mesh: each labelled object becomes an object of the scene, and the unlabelled
/// surface becomes structure. If the room's colours are in another mesh, that one is read as well
/// and gets the labels (transferLabels()). Errors: BadInput, Cancelled.
[[nodiscard]] Result<RawScene> readLabelled(const LabelledFiles& files, const JobContext& job);

/// Reads a PLY mesh without the label files of a known dataset. Objects are those of the numbers of
/// its faces or vertices, with names by findNameList(); fewer than two are ignored, and the scene
/// then has no objects yet. Errors: BadInput, Cancelled.
[[nodiscard]] Result<RawScene> readPly(const std::filesystem::path& path, const JobContext& job);

}  // namespace dollytrack::semantics
