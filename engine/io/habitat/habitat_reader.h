#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace dollytrack::habitat {

/// Whether the first bytes of a JSON file may be those of a scene instance, a dataset config, a
/// stage config or an object config.
bool likeHabitat(std::string_view head);

/// Whether a file describes a stage or an object, by its name. Batches skip these files; they are
/// read only when named directly.
bool isHabitatPart(const std::filesystem::path& path);

/// Reads a scene of Habitat: a scene instance with stage, objects and articulated objects; a stage
/// or object alone; or the only scene of a dataset config. y up, metres. Errors: BadInput,
/// Cancelled.
Result<RawScene> readHabitat(const std::filesystem::path& path, const ImportOptions& options,
                             const JobContext& job);

/// The folders that readHabitat() opens files in: the dataset's, the scene's and those given. They
/// are known by names of files alone; no file is opened.
std::vector<std::filesystem::path> habitatInputs(const std::filesystem::path& path,
                                                 const ImportOptions& options);

/// The scene files of a dataset config, in natural order of name: what a batch makes jobs of. The
/// config is of unknown origin and parsed in this process, so at most 1 MiB and 100,000 names are
/// read. `also_named` are the other configs of the batch, absolute. Error: BadInput, also where the
/// config gives axes or a size to models that it lists as scenes, and where a scene would be read
/// with a config that is not named.
Result<std::vector<std::filesystem::path>> scenesOfDataset(
    const std::filesystem::path& config, const std::vector<std::filesystem::path>& also_named = {});

}  // namespace dollytrack::habitat
