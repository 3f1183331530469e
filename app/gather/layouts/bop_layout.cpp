#include "app/gather/layouts/layout.h"
#include "engine/io/files/bounded_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

namespace dollytrack::gather {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 2> kBopRequired = {kDepth, "bop"};
constexpr std::array<const char*, 3> kBopCopied = {"mask/", "mask_visib/", "scene_"};
constexpr const char* kBopMasks = "mask";
constexpr const char* kBopVisibleMasks = "mask_visib";
constexpr const char* kTruthFile = "scene_gt.json";

/// The frame that a key of scene_gt.json names; `frames` if it names none.
std::size_t frameOfKey(const std::string& key, std::size_t frames) {
    std::size_t frame = 0;
    const auto read = std::from_chars(key.data(), key.data() + key.size(), frame);
    const bool is_number = read.ec == std::errc() && read.ptr == key.data() + key.size();
    return is_number ? std::min(frame, frames) : frames;
}

/// Each dataset becomes a scene of BOP. Objects are numbered anew: an object of a scene has one id
/// in all datasets of that scene, and those of different scenes have different ids.
class BopLayout : public Layout {
  public:
    explicit BopLayout(LayoutInput input) : input_(std::move(input)) {}

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        return {};
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        if (begin == 0) {
            if (Status begun = beginScene(source); !begun) return begun;
        }
        for (const std::string folder : {kPicture, kDepth, kBopMasks, kBopVisibleMasks}) {
            const bool is_mask = folder == kBopMasks || folder == kBopVisibleMasks;
            Status copied = input_.files.copyFrames(
                source, folder, begin, end,
                [&](std::size_t frame) { return is_mask ? objects_in_frame_[frame] : 1; },
                scene_folder_ + "/" + folder, input_.job);
            if (!copied) return copied;
        }
        return {};
    }

    Status endPart() override { return {}; }

    Status finish(std::span<const PartIndex> /*parts*/) override {
        if (lens_ && !lenses_differ_) {
            // BOP puts pixel centres at integer coordinates.
            const Json camera = {{"cx", lens_->cx - 0.5}, {"cy", lens_->cy - 0.5},
                                 {"depth_scale", 1.0},    {"fx", lens_->fx},
                                 {"fy", lens_->fy},       {"height", lens_->height},
                                 {"width", lens_->width}};
            const Status written = input_.files.write("camera.json", camera.dump(1) + "\n");
            if (!written) return written;
        }
        const Json index = {{"scenes", std::move(scenes_)}, {"objects", std::move(objects_)}};
        return input_.files.write("index.json", index.dump(1) + "\n");
    }

  private:
    Status beginScene(const OpenedSource& source) {
        const std::size_t number = scenes_.size();
        scene_folder_ = fmt::format("{}/{:06}", part_, number);
        scenes_.push_back({{"scene_id", number},
                           {"part", part_},
                           {"source", source.source.name},
                           {"scene", source.source.scene}});
        const Intrinsics& lens = source.dataset.lens;
        lenses_differ_ =
            lenses_differ_ || (lens_ && (lens_->fx != lens.fx || lens_->fy != lens.fy));
        if (!lens_) lens_ = lens;
        const Result<std::string> truth = truthOf(source);
        if (!truth) return tl::unexpected(truth.error());
        Status written = input_.files.write(scene_folder_ + "/" + kTruthFile, *truth);
        if (!written) return written;
        return input_.files.copyFiles(source,
                                      {{"scene_camera.json", "scene_camera.json"},
                                       {"scene_gt_info.json", "scene_gt_info.json"}},
                                      scene_folder_, input_.job);
    }

    /// The dataset's scene_gt.json with the new object ids. Counts the objects of each frame.
    Result<std::string> truthOf(const OpenedSource& source) {
        const Result<SourceFile> file = listedFile(source.dataset, kTruthFile);
        if (!file) return tl::unexpected(file.error());
        const Result<std::string> text = readProven(*file);
        if (!text) return tl::unexpected(text.error());
        std::vector<std::string> lines(source.source.frames);
        objects_in_frame_.assign(lines.size(), 0);
        bool is_damaged = false;
        std::size_t frame = lines.size();
        // Frame by frame, so that the JSON of only one is in memory.
        const auto take = [&](int depth, nlohmann::json::parse_event_t event,
                              nlohmann::json& value) {
            if (depth == 1 && event == nlohmann::json::parse_event_t::key) {
                frame = frameOfKey(value.get<std::string>(), lines.size());
                is_damaged = is_damaged || frame == lines.size();
            }
            if (depth != 1 || event != nlohmann::json::parse_event_t::array_end) return true;
            if (is_damaged || !renumber(value, source)) {
                is_damaged = true;
            } else {
                objects_in_frame_[frame] = value.size();
                lines[frame] = fmt::format("\n\"{}\": {}", frame, value.dump());
            }
            return false;
        };
        const Result<nlohmann::json> parsed =
            parseBoundedJson<nlohmann::json>(*text, file->path.string(), take);
        if (!parsed) return tl::unexpected(parsed.error());
        std::string result = "{";
        for (const std::string& line : lines) {
            if (is_damaged || line.empty()) {
                return fail(ErrorCode::BadInput,
                            "It lacks a frame, or names an object that dataset.json does not list; "
                            "export the dataset again.",
                            file->path.string());
            }
            if (result.size() > 1) result += ',';
            result += line;
        }
        return result + "\n}\n";
    }

    /// Replaces the object ids. Returns false if one is not in dataset.json.
    bool renumber(nlohmann::json& objects, const OpenedSource& source) {
        for (nlohmann::json& one : objects) {
            if (!one.is_object() || !one.contains("obj_id")) return false;
            nlohmann::json& id = one["obj_id"];
            const auto number = id.is_number_integer() ? id.get<std::int64_t>() : 0;
            if (number < 1 || number > std::numeric_limits<int>::max()) return false;
            const verify::StoredObject* object = source.dataset.object(static_cast<int>(number));
            if (object == nullptr) return false;
            id = idOf(*object, source);
        }
        return true;
    }

    int idOf(const verify::StoredObject& object, const OpenedSource& source) {
        const std::size_t number = objects_.size() + 1;
        const auto [known, is_new] =
            ids_.emplace(std::tuple(source.source.scene_number, object.id, object.name),
                         static_cast<int>(number));
        if (!is_new) return known->second;
        Json described = {{"obj_id", number},
                          {"scene", source.source.scene},
                          {"scene_object_id", object.id},
                          {"name", object.name}};
        if (const DatasetClass* of = source.dataset.boxClass(object)) {
            const GatheredClass& gathered = input_.classes.classes()[input_.classes.indexOf(*of)];
            described["category_id"] = gathered.id;
            described["category"] = gathered.name;
        }
        constexpr double kMillimetres = 1000.0;
        const Eigen::Vector3d size = 2.0 * kMillimetres * object.box.half_size;
        described["size_mm"] = {size.x(), size.y(), size.z()};
        objects_.push_back(std::move(described));
        return known->second;
    }

    LayoutInput input_;
    std::string part_;
    std::string scene_folder_;
    std::vector<std::size_t> objects_in_frame_;  // of the current scene
    std::optional<Intrinsics> lens_;             // of the first dataset
    bool lenses_differ_ = false;
    std::map<std::tuple<std::size_t, int, std::string>, int> ids_;  // by scene, id there and name
    Json scenes_ = Json::array();
    Json objects_ = Json::array();
};

}  // namespace

const LayoutKind kBopLayout = {
    .name = "bop",
    .text = "scenes of the BOP benchmark: PART/000000/ with rgb, depth, masks and object poses",
    .content = LayoutContent::Colour,
    .tasks = kMaskTasks,
    .make = makeLayout<BopLayout>,
    .labels = kBoxesAndMasks,
    .how_to_read =
        "Readers of the BOP benchmark, such as bop_toolkit, take each `PART/000000/` as a scene, "
        "with `scene_camera.json`, `scene_gt.json` and `scene_gt_info.json` in millimetres. There "
        "are no models: an object's origin and axes are the centre and the axes of its box. "
        "`index.json` has each object's name, class and box size, and each scene's source. An "
        "object has one `obj_id` in all datasets of its scene. `cam_K` puts the centre of the "
        "first "
        "pixel at (0, 0), which is (0.5, 0.5) under Conventions; poses are from the world to the "
        "camera. `bbox_obj` ends at the borders of the image.",
    .data_files = nullptr,
    .required = kBopRequired,
    .copied = kBopCopied,
};

}  // namespace dollytrack::gather
