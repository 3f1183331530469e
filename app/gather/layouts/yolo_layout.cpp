#include "app/gather/layouts/layout.h"

#include "engine/core/log.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace dollytrack::gather {
namespace {

/// Readers find labels by replacing `images` by `labels` in an image's path.
class YoloLayout : public Layout {
  public:
    explicit YoloLayout(LayoutInput input) : input_(std::move(input)) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        return {};
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        std::vector<std::pair<std::string, std::string>> labels;
        const double width = source.dataset.lens.width;
        const double height = source.dataset.lens.height;
        for (std::size_t frame = begin; frame < end; ++frame) {
            std::string text;
            for (const Annotation& one : source.annotations[frame]) {
                const auto& [x, y, w, h] = one.box;
                text += fmt::format("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", one.class_index,
                                    (x + 0.5 * w) / width, (y + 0.5 * h) / height, w / width,
                                    h / height);
            }
            labels.emplace_back(source.frameName(frame) + ".txt", std::move(text));
        }
        Status status =
            input_.files.copyPictures(source, begin, end, "images/" + part_, input_.job);
        return status ? input_.files.write("labels/" + part_, labels) : status;
    }

    Status endPart() override { return {}; }

    Status finish(std::span<const PartIndex> parts) override {
        // Without a line `path`, paths are relative to this file, wherever the dataset is. Readers
        // require `val` even if there is none.
        std::string yaml;
        const bool has_val = std::ranges::count(parts, PartIndex{1}) > 0;
        for (const PartIndex part : parts) {
            yaml += fmt::format("{}: images/{}\n", kParts[part], kParts[part]);
            if (part == 0 && !has_val) {
                yaml += fmt::format("val: images/{}  # the training images: there is no part val\n",
                                    kParts[0]);
                log::warn("gather",
                          "data.yaml: there is no validation part, so 'val' names the training "
                          "images; '--split by-room 80/10/10' makes one of several scenes");
            }
        }
        yaml += fmt::format("nc: {}\nnames:\n", input_.classes.classes().size());
        int number = 0;
        for (const GatheredClass& one : input_.classes.classes()) {
            yaml += fmt::format("  {}: {}\n", number++, nlohmann::json(one.name).dump());
        }
        return input_.files.write("data.yaml", yaml);
    }

  private:
    LayoutInput input_;
    std::string part_;
};

}  // namespace

const LayoutKind kYoloLayout = {
    .name = "yolo",
    .text = "images in images/, boxes in labels/, and data.yaml, for Ultralytics",
    .content = LayoutContent::Colour,
    .tasks = kBoxTasks,
    .make = makeLayout<YoloLayout>,
    .labels = kBoxes,
    .how_to_read =
        "Train YOLO with `data.yaml`: `yolo detect train data=data.yaml`. Each line of a file in "
        "`labels/` has a class number and the box's centre and size as fractions of the image "
        "size.",
    .data_files = nullptr,
};

}  // namespace dollytrack::gather
