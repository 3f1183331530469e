#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// A file of an archive: a relative name with slashes, and its bytes.
struct ArchiveFile {
    std::string name;
    std::vector<std::uint8_t> bytes;
};

/// A zip archive of the files in their order. The same files give the same bytes: every entry has
/// the same date. Images are stored, everything else is deflated.
Result<std::vector<std::uint8_t>> makeArchive(const std::vector<ArchiveFile>& files);

}  // namespace dollytrack
