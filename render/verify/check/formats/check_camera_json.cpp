// Checks camera.json except its poses: lens, planes, and the targets that each frame shows well.
#include "engine/io/files/bounded_json.h"
#include "engine/plan/capture.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/json_file.h"
#include "render/verify/read/number_table.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace dollytrack::verify {
namespace {

using Json = nlohmann::json;

constexpr const char* kCameraJsonFile = "camera.json";
constexpr double kCameraJsonTolerance = 1e-6;

using Names = std::vector<std::string>;

/// Data for comparing the targets.
struct Targets {
    std::vector<Names> of_frame;                           // names in the file, sorted
    std::vector<std::map<int, double>> visible_fractions;  // by object; empty without instances.csv
};

double farthestCorner(const StoredDataset& dataset, const Eigen::AlignedBox3d& room) {
    double farthest = 0.0;
    for (const StoredFrame& frame : dataset.frames) {
        for (int corner = 0; corner < 8 && !room.isEmpty(); ++corner) {
            const auto at = room.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
            farthest = std::max(farthest, (at - frame.pose.position).norm());
        }
    }
    return farthest;
}

class EntryCheck {
  public:
    EntryCheck(const Subject& subject, Findings& findings)
        : subject_(subject), dataset_(subject.dataset), findings_(findings) {}

    void run(int frame, const Json& entry) {
        const Intrinsics& lens = dataset_.lens;
        compare(frame, entry, "fov", dataset_.hfov_deg);
        compare(frame, entry, "near", dataset_.near_m);
        compare(frame, entry, "width", lens.width);
        compare(frame, entry, "height", lens.height);
        compare(frame, entry, "time", dataset_.frames[frame].time_s);
        const auto axis = entry.at("fov_axis").get<std::string>();
        if (axis != "h") add(frame, "fov_axis " + axis, "h");
        checkFar(frame, entry.at("far").get<double>());
    }

  private:
    void add(int frame, std::string found, std::string expected) {
        findings_.add({kCameraJsonFile, frame, {}, std::move(found), std::move(expected)});
    }

    void compare(int frame, const Json& entry, const char* key, double expected) {
        const double found = entry.at(key).get<double>();
        if (std::abs(found - expected) <= kCameraJsonTolerance) return;
        add(frame, fmt::format("{} {:.9g}", key, found), fmt::format("{:.9g}", expected));
    }

    /// There is one far plane for all frames, a metre or two behind the room's farthest corner.
    void checkFar(int frame, double far_m) {
        if (frame == 0) far_m_ = far_m;
        if (far_m != far_m_ || !(far_m > dataset_.near_m)) {
            add(frame, fmt::format("far {:.6g} m", far_m),
                fmt::format("{:.6g} m, that of frame 0, behind the near plane", far_m_));
        }
        if (!subject_.scene || frame > 0) return;
        const double corner = farthestCorner(dataset_, subject_.scene->room_bounds);
        if (far_m >= corner + 1.0 - kCameraJsonTolerance &&
            far_m <= corner + 2.0 + kCameraJsonTolerance)
            return;
        add(frame, fmt::format("far {:.6g} m", far_m),
            fmt::format("1 to 2 m behind the room's farthest corner, which is {:.6g} m away",
                        corner));
    }

    const Subject& subject_;
    const StoredDataset& dataset_;
    Findings& findings_;
    double far_m_ = 0.0;
};

void readVisibleFractions(const StoredDataset& dataset, Targets& targets) {
    if (!dataset.has("instances")) return;
    const auto table = NumberTable::read(dataset.folder / "instances.csv");
    if (!table) return;  // reported by another check
    targets.visible_fractions.resize(dataset.frames.size());
    for (std::size_t row = 0; row < table->rows(); ++row) {
        const double frame = table->number(row, "frame").value_or(-1.0);
        if (!(frame >= 0.0 && frame < static_cast<double>(dataset.frames.size()))) continue;
        const auto id = table->number(row, "object_id");
        const auto fraction = table->number(row, "visible_fraction");
        if (!id || !fraction) continue;
        targets.visible_fractions[frame][static_cast<int>(*id)] = *fraction;
    }
}

std::string listed(const Names& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

/// Targets that a frame shows well: 120 px at 640 x 480, a box of 5 % of the image and, if
/// instances.csv tells, 80 % of the object visible.
void compareTargets(const StoredDataset& dataset, const Targets& targets, FrameImages& images,
                    Findings& findings) {
    const Image16* ids = images.image16("instance");
    if (!ids) return;
    const std::size_t frame = images.frame();
    const CaptureRules rules;
    const double area = static_cast<double>(ids->width) * ids->height;
    Names may, must;
    for (const auto& [id, shown] : images.seen()) {
        if (dataset.unusable_frames.contains(images.frame())) break;
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target") continue;
        const auto box = shown.box();
        if (shown.count * (640.0 * 480.0) / area < rules.min_visible_px ||
            box[2] * box[3] / area < rules.min_box_share) {
            continue;
        }
        double fraction = std::nan("");
        if (!targets.visible_fractions.empty()) {
            const auto& known = targets.visible_fractions[frame];
            if (const auto at = known.find(id); at != known.end()) fraction = at->second;
        }
        // The file has six digits.
        if (!(fraction < rules.min_visible_fraction - kCameraJsonTolerance))
            may.push_back(object->name);
        if (fraction > rules.min_visible_fraction + kCameraJsonTolerance)
            must.push_back(object->name);
    }
    std::sort(may.begin(), may.end());
    std::sort(must.begin(), must.end());
    const Names& found = targets.of_frame[frame];
    if (std::includes(may.begin(), may.end(), found.begin(), found.end()) &&
        std::includes(found.begin(), found.end(), must.begin(), must.end())) {
        return;
    }
    findings.add({kCameraJsonFile,
                  images.frame(),
                  {},
                  "targets " + listed(found),
                  (must == may ? "" : "of these: ") + listed(may)});
}

}  // namespace

CheckWork beginCameraJson(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    auto targets = std::make_shared<Targets>();
    try {
        const Result<Json> read = readJson(dataset.folder / kCameraJsonFile);
        if (!read) {
            findings.add({kCameraJsonFile, {}, {}, read.error().message, "an array of cameras"});
            return {};
        }
        const Json& root = *read;
        if (root.size() != dataset.frames.size()) {
            findings.add({kCameraJsonFile,
                          {},
                          {},
                          fmt::format("{} frames", root.size()),
                          fmt::format("{}", dataset.frames.size())});
            return {};
        }
        EntryCheck check(subject, findings);
        for (std::size_t i = 0; i < root.size(); ++i) {
            check.run(static_cast<int>(i), root.at(i));
            Names names = root.at(i).at("targets").get<Names>();
            std::sort(names.begin(), names.end());
            targets->of_frame.push_back(std::move(names));
        }
    } catch (const Json::exception& error) {
        findings.add({kCameraJsonFile, {}, {}, plainReason(error), "an array of cameras"});
        return {};
    }
    readVisibleFractions(dataset, *targets);
    CheckWork work;
    work.frame = [&dataset, targets](FrameImages& images, Findings& found) {
        compareTargets(dataset, *targets, images, found);
    };
    return work;
}

}  // namespace dollytrack::verify
