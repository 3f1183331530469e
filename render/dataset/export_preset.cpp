#include "render/dataset/export_preset.h"

#include "engine/core/name_hint.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::render {
namespace {

const std::vector<ExportPreset>& presets() {
    // Built at first use, because vectors cannot be constants.
    static const std::vector<ExportPreset> rows = {
        {"default",
         "Default",
         "colour, depth, objects and classes, with COCO masks, poses and measurements",
         {},
         {}},
        {"nerf",
         "NeRF",
         "radiance fields and Gaussian splatting: colour and depth, poses for nerfstudio, "
         "instant-ngp and COLMAP",
         {"rgb", "depth"},
         {"camera_json", "nerfstudio", "instant_ngp", "colmap"}},
        {"slam",
         "SLAM",
         "odometry and SLAM: colour and depth, poses as in TUM and EuRoC, inertial measurements; "
         "plan with motion_preset slam",
         {"rgb", "depth"},
         {"camera_json", "tum", "euroc", "imu", "frames", "calibration"}},
        {"detection",
         "Detection",
         "object detection: colour, 2D and 3D boxes for COCO, YOLO and KITTI, visibility",
         {"rgb"},
         {"camera_json", "coco", "yolo", "kitti_objects", "instances"}},
        {"segmentation",
         "Segmentation",
         "segmentation: colour, objects and classes, masks and outlines for COCO and YOLO",
         {"rgb", "instance", "semantic"},
         {"camera_json", "coco", "coco_polygons", "yolo"}},
        {"everything", "Everything", "all modalities and formats", {"all"}, {"all"}},
    };
    return rows;
}

}  // namespace

std::span<const ExportPreset> exportPresets() {
    return presets();
}

Status applyPreset(std::string_view name, DatasetSettings& settings) {
    if (name.empty()) return {};
    const auto found = std::ranges::find(presets(), name, &ExportPreset::name);
    if (found == presets().end()) {
        std::vector<std::string> known;
        for (const ExportPreset& one : presets()) known.emplace_back(one.name);
        return fail(ErrorCode::Usage,
                    fmt::format("There is no export preset '{}'{}", name, nameHint(name, known)),
                    "--preset");
    }
    if (settings.modalities.empty()) settings.modalities = found->modalities;
    if (settings.formats.empty()) settings.formats = found->formats;
    return {};
}

}  // namespace dollytrack::render
