#pragma once

#include "engine/camera/camera_motion.h"
#include "engine/camera/camera_params.h"
#include "engine/camera/rig.h"
#include "engine/camera/sensor_params.h"
#include "engine/camera/trajectory.h"
#include "engine/plan/capture.h"
#include "engine/plan/image_score.h"
#include "engine/scene/light_params.h"
#include "engine/scene/scene.h"
#include "render/dataset/contents/frame_folds.h"
#include "render/dataset/contents/modality.h"
#include "render/frames/frame_file.h"
#include "render/frames/instances.h"
#include "render/frames/mask_rle.h"
#include "render/pictures/picture_quality.h"
#include "render/scene/object_motion.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// One exported frame: pose and results, without images.
struct DatasetFrame {
    TrajectoryFrame camera;
    int source_frame = 0;           // frame number in the trajectory
    std::string room;               // for example "room 1"
    double clearance_m = 0.0;       // exact distance from the camera centre to the nearest surface
    std::vector<int> well_shown;    // ids of the targets that it shows well
    std::vector<ObjectMask> masks;  // visible masks of all objects; empty unless a format needs
                                    // them
    std::vector<InstanceInFrame> instances;  // of visible objects; empty unless needed
    std::optional<PictureQuality> quality;   // of the colour image; none without modality rgb
};

/// Everything that formats write from, except the images themselves.
struct DatasetContents {
    const Scene& scene;
    CameraParams camera;
    ModalitySet modalities;            // modalities in the dataset
    std::vector<DatasetFrame> frames;  // by index
    CameraMotion camera_motion = {};   // continuous motion along the whole trajectory
    double frame_interval_s = 0.1;     // of the whole trajectory
    double imu_rate_hz = 200.0;
    ScoreWeights score = {};
    std::vector<int> flow_distances = {1};  // in frames of the dataset, each at least 1
    double stereo_baseline_m = 0.1;
    std::vector<ObjectMotion> motions = {};  // of moving objects, by frame of the dataset
    FoldSettings folds = {};
    SensorParams sensor = {};
    LightParams light = {};
    Rig rig = {};                       // additional cameras, fixed to the planned one
    std::filesystem::path folder = {};  // folder of the images, for files made from them

    /// A frame's number in the trajectory. It seeds random numbers, so that exporting a part of the
    /// frames gives the same bytes.
    [[nodiscard]] int sourceFrame(int index) const { return frames[index].source_frame; }

    /// The modality that other files show or refer to: rgb, else rgb_sensor, else the first that is
    /// an image, else the first of all.
    [[nodiscard]] const Modality& pictureModality() const {
        for (const std::string_view first : {std::string_view("rgb"), kRgbSensor}) {
            for (const Modality* modality : modalities) {
                if (first == modality->name) return *modality;
            }
        }
        for (const Modality* modality : modalities) {
            if (modality->is_picture) return *modality;
        }
        return *modalities.front();
    }
    [[nodiscard]] std::string pictureFile(int index) const {
        const Modality& picture = pictureModality();
        const bool of_sensor = std::string_view(picture.name) == kRgbSensor;
        return frameFile(picture.name, index, of_sensor ? pictureEnding(sensor) : ".png");
    }
};

}  // namespace dollytrack::render
