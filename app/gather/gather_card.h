#pragma once

#include "app/gather/gather.h"
#include "app/gather/output/output_files.h"
#include "app/gather/sources/class_union.h"
#include "app/gather/sources/source.h"
#include "render/dataset/folder/dataset_journal.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace dollytrack::gather {

/// What gather.json and README.md tell. Neither holds a clock or a path, so that equal datasets
/// give equal bytes wherever they are.
struct GatherCard {
    const GatherOrder& order;
    std::span<const Source> sources;
    std::span<const PartIndex> part_of;  // of each source
    const ClassUnion& classes;
    const GatherSummary& summary;
    nlohmann::ordered_json conventions;
    std::set<std::string> modalities;
    render::DatasetIdentity identity;
    std::string sums_sha256;  // of SHA256SUMS
};

[[nodiscard]] std::string gatherJson(const GatherCard& card);

/// Writes LICENSES: each text that datasets have in theirs, once, under the names of these
/// datasets. Writes nothing if no dataset has licences. Errors: BadInput, CannotWrite.
[[nodiscard]] Status writeLicenses(std::span<const Source> sources, OutputFiles& files);

/// The dataset card, with the header in YAML that Hugging Face reads.
[[nodiscard]] std::string readmeText(const GatherCard& card);

/// The parts that hold frames.
[[nodiscard]] std::vector<PartIndex> partsOf(std::span<const PartIndex> part_of);

}  // namespace dollytrack::gather
