#include "render/formats/tables/fold_files.h"

#include "engine/io/files/durable_file.h"
#include "render/formats/labels/coco.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace dollytrack::render {

Result<std::vector<DatasetFile>> foldFiles(const DatasetContents& contents,
                                           const FormatSet& formats) {
    const Result<FrameFolds> split = splitFrames(contents.frames, contents.folds);
    if (!split) return tl::unexpected(split.error());
    const bool coco = std::any_of(formats.begin(), formats.end(), [](const Format* format) {
        return std::string_view(format->name) == "coco";
    });
    std::vector<DatasetFile> files;
    const auto add = [&](std::size_t fold, const char* part, const std::vector<int>& frames) {
        const std::string name = fmt::format("{}/fold_{}_{}", kFoldFolder, fold, part);
        std::string list;
        for (const int index : frames) list += contents.pictureFile(index) + "\n";
        files.push_back({name + ".txt", std::move(list)});
        if (coco) files.push_back({name + ".json", cocoText(contents, frames)});
    };
    for (std::size_t i = 0; i < split->folds.size(); ++i) {
        add(i, "train", split->folds[i].train);
        add(i, "val", split->folds[i].val);
    }
    return files;
}

nlohmann::ordered_json foldConvention(const DatasetContents& contents) {
    const Result<FrameFolds> split = splitFrames(contents.frames, contents.folds);
    const bool by_room = split && split->by_room;
    nlohmann::ordered_json json = {
        {"folder", kFoldFolder},
        {"count", contents.folds.count},
        {"seed", contents.folds.seed},
        {"split_by", by_room ? "room" : "block"},
        {"format",
         "one image path per line; every frame is in one fold_K_val; the other frames of fold K "
         "are in fold_K_train, except those left out"}};
    if (!by_room) {
        json["left_out"] = {{"closer_s", kFoldGuard_s},
                            {"closer_m", kFoldGuard_m},
                            {"turned_less_deg", kFoldGuard_deg}};
    }
    return json;
}

bool isFoldFile(std::string_view name) {
    constexpr std::string_view kStart = "fold_";
    name = completedName(name);
    if (!name.starts_with(kStart)) return false;
    name.remove_prefix(kStart.size());
    const std::size_t digits = name.find_first_not_of("0123456789");
    if (digits == 0 || digits == std::string_view::npos) return false;
    name.remove_prefix(digits);
    return name == "_train.txt" || name == "_train.json" || name == "_val.txt" ||
           name == "_val.json";
}

}  // namespace dollytrack::render
