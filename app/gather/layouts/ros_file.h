#pragma once

#include "app/gather/layouts/ros_messages.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/jobs/job.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace dollytrack::gather {

/// Metadata of a topic: MCAP's channel metadata, or fields of a bag's connection header.
using TopicMetadata = std::map<std::string, std::string>;

/// Names of the classes by their ids, as text.
using ClassNames = std::map<std::string, std::string>;

/// A topic of a recording.
struct RosTopic {
    std::string name;         // "/camera/camera_info"
    std::string type;         // "sensor_msgs/CameraInfo": without "/msg", also for ROS 2
    bool is_latched = false;  // nodes that subscribe later get the last message
    TopicMetadata metadata = {};
};

/// A file of ROS messages, written from its beginning to its end. Messages come in the order of
/// their times, which are in ns. Errors are CannotWrite.
class RosFile {
  public:
    virtual ~RosFile() = default;
    /// How its messages are serialised.
    [[nodiscard]] virtual ros::Version version() const = 0;
    /// Returns the number of the topic's channel.
    [[nodiscard]] virtual Result<std::uint16_t> addTopic(const RosTopic& topic) = 0;
    [[nodiscard]] virtual Status addMessage(std::uint16_t channel, std::uint64_t time_ns,
                                            std::string_view data) = 0;
    /// Adds dataset.json and the names of the classes by their ids.
    [[nodiscard]] virtual Status describe(std::uint64_t time_ns, const std::string& dataset_json,
                                          const ClassNames& classes) = 0;
    /// Closes the file; returns its SHA-256. Error also: Cancelled.
    [[nodiscard]] virtual Result<std::string> finish(const JobContext& job) = 0;
};

/// Creates the file and replaces one of this name. `program`: name and version of the program that
/// exported the dataset.
using CreateRosFile = Result<std::unique_ptr<RosFile>>(const GuardedFolder& folder,
                                                       const std::string& name,
                                                       const std::string& program);
CreateRosFile createMcapFile;  // ROS 2
CreateRosFile createBagFile;   // ROS 1, bag format 2.0

}  // namespace dollytrack::gather
