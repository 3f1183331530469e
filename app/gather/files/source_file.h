#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/text_file.h"
#include "engine/jobs/job.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace dollytrack::gather {

// Files of the datasets that are gathered. Links to them are followed, but each must have the
// SHA-256 that dataset.json lists. Error: BadInput, a sentence with the file.

/// A file and the hash that it must have.
struct SourceFile {
    std::filesystem::path path;
    std::string sha256;
};

/// Error also if it has more than `most` bytes.
[[nodiscard]] Result<std::string> readProven(const SourceFile& file,
                                             std::uint64_t most = kMostTextBytes);
/// The same, into `into`, whose memory is reused; that saves time with many large files.
[[nodiscard]] Status readProven(const SourceFile& file, std::string& into,
                                std::uint64_t most = kMostTextBytes);

/// Copies its bytes to a new file. Error also: CannotWrite.
[[nodiscard]] Status copyProven(const SourceFile& file, const GuardedFolder& to,
                                const std::string& name);

/// Reads the file for its hash alone.
[[nodiscard]] Status prove(const SourceFile& file);

/// SHA-256 of a file in a guarded folder; nothing where it cannot be read or the job is cancelled.
[[nodiscard]] std::optional<std::string> sha256Within(const GuardedFolder& folder,
                                                      const std::string& name,
                                                      const JobContext& job);

}  // namespace dollytrack::gather
