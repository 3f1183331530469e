#pragma once

#include "engine/core/result.h"
#include "engine/io/habitat/dataset_config.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/jobs/job.h"
#include "engine/scene/label_table.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace dollytrack::habitat {

/// Reads a scene instance of a dataset: stage, objects and articulated objects, y up, metres.
/// `path` is the instance's file. Errors: BadInput, Cancelled.
Result<RawScene> readSceneInstance(const std::filesystem::path& path,
                                   const nlohmann::json& instance, const Dataset& dataset,
                                   const LabelTable& labels, const JobContext& job);

/// Reads a single stage or object. A model without a description and without axes among the
/// dataset's defaults keeps the axes of its file. Errors: BadInput, Cancelled.
Result<RawScene> readPart(const std::filesystem::path& path, const Template& part,
                          const Dataset& dataset, const LabelTable& labels, const JobContext& job);

}  // namespace dollytrack::habitat
