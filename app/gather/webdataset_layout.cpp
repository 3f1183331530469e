#include "app/gather/layout.h"
#include "app/gather/tar_header.h"
#include "engine/jobs/parallel.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

/// The contents of a frame's files by extension: "png", "depth.png", "json".
using FrameMembers = std::vector<std::pair<std::string, std::string>>;

/// A frame's JSON. Masks are already JSON and are inserted unchanged.
std::string describeFrame(const OpenedSource& source, std::size_t frame,
                          const ClassUnion& classes) {
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
    std::string objects;
    for (const Annotation& one : source.annotations[frame]) {
        const GatheredClass& of = classes.classes()[one.class_index];
        objects += fmt::format(
            R"({}{{"bbox":[{},{},{},{}],"category":{},"category_id":{},"name":{},"area":{},)"
            R"("object_id":{},"segmentation":{}}})",
            objects.empty() ? "" : ",", one.box[0], one.box[1], one.box[2], one.box[3],
            one.class_index, of.id, nlohmann::json(of.name).dump(), one.area, one.object_id,
            one.segmentation);
    }
    return text + fmt::format(R"(,"objects":[{}]}})", objects);
}

class WebDatasetLayout : public Layout {
  public:
    explicit WebDatasetLayout(LayoutInput input) : input_(std::move(input)) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        shard_ = 0;
        to_pass_ = 0;
        return passFinished();
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        const std::size_t passed = std::min(to_pass_, end - begin);
        to_pass_ -= passed;
        begin += passed;
        std::vector<Result<FrameMembers>> frames(end - begin, FrameMembers());
        Status appended;
        // One thread writes and hashes the previous frames while the others read.
        parallelFor(frames.size() + 1, [&](std::size_t i) {
            if (i == 0) {
                appended = appendWaiting();
            } else if (!input_.job.cancelled()) {
                frames[i - 1] = membersOf(source, begin + i - 1);
            }
        });
        if (!appended) return appended;
        for (std::size_t i = 0; i < frames.size() && !input_.job.cancelled(); ++i) {
            if (!frames[i]) return tl::unexpected(frames[i].error());
            waiting_.emplace_back(source.frameName(begin + i), std::move(*frames[i]));
        }
        return {};
    }

    Status endPart() override {
        if (Status appended = appendWaiting(); !appended) return appended;
        return file_ ? endShard() : Status();
    }

  private:
    [[nodiscard]] std::string shardName() const {
        return fmt::format("{}-{:06}.tar", part_, shard_);
    }

    /// Keeps the shards of an interrupted run up to the first missing or damaged one.
    Status passFinished() {
        for (;; ++shard_) {
            const std::string name = shardName();
            const auto done = std::ranges::find(input_.finished, name, &FinishedShard::name);
            if (done == input_.finished.end()) return {};
            if (sha256Within(input_.files.folder(), name, input_.job) != done->sha256) return {};
            to_pass_ += done->frames;
            if (Status status = input_.files.list(name, done->sha256); !status) return status;
        }
    }

    Result<FrameMembers> membersOf(const OpenedSource& source, std::size_t frame) const {
        FrameMembers members;
        for (const std::string& modality : input_.modalities) {
            Result<std::string> bytes = readProven(source.file(modality, frame));
            if (!bytes) return tl::unexpected(bytes.error());
            members.emplace_back(modality == kPicture ? "png" : modality + ".png",
                                 std::move(*bytes));
        }
        members.emplace_back("json", describeFrame(source, frame, input_.classes));
        return members;
    }

    Status appendWaiting() {
        Status status;
        for (const auto& [key, members] : waiting_) {
            if (status) status = append(key, members);
        }
        waiting_.clear();
        return status;
    }

    Status append(const std::string& key, const FrameMembers& members) {
        std::uint64_t bytes = 0;
        for (const auto& [ending, content] : members) bytes += tarBytes(content.size());
        constexpr std::uint64_t kEnd = 2 * kTarBlock;
        const ShardLimits& limits = input_.shards;
        if (file_ && (file_->size() + bytes + kEnd > limits.bytes ||
                      (limits.frames > 0 && frames_ >= limits.frames))) {
            if (Status status = endShard(); !status) return status;
        }
        if (!file_) {
            Result<HashingFileWriter> file =
                HashingFileWriter::create(input_.files.folder(), shardName());
            if (!file) return tl::unexpected(file.error());
            file_.emplace(std::move(*file));
            frames_ = 0;
        }
        Status status;
        for (const auto& [ending, content] : members) {
            const auto header = tarHeader(key + "." + ending, content.size());
            if (status) status = file_->write(std::string_view(header.data(), header.size()));
            if (status) status = file_->write(content);
            const std::size_t padding = tarBytes(content.size()) - kTarBlock - content.size();
            if (status) status = file_->write(std::string(padding, '\0'));
        }
        ++frames_;
        return status;
    }

    Status endShard() {
        if (Status status = file_->write(std::string(2 * kTarBlock, '\0')); !status) return status;
        Result<std::string> sha256 = file_->finish();
        if (!sha256) return tl::unexpected(sha256.error());
        file_.reset();
        const FinishedShard shard{shardName(), frames_, std::move(*sha256)};
        ++shard_;
        if (Status status = input_.files.list(shard.name, shard.sha256); !status) return status;
        return input_.on_shard(shard);
    }

    LayoutInput input_;
    std::string part_;
    std::size_t shard_ = 0;    // number within the part
    std::size_t frames_ = 0;   // in the current shard
    std::size_t to_pass_ = 0;  // frames in finished shards, to be skipped
    std::vector<std::pair<std::string, FrameMembers>> waiting_;  // frames read but not yet written
    std::optional<HashingFileWriter> file_;
};

}  // namespace

const LayoutKind kWebDatasetLayout = {
    .name = "webdataset",
    .text =
        "tar files of similar size, in which each frame is KEY.png, KEY.depth.png ..., KEY.json",
    .every_modality = true,
    .make = [](LayoutInput input) -> std::unique_ptr<Layout> {
        return std::make_unique<WebDatasetLayout>(std::move(input));
    },
    .how_to_read =
        "`webdataset.WebDataset(\"train-000000.tar\").decode(\"pil\")` reads a tar file; "
        "`datasets.load_dataset(\".\", streaming=True)` all of them. `png` is the colour image; "
        "`depth.png`, `instance.png` and `semantic.png` have the same pixels; `json` has boxes, "
        "masks, camera and pose.",
    .data_files = "{}-*.tar",
};

}  // namespace dollytrack::gather
