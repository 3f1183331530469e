#include "app/batch/job_result.h"

#include "app/cli/export/export_metrics.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"
#include "engine/io/settings/project_file.h"
#include "render/formats/tables/dataset_card.h"

#include <fmt/format.h>

#include <array>
#include <system_error>

namespace dollytrack::batch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFile = "result.json";
constexpr std::array<const char*, 8> kNames = {"not run", "begun",     "done",        "failed",
                                               "crashed", "timed out", "interrupted", "busy"};

Json readJson(const fs::path& path) {
    return readBoundedJson<Json>(path).value_or(Json());
}

void takeNumbers(const Json& from, Json& to) {
    for (const auto& [key, value] : from.items()) {
        if (value.is_number()) to[key] = value;
    }
}

/// The input files of a job. If a project cannot be read, only the project file: the job itself
/// will report the error.
std::vector<fs::path> filesOf(const Job& job) {
    std::vector<fs::path> files = {job.scene};
    if (job.scene.extension() == ".dolly") {
        std::error_code error;
        const auto project = loadProject(job.scene);
        if (project && fs::is_regular_file(project->scene, error)) files.push_back(project->scene);
    }
    const auto labels = std::find(job.arguments.begin(), job.arguments.end(), "--labels");
    if (labels != job.arguments.end() && labels + 1 != job.arguments.end()) {
        files.emplace_back(*(labels + 1));
    }
    return files;
}

}  // namespace

const char* name(JobState state) {
    return kNames[static_cast<std::size_t>(state)];
}

Result<SceneStamp> stampOf(const Job& job, const SceneStamp& known) {
    const std::vector<fs::path> files = filesOf(job);
    SceneStamp stamp;
    for (const fs::path& file : files) {
        std::error_code error;
        stamp.size += fs::file_size(file, error);
        const auto changed = error ? fs::file_time_type{} : fs::last_write_time(file, error);
        if (error) {
            return fail(ErrorCode::BadInput, "the scene cannot be read (" + error.message() + ")",
                        file.string());
        }
        using std::chrono::nanoseconds;
        const auto ns = std::chrono::duration_cast<nanoseconds>(changed.time_since_epoch());
        // Unsigned arithmetic, which may wrap around: the sum is only compared.
        stamp.changed_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(stamp.changed_ns) +
                                                     static_cast<std::uint64_t>(ns.count()));
    }
    if (stamp.size == known.size && stamp.changed_ns == known.changed_ns) return known;
    for (const fs::path& file : files) {
        Result<std::string> sha256 = sha256OfFile(file);
        if (!sha256) return tl::unexpected(std::move(sha256.error()));
        stamp.sha256 += *sha256;
    }
    if (files.size() > 1) stamp.sha256 = sha256Of(std::string_view(stamp.sha256));
    return stamp;
}

bool isOf(const JobResult& result, const Job& job) {
    return result.command == job.command && result.arguments == job.arguments;
}

JobResult readResult(const fs::path& folder) {
    JobResult result;
    const Json json = readJson(folder / kFile);
    if (!json.is_object()) return result;
    try {
        const auto state = json.at("state").get<std::string>();
        const auto* at = std::find(kNames.begin(), kNames.end(), state);
        if (at == kNames.end()) return {};
        result.state = static_cast<JobState>(at - kNames.begin());
        result.exit_code = json.at("exit_code").get<int>();
        result.signal = json.at("signal").get<int>();
        result.message = json.at("message").get<std::string>();
        result.seconds = json.at("seconds").get<double>();
        result.peak_bytes = json.at("peak_bytes").get<std::uint64_t>();
        const Json& scene = json.at("scene");
        result.scene = {scene.at("size").get<std::uint64_t>(),
                        scene.at("changed_ns").get<std::int64_t>(),
                        scene.at("sha256").get<std::string>()};
        result.command = json.at("command").get<std::string>();
        result.arguments = json.at("arguments").get<std::vector<std::string>>();
        result.version = json.at("version").get<std::string>();
        // Other values cannot come from this program.
        takeNumbers(json.at("metrics"), result.metrics);
        for (const Json& one : json.at("datasets")) {
            result.datasets.push_back({one.at("folder").get<std::string>(),
                                       one.at("frames").get<int>(), one.value("unusable", "")});
        }
    } catch (const Json::exception&) {
        return {};
    }
    return result;
}

JobResult resultOf(const Job& job, const fs::path& batch_folder) {
    JobResult result = readResult(batch_folder / job.name);
    return isOf(result, job) ? result : JobResult();
}

Status writeResult(const GuardedFolder& folder, const JobResult& result) {
    Json datasets = Json::array();
    for (const WrittenDataset& one : result.datasets) {
        datasets.push_back(
            {{"folder", one.folder}, {"frames", one.frames}, {"unusable", one.unusable}});
    }
    const Json json = {{"state", name(result.state)},
                       {"exit_code", result.exit_code},
                       {"signal", result.signal},
                       {"message", result.message},
                       {"seconds", result.seconds},
                       {"peak_bytes", result.peak_bytes},
                       {"scene",
                        {{"size", result.scene.size},
                         {"changed_ns", result.scene.changed_ns},
                         {"sha256", result.scene.sha256}}},
                       {"command", result.command},
                       {"arguments", result.arguments},
                       {"version", result.version},
                       {"metrics", result.metrics},
                       {"datasets", std::move(datasets)}};
    return folder.write(kFile, json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

void readOutput(const fs::path& output, const fs::path& folder, JobResult& result) {
    const Json json = readJson(output);
    if (!json.is_object()) return;
    result.metrics = Json::object();
    result.datasets.clear();
    try {
        if (!json.contains("out")) {  // `plan` prints the metrics only
            takeNumbers(json, result.metrics);
            return;
        }
        const Json all = json.contains("rooms") ? json.at("rooms") : Json::array({json});
        for (const Json& one : all) {
            const fs::path written = one.at("out").get<std::string>();
            result.datasets.push_back(
                {written.lexically_relative(folder).string(), one.at("frames").get<int>(),
                 render::unusableText(render::pictureTallyFrom(one.at("pictures")))});
        }
        if (!all.empty()) takeNumbers(cli::exportMetrics(json), result.metrics);
    } catch (const Json::exception&) {
        return;
    }
}

}  // namespace dollytrack::batch
