// Checks transforms.json of nerfstudio and instant-ngp except poses: lens, names, and scaling.
#include "engine/io/files/bounded_json.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/json_file.h"
#include "render/verify/read/sensor_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace dollytrack::verify {
namespace {

using Json = nlohmann::json;

constexpr double kTransformsTolerance = 1e-9;

/// Differences between the two formats.
struct TransformsFile {
    const char* format;
    const char* file;
    const char* depth_key;
    bool in_unit_cube;  // instant-ngp only
};

constexpr std::array kFiles = {
    TransformsFile{"nerfstudio", "transforms.json", "depth_file_path", false},
    TransformsFile{"instant_ngp", "transforms_ngp.json", "depth_path", true},
};

class FileCheck {
  public:
    FileCheck(const Subject& subject, const TransformsFile& file, Findings& findings)
        : subject_(subject),
          dataset_(subject.dataset),
          bent_(distortionOfPictures(subject.dataset)),
          file_(file),
          findings_(findings) {}

    void run() {
        const Result<Json> read = readJson(dataset_.folder / file_.file);
        if (!read) return add({}, read.error().message, "frames");
        const Json& root = *read;
        checkLens(root);
        const Json& frames = root.at("frames");
        if (frames.size() != dataset_.frames.size()) {
            add({}, fmt::format("{} frames", frames.size()),
                fmt::format("{}", dataset_.frames.size()));
        }
        for (std::size_t i = 0; i < std::min(frames.size(), dataset_.frames.size()); ++i) {
            checkNames(static_cast<int>(i), frames[i]);
        }
        if (file_.in_unit_cube) checkCube(root);
    }

  private:
    /// Depth is undistorted, so it is not listed beside distorted images.
    [[nodiscard]] bool depthIsNamed() const { return dataset_.has("depth") && bent_.none(); }

    void add(std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({file_.file, frame, {}, std::move(found), std::move(expected)});
    }

    void compare(const Json& root, const char* key, double expected) {
        const double found = root.at(key).get<double>();
        if (std::abs(found - expected) <= kTransformsTolerance * std::max(1.0, std::abs(expected)))
            return;
        add({}, fmt::format("{} {:.9g}", key, found), fmt::format("{:.9g}", expected));
    }

    void checkLens(const Json& root) {
        const Intrinsics& lens = dataset_.lens;
        compare(root, "fl_x", lens.fx);
        compare(root, "fl_y", lens.fy);
        compare(root, "cx", lens.cx);
        compare(root, "cy", lens.cy);
        compare(root, "w", lens.width);
        compare(root, "h", lens.height);
        compare(root, "k1", bent_.k1);
        compare(root, "k2", bent_.k2);
        compare(root, "p1", bent_.p1);
        compare(root, "p2", bent_.p2);
        if (bent_.k3 != 0.0) compare(root, "k3", bent_.k3);
        if (!file_.in_unit_cube) {
            const auto model = root.at("camera_model").get<std::string>();
            if (model != "OPENCV") add({}, "camera_model " + model, "OPENCV");
            return;
        }
        compare(root, "camera_angle_x", 2.0 * std::atan(0.5 * lens.width / lens.fx));
        compare(root, "camera_angle_y", 2.0 * std::atan(0.5 * lens.height / lens.fy));
        if (depthIsNamed()) compare(root, "integer_depth_scale", 0.001);
    }

    void checkNames(int frame, const Json& one) {
        const auto picture = one.at("file_path").get<std::string>();
        const bool numbered = picture.find(fmt::format("/{:06}.", frame)) != std::string::npos;
        if (!numbered || !dataset_.sha256s.contains(picture)) {
            add(frame, "file_path " + picture, fmt::format("an image of frame {}", frame));
        }
        if (!depthIsNamed()) return;
        const auto depth = one.at(file_.depth_key).get<std::string>();
        if (depth == imageFile("depth", frame)) return;
        add(frame, fmt::format("{} {}", file_.depth_key, depth), imageFile("depth", frame));
    }

    /// After scaling and offset, cameras and rooms lie in the unit cube and fill it.
    void checkCube(const Json& root) {
        const double scale = root.at("scale").get<double>();
        const auto o = root.at("offset").get<std::array<double, 3>>();
        const Eigen::Vector3d offset(o[0], o[1], o[2]);
        Eigen::AlignedBox3d span;
        for (const StoredFrame& frame : dataset_.frames) span.extend(frame.pose.position);
        if (subject_.scene && !subject_.scene->room_bounds.isEmpty()) {
            span.extend(subject_.scene->room_bounds);
        }
        if (span.isEmpty()) return;
        const Eigen::Vector3d low = scale * span.min() + offset;
        const Eigen::Vector3d high = scale * span.max() + offset;
        const char* what = subject_.scene ? "the room" : "the cameras";
        if (!(low.minCoeff() >= -1e-6 && high.maxCoeff() <= 1.0 + 1e-6)) {
            add({}, fmt::format("scale and offset put {} beyond the unit cube", what), "inside");
        }
        if (!subject_.scene) return;
        const double filled = (high - low).maxCoeff();
        if (filled >= 0.9) return;
        add({}, fmt::format("the room's longest side is {:.3g} of the unit cube's edge", filled),
            "0.95");
    }

    const Subject& subject_;
    const StoredDataset& dataset_;
    StoredDistortion bent_;
    const TransformsFile& file_;
    Findings& findings_;
};

}  // namespace

CheckWork beginTransforms(const Subject& subject, Findings& findings) {
    for (const TransformsFile& file : kFiles) {
        if (!subject.dataset.has(file.format)) continue;
        try {
            FileCheck(subject, file, findings).run();
        } catch (const Json::exception& error) {
            findings.add({file.file, {}, {}, plainReason(error), "a transforms.json"});
        }
    }
    return {};
}

}  // namespace dollytrack::verify
