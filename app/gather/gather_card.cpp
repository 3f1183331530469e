#include "app/gather/gather_card.h"

#include "app/gather/output/output_folder.h"
#include "engine/core/clean_lines.h"
#include "engine/core/clean_text.h"
#include "render/formats/tables/dataset_card.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

std::string quoted(const std::string& text) {
    return nlohmann::json(text).dump();
}

std::size_t allFrames(const GatherSummary& summary) {
    std::size_t frames = 0;
    for (const PartSummary& part : summary.parts) frames += part.frames;
    return frames;
}

/// Hugging Face's size category for a number of frames.
const char* sizeCategory(std::size_t frames) {
    if (frames < 1'000) return "n<1K";
    if (frames < 10'000) return "1K<n<10K";
    if (frames < 100'000) return "10K<n<100K";
    if (frames < 1'000'000) return "100K<n<1M";
    return frames < 10'000'000 ? "1M<n<10M" : "10M<n<100M";
}

/// The line `license: cc-by-4.0`; a text that is not an identifier becomes license_name of `other`.
std::string licenseLines(const std::string& license) {
    const auto isPlain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
    };
    if (license.empty()) return "license: unknown\n";
    if (std::ranges::all_of(license, isPlain)) return fmt::format("license: {}\n", license);
    return fmt::format("license: other\nlicense_name: {}\n", quoted(license));
}

std::vector<std::string> tasksOf(const GatherCard& card) {
    const auto of_layout = card.order.layout->tasks;
    std::vector<std::string> tasks(of_layout.begin(), of_layout.end());
    if (card.modalities.contains(kDepth)) tasks.emplace_back("depth-estimation");
    return tasks;
}

std::string headerOf(const GatherCard& card) {
    const GatherOrder& order = card.order;
    std::string text = "---\n" + licenseLines(order.license);
    text += fmt::format("pretty_name: {}\nsize_categories:\n- {}\ntask_categories:\n",
                        quoted(order.title), sizeCategory(allFrames(card.summary)));
    for (const std::string& task : tasksOf(card)) text += fmt::format("- {}\n", task);
    text += "tags:\n- synthetic\n- indoor\n- dollytrack\n";
    if (order.layout->data_files == nullptr) return text + "---\n";
    text += "configs:\n- config_name: default\n  data_files:\n";
    for (const PartIndex part : partsOf(card.part_of)) {
        text +=
            fmt::format("  - split: {}\n    path: {}\n", part == 1 ? "validation" : kParts[part],
                        quoted(fmt::format(fmt::runtime(order.layout->data_files), kParts[part])));
    }
    return text + "---\n";
}

/// " of 640 x 480 px"; empty if the sizes differ.
std::string sizeOf(std::span<const Source> sources) {
    const Source& first = sources.front();
    const bool is_common = std::ranges::all_of(sources, [&](const Source& one) {
        return one.width == first.width && one.height == first.height;
    });
    return is_common ? fmt::format(" of {} x {} px", first.width, first.height) : std::string();
}

std::string partTable(const GatherCard& card) {
    std::string text =
        "| part | frames | boxes | scenes | source datasets |\n|---|---|---|---|---|\n";
    for (const PartIndex part : partsOf(card.part_of)) {
        const PartSummary& one = card.summary.parts[part];
        text += fmt::format("| {} | {} | {} | {} | {} |\n", kParts[part], one.frames,
                            one.annotations, one.scenes, one.datasets);
    }
    return text;
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string classTable(const GatherCard& card) {
    const std::vector<PartIndex> parts = partsOf(card.part_of);
    std::string text = "| number | id | name |";
    std::string line = "|---|---|---|";
    for (const PartIndex part : parts) {
        text += fmt::format(" boxes in {} |", kParts[part]);
        line += "---|";
    }
    text += "\n" + line + "\n";
    std::size_t number = 0;
    std::size_t unused = 0;
    for (const GatheredClass& one : card.classes.classes()) {
        const bool is_used = std::ranges::any_of(parts, [&](PartIndex part) {
            const std::vector<std::size_t>& boxes = card.summary.parts[part].boxes_of_class;
            return number < boxes.size() && boxes[number] > 0;
        });
        if (!is_used) {
            ++unused;
            ++number;
            continue;
        }
        std::string name;
        for (const char c : one.name) name += c == '|' ? std::string("\\|") : std::string(1, c);
        text += fmt::format("| {} | {} | {} |", number, one.id, name);
        for (const PartIndex part : parts) {
            const std::vector<std::size_t>& boxes = card.summary.parts[part].boxes_of_class;
            text += fmt::format(" {} |", number < boxes.size() ? boxes[number] : 0);
        }
        text += "\n";
        ++number;
    }
    if (unused > 0) {
        text += fmt::format("\n{} without boxes {} in `gather.json` only.\n",
                            unused == 1 ? "1 class" : fmt::format("{} classes", unused),
                            unused == 1 ? "is" : "are");
    }
    return text;
}

std::string conventionList(const GatherCard& card) {
    std::string text;
    for (const auto& [name, value] : card.conventions.items()) {
        // The value is from dataset.json, and a line break in it would end the list.
        text += fmt::format("- `{}`: `{}`\n", name,
                            value.is_string() ? cleanText(value.get<std::string>()) : value.dump());
    }
    return text;
}

/// The section about LICENSES; empty if no dataset has licences.
std::string licensesSection(std::span<const Source> sources) {
    const auto without = static_cast<std::size_t>(
        std::ranges::count(sources, std::string(), &Source::licenses_sha256));
    if (without == sources.size()) return {};
    const std::string which = without == 0 ? "all source datasets"
                                           : fmt::format("{} of the {} source datasets",
                                                         sources.size() - without, sources.size());
    return fmt::format(
        "## Licences of the scenes\n\n[{0}]({0}) has the licence files of the scenes of {1}. They "
        "apply besides the licence of this card, and may require attribution.\n\n",
        render::kLicensesFile, which);
}

Json partJson(const GatherCard& card, PartIndex part) {
    const PartSummary& one = card.summary.parts[part];
    return {{"name", kParts[part]},
            {"frames", one.frames},
            {"annotations", one.annotations},
            {"scenes", one.scenes},
            {"datasets", one.datasets}};
}

/// Names of the image kinds and of the copied folders.
std::string imageList(const GatherCard& card) {
    std::vector<std::string> names(card.modalities.begin(), card.modalities.end());
    std::erase(names, kTracks);  // point tracks are no images of a frame
    for (const std::string_view copied : card.order.layout->copied) {
        const bool is_left_out = copied == "seg_left/" && !card.classes.keepsIds();
        if (copied.ends_with('/') && !is_left_out) {
            names.emplace_back(copied.substr(0, copied.size() - 1));
        }
    }
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::vector<PartIndex> partsOf(std::span<const PartIndex> part_of) {
    const std::set<PartIndex> parts(part_of.begin(), part_of.end());
    return {parts.begin(), parts.end()};
}

std::string gatherJson(const GatherCard& card) {
    const GatherOrder& order = card.order;
    Json root = {{"format", kGatherFormat},
                 {"format_version", 1},
                 {"product_version", order.product_version},
                 {"title", order.title},
                 {"license", order.license},
                 {"layout", order.layout->name},
                 {"modalities", card.modalities},
                 {"conventions", card.conventions}};
    root["split"] = {{"kind", order.split.by_room ? "by-room" : "none"},
                     {"shares", order.split.shares},
                     {"seed", order.split.seed}};
    Json parts = Json::array();
    for (const PartIndex part : partsOf(card.part_of)) parts.push_back(partJson(card, part));
    root["parts"] = std::move(parts);
    Json classes = Json::array();
    for (const GatheredClass& one : card.classes.classes()) {
        classes.push_back({{"number", classes.size()}, {"id", one.id}, {"name", one.name}});
    }
    root["classes"] = std::move(classes);
    if (order.class_map) root["class_map"] = *order.class_map;
    Json sources = Json::array();
    for (std::size_t i = 0; i < card.sources.size(); ++i) {
        const Source& one = card.sources[i];
        sources.push_back({{"name", one.name},
                           {"part", kParts[card.part_of[i]]},
                           {"frames", one.frames},
                           {"scene", one.scene},
                           {"scene_number", one.scene_number},
                           {"scene_sha256", one.scene_sha256},
                           {"geometry_sha256", one.geometry_sha256},
                           {"licenses_sha256", one.licenses_sha256},
                           {"dataset_json_sha256", one.card_sha256},
                           {"product_version", one.product_version},
                           {"missing_classes", card.classes.missingIn(one)}});
    }
    root["sources"] = std::move(sources);
    Json skipped = Json::array();
    for (const SkippedDataset& one : card.summary.skipped) skipped.push_back(one.name);
    root["skipped"] = std::move(skipped);
    root["files"] = {{"list", kSumsFile}, {"sha256", card.sums_sha256}};
    root["identity"] = card.identity;
    return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Status writeLicenses(std::span<const Source> sources, OutputFiles& files) {
    std::map<std::string, std::vector<std::string>> names;  // of datasets, by the text's hash
    for (const Source& one : sources) {
        if (!one.licenses_sha256.empty()) names[one.licenses_sha256].push_back(one.name);
    }
    if (names.empty()) return {};
    Result<HashingFileWriter> file =
        HashingFileWriter::create(files.folder(), render::kLicensesFile);
    if (!file) return tl::unexpected(file.error());
    Status status = file->write("The licence files of the scenes of these datasets.\n");
    for (const Source& one : sources) {
        const auto datasets = names.extract(one.licenses_sha256);
        if (!datasets) continue;  // none, or written already
        const Result<std::string> text = readProven(
            {one.folder / render::kLicensesFile, one.licenses_sha256}, render::kMostLicenseBytes);
        if (!text) return tl::unexpected(text.error());
        if (status) {
            status = file->write(fmt::format(
                "\n===== {} =====\n\n{}\n", fmt::join(datasets.mapped(), ", "), cleanLines(*text)));
        }
    }
    const Result<std::string> sha256 = file->finish();
    if (!status) return status;
    return sha256 ? files.list(render::kLicensesFile, *sha256) : tl::unexpected(sha256.error());
}

std::string readmeText(const GatherCard& card) {
    const GatherOrder& order = card.order;
    std::size_t scenes = 0;
    for (const PartSummary& part : card.summary.parts) scenes += part.scenes;
    std::string text = headerOf(card);
    text += fmt::format(
        "\n# {}\n\nImages of {} rendered with labels by Dollytrack {}: {} frames{} with {}. Merged "
        "from {} with `dollytrack gather --format {}`.\n\n",
        order.title, counted(scenes, "indoor scene"), order.product_version,
        allFrames(card.summary), sizeOf(card.sources), order.layout->labels,
        counted(card.sources.size(), "dataset"), order.layout->name);
    std::string reading = order.layout->how_to_read;
    if (order.layout->how_to_read_modalities != nullptr) {
        reading += " " + order.layout->how_to_read_modalities(card.modalities);
    }
    text += fmt::format("## Reading\n\n{}\n\n", trimmed(reading));
    text += fmt::format("## Parts\n\n{}\n{}\n\n", partTable(card),
                        order.split.by_room
                            ? fmt::format("Each scene, and so each room, is in only one part (seed "
                                          "{}). `gather.json` lists the part of each source.",
                                          order.split.seed)
                        : scenes > 1 ? "The dataset is not split; `dollytrack gather --split "
                                       "by-room 80/10/10` makes a split one."
                                     : "The dataset is not split.");
    text += fmt::format("## Images\n\nImages of each frame: {}.\n\n", imageList(card));
    text +=
        fmt::format("## Classes\n\n{}{}\n",
                    card.modalities.contains(kSemantic)
                        ? "Pixels of `semantic` images have the *id* below, not the *number*.\n\n"
                        : "",
                    classTable(card));
    text += fmt::format("## Conventions\n\n{}\n", conventionList(card));
    text += licensesSection(card.sources);
    text +=
        "## Files\n\n`gather.json` names the source datasets, their scenes, parts and hashes. "
        "`sha256sum -c SHA256SUMS` checks all other files.\n";
    return text;
}

}  // namespace dollytrack::gather
