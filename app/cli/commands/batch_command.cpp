#include "app/batch/batch_folder.h"
#include "app/batch/batch_runner.h"
#include "app/batch/jobs_file.h"
#include "app/batch/report.h"
#include "app/cli/command_line.h"
#include "app/cli/requirement.h"
#include "engine/core/log.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;
using batch::BatchList;
using batch::BatchOrder;
using batch::Job;
using batch::Report;
using batch::ResumeState;
using batch::Shard;

struct BatchArguments {
    std::string file;
    std::string out;
    std::string merge;
    std::string shard;
    std::vector<std::string> require;
    std::optional<double> timeout_s;
    int parallel = 1;
    bool resume = false;
    bool dry_run = false;
    bool as_json = false;
};

/// Folder of the shards' reports; '@' cannot occur in a job's name.
constexpr const char* kShards = "@shards";

Result<batch::RunSettings> settingsFor(const BatchArguments& arguments, const BatchOrder& order,
                                       const Session& session) {
    Result<fs::path> program = batch::ownProgram();
    if (!program) return tl::unexpected(std::move(program.error()));
    batch::RunSettings settings;
    settings.program = std::move(*program);
    settings.version = DOLLYTRACK_VERSION;
    settings.folder = fs::absolute(arguments.out.empty() ? order.out : fs::path(arguments.out));
    settings.folder = settings.folder.lexically_normal();
    settings.parallel = arguments.parallel;
    const auto cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1U));
    settings.threads =
        session.threads > 0 ? session.threads : std::max(1, cores / arguments.parallel);
    settings.timeout_s = arguments.timeout_s.value_or(order.timeout_s);
    settings.memory_mb = order.memory_mb;
    return settings;
}

void print(const Report& report, bool as_json) {
    if (as_json) {
        fmt::print("{}\n", batch::reportJson(report).dump(
                               1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    } else {
        fmt::print("{}", batch::reportText(report));
    }
}

ExitCode exitCodeOf(const Report& report) {
    return std::all_of(report.rows.begin(), report.rows.end(), batch::isGood) ? kDone : kPartial;
}

/// Lists the jobs and what remains to be done, without writing anything.
Result<ExitCode> listJobs(const std::vector<Job>& jobs, const batch::RunSettings& settings,
                          bool as_json, const JobContext& context) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Job& job : jobs) {
        if (context.cancelled()) return fail(ErrorCode::Cancelled, "The list was stopped.");
        const auto resume = batch::resumeStateOf(job, settings);
        const bool done = resume && resume->action == ResumeState::Action::None;
        const bool goes_on = resume && resume->action == ResumeState::Action::Resume;
        std::string what = done ? "done" : goes_on ? "go on" : "begin";
        if (!resume) what = describe(resume.error());
        if (resume && !resume->why.empty()) what += ": " + resume->why;
        if (!as_json) {
            fmt::print("{:>5}  {:<40} {}\n", job.number, job.name, what);
            continue;
        }
        nlohmann::ordered_json one = toJson(job);
        one["to_do"] = what;
        one["runs"] = commandOf(job, settings, goes_on);
        list.push_back(std::move(one));
    }
    if (as_json) {
        fmt::print("{}\n",
                   list.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
    }
    return kDone;
}

/// Merges the results in a batch's folder, whichever machine produced them.
Result<ExitCode> mergeBatch(const BatchArguments& arguments) {
    const fs::path folder = fs::absolute(arguments.merge).lexically_normal();
    Result<BatchList> list = batch::readBatchList(folder);
    if (!list) return tl::unexpected(std::move(list.error()));
    list->require.insert(list->require.end(), arguments.require.begin(), arguments.require.end());
    if (Status status = batch::checkRequirements(list->require, list->jobs); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    std::vector<batch::JobResult> results;
    for (const Job& job : list->jobs) {
        results.push_back(batch::resultOf(job, folder));
    }
    const Report report{folder.filename().string(), folder, folder, list->require,
                        batch::evaluateResults(list->jobs, std::move(results), list->require)};
    if (Status status = batch::writeReport(report); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    print(report, arguments.as_json);
    return exitCodeOf(report);
}

Status checkUsage(const BatchArguments& arguments) {
    for (const std::string& text : arguments.require) {
        if (const auto parsed = parseRequirement(text); !parsed) {
            return tl::unexpected(parsed.error());
        }
    }
    if (arguments.merge.empty()) {
        if (!arguments.file.empty()) return {};
        return fail(ErrorCode::Usage, "Give a jobs file, or the folder of a batch with --merge.",
                    "JOBS.toml");
    }
    for (const auto& [given, option] : {std::pair(!arguments.file.empty(), "JOBS.toml"),
                                        std::pair(!arguments.out.empty(), "--out"),
                                        std::pair(!arguments.shard.empty(), "--shard"),
                                        std::pair(arguments.dry_run, "--dry-run")}) {
        if (!given) continue;
        return fail(ErrorCode::Usage,
                    "--merge takes only the folder of a batch; leave the jobs file out.", option);
    }
    return {};
}

Result<ExitCode> runBatch(const BatchArguments& arguments, const Session& session) {
    if (Status status = checkUsage(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (!arguments.merge.empty()) return mergeBatch(arguments);
    Shard shard;
    if (!arguments.shard.empty()) {
        const Result<Shard> parsed = batch::parseShard(arguments.shard);
        if (!parsed) return tl::unexpected(parsed.error());
        shard = *parsed;
    }
    Result<BatchOrder> order = batch::readJobsFile(arguments.file);
    if (!order) return tl::unexpected(std::move(order.error()));
    BatchList all{batch::jobsOf(*order), order->require};
    for (std::size_t i = 0; i < order->require.size(); ++i) {
        if (Status status = batch::checkRequirements({order->require[i]}, all.jobs); !status) {
            return fail(ErrorCode::BadInput, status.error().message, order->require_places[i]);
        }
    }
    all.require.insert(all.require.end(), arguments.require.begin(), arguments.require.end());
    if (Status status = batch::checkRequirements(all.require, all.jobs); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (arguments.out.empty() && order->out.empty()) {
        return fail(ErrorCode::Usage,
                    "Give the folder for the datasets with --out, or with 'out' in the file.",
                    "--out");
    }
    const Result<batch::RunSettings> settings = settingsFor(arguments, *order, session);
    if (!settings) return tl::unexpected(settings.error());
    std::vector<Job> jobs;
    std::copy_if(all.jobs.begin(), all.jobs.end(), std::back_inserter(jobs),
                 [&](const Job& job) { return shard.has(job); });
    if (arguments.dry_run) return listJobs(jobs, *settings, arguments.as_json, session.job());
    if (Status status = batch::claimBatchFolder(settings->folder, all); !status) {
        return tl::unexpected(std::move(status.error()));
    }

    const JobContext job = session.job().stage(0.0, 1.0, "jobs");
    std::vector<batch::JobResult> results = batch::runJobs(jobs, *settings, job);
    Report report{order->file.stem().string(), settings->folder, settings->folder, all.require,
                  batch::evaluateResults(jobs, std::move(results), all.require)};
    if (shard.count > 1) {
        report.title += fmt::format(", part {} of {}", shard.index, shard.count);
        report.folder /= fmt::format("{}/{}-of-{}", kShards, shard.index, shard.count);
    }
    if (Status status = batch::writeReport(report); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    if (job.cancelled()) {
        const auto done = std::count_if(
            report.rows.begin(), report.rows.end(),
            [](const auto& row) { return row.result.state == batch::JobState::Done; });
        return fail(
            ErrorCode::Cancelled,
            fmt::format(
                "the batch was stopped; {} of {} jobs are done, and the same command resumes it",
                done, report.rows.size()));
    }
    print(report, arguments.as_json);
    return exitCodeOf(report);
}

}  // namespace

void addBatchCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "batch", "Export many scenes with many settings, each in its own process");
    auto arguments = std::make_shared<BatchArguments>();
    command
        ->add_option("jobs", arguments->file,
                     "Jobs file (TOML; the guide on batches has an example)")
        ->type_name("JOBS.toml");
    command->add_option("--out", arguments->out, "Folder of the batch; overrides 'out' in the file")
        ->type_name("DIR");
    command->add_option("-j,--jobs", arguments->parallel, "Jobs at a time; they share the threads")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    command
        ->add_option("--timeout", arguments->timeout_s,
                     "Stop a job that takes longer; overrides the file; 0: never")
        ->check(CLI::Range(0.0, 1e9).description("0 .. 1e9"))
        ->type_name("SECONDS");
    command
        ->add_option("--shard", arguments->shard,
                     "Only every n-th job, starting with job i (0 .. n-1): one machine's share")
        ->type_name("i/n");
    command
        ->add_option("--require", arguments->require,
                     "A job is good only if its metric meets this condition, as in "
                     "'well_captured_rate>=0.8'; repeatable")
        ->type_name("CONDITION")
        ->allow_extra_args(false);
    command->add_flag("--resume", arguments->resume, "Resume unfinished jobs (the default)");
    command->add_flag("--dry-run", arguments->dry_run, "List the jobs and what remains to be done");
    command
        ->add_option("--merge", arguments->merge,
                     "Merge the results of all shards in a batch's folder")
        ->type_name("DIR");
    command->add_flag("--json", arguments->as_json, "Print the summary as JSON");
    command->footer(
        "Finished jobs are skipped, interrupted ones resumed; jobs restart if their settings,\n"
        "scene file or labels have changed (textures and models are not checked).\n"
        "The folder gets summary.json, junit.xml, index.html and a folder for each job.\n"
        "Exit code: 0 all jobs are good, 3 some are not, 4 the jobs file cannot be used.\n"
        "Example: dollytrack batch rooms.toml --jobs 4 --timeout 3600");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runBatch(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
