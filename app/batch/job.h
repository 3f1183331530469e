#pragma once

#include "app/batch/jobs_file.h"
#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// One job of a batch: a scene with a parameter set, a planner and a seed.
struct Job {
    int number = 0;               // counted from 1, in the order of the jobs file
    std::string name;             // name of the job and of its folder, "kitchen.wide.uniform.seed2"
    std::filesystem::path scene;  // absolute path of the scene or project
    std::string set;              // name of the parameter set; empty: the default parameters
    std::string planner;
    std::optional<int> seed;
    std::string command;                 // "export" or "plan"
    std::vector<std::string> arguments;  // command-line arguments except the scene and the output
};

/// All combinations of scenes, sets, planners and seeds. A job's name depends only on its own
/// scene's name, set, planner and seed.
[[nodiscard]] std::vector<Job> jobsOf(const BatchOrder& order);

/// A share of a batch for one machine: the jobs with (number - 1) % count == index.
struct Shard {
    int index = 0;  // 0 <= index < count
    int count = 1;

    [[nodiscard]] bool has(const Job& job) const { return (job.number - 1) % count == index; }
};

/// Parses "index/count": "2/8" is the third of eight, as cluster array tasks count. Error: Usage.
[[nodiscard]] Result<Shard> parseShard(const std::string& text);

/// The job as JSON, with the absolute path of its scene.
[[nodiscard]] nlohmann::ordered_json toJson(const Job& job);
/// Inverse of toJson(). Throws nlohmann::json exceptions.
[[nodiscard]] Job jobFromJson(const nlohmann::ordered_json& json);

}  // namespace dollytrack::batch
