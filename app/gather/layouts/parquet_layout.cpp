#include "app/gather/layouts/parquet_writer.h"
#include "app/gather/layouts/shard_layout.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ParquetField::Kind;

/// Contents of one row of the table, read but not yet written.
struct ParquetRow {
    std::string name;
    std::string source;
    std::string scene;
    std::size_t frame = 0;
    Intrinsics lens;
    double time_s = 0.0;
    Pose pose;
    std::vector<std::string> images;  // of each modality
    std::vector<Annotation> objects;
};

/// A column of values, in the schema and for Hugging Face.
struct ParquetColumnKind {
    const char* name;
    ParquetField field;
    Json feature;
};

ParquetField listOf(ParquetField element) {
    element.name = "element";
    return {"", Kind::List, {std::move(element)}};
}

Json featureOf(const char* type) {
    return {{"dtype", type}, {"_type", "Value"}};
}

Json sequenceOf(Json feature, int length = -1) {
    Json sequence = {{"feature", std::move(feature)}, {"_type", "Sequence"}};
    if (length >= 0) sequence["length"] = length;
    return sequence;
}

/// The column of a modality's images.
std::string imageColumn(const std::string& modality) {
    return modality == kPicture ? "image" : modality;
}

ParquetColumnKind imageColumnKind(const char* name) {
    return {name,
            {"", Kind::Group, {{"bytes", Kind::Bytes}, {"path", Kind::Text}}},
            {{"_type", "Image"}}};
}

std::vector<ParquetColumnKind> objectColumns(const ClassUnion& classes) {
    Json names = Json::array();
    for (const GatheredClass& one : classes.classes()) names.push_back(one.name);
    return {{"id", listOf({"", Kind::Int64}), sequenceOf(featureOf("int64"))},
            {"bbox", listOf(listOf({"", Kind::Float})),
             sequenceOf(sequenceOf(featureOf("float32"), 4))},
            {"category", listOf({"", Kind::Int64}),
             sequenceOf({{"names", std::move(names)}, {"_type", "ClassLabel"}})},
            {"area", listOf({"", Kind::Int64}), sequenceOf(featureOf("int64"))},
            {"object_id", listOf({"", Kind::Int32}), sequenceOf(featureOf("int32"))},
            {"segmentation", listOf({"", Kind::Text}), sequenceOf(featureOf("string"))}};
}

std::vector<ParquetColumnKind> columnsOf(const LayoutInput& input) {
    std::vector<ParquetColumnKind> columns = {imageColumnKind("image")};
    for (const char* modality : {kDepth, kInstance, kSemantic}) {
        if (input.modalities.contains(modality)) columns.push_back(imageColumnKind(modality));
    }
    columns.push_back({"image_id", {"", Kind::Int64}, featureOf("int64")});
    columns.push_back({"width", {"", Kind::Int32}, featureOf("int32")});
    columns.push_back({"height", {"", Kind::Int32}, featureOf("int32")});
    columns.push_back({"source", {"", Kind::Text}, featureOf("string")});
    columns.push_back({"scene", {"", Kind::Text}, featureOf("string")});
    columns.push_back({"frame", {"", Kind::Int32}, featureOf("int32")});
    columns.push_back({"timestamp", {"", Kind::Double}, featureOf("float64")});
    columns.push_back({"pose", listOf({"", Kind::Double}), sequenceOf(featureOf("float64"), 16)});
    columns.push_back(
        {"intrinsics", listOf({"", Kind::Double}), sequenceOf(featureOf("float64"), 4)});
    ParquetColumnKind objects{"objects", {"", Kind::Group}, Json::object()};
    for (ParquetColumnKind& one : objectColumns(input.classes)) {
        one.field.name = one.name;
        objects.field.children.push_back(std::move(one.field));
        objects.feature[one.name] = std::move(one.feature);
    }
    columns.push_back(std::move(objects));
    return columns;
}

/// Files of a table of frames, named as those on the Hugging Face Hub. Their names contain their
/// number, so each part's files are renamed when the part ends.
class ParquetLayout : public ShardLayout<ParquetRow> {
  public:
    explicit ParquetLayout(LayoutInput input) : ShardLayout(std::move(input)) {
        Json features = Json::object();
        for (ParquetColumnKind& column : columnsOf(this->input())) {
            features[column.name] = std::move(column.feature);
            column.field.name = column.name;
            fields_.push_back(std::move(column.field));
        }
        const Json info = {{"info", {{"features", std::move(features)}}}};
        metadata_ = {{"huggingface", info.dump()}};
    }

    Status beginPart(PartIndex part) override {
        kept_.clear();
        if (Status undone = undoRenaming(kParts[part]); !undone) return undone;
        return ShardLayout::beginPart(part);
    }

    Status endPart() override {
        if (Status ended = ShardLayout::endPart(); !ended) return ended;
        const GuardedFolder& folder = input().files.folder();
        for (std::size_t i = 0; i < kept_.size(); ++i) {
            const std::string name = finalName(part(), i, kept_.size());
            const Result<bool> moved = folder.move(kept_[i].name, folder, name);
            if (!moved) return tl::unexpected(moved.error());
            if (Status listed = input().files.list(name, kept_[i].sha256); !listed) return listed;
        }
        return {};
    }

  private:
    static std::string finalName(const std::string& part, std::size_t shard, std::size_t count) {
        return fmt::format("data/{}-{:05}-of-{:05}.parquet", part, shard, count);
    }

    static std::string temporaryName(const std::string& part, std::size_t shard) {
        return fmt::format("data/{}-{:05}.parquet", part, shard);
    }

    /// Undoes the renaming by an earlier run that was interrupted after it finished the part. Files
    /// of that run must not stay beside those of this one.
    Status undoRenaming(const std::string& part) {
        const GuardedFolder& folder = input().files.folder();
        if (!folder.has("data")) return {};
        const Result<std::vector<std::string>> names = folder.list("data");
        if (!names) return tl::unexpected(names.error());
        for (const std::string& name : *names) {
            const std::string numbers = name.substr(std::min(name.size(), part.size() + 1));
            std::size_t shard = 0;
            if (std::from_chars(numbers.data(), numbers.data() + numbers.size(), shard).ec !=
                    std::errc() ||
                !name.starts_with(part + "-") || numbers.find("-of-") == std::string::npos) {
                continue;
            }
            const Result<bool> moved =
                folder.move("data/" + name, folder, temporaryName(part, shard));
            if (!moved) return tl::unexpected(moved.error());
        }
        return {};
    }

    [[nodiscard]] std::string shardName(std::size_t shard) const override {
        return temporaryName(part(), shard);
    }

    void skip(const OpenedSource& source, std::size_t frame) override {
        ++image_id_;
        object_id_ += source.annotations[frame].size();
    }

    [[nodiscard]] Status read(const OpenedSource& source, std::size_t frame,
                              ParquetRow& row) const override {
        const verify::StoredFrame& stored = source.dataset.frames[frame];
        row.name = source.frameName(frame);
        row.source = source.source.name;
        row.scene = source.source.scene;
        row.frame = frame;
        row.lens = source.dataset.lens;
        row.time_s = stored.time_s;
        row.pose = stored.pose;
        row.objects = source.annotations[frame];
        row.images.resize(input().modalities.size());
        std::size_t number = 0;
        for (const std::string& modality : input().modalities) {
            const SourceFile file = source.file(frameFileOf(source.dataset, modality, frame));
            if (Status proven = readProven(file, row.images[number++]); !proven) return proven;
        }
        return {};
    }

    [[nodiscard]] std::uint64_t bytesWith(const ParquetRow& row) const override {
        constexpr std::uint64_t kRowBytes = 500;     // all values of fixed size
        constexpr std::uint64_t kObjectBytes = 100;  // the same, with levels
        std::uint64_t bytes = kRowBytes + row.source.size() + row.scene.size();
        for (const std::string& image : row.images) bytes += image.size() + row.name.size();
        for (const Annotation& one : row.objects) bytes += kObjectBytes + one.segmentation.size();
        return table_->mostBytes(bytes);
    }

    [[nodiscard]] Status beginFile() override {
        table_ = std::make_unique<ParquetWriter>(
            fields_, metadata_, [this](std::string_view bytes) { return file().write(bytes); });
        return {};
    }

    [[nodiscard]] Status append(const ParquetRow& row) override {
        ParquetWriter& table = *table_;
        std::size_t number = 0;
        for (const std::string& modality : input().modalities) {
            table.column(imageColumn(modality) + ".bytes").addBytes(row.images[number++]);
            const char* ending = modality == kPicture ? "" : ".";
            table.column(imageColumn(modality) + ".path")
                .addBytes(fmt::format("{}{}{}.png", row.name, ending,
                                      modality == kPicture ? "" : modality));
        }
        table.column("image_id").addInteger(static_cast<std::int64_t>(++image_id_));
        table.column("width").addInteger(row.lens.width);
        table.column("height").addInteger(row.lens.height);
        table.column("source").addBytes(row.source);
        table.column("scene").addBytes(row.scene);
        table.column("frame").addInteger(static_cast<std::int64_t>(row.frame));
        table.column("timestamp").addNumber(row.time_s);
        ParquetColumn& pose = table.column("pose");
        pose.beginList();
        const Eigen::Matrix4d matrix = row.pose.worldFromCamera().matrix();
        for (const double value : matrix.transpose().reshaped()) pose.addNumber(value);
        pose.endList();
        ParquetColumn& intrinsics = table.column("intrinsics");
        intrinsics.beginList();
        for (const double value : {row.lens.fx, row.lens.fy, row.lens.cx, row.lens.cy}) {
            intrinsics.addNumber(value);
        }
        intrinsics.endList();
        appendObjects(row);
        return table.endRow();
    }

    void appendObjects(const ParquetRow& row) {
        const auto addList = [&](const char* name, const auto& add) {
            ParquetColumn& column = table_->column(name);
            column.beginList();
            for (const Annotation& one : row.objects) add(column, one);
            column.endList();
        };
        addList("objects.id", [&](ParquetColumn& column, const Annotation& /*one*/) {
            column.addInteger(static_cast<std::int64_t>(++object_id_));
        });
        addList("objects.bbox", [](ParquetColumn& column, const Annotation& one) {
            column.beginList();
            for (const int value : one.box) column.addNumber(value);
            column.endList();
        });
        addList("objects.category", [](ParquetColumn& column, const Annotation& one) {
            column.addInteger(static_cast<std::int64_t>(one.class_index));
        });
        addList("objects.area",
                [](ParquetColumn& column, const Annotation& one) { column.addInteger(one.area); });
        addList("objects.object_id", [](ParquetColumn& column, const Annotation& one) {
            column.addInteger(one.object_id);
        });
        addList("objects.segmentation", [](ParquetColumn& column, const Annotation& one) {
            column.addBytes(one.segmentation);
        });
    }

    [[nodiscard]] Status endFile() override { return table_->finish(); }

    /// Listed under its final name when the part ends.
    [[nodiscard]] Status keep(const FinishedShard& shard) override {
        kept_.push_back(shard);
        return {};
    }

    std::vector<ParquetField> fields_;
    std::map<std::string, std::string> metadata_;
    std::unique_ptr<ParquetWriter> table_;  // in the open shard
    std::vector<FinishedShard> kept_;       // of the part
    std::size_t image_id_ = 0;              // both unique across all parts
    std::size_t object_id_ = 0;
};

/// What the dataset's README.md says about images besides the colour image.
std::string parquetImagesText(const std::set<std::string>& modalities) {
    std::string text = labelImagesText(modalities, "");
    if (modalities.contains(kInstance)) {
        text += "The value of an object's pixels in `instance` is its `object_id`. ";
    }
    return text;
}

}  // namespace

const LayoutKind kParquetLayout = {
    .name = "parquet",
    .text = "Parquet files for the Hugging Face Hub: a table of frames with images and objects",
    .content = LayoutContent::Shared,
    .tasks = kMaskTasks,
    .make = makeLayout<ParquetLayout>,
    .labels = kBoxesAndMasks,
    .how_to_read =
        "`datasets.load_dataset(\".\")` reads it. `image` is the colour image. `objects` has boxes "
        "(x, y, width, height, px), class numbers, `object_id`, a number that an object has in all "
        "frames of its source, and masks (JSON of COCO's compressed run lengths). `pose` is "
        "world_from_camera, a 4 x 4 matrix by rows, and `intrinsics` is fx, fy, cx, cy.",
    .how_to_read_modalities = parquetImagesText,
    .data_files = "data/{}-*",
    .shard_bytes = 500'000'000,
};

}  // namespace dollytrack::gather
