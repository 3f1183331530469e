#include "render/formats/labels/yolo.h"

#include "engine/core/name_pattern.h"
#include "render/dataset/contents/frame_context.h"
#include "render/dataset/contents/frame_folds.h"
#include "render/encoders/pack.h"
#include "render/formats/labels/mask_outline.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace dollytrack::render {
namespace {

constexpr std::array<const char*, 4> kYoloFiles = {"data.yaml", "classes.txt", "train.txt",
                                                   "val.txt"};
/// Readers replace `images` by `labels` in an image's path.
constexpr std::array<const char*, 3> kYoloFolders = {"labels", "labels_seg", "images"};

std::string pictureName(int frame) {
    return frameFile(kYoloFolders[2], frame);
}

/// Training and validation frames: the first fold, or the first of five if none are configured.
Fold splitOf(const DatasetContents& contents) {
    constexpr int kUsual = 5;
    const bool asked = contents.folds.count > 1;
    for (int count = asked ? contents.folds.count : kUsual; count > 1; --count) {
        Result<FrameFolds> split = splitFrames(
            contents.frames, {count, asked ? contents.folds.seed : FoldSettings{}.seed});
        if (split) return std::move(split->folds.front());
    }
    // A trajectory too short to hold frames back together with their neighbours.
    Fold fold;
    const int frames = static_cast<int>(contents.frames.size());
    const int held_back = std::max(1, frames / kUsual);
    for (int i = 0; i < frames; ++i) {
        (i < frames - held_back ? fold.train : fold.val).push_back(i);
    }
    if (fold.train.empty()) fold.train = fold.val;
    return fold;
}

/// An image list; readers resolve names that begin with "./" relative to the list's folder.
std::string listOf(const std::vector<int>& frames) {
    std::string text;
    for (const int frame : frames) text += fmt::format("./{}\n", pictureName(frame));
    return text;
}

std::vector<std::uint8_t> asBytes(const std::string& text) {
    return {text.begin(), text.end()};
}

/// A name as YAML scalar. Names that YAML would read as something else are quoted as in JSON, which
/// YAML accepts.
std::string yamlText(const std::string& name) {
    constexpr std::array<std::string_view, 9> kWords = {"y",  "n",   "yes",   "no",  "true",
                                                        "on", "off", "false", "null"};
    const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const bool plain =
        isLetter(name.front()) && name.back() != ' ' &&
        std::ranges::find(kWords, inSmallLetters(name)) == kWords.end() &&
        std::ranges::all_of(name, [&](char c) {
            return isLetter(c) || (c >= '0' && c <= '9') || c == ' ' || c == '_' || c == '-';
        });
    return plain ? name : nlohmann::json(name).dump();
}

/// The object's largest visible part, because a line holds one polygon.
const Outline* largest(const std::vector<Outline>& outlines) {
    const Outline* best = nullptr;
    double best_area = 0.0;
    for (const Outline& outline : outlines) {
        double doubled = 0.0;
        for (std::size_t i = 0; i < outline.corners.size(); ++i) {
            const Eigen::Vector2d a = outline.corners[i].cast<double>();
            const Eigen::Vector2d b =
                outline.corners[(i + 1) % outline.corners.size()].cast<double>();
            doubled += a.x() * b.y() - a.y() * b.x();
        }
        if (!outline.hole && doubled > best_area) {
            best = &outline;
            best_area = doubled;
        }
    }
    return best;
}

Result<std::vector<FrameFile>> encodeYolo(const FrameContext& context, const FrameRecord& frame) {
    std::string boxes, outlines;
    const ClassTable& classes = context.contents.scene.classes();
    const double width = frame.width;
    const double height = frame.height;
    for (const ObjectMask& mask : objectMasks(frame.width, frame.height, frame.instance)) {
        const Object& object = context.contents.scene.object(mask.object_id);
        const DatasetClass* of = classes.boxClassOf(object);
        if (object.role != Role::Target || of == nullptr) continue;
        const int number = classes.indexOf(*of);
        const auto& [x, y, w, h] = mask.bbox;
        boxes += fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", number, (x + 0.5 * w) / width,
                             (y + 0.5 * h) / height, w / width, h / height);
        const auto parts = outlinesOfCounts(frame.width, frame.height, mask.counts);
        const Outline* outline = largest(parts);
        if (outline == nullptr) continue;
        outlines += std::to_string(number);
        for (const Eigen::Vector2i& corner : outline->corners) {
            outlines += fmt::format(" {:.6f} {:.6f}", corner.x() / width, corner.y() / height);
        }
        outlines += '\n';
    }
    std::vector<FrameFile> files;
    files.push_back({frameFile(kYoloFolders[0], frame.index, ".txt"), asBytes(boxes)});
    files.push_back({frameFile(kYoloFolders[1], frame.index, ".txt"), asBytes(outlines)});
    return files;
}

Result<std::vector<DatasetFile>> writeYolo(const DatasetContents& contents) {
    // Without a `path` line, readers look beside this file wherever the dataset is.
    std::string yaml = fmt::format("train: {}\nval: {}\nnames:\n", kYoloFiles[2], kYoloFiles[3]);
    std::string classes;
    const ClassTable& table = contents.scene.classes();
    for (const DatasetClass& one : table.classes()) {
        yaml += fmt::format("  {}: {}\n", table.indexOf(one), yamlText(one.name));
        classes += one.name + "\n";
    }
    const Fold split = splitOf(contents);
    return std::vector<DatasetFile>{{kYoloFiles[0], std::move(yaml)},
                                    {kYoloFiles[1], std::move(classes)},
                                    {kYoloFiles[2], listOf(split.train)},
                                    {kYoloFiles[3], listOf(split.val)}};
}

nlohmann::ordered_json yoloConvention(const DatasetContents& contents) {
    const bool nyu40 = contents.scene.classes().isNyu40();
    return {{"files", kYoloFiles},
            {"folders", kYoloFolders},
            {"format",
             fmt::format("YOLO: class ({}) and, as fractions of the image size, the box's centre "
                         "and size (labels) or the outline of the object's largest visible part "
                         "(labels_seg); targets only; train.txt and val.txt are the first fold of "
                         "--folds (default: of five); images are hard links to those of rgb",
                         nyu40 ? "NYU40 - 1" : "index in classes without void")}};
}

}  // namespace

PictureLinks yoloPictures(const DatasetContents& contents) {
    PictureLinks links;
    for (int i = 0; i < static_cast<int>(contents.frames.size()); ++i) {
        links[pictureName(i)] = frameFile("rgb", i);
    }
    return links;
}

const Format kYoloFormat = {
    .name = "yolo",
    .text = "boxes and outlines of the targets in YOLO's format, in labels and labels_seg",
    .group = ContentGroup::Labels,
    .files = kYoloFiles,
    .folders = kYoloFolders,
    .write = writeYolo,
    .encode = encodeYolo,
    .convention = yoloConvention,
    .modality = "rgb",
    .bytes_per_pixel = 0.25,
    .outlines_things = true,
};

}  // namespace dollytrack::render
