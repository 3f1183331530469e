#pragma once

#include "app/gather/layouts/ros_file.h"
#include "app/gather/layouts/ros_messages.h"
#include "app/gather/sources/class_union.h"
#include "app/gather/sources/opened_source.h"
#include "engine/core/result.h"
#include "render/verify/read/stored_rig.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace dollytrack::gather {

/// A camera of a recording. Its topics begin with its name.
struct RecordedCamera {
    std::string name;   // "/camera_left"
    std::string frame;  // "camera_left_optical_frame"
    std::optional<ros::CameraInfo> info;
    std::optional<std::size_t> rig_index;  // in RecordedSensors::rig, if it is of the rig
};

struct ImuSample {
    std::uint64_t time_ns = 0;
    std::array<double, 3> rate_rps = {};    // angular rate
    std::array<double, 3> force_mps2 = {};  // specific force
};

/// The cameras of a dataset, their times and the inertial measurements.
struct RecordedSensors {
    std::vector<std::uint64_t> times_ns;  // of the frames
    std::vector<RecordedCamera> cameras;  // the planned one first
    std::vector<verify::StoredCamera> rig;
    std::vector<ImuSample> imu;
};

/// Takes them from dataset.json and imu.csv. Error: BadInput where they cannot be recorded.
[[nodiscard]] Result<RecordedSensors> readSensors(const verify::StoredDataset& dataset);

/// A dataset as one file of ROS messages: its images, cameras, poses, inertial measurements
/// and boxes. Frames are "map" (the dataset's world: z up, m), "camera_optical_frame" and those of
/// the other cameras, all with x right, y down, z forward. Times are those of dataset.json in ns.
class RosRecording {
  public:
    /// Creates the file by `create` and writes what does not depend on the frame. `images`: names
    /// of the folders whose images are written; those that the dataset lacks are skipped. `source`
    /// must outlive the recording. Errors: BadInput where a file of the dataset is damaged;
    /// CannotWrite.
    [[nodiscard]] static Result<RosRecording> begin(
        const OpenedSource& source, const ClassUnion& classes, const std::set<std::string>& images,
        CreateRosFile* create, const GuardedFolder& folder, const std::string& name);

    /// Writes frames `begin` to `end` (not included), which follow those written before.
    [[nodiscard]] Status add(std::size_t begin, std::size_t end, const JobContext& job);

    /// After the last frame; returns the file's SHA-256, or an error if the job is cancelled.
    [[nodiscard]] Result<std::string> finish(const JobContext& job);

  private:
    /// The images of one folder.
    struct ImageTopic {
        std::string folder;
        std::string frame;
        bool is_depth = false;  // along the viewing axis
        std::uint16_t channel = 0;
    };

    RosRecording(const OpenedSource& source, RecordedSensors sensors,
                 std::unique_ptr<RosFile> file);
    [[nodiscard]] Status addSensorTopics();
    [[nodiscard]] Status addImages(const verify::StoredDataset& dataset,
                                   const std::set<std::string>& images);
    [[nodiscard]] Status addBoxes(const ClassUnion& classes);
    [[nodiscard]] Status addPath();
    [[nodiscard]] Status addStaticTransforms();
    [[nodiscard]] Status describe(verify::StoredDataset& dataset, const ClassUnion& classes);
    [[nodiscard]] Status addImuBefore(std::uint64_t time_ns);
    [[nodiscard]] Status addPoses(std::size_t frame);

    const OpenedSource& source_;
    RecordedSensors sensors_;
    std::unique_ptr<RosFile> file_;
    ros::Version version_;
    std::vector<ImageTopic> images_;
    std::vector<ros::BoxMarker> moving_boxes_;  // of objects that move in any frame, at rest
    std::size_t next_imu_ = 0;
    std::uint64_t start_ns_ = 0;                // of the first message
    std::vector<std::uint16_t> info_channels_;  // of the cameras; unused where a camera has no info
    std::uint16_t poses_ = 0;                   // channel numbers
    std::uint16_t moving_objects_ = 0;
    std::uint16_t imu_channel_ = 0;
};

}  // namespace dollytrack::gather
