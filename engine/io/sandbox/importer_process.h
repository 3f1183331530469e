#pragma once

#include "engine/core/result.h"
#include "engine/io/files/input_record.h"
#include "engine/io/sandbox/shared_memory.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack {

/// The result of an importer process, not yet checked.
struct ImporterResult {
    SharedMemory memory;
    std::span<const std::uint8_t> serialized;  // within the memory
    // As reported by the importer; empty if there are more than the cache keeps.
    std::optional<std::vector<InputUse>> inputs;
};

/// Path of the program `dollytrack-import`; see siblingProgram().
[[nodiscard]] std::filesystem::path importerProgram();

/// Reads a scene file in a separate process, which can open only what lies below the scene's folder
/// and `more_inputs` (folders or files), and waits for it. Its time is limited by a ReadingClock;
/// `work` is that of the scene's format. Cancelling kills the process. Errors: BadInput if it
/// crashes, takes too long or returns nothing; Cancelled; Failed if the importer is missing or
/// cannot be started.
[[nodiscard]] Result<ImporterResult> runImporterProcess(
    const std::filesystem::path& scene, const ImportOptions& options, const JobContext& job,
    const std::vector<std::filesystem::path>& more_inputs = {}, double work = 1.0);

}  // namespace dollytrack
