#include "render/verify/read/stored_dataset.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/text_file.h"
#include "engine/io/settings/class_table_file.h"
#include "render/formats/tables/dataset_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

// px. Exports have at most 8192; a damaged dataset.json with larger sizes must not exhaust memory.
constexpr int kLargestSide = 1 << 14;
constexpr double kFarthest_m = 1e6;  // as in trajectory files
constexpr double kLargestNumber = 1e6;

Eigen::Vector3d vectorFrom(const OrderedJson& value) {
    return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

Eigen::Quaterniond quaternionFrom(const OrderedJson& value) {
    return {value.at(3).get<double>(), value.at(0).get<double>(), value.at(1).get<double>(),
            value.at(2).get<double>()};
}

void readLens(const OrderedJson& card, StoredDataset& dataset) {
    const OrderedJson& lens = card.at("conventions").at("intrinsics");
    dataset.lens = {lens.at("width").get<int>(), lens.at("height").get<int>(),
                    lens.at("fx").get<double>(), lens.at("fy").get<double>(),
                    lens.at("cx").get<double>(), lens.at("cy").get<double>()};
    dataset.hfov_deg = lens.at("hfov_deg").get<double>();
    dataset.near_m = lens.at("near_m").get<double>();
}

StoredObject objectFrom(const OrderedJson& one) {
    const OrderedJson& box = one.at("box");
    return {one.at("id").get<int>(),
            one.at("name").get<std::string>(),
            one.at("nyu40").get<int>(),
            one.at("role").get<std::string>(),
            {vectorFrom(box.at("center")), 0.5 * vectorFrom(box.at("size")),
             box.at("yaw_rad").get<double>()},
            one.contains("class_id") ? one["class_id"].get<int>() : one.at("nyu40").get<int>()};
}

StoredFrame frameFrom(const OrderedJson& one) {
    StoredFrame frame;
    frame.source_frame = one.at("trajectory_frame").get<int>();
    frame.time_s = one.at("time_s").get<double>();
    frame.pose.position = vectorFrom(one.at("position"));
    const Eigen::Quaterniond rotation = quaternionFrom(one.at("quaternion_xyzw"));
    frame.quaternion_length = rotation.norm();
    frame.pose.rotation = rotation.normalized();
    if (!one.contains("moving")) return frame;
    for (const OrderedJson& moved : one["moving"]) {
        MovedObject object{moved.at("object_id").get<int>()};
        object.now_from_rest.linear() =
            quaternionFrom(moved.at("quaternion_xyzw")).normalized().toRotationMatrix();
        object.now_from_rest.translation() = vectorFrom(moved.at("position"));
        frame.moving.push_back(object);
    }
    return frame;
}

/// Frames that dataset.json lists as unusable; the check `usable` verifies the lists.
std::set<int> readUnusableFrames(const OrderedJson& card) {
    std::set<int> frames;
    for (const char* kind : {"dark", "white", "flat"}) {
        const OrderedJson::json_pointer list(std::string("/metrics/pictures/") + kind);
        if (!card.contains(list)) continue;
        for (const OrderedJson& frame : card.at(list)) {
            if (frame.is_number_integer()) frames.insert(frame.get<int>());
        }
    }
    return frames;
}

/// @param field  set to the field being read, for the message if reading throws
Status readCard(StoredDataset& dataset, std::string& field) {
    const OrderedJson& card = dataset.card;
    const auto list = [&](const char* name) -> const OrderedJson& {
        field = name;
        const OrderedJson& all = card.at(name);
        if (!all.is_array()) (void)all.get<OrderedJson::array_t>();  // throws
        return all;
    };
    field = "labels";
    if (card.contains("labels")) {
        Result<ClassTable> own =
            classTableFromJson(nlohmann::json(card["labels"]),
                               (dataset.folder / "dataset.json").string() + ": labels");
        if (!own) return tl::unexpected(own.error());
        dataset.own_classes = std::make_shared<const ClassTable>(std::move(*own));
    }
    field = "conventions.intrinsics";
    readLens(card, dataset);
    dataset.modalities = list("modalities").get<std::vector<std::string>>();
    dataset.formats = list("formats").get<std::vector<std::string>>();
    for (const OrderedJson& one : list("objects")) {
        field = fmt::format("objects[{}]", dataset.objects.size());
        dataset.objects.push_back(objectFrom(one));
    }
    for (const OrderedJson& one : list("frames")) {
        field = fmt::format("frames[{}]", dataset.frames.size());
        dataset.frames.push_back(frameFrom(one));
    }
    return {};
}

bool isFar(const Eigen::Vector3d& v) {
    return !(v.cwiseAbs().maxCoeff() <= kFarthest_m);
}

/// Refuses positions, boxes and lenses with numbers far beyond those of any export.
Status checkNumbers(const StoredDataset& dataset, const std::string& path) {
    const auto damaged = [&](std::string problem, const std::string& field) {
        return fail(ErrorCode::BadInput, std::move(problem), path + ": " + field);
    };
    const char* const kFar = "A position or size is beyond 1,000,000 m; export the dataset again.";
    const Intrinsics& lens = dataset.lens;
    const auto isSide = [](int px) { return px >= 1 && px <= kLargestSide; };
    if (!isSide(lens.width) || !isSide(lens.height)) {
        return damaged(fmt::format("The image's width and height are not 1 to {} px; export the "
                                   "dataset again.",
                                   kLargestSide),
                       "conventions.intrinsics");
    }
    const auto isSmall = [](double number) { return std::abs(number) < kLargestNumber; };
    if (!(std::min({lens.fx, lens.fy, dataset.near_m}) > 0.0) || !isSmall(lens.fx) ||
        !isSmall(lens.fy) || !isSmall(lens.cx) || !isSmall(lens.cy) || !isSmall(dataset.near_m)) {
        return damaged(
            "fx, fy and near_m must be positive, and they, cx and cy below 1,000,000; export the "
            "dataset again.",
            "conventions.intrinsics");
    }
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        const OrientedBox& box = dataset.objects[i].box;
        if (!(box.half_size.minCoeff() >= 0.0)) {
            return damaged("A size is negative; export the dataset again.",
                           fmt::format("objects[{}].box", i));
        }
        if (isFar(box.center) || isFar(box.half_size)) {
            return damaged(kFar, fmt::format("objects[{}].box", i));
        }
    }
    for (std::size_t i = 0; i < dataset.frames.size(); ++i) {
        const StoredFrame& frame = dataset.frames[i];
        if (isFar(frame.pose.position)) return damaged(kFar, fmt::format("frames[{}]", i));
        if (!(frame.quaternion_length > 0.1 && frame.quaternion_length < 10.0)) {
            return damaged("The quaternion's length is not 1; export the dataset again.",
                           fmt::format("frames[{}]", i));
        }
        for (const MovedObject& one : frame.moving) {
            if (!isFar(one.now_from_rest.translation())) continue;
            return damaged(kFar, fmt::format("frames[{}].moving", i));
        }
    }
    return {};
}

/// What is wrong with a folder without dataset.json.
std::string whyNoDataset(const std::filesystem::path& folder) {
    std::error_code unknown;
    if (std::filesystem::exists(folder / "gather.json", unknown)) {
        return "The folder contains a gathered dataset, whose files 'sha256sum -c SHA256SUMS' "
               "checks; "
               "give the datasets that it was gathered from.";
    }
    std::string first;  // of the datasets within, by name
    for (std::filesystem::directory_iterator it(folder, unknown), end; !unknown && it != end;
         it.increment(unknown)) {
        for (const char* inner : {"", "dataset"}) {
            std::filesystem::path name = it->path().filename();
            if (*inner != '\0') name /= inner;
            if (!std::filesystem::exists(folder / name / "dataset.json", unknown)) continue;
            if (first.empty() || name.string() < first) first = name.string();
        }
        unknown.clear();
    }
    if (!first.empty()) {
        return fmt::format("The folder contains datasets; give one of them, such as {}.",
                           cleanText((folder / first).lexically_normal().string()));
    }
    return "The folder has no dataset.json: it is not a dataset, or its export did not finish; "
           "'dollytrack export --resume' finishes it.";
}

}  // namespace

const Eigen::Isometry3d* StoredFrame::movement(int object_id) const {
    for (const MovedObject& one : moving) {
        if (one.object_id == object_id) return &one.now_from_rest;
    }
    return nullptr;
}

bool StoredDataset::has(std::string_view name) const {
    return std::find(modalities.begin(), modalities.end(), name) != modalities.end() ||
           std::find(formats.begin(), formats.end(), name) != formats.end() ||
           (name == "folds" && card.contains("folds"));
}

const StoredObject* StoredDataset::object(int id) const {
    if (id < 1) return nullptr;
    const auto index = static_cast<std::size_t>(id) - 1;
    // Ids normally count from 1; another check reports lists that do not.
    if (index < objects.size() && objects[index].id == id) return &objects[index];
    const auto at =
        std::find_if(objects.begin(), objects.end(), [id](const auto& o) { return o.id == id; });
    return at == objects.end() ? nullptr : &*at;
}

int StoredDataset::pixelClass(int object_id) const {
    const StoredObject* found = object(object_id);
    return found ? found->class_id : classes().voidClass().id;
}

OrderedJson StoredDataset::convention(const std::string& name) const {
    const OrderedJson& all = card.at("conventions");
    return all.contains(name) ? all[name] : OrderedJson();
}

Eigen::Isometry3d cameraFromBox(const StoredObject& object, const StoredFrame& frame) {
    Eigen::Isometry3d world_from_box = Eigen::Translation3d(object.box.center) *
                                       Eigen::AngleAxisd(object.box.yaw, Eigen::Vector3d::UnitZ());
    if (const Eigen::Isometry3d* moved = frame.movement(object.id)) {
        world_from_box = *moved * world_from_box;
    }
    return frame.pose.worldFromCamera().inverse() * world_from_box;
}

Result<StoredDataset> readStoredDataset(const std::filesystem::path& folder) {
    StoredDataset dataset;
    dataset.folder = folder;
    const std::filesystem::path path = folder / "dataset.json";
    std::error_code unknown;
    if (!std::filesystem::is_directory(folder, unknown)) {
        return fail(ErrorCode::BadInput,
                    std::filesystem::exists(folder, unknown)
                        ? "The path is a file; give the folder of a dataset."
                        : "The folder does not exist; check the path.",
                    folder.string());
    }
    if (!std::filesystem::exists(path, unknown)) {
        return fail(ErrorCode::BadInput, whyNoDataset(folder), folder.string());
    }
    const Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    Result<SplitJson> card = parseSplitJson(*text, path.string(), "files");
    if (!card) return tl::unexpected(card.error());
    dataset.card = std::move(card->rest);
    dataset.card_sha256 = sha256Of(std::string_view(*text));
    std::string field = "format";
    try {
        if (dataset.card.value("format", "") != render::kDatasetFormat) {
            return fail(ErrorCode::BadInput,
                        "The file is not the dataset.json of a Dollytrack dataset.", path.string());
        }
        field = "format_version";
        const int version = dataset.card.at(field).get<int>();
        if (version < 1 || version > render::kDatasetVersion) {
            return fail(ErrorCode::BadInput,
                        fmt::format("The dataset has format version {}, but this program reads "
                                    "versions up to {}; use the program's version that made it.",
                                    version, render::kDatasetVersion),
                        path.string());
        }
        if (Status read = readCard(dataset, field); !read) {
            return tl::unexpected(read.error());
        }
        field = "files";
        dataset.sha256s = card->part.at("files").get<std::map<std::string, std::string>>();
        field = "metrics.pictures";
        dataset.unusable_frames = readUnusableFrames(dataset.card);
    } catch (const nlohmann::json::exception&) {
        return fail(ErrorCode::BadInput,
                    "This field of dataset.json is missing or has the wrong type; export the "
                    "dataset again.",
                    path.string() + ": " + field);
    }
    if (Status numbers = checkNumbers(dataset, path.string()); !numbers) {
        return tl::unexpected(numbers.error());
    }
    return dataset;
}

}  // namespace dollytrack::verify
