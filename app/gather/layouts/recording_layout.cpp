#include "app/gather/layouts/layout.h"
#include "app/gather/layouts/ros_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace dollytrack::gather {
namespace {

/// A file of ROS messages per dataset.
class RecordingLayout : public Layout {
  public:
    RecordingLayout(LayoutInput input, const char* ending, CreateRosFile* create)
        : input_(std::move(input)), ending_(ending), create_(create) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        return {};
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        const std::string name = fmt::format("{}/{}{}", part_, source.source.name, ending_);
        if (begin == 0) {
            if (Status status = beginFile(source, name); !status) return status;
        }
        if (!recording_) return {};  // finished by an earlier run
        Status status = recording_->add(begin, end, input_.job);
        if (!status || end < source.source.frames || input_.job.cancelled()) return status;
        Result<std::string> sha256 = recording_->finish(input_.job);
        if (input_.job.cancelled()) return {};
        if (!sha256) return tl::unexpected(sha256.error());
        recording_.reset();
        if (Status listed = input_.files.list(name, *sha256); !listed) return listed;
        return input_.on_shard({name, end, std::move(*sha256)});
    }

    Status endPart() override { return {}; }

  private:
    /// Keeps the file of an earlier run if it is complete and undamaged.
    Status beginFile(const OpenedSource& source, const std::string& name) {
        const auto done = std::ranges::find(input_.finished, name, &FinishedShard::name);
        if (done != input_.finished.end() &&
            sha256Within(input_.files.folder(), name, input_.job) == done->sha256) {
            return input_.files.list(name, done->sha256);
        }
        Result<RosRecording> recording = RosRecording::begin(
            source, input_.classes, input_.modalities, create_, input_.files.folder(), name);
        if (!recording) return tl::unexpected(recording.error());
        recording_.emplace(std::move(*recording));
        return {};
    }

    LayoutInput input_;
    const char* ending_;  // of the files' names
    CreateRosFile* create_;
    std::string part_;
    std::optional<RosRecording> recording_;  // of the current dataset
};

constexpr std::array kRecordingTasks = {"robotics"};

Status checkSensors(const verify::StoredDataset& dataset) {
    const Result<RecordedSensors> sensors = readSensors(dataset);
    return sensors ? Status() : tl::unexpected(sensors.error());
}

}  // namespace

const LayoutKind kMcapLayout = {
    .name = "mcap",
    .text = "an MCAP file of ROS 2 messages per dataset, for Foxglove, Rerun and ROS 2",
    .content = LayoutContent::Everything,
    .tasks = kRecordingTasks,
    .make = [](LayoutInput input) -> std::unique_ptr<Layout> {
        return std::make_unique<RecordingLayout>(std::move(input), ".mcap", createMcapFile);
    },
    .labels = "the oriented boxes of all objects",
    .how_to_read =
        "Foxglove and Rerun open the files; `ros2 bag play -s mcap NAME.mcap` publishes the "
        "messages. "
        "`/tf` has the camera's poses in the frame `map`, `/objects` and `/moving_objects` the "
        "objects' oriented boxes; "
        "images are below `/camera`.",
    .data_files = nullptr,
    .check = checkSensors,
};

const LayoutKind kRosbagLayout = {
    .name = "rosbag",
    .text = "a bag file of ROS 1 messages per dataset",
    .content = LayoutContent::Everything,
    .tasks = kRecordingTasks,
    .make = [](LayoutInput input) -> std::unique_ptr<Layout> {
        return std::make_unique<RecordingLayout>(std::move(input), ".bag", createBagFile);
    },
    .labels = "the oriented boxes of all objects",
    .how_to_read =
        "`rosbag play NAME.bag` publishes the messages; Foxglove opens the files. "
        "`/tf` has the camera's poses in the frame `map`, `/objects` and `/moving_objects` the "
        "objects' oriented boxes; "
        "images are below `/camera`.",
    .data_files = nullptr,
    .check = checkSensors,
};

}  // namespace dollytrack::gather
