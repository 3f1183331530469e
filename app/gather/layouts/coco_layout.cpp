#include "app/gather/layouts/layout.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

// Annotations come after all images in the file, so they are collected in this temporary file.
constexpr const char* kWaiting = "annotations/.waiting";

class CocoLayout : public Layout {
  public:
    explicit CocoLayout(LayoutInput input) : input_(std::move(input)) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        Result<HashingFileWriter> file =
            HashingFileWriter::create(input_.files.folder(), fileName());
        if (!file) return tl::unexpected(file.error());
        Result<HashingFileWriter> waiting =
            HashingFileWriter::create(input_.files.folder(), kWaiting);
        if (!waiting) return tl::unexpected(waiting.error());
        images_.emplace(std::move(*file));
        annotations_.emplace(std::move(*waiting));
        images_in_part_ = 0;
        annotations_in_part_ = 0;
        Json categories = Json::array();
        for (const GatheredClass& one : input_.classes.classes()) {
            // Readers require the key; a class without a supercategory is its own.
            const std::string& above = one.supercategory.empty() ? one.name : one.supercategory;
            categories.push_back({{"id", one.id}, {"name", one.name}, {"supercategory", above}});
        }
        return images_->write(fmt::format(
            "{{\"info\": {{\"description\": \"Dollytrack dataset\", \"version\": \"1.0\"}},\n"
            "\"licenses\": [],\n\"categories\": {},\n\"images\": [",
            categories.dump()));
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        Status status = input_.files.copyPictures(source, begin, end, part_, input_.job);
        for (std::size_t frame = begin; status && frame < end; ++frame) {
            status = addFrame(source, frame);
        }
        return status;
    }

    Status endPart() override {
        if (Status status = images_->write("\n],\n\"annotations\": ["); !status) return status;
        if (Status status = appendAnnotations(); !status) return status;
        if (Status status = images_->write("\n]}\n"); !status) return status;
        const Result<std::string> sha256 = images_->finish();
        if (!sha256) return tl::unexpected(sha256.error());
        images_.reset();
        return input_.files.list(fileName(), *sha256);
    }

  private:
    [[nodiscard]] std::string fileName() const {
        return fmt::format("annotations/instances_{}.json", part_);
    }

    Status addFrame(const OpenedSource& source, std::size_t frame) {
        ++image_id_;  // unique across all parts
        Status status = images_->write(
            fmt::format("{}\n{{\"id\": {}, \"file_name\": {}, \"width\": {}, \"height\": {}}}",
                        images_in_part_++ == 0 ? "" : ",", image_id_,
                        nlohmann::json(pictureNameOf(source, frame)).dump(), source.source.width,
                        source.source.height));
        for (const Annotation& one : source.annotations[frame]) {
            if (!status) return status;
            const GatheredClass& of = input_.classes.classes()[one.class_index];
            status = annotations_->write(fmt::format(
                "{}\n{{\"id\": {}, \"image_id\": {}, \"category_id\": {}, \"iscrowd\": 0, "
                "\"area\": {}, \"bbox\": [{}, {}, {}, {}], \"segmentation\": {}, \"object_id\": "
                "{}}}",
                annotations_in_part_++ == 0 ? "" : ",", ++annotation_id_, image_id_, of.id,
                one.area, one.box[0], one.box[1], one.box[2], one.box[3], one.segmentation,
                one.object_id));
        }
        return status;
    }

    Status appendAnnotations() {
        if (const auto ended = annotations_->finish(); !ended) return tl::unexpected(ended.error());
        annotations_.reset();
        const Result<InputFile> waiting = input_.files.folder().openInput(kWaiting);
        if (!waiting) return tl::unexpected(waiting.error());
        std::string piece(std::size_t{1} << 20U, '\0');
        std::uint64_t at = 0;
        while (const std::size_t got = waiting->read(at, piece.data(), piece.size())) {
            if (Status status = images_->write(std::string_view(piece).substr(0, got)); !status) {
                return status;
            }
            at += got;
        }
        if (at != waiting->size()) {
            return fail(ErrorCode::CannotWrite, "the file cannot be read back",
                        (input_.files.folder().path() / kWaiting).string());
        }
        return input_.files.folder().remove(kWaiting);
    }

    LayoutInput input_;
    std::string part_;
    std::optional<HashingFileWriter> images_;  // the annotation file of the part
    std::optional<HashingFileWriter> annotations_;
    std::size_t images_in_part_ = 0;
    std::size_t annotations_in_part_ = 0;
    std::size_t image_id_ = 0;
    std::size_t annotation_id_ = 0;
};

}  // namespace

const LayoutKind kCocoLayout = {
    .name = "coco",
    .text =
        "one folder of images per part, and annotations/instances_PART.json with boxes and masks",
    .content = LayoutContent::Colour,
    .tasks = kMaskTasks,
    .make = makeLayout<CocoLayout>,
    .labels = kBoxesAndMasks,
    .how_to_read =
        "`pycocotools.coco.COCO(\"annotations/instances_train.json\")` reads boxes and masks "
        "(compressed run lengths); `file_name` is an image in `train/`. Image and annotation ids "
        "are unique across all parts.",
    .data_files = nullptr,
};

}  // namespace dollytrack::gather
