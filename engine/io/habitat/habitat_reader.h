#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace dollytrack::habitat {

/// Whether a JSON file that begins with `head` may be a scene instance or a dataset, stage or
/// object config, by its keys.
bool likeHabitat(std::string_view head);

/// Whether a file describes a stage or an object, by its name. Batches skip these files unless they
/// are named explicitly.
bool isHabitatPart(const std::filesystem::path& path);

/// Reads a scene of Habitat: a scene instance with stage, objects and articulated objects; a stage
/// or object alone; or the only scene of a dataset config. y up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readHabitat(const std::filesystem::path& path, const ImportOptions& options,
                             const JobContext& job);

/// The folders in which readHabitat() opens files: the dataset's, the scene's and
/// ImportOptions::model_folders. Determined by file names; no file is opened.
std::vector<std::filesystem::path> habitatInputs(const std::filesystem::path& path,
                                                 const ImportOptions& options);

/// The scene files of a dataset config in natural order of name, for the jobs of a batch. Because
/// the untrusted config is parsed in this process, at most 1 MiB and 100,000 names are read.
/// `also_named` are the absolute paths of the batch's other configs. Error: BadInput, also if the
/// config gives axes or a scale to models that are scenes themselves (a batch would read them
/// without the config), and if readHabitat() would use an unnamed config for a scene.
Result<std::vector<std::filesystem::path>> scenesOfDataset(
    const std::filesystem::path& config, const std::vector<std::filesystem::path>& also_named = {});

}  // namespace dollytrack::habitat
