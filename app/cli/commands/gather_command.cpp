#include "app/cli/command_line.h"
#include "app/cli/plan/metrics_table.h"
#include "app/gather/gather.h"
#include "engine/core/clean_text.h"
#include "engine/core/name_pattern.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <charconv>
#include <optional>
#include <string>
#include <vector>

namespace dollytrack::cli {
namespace {

using gather::GatherOrder;

struct GatherArguments {
    GatherOrder order;
    std::string layout;
    std::vector<std::string> split;
    std::string class_map;
    std::string shard_size;
    std::string out;
    bool as_json = false;
};

/// The number of bytes of a text such as "500MB"; nullopt if it is not a size.
std::optional<std::uint64_t> bytesOf(const std::string& text) {
    double number = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string unit = inSmallLetters(std::string(read.ptr, text.data() + text.size()));
    const double factor = unit == "kb" ? 1e3 : unit == "mb" ? 1e6 : unit == "gb" ? 1e9 : 0.0;
    constexpr double kMost = 1e13;
    const double bytes = number * factor;
    if (read.ec != std::errc() || !(bytes >= 1.0) || !(bytes <= kMost)) return std::nullopt;
    return static_cast<std::uint64_t>(bytes);
}

Status readGatherArguments(GatherArguments& arguments) {
    GatherOrder& order = arguments.order;
    for (const gather::LayoutKind* kind : gather::layouts()) {
        if (arguments.layout == kind->name) order.layout = kind;
    }
    std::vector<std::string>& split = arguments.split;
    // An argument after '--split none' that is not a list of shares is a dataset.
    if (split.size() > 1 && !gather::looksLikeShares(split[1])) {
        const bool is_number =
            std::ranges::all_of(split[1], [](char c) { return c >= '0' && c <= '9'; });
        if (split[0] == "by-room" && is_number && !std::filesystem::is_directory(split[1])) {
            return fail(ErrorCode::Usage, "Give the shares as one argument, as in 80/10/10.",
                        fmt::format("--split {} {}", split[0], split[1]));
        }
        order.datasets.insert(order.datasets.begin(), split[1]);
        split.pop_back();
    }
    const std::string kind = split.empty() ? "none" : split[0];
    Result<gather::SplitOrder> parsed = gather::parseSplit(kind, split.size() > 1 ? split[1] : "");
    if (!parsed) return tl::unexpected(parsed.error());
    const std::uint64_t seed = order.split.seed;
    order.split = *parsed;
    order.split.seed = seed;
    const std::optional<std::uint64_t> bytes =
        arguments.shard_size.empty() ? order.layout->shard_bytes : bytesOf(arguments.shard_size);
    if (!bytes) {
        return fail(ErrorCode::Usage,
                    "A size is a number with the unit kB, MB or GB, such as 500MB or 1GB.",
                    "--shard-size " + arguments.shard_size);
    }
    order.shards.bytes = *bytes;
    if (order.datasets.empty()) {
        return fail(ErrorCode::Usage, "Give the folders of the datasets.", "datasets");
    }
    if (!arguments.class_map.empty()) {
        Result<gather::ClassMap> map = gather::readClassMap(arguments.class_map);
        if (!map) return tl::unexpected(map.error());
        order.class_map = std::move(*map);
    }
    order.title = cleanText(order.title);  // cleaned, because it is written into JSON and YAML
    order.license = cleanText(order.license);
    order.out = arguments.out;
    order.product_version = DOLLYTRACK_VERSION;
    return {};
}

nlohmann::json summaryJsonOf(const GatherArguments& arguments,
                             const gather::GatherSummary& summary) {
    nlohmann::json parts = nlohmann::json::object();
    for (gather::PartIndex part = 0; part < gather::kParts.size(); ++part) {
        const gather::PartSummary& one = summary.parts[part];
        if (one.datasets == 0) continue;
        parts[gather::kParts[part]] = {{"datasets", one.datasets},
                                       {"scenes", one.scenes},
                                       {"frames", one.frames},
                                       {"annotations", one.annotations}};
    }
    nlohmann::json skipped = nlohmann::json::array();
    for (const gather::SkippedDataset& one : summary.skipped) {
        skipped.push_back({{"dataset", one.folder}, {"reason", one.why}});
    }
    return {{"out", arguments.out},          {"format", arguments.layout},
            {"classes", summary.classes},    {"parts", std::move(parts)},
            {"skipped", std::move(skipped)}, {"was_complete", summary.was_complete}};
}

void printGathered(const GatherArguments& arguments, const gather::GatherSummary& summary) {
    if (summary.was_complete) {
        fmt::print("{} is complete and its files are undamaged.\n", arguments.out);
        return;
    }
    fmt::print("{}: {} classes\n\n  {:<6} {:>9} {:>11} {:>8} {:>9}\n", arguments.out,
               summary.classes, "part", "frames", "boxes", "scenes", "datasets");
    for (gather::PartIndex part = 0; part < gather::kParts.size(); ++part) {
        const gather::PartSummary& one = summary.parts[part];
        if (one.datasets == 0) continue;
        fmt::print("  {:<6} {:>9} {:>11} {:>8} {:>9}\n", gather::kParts[part], one.frames,
                   one.annotations, one.scenes, one.datasets);
    }
    if (!summary.skipped.empty()) {
        fmt::print("\n{} left out, unfinished or damaged\n", summary.skipped.size());
    }
}

Result<ExitCode> runGather(GatherArguments& arguments, const Session& session) {
    if (Status status = readGatherArguments(arguments); !status) {
        return tl::unexpected(std::move(status.error()));
    }
    const auto summary = gather::gatherDatasets(arguments.order, session.job());
    if (!summary) return tl::unexpected(summary.error());
    if (arguments.as_json) {
        fmt::print("{}\n", jsonText(summaryJsonOf(arguments, *summary)));
    } else {
        printGathered(arguments, *summary);
    }
    return kDone;
}

void addGatherOptions(CLI::App& command, GatherArguments& arguments) {
    GatherOrder& order = arguments.order;
    std::vector<std::string> names;
    for (const gather::LayoutKind* kind : gather::layouts()) names.emplace_back(kind->name);
    command.add_option("--format", arguments.layout, "Layout of the files")
        ->required()
        ->transform(CLI::IsMember(names, CLI::ignore_case))
        ->type_name("NAME");
    command
        .add_option("--split", arguments.split,
                    "'none' (default), or 'by-room' with the shares of train, val and test in % "
                    "(80/10/10): each scene goes to one part")
        ->expected(1, 2)
        ->allow_extra_args(false)
        ->type_name("KIND [SHARES]");
    command.add_option("--seed", order.split.seed, "Random seed of the split")
        ->capture_default_str();
    command
        .add_option("--class-map", arguments.class_map,
                    "New class names: JSON {\"from\": \"to\"} or lines 'from,to'; also merges "
                    "class tables that contradict each other")
        ->type_name("FILE");
    command.add_flag("--mixed-lenses", order.mixed_lenses,
                     "Datasets may have different focal lengths; sizes must agree");
    command
        .add_option("--shard-size", arguments.shard_size,
                    "Largest file of webdataset (default 1GB) and parquet (default 500MB)")
        ->type_name("SIZE");
    command
        .add_option("--shard-frames", order.shards.frames,
                    "Most frames of such a file; 0: any number")
        ->capture_default_str()
        ->check(CLI::Range(0, 100'000'000).description(""));
    command
        .add_option("--license", order.license,
                    "Licence in README.md, as Hugging Face names it: cc-by-4.0")
        ->type_name("NAME");
    command.add_option("--title", order.title, "Title in README.md")
        ->type_name("TEXT")
        ->capture_default_str();
    command.add_flag(
        "--hard-links", order.hard_links,
        "Make hard links to the datasets' images, if on the same disk, instead of copies");
    command.add_flag("--skip-damaged", order.skip_damaged,
                     "Leave out unfinished and damaged datasets; reads all files first");
    command.add_flag("--resume", order.resume, "Resume an interrupted run with the same arguments");
    command.add_flag("--overwrite", order.overwrite,
                     "Replace a complete gathered dataset once the new one is complete, and files "
                     "with the same names; other files are kept");
    command.add_flag("--json", arguments.as_json, "Print the summary as JSON");
}

}  // namespace

void addGatherCommand(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("gather", "Merge exported datasets into one for publication");
    auto arguments = std::make_shared<GatherArguments>();
    arguments->order.title = "Indoor scenes";
    command
        ->add_option("datasets", arguments->order.datasets,
                     "Datasets, folders that contain datasets, batch folders, or quoted patterns")
        ->type_name("DIR");
    command->add_option("--out", arguments->out, "Folder for the result; created if missing")
        ->required()
        ->check([](const std::string& folder) {
            return folder.empty() ? "The name of the folder is empty." : "";
        })
        ->type_name("DIR");
    addGatherOptions(*command, *arguments);
    command->footer(
        "Datasets need the modality rgb and the format coco, which 'export' writes by default;\n"
        "bop also needs the modality depth and the format bop, tartanair the format tartanair.\n"
        "Files are copied unchanged, and each copy is checked by its hash. The result has "
        "README.md\n"
        "(a dataset card for Hugging Face), gather.json (sources, parts, classes), SHA256SUMS\n"
        "and, if datasets have licences, LICENSES.\n"
        "Datasets with other image sizes, conventions or contradicting class tables are refused.\n"
        "Example: dollytrack gather datasets --out published --format yolo --split by-room "
        "80/10/10");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runGather(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
