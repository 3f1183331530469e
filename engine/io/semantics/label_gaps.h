#pragma once

#include <filesystem>
#include <string>

namespace dollytrack::semantics {

/// One sentence on the files of a labelled set that lie beside a mesh without those that belong to
/// them, such as ScanNet's .aggregation.json without its .segs.json; empty where none is missing.
[[nodiscard]] std::string missingLabelFile(const std::filesystem::path& mesh);

}  // namespace dollytrack::semantics
