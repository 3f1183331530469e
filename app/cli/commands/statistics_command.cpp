#include "app/cli/command_line.h"
#include "app/cli/export/room_exports.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/terminal/output_file.h"
#include "app/gather/sources/source_search.h"
#include "app/statistics/dataset_statistics.h"
#include "app/statistics/statistics_page.h"
#include "engine/core/log.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <set>
#include <utility>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;
using statistics::DatasetStatistics;

struct StatisticsArguments {
    std::vector<std::string> folders;
    std::string out;  // empty: beside the first dataset
    bool overwrite = false;
    bool as_json = false;
};

/// Later datasets of a name are called "name (2)", "name (3)" and so on: paths would differ between
/// machines and reveal where the datasets lie.
void makeNamesUnique(std::vector<DatasetStatistics>& datasets) {
    std::set<std::string> names;
    for (DatasetStatistics& dataset : datasets) {
        const std::string name = dataset.name;
        for (int number = 2; !names.insert(dataset.name).second; ++number) {
            dataset.name = fmt::format("{} ({})", name, number);
        }
    }
}

Result<std::vector<DatasetStatistics>> collectAll(const std::vector<std::string>& folders,
                                                  const JobContext& job) {
    const std::size_t examples = statistics::kMostExamples / folders.size();
    std::vector<DatasetStatistics> datasets;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const auto dataset = verify::readStoredDataset(folders[i]);
        if (!dataset) return tl::unexpected(dataset.error());
        const auto share = [&](std::size_t done) {
            return static_cast<double>(done) / static_cast<double>(folders.size());
        };
        auto collected = statistics::collectStatistics(
            *dataset, examples, job.stage(share(i), share(i + 1), "reading"));
        if (!collected) return tl::unexpected(collected.error());
        if (collected->images_unreadable > 0) {
            log::warn("statistics",
                      fmt::format("{}: missing or damaged images: {}; 'dollytrack verify' names "
                                  "them.",
                                  folders[i], collected->images_unreadable));
        }
        datasets.push_back(std::move(*collected));
    }
    makeNamesUnique(datasets);
    return datasets;
}

Result<ExitCode> runStatistics(StatisticsArguments arguments, const Session& session) {
    arguments.folders =
        gather::withoutFilesBesideFolders(std::move(arguments.folders), "statistics");
    if (arguments.folders.size() > statistics::kMostDatasets) {
        return fail(
            ErrorCode::Usage,
            fmt::format(
                "{} datasets were given; at most {} can be compared on one page: give fewer, "
                "or make several pages.",
                arguments.folders.size(), statistics::kMostDatasets),
            "datasets");
    }
    for (const std::string& folder : arguments.folders) {
        if (const Status status = refuseRooms(folder); !status) {
            return tl::unexpected(status.error());
        }
    }
    const fs::path file = arguments.out.empty()
                              ? fileBeside(arguments.folders[0], "-statistics.html")
                              : fs::path(arguments.out);
    const Result<GuardedFolder> folder = openPageFolder(file, arguments.overwrite);
    if (!folder) return tl::unexpected(folder.error());
    const auto datasets = collectAll(arguments.folders, session.job());
    if (!datasets) return tl::unexpected(datasets.error());
    const std::string page = statistics::statisticsPage(*datasets);
    const Status written = folder->write(file.filename().string(), page);
    if (!written) return tl::unexpected(written.error());
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(statistics::statisticsJson(*datasets)));
        return kDone;
    }
    std::size_t frames = 0;
    std::size_t boxes = 0;
    for (const DatasetStatistics& dataset : *datasets) {
        frames += dataset.frames;
        boxes += dataset.boxes;
    }
    fmt::print("{}: {:.2f} MB, {} dataset{}, {} frames, {} boxes\n", file.string(),
               static_cast<double>(page.size()) / 1e6, datasets->size(),
               datasets->size() == 1 ? "" : "s", frames, boxes);
    return kDone;
}

}  // namespace

void addStatisticsCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "statistics", "Make one web page of the numbers of a dataset, or compare several");
    auto arguments = std::make_shared<StatisticsArguments>();
    command
        ->add_option("datasets", arguments->folders,
                     fmt::format("Folders of datasets, at most {}", statistics::kMostDatasets))
        ->required()
        ->type_name("DIR");
    command
        ->add_option(
            "-o,--out", arguments->out,
            "File name of the page; default: DATASET-statistics.html beside the first dataset")
        ->type_name("FILE");
    command->add_flag("--overwrite", arguments->overwrite, "Replace a file of that name");
    command->add_flag("--json", arguments->as_json, "Also print the numbers as JSON");
    command->footer(
        "The page is one file below 2 MB without scripts. It shows boxes, objects and captures by\n"
        "class, distributions of box sizes, distances, camera motion, depth and brightness, and\n"
        "example frames. Several datasets share the axes of the charts; tables show differences\n"
        "from the first. Visible fraction and truncation need instances.csv, which 'export' "
        "writes\n"
        "with --formats coco,camera_json,frames,imu,instances. The same datasets give the same "
        "bytes.\n"
        "Example: dollytrack statistics dataset other_dataset -o page.html");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runStatistics(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
