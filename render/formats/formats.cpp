#include "render/formats/formats.h"

#include "render/dataset/contents/name_selection.h"
#include "render/formats/labels/bop.h"
#include "render/formats/labels/coco.h"
#include "render/formats/labels/kitti_objects.h"
#include "render/formats/labels/yolo.h"
#include "render/formats/media/video.h"
#include "render/formats/poses/calibration.h"
#include "render/formats/poses/camera_json.h"
#include "render/formats/poses/colmap.h"
#include "render/formats/poses/euroc.h"
#include "render/formats/poses/imu_csv.h"
#include "render/formats/poses/instant_ngp.h"
#include "render/formats/poses/kitti.h"
#include "render/formats/poses/nerfstudio.h"
#include "render/formats/poses/tartan_air.h"
#include "render/formats/poses/tum.h"
#include "render/formats/scenes/gltf.h"
#include "render/formats/tables/frames_csv.h"
#include "render/formats/tables/hdf5_frames.h"
#include "render/formats/tables/instances_csv.h"

namespace dollytrack::render {
namespace {

const std::vector<Format>& table() {
    // Built at first use, when the rows defined in other files are initialised.
    static const std::vector<Format> rows = {
        kCocoFormat,       kCameraJsonFormat,   kFramesFormat,       kImuFormat,
        kInstancesFormat,  kCocoPolygonsFormat, kYoloFormat,         kBopFormat,
        kTumFormat,        kEurocFormat,        kKittiFormat,        kColmapFormat,
        kNerfstudioFormat, kInstantNgpFormat,   kKittiObjectsFormat, kTartanAirFormat,
        kHdf5FramesFormat, kGltfFormat,         kVideoFormat,        kCalibrationFormat,
    };
    return rows;
}

}  // namespace

std::span<const Format> formats() {
    return table();
}

Result<FormatSet> chooseFormats(const std::vector<std::string>& names) {
    return chooseRows(formats(), names, "format", "--formats");
}

Status checkNeeds(const FormatSet& formats, const ModalitySet& modalities) {
    for (const Format* format : formats) {
        if (const char* missing = format->missing ? format->missing() : nullptr) {
            return fail(
                ErrorCode::Failed,
                std::string("The format '") + format->name + "' cannot be written: " + missing,
                "--formats");
        }
        if (!format->modality || contains(modalities, format->modality)) continue;
        return fail(ErrorCode::Usage,
                    std::string("The format '") + format->name + "' needs the modality '" +
                        format->modality +
                        "', which --modalities leaves out; add it, or choose other formats.",
                    "--formats");
    }
    return {};
}

}  // namespace dollytrack::render
