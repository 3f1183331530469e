#include "app/gather/layouts/mcap_writer.h"
#include "app/gather/layouts/ros_file.h"

#include <fmt/format.h>

#include <utility>

namespace dollytrack::gather {
namespace {

/// What rosbag2 needs to publish a topic as it was; the values are those of rmw's enumerations.
constexpr const char* kQos =
    "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false";

class McapFile : public RosFile {
  public:
    explicit McapFile(McapWriter file) : file_(std::move(file)) {}

    ros::Version version() const override { return ros::Version::Ros2; }

    Result<std::uint16_t> addTopic(const RosTopic& topic) override {
        auto known = schemas_.find(topic.type);
        if (known == schemas_.end()) {
            std::string name = topic.type;
            name.insert(name.find('/'), "/msg");
            const Result<std::uint16_t> schema =
                file_.addSchema({name, "ros2msg", ros::definitionOf(version(), topic.type)});
            if (!schema) return schema;
            known = schemas_.emplace(topic.type, *schema).first;
        }
        McapMap metadata = topic.metadata;
        metadata["offered_qos_profiles"] =
            topic.is_latched ? fmt::format(kQos, 1, 1) : fmt::format(kQos, 10, 2);
        return file_.addChannel(known->second, topic.name, "cdr", metadata);
    }

    Status addMessage(std::uint16_t channel, std::uint64_t time_ns,
                      std::string_view data) override {
        return file_.addMessage(channel, time_ns, data);
    }

    Status describe(std::uint64_t time_ns, const std::string& dataset_json,
                    const ClassNames& classes) override {
        const Status added =
            file_.addAttachment(time_ns, "dataset.json", "application/json", dataset_json);
        return added ? file_.addMetadata("classes", classes) : added;
    }

    Result<std::string> finish(const JobContext& /*job*/) override { return file_.finish(); }

  private:
    McapWriter file_;
    std::map<std::string, std::uint16_t> schemas_;  // by type
};

}  // namespace

Result<std::unique_ptr<RosFile>> createMcapFile(const GuardedFolder& folder,
                                                const std::string& name,
                                                const std::string& program) {
    Result<McapWriter> file = McapWriter::create(folder, name, "ros2", program);
    if (!file) return tl::unexpected(file.error());
    return std::make_unique<McapFile>(std::move(*file));
}

}  // namespace dollytrack::gather
