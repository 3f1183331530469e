#pragma once

#include "app/batch/scene_files.h"
#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// Parameters that belong together, under a name.
struct ParameterSet {
    std::string name;
    std::vector<std::string> assignments;  // "fill=0.5", as --set takes them
};

/// How a job's dataset is written.
struct ExportOrder {
    std::optional<int> max_frames;
    std::string range;
    std::vector<std::string> modalities;  // empty: the standard ones
    std::vector<std::string> formats;
    std::vector<std::string> arguments;  // more of them, for `dollytrack export`
};

/// What a jobs file asks for: every scene with every set, planner and seed.
struct BatchOrder {
    std::filesystem::path file;
    std::filesystem::path out;  // absolute, or from where the program runs; empty: not said
    std::vector<SceneFile> scenes;
    std::vector<ParameterSet> sets;     // empty: none, and jobs are not called after them
    std::vector<std::string> planners;  // likewise
    std::vector<int> seeds;             // likewise: that of each scene or project
    std::optional<double> unit_m;
    std::optional<std::string> up_axis;
    std::optional<std::filesystem::path> labels;
    std::vector<std::filesystem::path> models;  // folders
    std::optional<std::filesystem::path> annotations;
    std::optional<ExportOrder> exports;  // none: the jobs only plan
    std::vector<std::string> require;
    std::vector<std::string> require_places;  // of each, "jobs.toml:12"
    double timeout_s = 0.0;                   // of one job; 0: none
    std::uint64_t memory_mb = 0;              // likewise
};

/// Reads a jobs file, README.md has an example, and looks for its scenes. All names and values are
/// checked here, so that no job fails for a slip of the pen after hours. Error: BadInput, with file
/// and line.
[[nodiscard]] Result<BatchOrder> readJobsFile(const std::filesystem::path& file);

}  // namespace dollytrack::batch
