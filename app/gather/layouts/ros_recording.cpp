#include "app/gather/layouts/ros_recording.h"

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

constexpr const char* kImageType = "sensor_msgs/CompressedImage";
constexpr const char* kInfoType = "sensor_msgs/CameraInfo";
constexpr const char* kTransformType = "tf2_msgs/TFMessage";
constexpr const char* kBoxType = "visualization_msgs/MarkerArray";

tl::unexpected<Error> damaged(const std::string& what, const std::string& where) {
    return fail(ErrorCode::BadInput, what + "; export the dataset again.", where);
}

constexpr const char* kBadTime =
    "A time is negative, earlier than the one before, or beyond 2,147,483,647 s";

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

Status readTimes(const verify::StoredDataset& dataset, std::vector<std::uint64_t>& times_ns) {
    for (const verify::StoredFrame& frame : dataset.frames) {
        const std::size_t i = times_ns.size();
        if (!isTime(frame.time_s) || (i > 0 && frame.time_s < dataset.frames[i - 1].time_s)) {
            return damaged(kBadTime, fmt::format("{}/dataset.json: frames[{}].time_s",
                                                 dataset.folder.string(), i));
        }
        times_ns.push_back(static_cast<std::uint64_t>(std::llround(frame.time_s * 1e9)));
    }
    return {};
}

Status readImu(const verify::StoredDataset& dataset, std::vector<ImuSample>& imu) {
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
            (!imu.empty() && v[0] < static_cast<double>(imu.back().time_ns))) {
            return damaged(kBadTime, placeOf(file->path, line.line));
        }
        imu.push_back({static_cast<std::uint64_t>(v[0]), {v[1], v[2], v[3]}, {v[4], v[5], v[6]}});
    }
    return {};
}

/// The planned camera, and those of its other images.
Status addPlannedCameras(const verify::StoredDataset& dataset,
                         std::vector<RecordedCamera>& cameras) {
    const ros::CameraInfo planned = infoOf(dataset.lens);
    cameras.push_back({"/camera", opticalFrame("/camera"), planned, {}});
    try {
        for (const char* folder : {"rgb_right", "depth_right"}) {
            if (!dataset.has(folder)) continue;
            ros::CameraInfo right = planned;
            right.baseline_m = dataset.convention(folder).at("baseline_m").get<double>();
            cameras.push_back({kRightCamera, opticalFrame(kRightCamera), right, {}});
            break;
        }
        if (dataset.has("rgb_sensor")) {
            const Json distortion = dataset.convention("rgb_sensor").at("distortion");
            ros::CameraInfo sensor = planned;
            sensor.distortion.clear();
            for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) {
                sensor.distortion.push_back(distortion.at(key).get<double>());
            }
            cameras.push_back({kSensorCamera, cameras[0].frame, sensor, {}});
        }
    } catch (const Json::exception&) {
        return damaged("A convention of an image is missing or of the wrong type",
                       (dataset.folder / "dataset.json").string() + ": conventions");
    }
    return {};
}

Status addRigCameras(const verify::StoredDataset& dataset, RecordedSensors& sensors) {
    if (!dataset.has("cameras")) return {};
    Result<std::vector<verify::StoredCamera>> rig = verify::readStoredRig(dataset);
    if (!rig) return tl::unexpected(rig.error());
    sensors.rig = std::move(*rig);
    for (std::size_t i = 0; i < sensors.rig.size(); ++i) {
        const std::string name = cameraNameOf(sensors.rig[i].name);
        if (std::ranges::find(sensors.cameras, name, &RecordedCamera::name) !=
            sensors.cameras.end()) {
            return fail(ErrorCode::BadInput,
                        fmt::format("Two cameras of the rig would have the topic {}; export the "
                                    "dataset with other names.",
                                    name),
                        dataset.folder.string());
        }
        sensors.cameras.push_back({name, opticalFrame(name), infoOf(sensors.rig[i]), i});
    }
    return {};
}

}  // namespace

Result<RecordedSensors> readSensors(const verify::StoredDataset& dataset) {
    RecordedSensors sensors;
    Status status = readTimes(dataset, sensors.times_ns);
    if (status) status = readImu(dataset, sensors.imu);
    if (status) status = addPlannedCameras(dataset, sensors.cameras);
    if (status) status = addRigCameras(dataset, sensors);
    if (!status) return tl::unexpected(status.error());
    return sensors;
}

RosRecording::RosRecording(const OpenedSource& source, RecordedSensors sensors,
                           std::unique_ptr<RosFile> file)
    : source_(source),
      sensors_(std::move(sensors)),
      file_(std::move(file)),
      version_(file_->version()) {
    start_ns_ = sensors_.times_ns.front();
    if (!sensors_.imu.empty()) start_ns_ = std::min(start_ns_, sensors_.imu.front().time_ns);
}

Result<RosRecording> RosRecording::begin(const OpenedSource& source, const ClassUnion& classes,
                                         const std::set<std::string>& images, CreateRosFile* create,
                                         const GuardedFolder& folder, const std::string& name) {
    Result<verify::StoredDataset> dataset = readDescription(source.source);
    if (!dataset) return tl::unexpected(dataset.error());
    Result<RecordedSensors> sensors = readSensors(*dataset);
    if (!sensors) return tl::unexpected(sensors.error());
    Result<std::unique_ptr<RosFile>> file =
        create(folder, name, "dollytrack " + cleanText(source.source.product_version));
    if (!file) return tl::unexpected(file.error());
    RosRecording recording(source, std::move(*sensors), std::move(*file));
    Status status = recording.addSensorTopics();
    if (status) status = recording.addImages(*dataset, images);
    if (status) status = recording.describe(*dataset, classes);
    if (status) status = recording.addStaticTransforms();
    if (status) status = recording.addBoxes(classes);
    if (status) status = recording.addPath();
    if (!status) return tl::unexpected(status.error());
    return recording;
}

/// The topics of poses, measurements and lenses.
Status RosRecording::addSensorTopics() {
    Status status;
    const auto add = [&](const std::string& topic, const char* type) -> std::uint16_t {
        if (!status) return 0;
        const Result<std::uint16_t> channel = file_->addTopic({topic, type});
        if (!channel) status = tl::unexpected(channel.error());
        return channel.value_or(0);
    };
    if (!sensors_.imu.empty()) imu_channel_ = add("/imu", "sensor_msgs/Imu");
    for (const RecordedCamera& camera : sensors_.cameras) {
        info_channels_.push_back(camera.info ? add(camera.name + "/camera_info", kInfoType) : 0);
    }
    poses_ = add("/tf", kTransformType);
    return status;
}

Status RosRecording::addImages(const verify::StoredDataset& dataset,
                               const std::set<std::string>& images) {
    for (const std::string& folder : source_.source.modalities) {
        if (!images.contains(folder)) continue;
        const auto [camera, image] = topicOf(folder);
        const auto found = std::ranges::find(sensors_.cameras, camera, &RecordedCamera::name);
        if (found == sensors_.cameras.end()) continue;
        const std::optional<std::size_t> rig = found->rig_index;
        ImageTopic topic{folder, found->frame};
        topic.is_depth = image.starts_with(kDepth) && !(rig && sensors_.rig[*rig].range);
        const Json convention =
            rig ? dataset.card["cameras"][*rig].value(image, Json()) : dataset.convention(folder);
        TopicMetadata metadata = {{"folder", folder}};
        if (!convention.is_null()) {
            metadata["convention"] =
                convention.dump(-1, ' ', false, Json::error_handler_t::replace);
        }
        const char* transport = topic.is_depth ? "compressedDepth" : "compressed";
        const Result<std::uint16_t> channel =
            file_->addTopic({fmt::format("{}/{}/{}", camera, image, transport), kImageType, false,
                             std::move(metadata)});
        if (!channel) return tl::unexpected(channel.error());
        topic.channel = *channel;
        images_.push_back(std::move(topic));
    }
    return {};
}

Status RosRecording::describe(verify::StoredDataset& dataset, const ClassUnion& classes) {
    Json& card = dataset.card;
    card.erase("files");          // the recording holds their content
    card["scene"].erase("path");  // on the machine that exported it
    ClassNames names;
    for (const GatheredClass& one : classes.classes()) {
        names[std::to_string(one.id)] = one.name;
    }
    return file_->describe(start_ns_,
                           card.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", names);
}

Status RosRecording::addStaticTransforms() {
    const std::string& planned = sensors_.cameras[0].frame;
    std::vector<ros::Transform> fixed;
    if (!sensors_.imu.empty()) fixed.push_back({planned, kImuFrame, Pose{}});
    for (const RecordedCamera& camera : sensors_.cameras) {
        if (camera.name == kRightCamera) {
            fixed.push_back({planned, camera.frame, shiftedRight(camera.info->baseline_m)});
        }
        if (!camera.rig_index) continue;
        const verify::StoredCamera& stored = sensors_.rig[*camera.rig_index];
        if (stored.level) continue;
        fixed.push_back({planned, camera.frame, stored.carrier_from_camera});
    }
    if (fixed.empty()) return {};
    const Result<std::uint16_t> channel =
        file_->addTopic({.name = "/tf_static", .type = kTransformType, .is_latched = true});
    if (!channel) return tl::unexpected(channel.error());
    return file_->addMessage(*channel, start_ns_, ros::transforms(version_, start_ns_, fixed));
}

/// Objects that move are on a topic of their own: a node that starts later gets only the last
/// message of a topic, which must hold all of the topic's boxes.
Status RosRecording::addBoxes(const ClassUnion& classes) {
    constexpr float kOpacity = 0.3F;
    std::set<int> moving;
    for (const verify::StoredFrame& frame : source_.dataset.frames) {
        for (const verify::MovedObject& object : frame.moving) moving.insert(object.object_id);
    }
    std::vector<ros::BoxMarker> static_boxes;
    const ClassTable& table = source_.source.classes();
    for (const verify::StoredObject& object : source_.dataset.objects) {
        const DatasetClass* found = table.find(object.class_id);
        const DatasetClass& of = found == nullptr ? table.voidClass() : *found;
        const std::string& class_name =
            &of == &table.voidClass() ? of.name : classes.classes()[classes.indexOf(of)].name;
        const auto share = [&](int i) { return static_cast<float>(of.color[i]) / 255.0F; };
        const Eigen::AngleAxisd turn(object.box.yaw, Eigen::Vector3d::UnitZ());
        std::vector<ros::BoxMarker>& boxes =
            moving.contains(object.id) ? moving_boxes_ : static_boxes;
        boxes.push_back({object.role + "/" + class_name,
                         object.id,
                         {object.box.center, Eigen::Quaterniond(turn)},
                         2.0 * object.box.half_size,
                         {share(0), share(1), share(2), kOpacity},
                         object.name});
    }
    const Result<std::uint16_t> channel =
        file_->addTopic({.name = "/objects", .type = kBoxType, .is_latched = true});
    if (!channel) return tl::unexpected(channel.error());
    if (!moving_boxes_.empty()) {
        const Result<std::uint16_t> moving_objects = file_->addTopic({"/moving_objects", kBoxType});
        if (!moving_objects) return tl::unexpected(moving_objects.error());
        moving_objects_ = *moving_objects;
    }
    return file_->addMessage(*channel, start_ns_,
                             ros::boxMarkers(version_, {start_ns_, kWorldFrame}, static_boxes));
}

Status RosRecording::addPath() {
    std::vector<ros::TimedPose> poses;
    for (std::size_t i = 0; i < sensors_.times_ns.size(); ++i) {
        poses.push_back({sensors_.times_ns[i], source_.dataset.frames[i].pose});
    }
    const Result<std::uint16_t> channel =
        file_->addTopic({.name = "/trajectory", .type = "nav_msgs/Path", .is_latched = true});
    if (!channel) return tl::unexpected(channel.error());
    return file_->addMessage(*channel, start_ns_,
                             ros::path(version_, {start_ns_, kWorldFrame}, poses));
}

Status RosRecording::addImuBefore(std::uint64_t time_ns) {
    for (; next_imu_ < sensors_.imu.size() && sensors_.imu[next_imu_].time_ns < time_ns;
         ++next_imu_) {
        const ImuSample& one = sensors_.imu[next_imu_];
        const std::string message =
            ros::imu(version_, {one.time_ns, kImuFrame, next_imu_}, one.rate_rps, one.force_mps2);
        Status added = file_->addMessage(imu_channel_, one.time_ns, message);
        if (!added) return added;
    }
    return {};
}

/// Poses of the planned camera and of level cameras, and boxes of the objects that move.
Status RosRecording::addPoses(std::size_t frame) {
    const verify::StoredFrame& stored = source_.dataset.frames[frame];
    const std::uint64_t time_ns = sensors_.times_ns[frame];
    std::vector<ros::Transform> poses = {{kWorldFrame, sensors_.cameras[0].frame, stored.pose}};
    for (const RecordedCamera& camera : sensors_.cameras) {
        if (!camera.rig_index || !sensors_.rig[*camera.rig_index].level) continue;
        poses.push_back({kWorldFrame, camera.frame, sensors_.rig[*camera.rig_index].poses[frame]});
    }
    Status status = file_->addMessage(poses_, time_ns, ros::transforms(version_, time_ns, poses));
    if (!status || moving_boxes_.empty()) return status;
    std::vector<ros::BoxMarker> boxes = moving_boxes_;
    for (ros::BoxMarker& box : boxes) {
        const Eigen::Isometry3d* motion = stored.movement(box.id);
        if (motion == nullptr) continue;
        box.pose = {*motion * box.pose.position,
                    Eigen::Quaterniond(motion->linear()) * box.pose.rotation};
    }
    return file_->addMessage(moving_objects_, time_ns,
                             ros::boxMarkers(version_, {time_ns, kWorldFrame}, boxes));
}

Status RosRecording::add(std::size_t begin, std::size_t end, const JobContext& job) {
    std::vector<Result<std::string>> messages((end - begin) * images_.size(), std::string());
    parallelFor(messages.size(), [&](std::size_t i) {
        const ImageTopic& topic = images_[i % images_.size()];
        const std::size_t frame = begin + i / images_.size();
        if (job.cancelled()) return;
        const SourceFile source = source_.file(frameFileOf(source_.dataset, topic.folder, frame));
        const Result<std::string> file = readProven(source);
        if (file && topic.is_depth && !file->starts_with("\x89PNG\r\n\x1A\n")) {
            messages[i] = damaged("The depth image is not a PNG file", source.path.string());
        } else if (file) {
            messages[i] = ros::compressedImage(
                version_, {sensors_.times_ns[frame], topic.frame, frame}, *file, topic.is_depth);
        } else {
            messages[i] = tl::unexpected(file.error());
        }
    });
    for (std::size_t frame = begin; frame < end && !job.cancelled(); ++frame) {
        const std::uint64_t time_ns = sensors_.times_ns[frame];
        Status status = addImuBefore(time_ns);
        if (status) status = addPoses(frame);
        for (std::size_t i = 0; i < info_channels_.size(); ++i) {
            const RecordedCamera& camera = sensors_.cameras[i];
            if (!status || !camera.info) continue;
            status = file_->addMessage(
                info_channels_[i], time_ns,
                ros::cameraInfo(version_, {time_ns, camera.frame, frame}, *camera.info));
        }
        for (std::size_t i = 0; status && i < images_.size(); ++i) {
            const Result<std::string>& message = messages[(frame - begin) * images_.size() + i];
            if (!message) return tl::unexpected(message.error());
            status = file_->addMessage(images_[i].channel, time_ns, *message);
        }
        if (!status) return status;
    }
    return {};
}

Result<std::string> RosRecording::finish(const JobContext& job) {
    constexpr std::uint64_t kEnd = ~std::uint64_t{0};
    if (Status added = addImuBefore(kEnd); !added) return tl::unexpected(added.error());
    return file_->finish(job);
}

}  // namespace dollytrack::gather
