#pragma once

#include "app/batch/scene_files.h"
#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A named set of parameters.
struct ParameterSet {
    std::string name;
    std::vector<std::string> assignments;  // in the form of --set: "fill=0.5"
};

/// Export settings of a job.
struct ExportOrder {
    std::optional<int> max_frames;
    std::string range;
    std::string preset;                   // empty: none
    std::vector<std::string> modalities;  // empty: those of the preset, or the default set
    std::vector<std::string> formats;
    std::vector<std::string> arguments;  // additional arguments of `dollytrack export`
};

/// Content of a jobs file: every scene is combined with every set, planner and seed.
struct BatchOrder {
    std::filesystem::path file;
    std::filesystem::path out;  // output folder; empty: not given
    std::vector<SceneFile> scenes;
    std::vector<ParameterSet> sets;     // empty: default parameters, not part of job names
    std::vector<std::string> planners;  // empty: the default planner, not part of job names
    std::vector<int> seeds;             // empty: each scene's own seed, not part of job names
    std::optional<double> unit_m;
    std::optional<std::string> up_axis;
    std::optional<std::filesystem::path> labels;
    std::vector<std::filesystem::path> models;  // folders with models
    std::optional<std::filesystem::path> annotations;
    bool convert = false;                // Blender files to glTF first (--convert)
    std::optional<ExportOrder> exports;  // unset: the jobs only plan
    std::vector<std::string> require;
    std::vector<std::string> require_places;  // location of each requirement, "jobs.toml:12"
    double timeout_s = 0.0;                   // time limit per job; 0: none
    std::uint64_t memory_mb = 0;              // memory limit per job, MB; 0: none
};

/// Reads a jobs file (example in app/guides/batches.md) and finds its scenes. All names and values
/// are validated here, so that no job fails on a typing error after hours. Error: BadInput, with
/// file and line.
[[nodiscard]] Result<BatchOrder> readJobsFile(const std::filesystem::path& file);

}  // namespace dollytrack::batch
