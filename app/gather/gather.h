#pragma once

#include "app/gather/layouts/layout.h"
#include "app/gather/sources/class_map.h"
#include "app/gather/sources/scene_split.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::gather {

/// The datasets to gather, and how: layout, splits, sizes of shards, classes.
struct GatherOrder {
    std::vector<std::string> datasets;  // as findDatasets() takes them
    std::filesystem::path out;
    const LayoutKind* layout = nullptr;
    SplitOrder split;
    ShardLimits shards;
    std::optional<ClassMap> class_map;
    std::string license;  // empty: none is named
    std::string title;
    std::string product_version;
    bool mixed_lenses = false;
    bool skip_damaged = false;
    bool hard_links = false;
    bool overwrite = false;
    bool resume = false;
};

/// What a part holds.
struct PartSummary {
    std::size_t datasets = 0;
    std::size_t scenes = 0;
    std::size_t frames = 0;
    std::size_t annotations = 0;
    std::vector<std::size_t> boxes_of_class;  // by index into the gathered classes; empty: none
};

/// A dataset that was left out, and why.
struct SkippedDataset {
    std::string name;
    std::string folder;
    std::string why;
};

struct GatherSummary {
    std::array<PartSummary, kParts.size()> parts;
    std::vector<SkippedDataset> skipped;
    std::size_t classes = 0;
    bool was_complete = false;  // nothing was left to do
};

/// Makes one dataset of many. Memory holds two of them at a time. Errors: Usage, also for a
/// complete dataset in the way and for `resume` of something else; BadInput for datasets that are
/// unfinished or damaged or do not go together; CannotWrite; Cancelled, after which `resume` goes
/// on.
[[nodiscard]] Result<GatherSummary> gatherDatasets(const GatherOrder& order, const JobContext& job);

}  // namespace dollytrack::gather
