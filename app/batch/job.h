#pragma once

#include "app/batch/jobs_file.h"
#include "engine/core/result.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// One run of the program: a scene with a set, a planner and a seed.
struct Job {
    int number = 0;               // from 1, in the order of the jobs file
    std::string name;             // its folder's; "kitchen.wide.uniform.seed2"
    std::filesystem::path scene;  // from where the program runs
    std::string set;              // empty: none is named
    std::string planner;
    std::optional<int> seed;
    std::string command;                 // "export" or "plan"
    std::vector<std::string> arguments;  // but for the scene and where to write
};

/// Every combination, with names that do not change when others come or go.
[[nodiscard]] std::vector<Job> jobsOf(const BatchOrder& order);

/// A part of a batch for one machine: the jobs whose number leaves the same remainder.
struct Shard {
    int index = 0;  // 0 <= index < count
    int count = 1;

    [[nodiscard]] bool has(const Job& job) const { return (job.number - 1) % count == index; }
};

/// "2/8": the third of eight, as array tasks of clusters count. Error: Usage.
[[nodiscard]] Result<Shard> parseShard(const std::string& text);

/// A job for a file, without its scene's place on this machine being lost.
[[nodiscard]] nlohmann::ordered_json toJson(const Job& job);
/// Throws nlohmann's exceptions.
[[nodiscard]] Job jobFromJson(const nlohmann::ordered_json& json);

}  // namespace dollytrack::batch
