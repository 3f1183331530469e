#include "app/gather/layouts/shard_layout.h"
#include "app/gather/layouts/tar_header.h"
#include "render/verify/read/flow_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iterator>
#include <utility>
#include <vector>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kTarEnd = 2 * kTarBlock;  // an archive ends with two empty blocks

/// The contents of a frame's files by extension: "png", "depth.png", "json".
using FrameMembers = std::vector<std::pair<std::string, std::string>>;

/// A frame's JSON. Masks are already JSON and are inserted unchanged.
/// @param class_names  as JSON
std::string describeFrame(const OpenedSource& source, std::size_t frame, const ClassUnion& classes,
                          const std::vector<std::string>& class_names) {
    const verify::StoredFrame& stored = source.dataset.frames[frame];
    const Intrinsics& lens = source.dataset.lens;
    const Eigen::Vector3d& p = stored.pose.position;
    const Eigen::Quaterniond& q = stored.pose.rotation;
    std::string text =
        Json({{"source", source.source.name},
              {"frame", frame},
              {"width", lens.width},
              {"height", lens.height},
              {"intrinsics", {{"fx", lens.fx}, {"fy", lens.fy}, {"cx", lens.cx}, {"cy", lens.cy}}},
              {"time_s", stored.time_s},
              {"position", {p.x(), p.y(), p.z()}},
              {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}})
            .dump();
    text.pop_back();  // removes the closing bracket, because the objects follow
    text += R"(,"objects":[)";
    const char* separator = "";
    for (const Annotation& one : source.annotations[frame]) {
        fmt::format_to(
            std::back_inserter(text),
            R"({}{{"bbox":[{},{},{},{}],"category":{},"category_id":{},"name":{},"area":{},)"
            R"("object_id":{},"segmentation":{}}})",
            separator, one.box[0], one.box[1], one.box[2], one.box[3], one.class_index,
            classes.classes()[one.class_index].id, class_names[one.class_index], one.area,
            one.object_id, one.segmentation);
        separator = ",";
    }
    return text + "]}";
}

/// The extensions of a frame's files of a modality, and their names in the dataset.
std::vector<std::pair<std::string, std::string>> filesByExtension(
    const verify::StoredDataset& dataset, const std::string& modality, std::size_t frame) {
    if (modality == kPicture) return {{"png", frameFileOf(dataset, modality, frame)}};
    if (modality == kTracks) return {};
    if (modality != kSceneFlow) {
        return {{modality + ".png", frameFileOf(dataset, modality, frame)}};
    }
    const int from = static_cast<int>(frame);
    std::vector<std::pair<std::string, std::string>> files;
    for (const verify::FlowFile& file : verify::pairFiles(dataset, modality, from)) {
        files.emplace_back(fmt::format("{}_{}.exr", modality, file.other - from),
                           file.stem + ".exr");
    }
    return files;
}

/// A frame's key and files.
struct WebDatasetSample {
    std::string key;
    FrameMembers members;
};

/// Tar files of frames; the arrays of point tracks, which belong to many frames, are files beside
/// them.
class WebDatasetLayout : public ShardLayout<WebDatasetSample> {
  public:
    explicit WebDatasetLayout(LayoutInput layout_input) : ShardLayout(std::move(layout_input)) {
        for (const GatheredClass& one : input().classes.classes()) {
            class_names_.push_back(nlohmann::json(one.name).dump());
        }
    }

    Status beginPart(PartIndex part) override {
        kept_.clear();
        return ShardLayout::beginPart(part);
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        if (input().modalities.contains(kTracks)) {
            if (Status copied = copyTracks(source, begin, end); !copied) return copied;
        }
        return ShardLayout::add(source, begin, end);
    }

    Status endPart() override {
        if (Status ended = ShardLayout::endPart(); !ended) return ended;
        for (const FinishedShard& shard : kept_) {
            if (Status listed = ShardLayout::keep(shard); !listed) return listed;
        }
        return {};
    }

  private:
    [[nodiscard]] Status copyTracks(const OpenedSource& source, std::size_t begin,
                                    std::size_t end) {
        std::vector<FileCopy> files;
        for (std::size_t frame = begin; frame < end; ++frame) {
            for (const std::string& name : frameFilesOf(source.dataset, kTracks, frame)) {
                files.push_back({name, source.source.name + "_" + name.substr(name.find('/') + 1)});
            }
        }
        if (files.empty()) return {};
        return input().files.copyFiles(source, files, fmt::format("{}/{}", kTracks, part()),
                                       input().job);
    }

    /// Listed after the part's tracks, so that the list of a resumed run has the same order.
    [[nodiscard]] Status keep(const FinishedShard& shard) override {
        kept_.push_back(shard);
        return {};
    }

    [[nodiscard]] std::string shardName(std::size_t shard) const override {
        return fmt::format("{}-{:06}.tar", part(), shard);
    }

    [[nodiscard]] Status read(const OpenedSource& source, std::size_t frame,
                              WebDatasetSample& sample) const override {
        sample.key = source.frameName(frame);
        std::size_t members = 0;
        const auto addMember = [&](std::string extension) -> std::string& {
            if (members == sample.members.size()) sample.members.emplace_back();
            auto& [of_member, content] = sample.members[members++];
            of_member = std::move(extension);
            return content;
        };
        for (const std::string& modality : input().modalities) {
            for (auto& [extension, name] : filesByExtension(source.dataset, modality, frame)) {
                std::string& content = addMember(std::move(extension));
                if (Status proven = readProven(source.file(name), content); !proven) return proven;
            }
        }
        addMember("json") = describeFrame(source, frame, input().classes, class_names_);
        sample.members.resize(members);
        return {};
    }

    [[nodiscard]] std::uint64_t bytesWith(const WebDatasetSample& sample) const override {
        std::uint64_t bytes = file().size() + kTarEnd;
        for (const auto& [ending, content] : sample.members) bytes += tarBytes(content.size());
        return bytes;
    }

    [[nodiscard]] Status append(const WebDatasetSample& sample) override {
        Status status;
        for (const auto& [ending, content] : sample.members) {
            const auto header = tarHeader(sample.key + "." + ending, content.size());
            if (status) status = file().write(std::string_view(header.data(), header.size()));
            if (status) status = file().write(content);
            const std::size_t padding = tarBytes(content.size()) - kTarBlock - content.size();
            if (status) status = file().write(std::string(padding, '\0'));
        }
        return status;
    }

    [[nodiscard]] Status endFile() override { return file().write(std::string(kTarEnd, '\0')); }

    std::vector<FinishedShard> kept_;       // of the part
    std::vector<std::string> class_names_;  // as JSON
};

/// What the dataset's README.md says about images besides the colour image.
std::string webDatasetImagesText(const std::set<std::string>& modalities) {
    std::string text = labelImagesText(modalities, ".png");
    const bool has_instances = modalities.contains(kInstance);
    if (has_instances)
        text += "The value of an object's pixels in `instance.png` is its `object_id`. ";
    if (has_instances || modalities.contains(kDepth)) {
        text += fmt::format(
            "Without `only`, webdataset would turn the 16-bit images into 8-bit colours; "
            "`cv2.imdecode(np.frombuffer(sample[\"{}.png\"], np.uint8), -1)` decodes them. ",
            modalities.contains(kDepth) ? kDepth : kInstance);
    }
    if (modalities.contains(kSceneFlow)) {
        text += "`scene_flow_1.exr` is the 3D motion to the next frame. ";
    }
    if (modalities.contains(kTracks)) {
        text += "`tracks/PART` contains point tracks as NumPy arrays. ";
    }
    return text;
}

constexpr std::array<const char*, 2> kWebDatasetExtra = {kSceneFlow, kTracks};

}  // namespace

const LayoutKind kWebDatasetLayout = {
    .name = "webdataset",
    .text =
        "tar files of similar size, in which each frame is KEY.png, KEY.depth.png ..., KEY.json",
    .content = LayoutContent::Shared,
    .tasks = kMaskTasks,
    .make = makeLayout<WebDatasetLayout>,
    .labels = kBoxesAndMasks,
    .how_to_read =
        "`webdataset.WebDataset(\"train-000000.tar\").decode(\"pil\", only=[\"png\", \"json\"])` "
        "reads a tar file; `datasets.load_dataset(\".\", streaming=True)` all of them. `png` is "
        "the "
        "colour image. `json` has the camera (`intrinsics`, `position`, `quaternion_xyzw`) and "
        "`objects`: `bbox` is x, y, width, height in px, `category` the class's number in the "
        "table "
        "below, `object_id` a number that an object has in all frames of its source, and "
        "`segmentation` the mask in COCO's compressed run lengths.",
    .how_to_read_modalities = webDatasetImagesText,
    .data_files = "{}-*.tar",
    .extra = kWebDatasetExtra,
};

}  // namespace dollytrack::gather
