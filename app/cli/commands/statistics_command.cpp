#include "app/batch/scene_files.h"
#include "app/cli/command_line.h"
#include "app/cli/plan/metrics_table.h"
#include "app/cli/terminal/output_file.h"
#include "app/gather/sources/source_search.h"
#include "app/statistics/dataset_statistics.h"
#include "app/statistics/statistics_page.h"
#include "app/view/even_frames.h"
#include "engine/core/log.h"
#include "render/dataset/folder/dataset_journal.h"
#include "render/dataset/folder/dataset_listing.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
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
    bool skip_damaged = false;
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

/// The datasets of a column of the page: one, or those of a folder, which are counted together.
using Column = std::vector<gather::FoundDataset>;

/// A dataset's own folder is a column of one, whatever its state.
Result<Column> columnOf(const std::string& argument) {
    std::error_code error;
    const fs::path folder(argument);
    const bool around = fs::is_directory(folder, error) &&
                        !fs::exists(folder / render::kCardFile, error) &&
                        !fs::exists(folder / render::kJournalFile, error) &&
                        !fs::exists(folder / gather::kGatherCard, error);
    if (around || batch::isPattern(argument)) {
        auto found = gather::findDatasets({argument});
        if (!found) return tl::unexpected(found.error());
        return *std::move(found);
    }
    return Column{{folder, cli::fileBeside(folder, "").filename().string()}};
}

Result<DatasetStatistics> collect(const gather::FoundDataset& found,
                                  const statistics::FrameSamples& samples, const JobContext& job) {
    const auto dataset = verify::readStoredDataset(found.folder);
    if (!dataset) return tl::unexpected(dataset.error());
    auto collected = statistics::collectStatistics(*dataset, samples, job);
    if (collected && collected->images_unreadable > 0) {
        log::warn("statistics",
                  fmt::format("{}: missing or damaged images: {}; 'dollytrack verify' names them.",
                              found.folder.string(), collected->images_unreadable));
    }
    return collected;
}

/// The numbers of a column, named like its argument. `examples` frames of it are shown.
Result<DatasetStatistics> collectColumn(const std::string& argument, const Column& column,
                                        std::size_t examples, bool skip_damaged,
                                        const JobContext& job) {
    const std::size_t count = column.size();
    if (count == 0) {  // a folder that leads only to itself
        return fail(ErrorCode::BadInput, "The folder contains no dataset.", argument);
    }
    const std::vector<int> shown = view::evenlySpaced(examples, count);
    const std::size_t measured = std::max<std::size_t>(1, statistics::kMostImages / count);
    std::optional<DatasetStatistics> sum;
    for (std::size_t i = 0; i < count; ++i) {
        const auto show = std::ranges::count(shown, static_cast<int>(i));
        const auto share = [&](std::size_t done) {
            return static_cast<double>(done) / static_cast<double>(count);
        };
        const statistics::FrameSamples samples = {measured, show == 0 ? 0 : examples / shown.size(),
                                                  share(i)};
        auto collected = collect(column[i], samples, job.stage(share(i), share(i + 1), "reading"));
        if (!collected && skip_damaged && collected.error().code == ErrorCode::BadInput) {
            log::warn("statistics", fmt::format("{}: left out: {}", column[i].folder.string(),
                                                collected.error().message));
            continue;
        }
        if (!collected) return collected;
        if (count > 1) {
            for (statistics::ExampleFrame& example : collected->examples) {
                example.dataset = column[i].name;
            }
        }
        if (!sum) {
            sum = std::move(*collected);
            if (count > 1) sum->name = cli::fileBeside(argument, "").filename().string();
            continue;
        }
        if (sum->width_px != collected->width_px || sum->height_px != collected->height_px) {
            return fail(ErrorCode::BadInput,
                        fmt::format("The images have {} x {} px, those of datasets before it {} x "
                                    "{}; datasets of one folder are counted together and need "
                                    "equal sizes: give them one by one.",
                                    collected->width_px, collected->height_px, sum->width_px,
                                    sum->height_px),
                        column[i].folder.string());
        }
        statistics::addStatistics(std::move(*collected), *sum);
    }
    if (!sum) {
        return fail(ErrorCode::BadInput, "The folder contains no complete dataset.", argument);
    }
    return *std::move(sum);
}

Result<std::vector<DatasetStatistics>> collectAll(const StatisticsArguments& arguments,
                                                  const JobContext& job) {
    const std::vector<std::string>& folders = arguments.folders;
    const std::size_t examples = statistics::kMostExamples / folders.size();
    std::vector<DatasetStatistics> datasets;
    for (std::size_t i = 0; i < folders.size(); ++i) {
        const auto share = [&](std::size_t done) {
            return static_cast<double>(done) / static_cast<double>(folders.size());
        };
        const Result<Column> column = columnOf(folders[i]);
        if (!column) return tl::unexpected(column.error());
        auto collected = collectColumn(folders[i], *column, examples, arguments.skip_damaged,
                                       job.stage(share(i), share(i + 1), "reading"));
        if (!collected) return tl::unexpected(collected.error());
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
                "{} folders were given; at most {} can be compared on one page: give fewer, or a "
                "folder that contains the datasets, which are then counted together.",
                arguments.folders.size(), statistics::kMostDatasets),
            "datasets");
    }
    const fs::path file = arguments.out.empty()
                              ? fileBeside(arguments.folders[0], "-statistics.html")
                              : fs::path(arguments.out);
    const Result<GuardedFolder> folder = openPageFolder(file, arguments.overwrite);
    if (!folder) return tl::unexpected(folder.error());
    const auto datasets = collectAll(arguments, session.job());
    if (!datasets) return tl::unexpected(datasets.error());
    const std::string page = statistics::statisticsPage(*datasets);
    const Status written = folder->write(file.filename().string(), page);
    if (!written) return tl::unexpected(written.error());
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(statistics::statisticsJson(*datasets)));
        return kDone;
    }
    std::size_t count = 0;
    std::size_t frames = 0;
    std::size_t boxes = 0;
    for (const DatasetStatistics& dataset : *datasets) {
        count += dataset.datasets;
        frames += dataset.frames;
        boxes += dataset.boxes;
    }
    fmt::print("{}: {:.2f} MB, {} dataset{}, {} frames, {} boxes\n", file.string(),
               static_cast<double>(page.size()) / 1e6, count, count == 1 ? "" : "s", frames, boxes);
    return kDone;
}

}  // namespace

void addStatisticsCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "statistics", "Make one web page of the numbers of a dataset, or compare several");
    auto arguments = std::make_shared<StatisticsArguments>();
    command
        ->add_option("datasets", arguments->folders,
                     fmt::format("Datasets, or folders and quoted patterns of datasets, which are "
                                 "counted together; at most {}",
                                 statistics::kMostDatasets))
        ->required()
        ->type_name("DIR");
    command
        ->add_option(
            "-o,--out", arguments->out,
            "File name of the page; default: DATASET-statistics.html beside the first dataset")
        ->type_name("FILE");
    command->add_flag("--overwrite", arguments->overwrite, "Replace a file of that name");
    command->add_flag("--skip-damaged", arguments->skip_damaged,
                      "Leave out unfinished and damaged datasets");
    command->add_flag("--json", arguments->as_json, "Also print the numbers as JSON");
    command->footer(
        "The page is one file below 2 MB without scripts. It shows boxes, objects and captures by\n"
        "class, distributions of box sizes, distances, camera motion, depth and brightness, and\n"
        "example frames. Several datasets share the axes of the charts; tables show differences\n"
        "from the first. The datasets within a folder or a batch count as one. Visible fraction "
        "and truncation need instances.csv, which 'export' "
        "writes\n"
        "with --formats coco,camera_json,frames,imu,instances. The same datasets give the same "
        "bytes.\n"
        "Example: dollytrack statistics dataset other_dataset -o page.html");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runStatistics(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
