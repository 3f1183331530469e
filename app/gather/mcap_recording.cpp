#include "app/gather/mcap_recording.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/number_lines.h"
#include "engine/jobs/parallel.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWorldFrame = "map";
constexpr const char* kImuFrame = "imu_frame";
constexpr const char* kRightCamera = "/right_camera";
constexpr const char* kSensorCamera = "/sensor_camera";

constexpr const char* kImageType = "sensor_msgs/msg/CompressedImage";
constexpr const char* kInfoType = "sensor_msgs/msg/CameraInfo";
constexpr const char* kTransformType = "tf2_msgs/msg/TFMessage";

/// Asks rosbag2 to give the topic's last message to nodes that start later (transient local).
constexpr const char* kLatchedQos =
    "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n"
    "  deadline:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n"
    "  avoid_ros_namespace_conventions: false";

tl::unexpected<Error> damaged(const std::string& what, const std::string& where) {
    return fail(ErrorCode::BadInput, what + "; export the dataset again.", where);
}

/// A ROS time has 32 bits of seconds.
bool isTime(double time_s) {
    constexpr double kLatest_s = 2'147'483'647.0;
    return time_s >= 0.0 && time_s <= kLatest_s;
}

std::string opticalFrame(const std::string& camera) {
    return camera.substr(1) + "_optical_frame";
}

/// "/camera_NAME" with characters that a topic may have.
std::string cameraNameOf(const std::string& rig_name) {
    std::string name = "/camera_" + rig_name;
    std::ranges::replace_if(
        name.begin() + 1, name.end(),
        [](unsigned char c) { return c >= 0x80 || (std::isalnum(c) == 0 && c != '_'); }, '_');
    return name;
}

/// The name of the camera and of the image that a folder holds: "/right_camera", "rgb".
std::pair<std::string, std::string> topicOf(const std::string& folder) {
    constexpr std::string_view kRight = "_right";
    if (folder == "rgb_sensor") return {kSensorCamera, kPicture};
    if (folder.ends_with(kRight)) {
        return {kRightCamera, folder.substr(0, folder.size() - kRight.size())};
    }
    if (!folder.starts_with(kRigFolder)) return {"/camera", folder};
    const std::size_t end = folder.rfind('/');
    return {cameraNameOf(folder.substr(kRigFolder.size(), end - kRigFolder.size())),
            folder.substr(end + 1)};
}

/// Pixel centres of CameraInfo have integer coordinates.
ros::CameraInfo infoOf(const Intrinsics& lens) {
    return {lens.width,    lens.height,   lens.fx,     lens.fy,
            lens.cx - 0.5, lens.cy - 0.5, "plumb_bob", {0, 0, 0, 0, 0}};
}

/// Nothing for lenses without a model in ROS.
std::optional<ros::CameraInfo> infoOf(const verify::StoredCamera& camera) {
    ros::CameraInfo info = infoOf(
        Intrinsics{camera.width, camera.height, camera.focal, camera.focal, camera.cx, camera.cy});
    if (camera.lens == "pinhole") return info;
    if (camera.lens != "fisheye") return std::nullopt;
    info.distortion_model = "equidistant";
    info.distortion = {camera.k.begin(), camera.k.end()};
    return info;
}

Pose shiftedRight(double right_m) {
    return {{right_m, 0.0, 0.0}, Eigen::Quaterniond::Identity()};
}

}  // namespace

Result<McapRecording> McapRecording::begin(const OpenedSource& source, const ClassUnion& classes,
                                           const std::set<std::string>& images,
                                           const GuardedFolder& folder, const std::string& name) {
    Result<verify::StoredDataset> dataset = readDescription(source.source);
    if (!dataset) return tl::unexpected(dataset.error());
    Result<McapWriter> file = McapWriter::create(
        folder, name, "ros2", "dollytrack " + cleanText(source.source.product_version));
    if (!file) return tl::unexpected(file.error());
    McapRecording recording(source, std::move(*file));
    Status status = recording.readTimes();
    if (status) status = recording.readImu(*dataset);
    if (status) status = recording.addCameras(*dataset, images);
    if (status) status = recording.addImages(*dataset, images);
    if (status) status = recording.describe(*dataset, classes);
    if (status) status = recording.addStaticTransforms();
    if (status) status = recording.addBoxes(classes);
    if (status) status = recording.addPath();
    if (!status) return tl::unexpected(status.error());
    return recording;
}

Status McapRecording::readTimes() {
    const std::vector<verify::StoredFrame>& frames = source_.dataset.frames;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double time_s = frames[i].time_s;
        if (!isTime(time_s) || (i > 0 && time_s < frames[i - 1].time_s)) {
            return damaged("The times of the frames do not increase from 0 on",
                           fmt::format("{}/dataset.json: frames[{}].time_s",
                                       source_.source.folder.string(), i));
        }
        times_ns_.push_back(static_cast<std::uint64_t>(std::llround(time_s * 1e9)));
    }
    start_ns_ = times_ns_.front();
    return {};
}

Status McapRecording::readImu(const verify::StoredDataset& dataset) {
    if (!dataset.has("imu")) return {};
    const Result<SourceFile> file = listedFile(dataset, kImuFile);
    if (!file) return tl::unexpected(file.error());
    const Result<std::string> text = readProven(*file);
    if (!text) return tl::unexpected(text.error());
    if (text->find('\n') + 1 == text->size()) return {};  // a header, but no measurements
    const Result<std::vector<NumberLine>> lines =
        readNumberLines(file->path, *text, 7, "time, angular rate, specific force");
    if (!lines) return tl::unexpected(lines.error());
    for (const NumberLine& line : *lines) {
        const std::vector<double>& v = line.values;
        if (!isTime(1e-9 * v[0]) ||
            (!imu_.empty() && v[0] < static_cast<double>(imu_.back().time_ns))) {
            return damaged("The times do not increase from 0 on", placeOf(file->path, line.line));
        }
        imu_.push_back({static_cast<std::uint64_t>(v[0]), {v[1], v[2], v[3]}, {v[4], v[5], v[6]}});
    }
    start_ns_ = std::min(start_ns_, imu_.front().time_ns);
    const Result<std::uint16_t> channel = addTopic("/imu", "sensor_msgs/msg/Imu");
    if (channel) imu_channel_ = *channel;
    return channel ? Status() : tl::unexpected(channel.error());
}

Result<std::uint16_t> McapRecording::addTopic(const std::string& topic, const std::string& type,
                                              const McapMap& metadata) {
    auto known = schemas_.find(type);
    if (known == schemas_.end()) {
        const Result<std::uint16_t> schema =
            file_.addSchema({type, "ros2msg", ros::definitionOf(type)});
        if (!schema) return schema;
        known = schemas_.emplace(type, *schema).first;
    }
    return file_.addChannel(known->second, topic, "cdr", metadata);
}

Status McapRecording::addCameras(const verify::StoredDataset& dataset,
                                 const std::set<std::string>& images) {
    const auto add = [&](const std::string& name, const std::string& frame,
                         std::optional<ros::CameraInfo> info) {
        cameras_.push_back({name, frame, std::move(info)});
    };
    const auto isUsed = [&](const char* folder) {
        return dataset.has(folder) && images.contains(folder);
    };
    const ros::CameraInfo own = infoOf(dataset.lens);
    try {
        add("/camera", opticalFrame("/camera"), own);
        for (const char* folder : {"rgb_right", "depth_right"}) {
            if (!isUsed(folder) || cameras_.size() > 1) continue;
            ros::CameraInfo right = own;
            right.baseline_m = dataset.convention(folder).at("baseline_m").get<double>();
            add(kRightCamera, opticalFrame(kRightCamera), right);
        }
        if (isUsed("rgb_sensor")) {
            const Json bent = dataset.convention("rgb_sensor").at("distortion");
            ros::CameraInfo sensor = own;
            sensor.distortion.clear();
            for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) {
                sensor.distortion.push_back(bent.at(key).get<double>());
            }
            add(kSensorCamera, cameras_[0].frame, sensor);
        }
    } catch (const Json::exception&) {
        return damaged("A convention of an image is missing or of the wrong type",
                       (dataset.folder / "dataset.json").string() + ": conventions");
    }
    if (dataset.has("cameras")) {
        Result<std::vector<verify::StoredCamera>> rig = verify::readStoredRig(dataset);
        if (!rig) return tl::unexpected(rig.error());
        rig_ = std::move(*rig);
    }
    for (const verify::StoredCamera& one : rig_) {
        const std::string name = cameraNameOf(one.name);
        if (std::ranges::find(cameras_, name, &Camera::name) != cameras_.end()) {
            return fail(ErrorCode::BadInput,
                        fmt::format("Two cameras of the rig would have the topic {}; export the "
                                    "dataset with other names.",
                                    name),
                        dataset.folder.string());
        }
        add(name, opticalFrame(name), infoOf(one));
    }
    for (Camera& one : cameras_) {
        if (!one.info) continue;
        const Result<std::uint16_t> channel = addTopic(one.name + "/camera_info", kInfoType);
        if (!channel) return tl::unexpected(channel.error());
        one.info_channel = *channel;
    }
    const Result<std::uint16_t> poses = addTopic("/tf", kTransformType);
    if (poses) poses_ = *poses;
    return poses ? Status() : tl::unexpected(poses.error());
}

Status McapRecording::addImages(const verify::StoredDataset& dataset,
                                const std::set<std::string>& images) {
    for (const std::string& folder : source_.source.modalities) {
        if (!images.contains(folder)) continue;
        const auto [camera, image] = topicOf(folder);
        const auto found = std::ranges::find(cameras_, camera, &Camera::name);
        if (found == cameras_.end()) continue;
        const auto rig = std::ranges::find(
            rig_, camera, [](const verify::StoredCamera& one) { return cameraNameOf(one.name); });
        ImageTopic topic{folder, found->frame};
        topic.is_depth = image.starts_with(kDepth) && (rig == rig_.end() || !rig->range);
        Json convention = dataset.convention(folder);
        if (rig != rig_.end()) {
            const Json& stored = dataset.card["cameras"][rig - rig_.begin()];
            convention = stored.value(image, Json());
        }
        McapMap metadata = {{"folder", folder}};
        if (!convention.is_null()) {
            metadata["convention"] =
                convention.dump(-1, ' ', false, Json::error_handler_t::replace);
        }
        const char* transport = topic.is_depth ? "compressedDepth" : "compressed";
        const Result<std::uint16_t> channel =
            addTopic(fmt::format("{}/{}/{}", camera, image, transport), kImageType, metadata);
        if (!channel) return tl::unexpected(channel.error());
        topic.channel = *channel;
        images_.push_back(std::move(topic));
    }
    return {};
}

Status McapRecording::describe(verify::StoredDataset& dataset, const ClassUnion& classes) {
    Json& card = dataset.card;
    card.erase("files");          // the recording holds their content
    card["scene"].erase("path");  // on the machine that exported it
    McapMap names;
    for (const GatheredClass& one : classes.classes()) {
        names[std::to_string(one.id)] = one.name;
    }
    const Status added =
        file_.addAttachment(start_ns_, "dataset.json", "application/json",
                            card.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
    return added ? file_.addMetadata("classes", names) : added;
}

Status McapRecording::addStaticTransforms() {
    const std::string& camera = cameras_[0].frame;
    std::vector<ros::Transform> fixed;
    if (!imu_.empty()) fixed.push_back({camera, kImuFrame, Pose{}});
    for (const Camera& one : cameras_) {
        if (one.name != kRightCamera) continue;
        fixed.push_back({camera, one.frame, shiftedRight(one.info->baseline_m)});
    }
    for (const verify::StoredCamera& one : rig_) {
        if (one.level) continue;
        fixed.push_back({camera, opticalFrame(cameraNameOf(one.name)), one.carrier_from_camera});
    }
    if (fixed.empty()) return {};
    const Result<std::uint16_t> channel =
        addTopic("/tf_static", kTransformType, {{"offered_qos_profiles", kLatchedQos}});
    if (!channel) return tl::unexpected(channel.error());
    return file_.addMessage(*channel, start_ns_, ros::transforms(start_ns_, fixed));
}

Status McapRecording::addBoxes(const ClassUnion& classes) {
    constexpr float kOpacity = 0.3F;
    const Result<std::uint16_t> channel = addTopic("/objects", "visualization_msgs/msg/MarkerArray",
                                                   {{"offered_qos_profiles", kLatchedQos}});
    if (!channel) return tl::unexpected(channel.error());
    objects_ = *channel;
    const ClassTable& table = source_.source.classes();
    for (const verify::StoredObject& object : source_.dataset.objects) {
        const DatasetClass* found = table.find(object.class_id);
        const DatasetClass& of = found == nullptr ? table.voidClass() : *found;
        const std::string& class_name =
            &of == &table.voidClass() ? of.name : classes.classes()[classes.indexOf(of)].name;
        const auto share = [&](int i) { return static_cast<float>(of.color[i]) / 255.0F; };
        const Eigen::AngleAxisd turn(object.box.yaw, Eigen::Vector3d::UnitZ());
        boxes_.push_back({object.role + "/" + class_name,
                          object.id,
                          {object.box.center, Eigen::Quaterniond(turn)},
                          2.0 * object.box.half_size,
                          {share(0), share(1), share(2), kOpacity},
                          object.name});
    }
    return file_.addMessage(objects_, start_ns_, ros::boxMarkers({start_ns_, kWorldFrame}, boxes_));
}

Status McapRecording::addPath() {
    std::vector<ros::TimedPose> poses;
    for (std::size_t i = 0; i < times_ns_.size(); ++i) {
        poses.push_back({times_ns_[i], source_.dataset.frames[i].pose});
    }
    const Result<std::uint16_t> channel =
        addTopic("/trajectory", "nav_msgs/msg/Path", {{"offered_qos_profiles", kLatchedQos}});
    if (!channel) return tl::unexpected(channel.error());
    return file_.addMessage(*channel, start_ns_, ros::path({start_ns_, kWorldFrame}, poses));
}

Status McapRecording::addImuBefore(std::uint64_t time_ns) {
    for (; next_imu_ < imu_.size() && imu_[next_imu_].time_ns < time_ns; ++next_imu_) {
        const ImuSample& one = imu_[next_imu_];
        const std::string message =
            ros::imu({one.time_ns, kImuFrame}, one.rate_rps, one.force_mps2);
        Status added = file_.addMessage(imu_channel_, one.time_ns, message);
        if (!added) return added;
    }
    return {};
}

/// Poses of the cameras that move on their own, and boxes of the objects that move.
Status McapRecording::addPoses(std::size_t frame) {
    const verify::StoredFrame& stored = source_.dataset.frames[frame];
    const std::uint64_t time_ns = times_ns_[frame];
    std::vector<ros::Transform> poses = {{kWorldFrame, cameras_[0].frame, stored.pose}};
    for (const verify::StoredCamera& one : rig_) {
        if (!one.level) continue;
        poses.push_back({kWorldFrame, opticalFrame(cameraNameOf(one.name)), one.poses[frame]});
    }
    Status status = file_.addMessage(poses_, time_ns, ros::transforms(time_ns, poses));
    std::vector<ros::BoxMarker> moved;
    for (const ros::BoxMarker& box : boxes_) {
        const Eigen::Isometry3d* motion = stored.movement(box.id);
        if (motion == nullptr) continue;
        moved.push_back(box);
        moved.back().pose = {*motion * box.pose.position,
                             Eigen::Quaterniond(motion->linear()) * box.pose.rotation};
    }
    if (!status || moved.empty()) return status;
    return file_.addMessage(objects_, time_ns, ros::boxMarkers({time_ns, kWorldFrame}, moved));
}

Status McapRecording::add(std::size_t begin, std::size_t end, const JobContext& job) {
    std::vector<Result<std::string>> messages((end - begin) * images_.size(), std::string());
    parallelFor(messages.size(), [&](std::size_t i) {
        const ImageTopic& topic = images_[i % images_.size()];
        const std::size_t frame = begin + i / images_.size();
        if (job.cancelled()) return;
        const Result<std::string> file =
            readProven(source_.file(frameFileOf(source_.dataset, topic.folder, frame)));
        if (file) {
            messages[i] =
                ros::compressedImage({times_ns_[frame], topic.frame}, *file, topic.is_depth);
        } else {
            messages[i] = tl::unexpected(file.error());
        }
    });
    for (std::size_t frame = begin; frame < end && !job.cancelled(); ++frame) {
        const std::uint64_t time_ns = times_ns_[frame];
        Status status = addImuBefore(time_ns);
        if (status) status = addPoses(frame);
        for (const Camera& camera : cameras_) {
            if (!status || !camera.info) continue;
            status = file_.addMessage(camera.info_channel, time_ns,
                                      ros::cameraInfo({time_ns, camera.frame}, *camera.info));
        }
        for (std::size_t i = 0; status && i < images_.size(); ++i) {
            const Result<std::string>& message = messages[(frame - begin) * images_.size() + i];
            if (!message) return tl::unexpected(message.error());
            status = file_.addMessage(images_[i].channel, time_ns, *message);
        }
        if (!status) return status;
    }
    return {};
}

Result<std::string> McapRecording::finish() {
    constexpr std::uint64_t kEnd = ~std::uint64_t{0};
    if (Status added = addImuBefore(kEnd); !added) return tl::unexpected(added.error());
    return file_.finish();
}

}  // namespace dollytrack::gather
