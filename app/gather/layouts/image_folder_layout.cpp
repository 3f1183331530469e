#include "app/gather/layouts/layout.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

class ImageFolderLayout : public Layout {
  public:
    explicit ImageFolderLayout(LayoutInput input) : input_(std::move(input)) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        Result<HashingFileWriter> file =
            HashingFileWriter::create(input_.files.folder(), fileName());
        if (!file) return tl::unexpected(file.error());
        rows_.emplace(std::move(*file));
        return {};
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        Status status = input_.files.copyPictures(source, begin, end, part_, input_.job);
        for (std::size_t frame = begin; status && frame < end; ++frame) {
            status = rows_->write(rowOf(source, frame).dump() + "\n");
        }
        return status;
    }

    Status endPart() override {
        const Result<std::string> sha256 = rows_->finish();
        if (!sha256) return tl::unexpected(sha256.error());
        rows_.reset();
        return input_.files.list(fileName(), *sha256);
    }

  private:
    [[nodiscard]] std::string fileName() const { return part_ + "/metadata.jsonl"; }

    static Json rowOf(const OpenedSource& source, std::size_t frame) {
        Json boxes = Json::array();
        Json categories = Json::array();
        Json areas = Json::array();
        Json ids = Json::array();
        for (const Annotation& one : source.annotations[frame]) {
            boxes.push_back(one.box);
            categories.push_back(one.class_index);
            areas.push_back(one.area);
            ids.push_back(one.object_id);
        }
        return {{"file_name", pictureNameOf(source, frame)},
                {"width", source.source.width},
                {"height", source.source.height},
                {"source", source.source.name},
                {"frame", frame},
                {"objects",
                 {{"bbox", std::move(boxes)},
                  {"categories", std::move(categories)},
                  {"area", std::move(areas)},
                  {"object_id", std::move(ids)}}}};
    }

    LayoutInput input_;
    std::string part_;
    std::optional<HashingFileWriter> rows_;
};

}  // namespace

const LayoutKind kImageFolderLayout = {
    .name = "imagefolder",
    .text = "one folder of images per part with metadata.jsonl, for Hugging Face's imagefolder",
    .content = LayoutContent::Colour,
    .tasks = kBoxTasks,
    .make = makeLayout<ImageFolderLayout>,
    .labels = kBoxes,
    .how_to_read =
        "`datasets.load_dataset(\"imagefolder\", data_dir=\".\")` reads it. `objects` "
        "has boxes (x, y, width, height, px) and their class numbers.",
    .data_files = "{}/**",
};

}  // namespace dollytrack::gather
