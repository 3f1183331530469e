#pragma once

#include "engine/core/result.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/frame_memory.h"
#include "engine/io/sandbox/input_record.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace dollytrack::io {

/// What an importer handed back; nothing in it is checked yet.
struct HandBack {
    FrameMemory memory;
    std::span<const std::uint8_t> frame;  // within the memory
    // As the importer says; nothing when they are more than can be kept.
    std::optional<std::vector<InputUse>> inputs;
};

/// The importer, `dollytrack-import`; see siblingProgram().
[[nodiscard]] std::filesystem::path importerProgram();

/// Reads a scene file in a process of its own, which can open what lies beneath the scene's folder
/// and `more_inputs` (folders or files), and waits for it. It gets the time of a
/// ReadingClock with the `work` of the scene's format.
/// Cancelling kills it. Errors: BadInput when it crashes, takes too long or ends with nothing;
/// Cancelled; Failed when there is no importer or it cannot be started.
[[nodiscard]] Result<HandBack> runImporterProcess(
    const std::filesystem::path& scene, const ImportOptions& options, const JobContext& job,
    const std::vector<std::filesystem::path>& more_inputs = {}, double work = 1.0);

}  // namespace dollytrack::io
