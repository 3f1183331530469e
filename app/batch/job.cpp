#include "app/batch/job.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

std::vector<std::string> argumentsOf(const BatchOrder& order, const ParameterSet& set,
                                     const std::string& planner, std::optional<int> seed) {
    std::vector<std::string> arguments;
    const auto add = [&](std::initializer_list<std::string> words) {
        arguments.insert(arguments.end(), words);
    };
    if (order.unit_m) add({"--unit", fmt::format("{}", *order.unit_m)});
    if (order.up_axis) add({"--up", *order.up_axis});
    if (order.labels) add({"--labels", fs::absolute(*order.labels).string()});
    for (const fs::path& folder : order.models) add({"--models", fs::absolute(folder).string()});
    if (order.annotations) add({"--annotations", fs::absolute(*order.annotations).string()});
    if (order.convert) add({"--convert"});
    for (const std::string& assignment : set.assignments) add({"--set", assignment});
    if (seed) add({"--seed", std::to_string(*seed)});
    if (!planner.empty()) add({"--planner", planner});
    if (!order.exports) return arguments;
    const ExportOrder& exports = *order.exports;
    if (exports.max_frames) add({"--max-frames", std::to_string(*exports.max_frames)});
    if (!exports.range.empty()) add({"--range", exports.range});
    if (!exports.preset.empty()) add({"--preset", exports.preset});
    if (!exports.modalities.empty()) add({"--modalities", joined(exports.modalities)});
    if (!exports.formats.empty()) add({"--formats", joined(exports.formats)});
    arguments.insert(arguments.end(), exports.arguments.begin(), exports.arguments.end());
    return arguments;
}

}  // namespace

std::vector<Job> jobsOf(const BatchOrder& order) {
    const std::vector<ParameterSet> sets =
        order.sets.empty() ? std::vector<ParameterSet>(1) : order.sets;
    const std::vector<std::string> planners =
        order.planners.empty() ? std::vector<std::string>(1) : order.planners;
    std::vector<std::optional<int>> seeds(order.seeds.begin(), order.seeds.end());
    if (seeds.empty()) seeds.emplace_back();
    std::vector<Job> jobs;
    for (const SceneFile& scene : order.scenes) {
        for (const ParameterSet& set : sets) {
            for (const std::string& planner : planners) {
                for (const std::optional<int>& seed : seeds) {
                    Job job;
                    job.number = static_cast<int>(jobs.size()) + 1;
                    job.name = scene.name;
                    if (!set.name.empty()) job.name += "." + set.name;
                    if (!planner.empty()) job.name += "." + planner;
                    if (seed) job.name += fmt::format(".seed{}", *seed);
                    // Absolute, so that it does not depend on the working directory.
                    job.scene = fs::absolute(order.file.parent_path() / scene.path);
                    job.scene = job.scene.lexically_normal();
                    job.set = set.name;
                    job.planner = planner.empty() ? "dollytrack" : planner;
                    job.seed = seed;
                    job.command = order.exports ? "export" : "plan";
                    job.arguments = argumentsOf(order, set, planner, seed);
                    jobs.push_back(std::move(job));
                }
            }
        }
    }
    return jobs;
}

Result<Shard> parseShard(const std::string& text) {
    Shard shard;
    const char* end = text.data() + text.size();
    const auto index = std::from_chars(text.data(), end, shard.index);
    const bool parted = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
    const auto count = parted ? std::from_chars(index.ptr + 1, end, shard.count) : index;
    if (!parted || count.ec != std::errc() || count.ptr != end || shard.index < 0 ||
        shard.count < 1 || shard.index >= shard.count) {
        return fail(ErrorCode::Usage,
                    fmt::format("'{}' is not a shard of a batch; write i/n with i from 0 to n - 1, "
                                "like 0/4 for the first of four.",
                                text),
                    "--shard");
    }
    return shard;
}

nlohmann::ordered_json toJson(const Job& job) {
    nlohmann::ordered_json json = {{"number", job.number},
                                   {"name", job.name},
                                   {"scene", job.scene.string()},
                                   {"planner", job.planner}};
    if (!job.set.empty()) json["set"] = job.set;
    if (job.seed) json["seed"] = *job.seed;
    json["command"] = job.command;
    json["arguments"] = job.arguments;
    return json;
}

Job jobFromJson(const nlohmann::ordered_json& json) {
    Job job;
    job.number = json.at("number").get<int>();
    job.name = json.at("name").get<std::string>();
    job.scene = json.at("scene").get<std::string>();
    job.planner = json.at("planner").get<std::string>();
    job.set = json.value("set", "");
    if (json.contains("seed")) job.seed = json.at("seed").get<int>();
    job.command = json.at("command").get<std::string>();
    job.arguments = json.at("arguments").get<std::vector<std::string>>();
    return job;
}

}  // namespace dollytrack::batch
