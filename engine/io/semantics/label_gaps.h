#pragma once

#include <filesystem>
#include <string>

namespace dollytrack::semantics {

/// A warning if one of two label files that belong together is missing beside a mesh, such as
/// ScanNet's .segs.json beside its .aggregation.json; otherwise empty.
[[nodiscard]] std::string missingLabelFile(const std::filesystem::path& mesh);

}  // namespace dollytrack::semantics
