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
#include "render/dataset/frame_folds.h"
#include "render/dataset/modalities.h"
#include "render/dataset/picture_quality.h"
#include "render/formats/labels/mask_rle.h"
#include "render/frames/frame_file.h"
#include "render/frames/instances.h"
#include "render/frames/object_motion.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::render {

/// One frame of a dataset whose images are written.
struct DatasetFrame {
    TrajectoryFrame camera;
    int source_frame = 0;           // its index in the trajectory
    std::string room;               // "room 1"
    double clearance_m = 0.0;       // from the camera's centre to the nearest surface, exact
    std::vector<int> well_shown;    // ids of the targets it shows well
    std::vector<ObjectMask> masks;  // of all objects; empty when no format needs them
    std::vector<InstanceInFrame> instances;  // of the things seen; empty when nothing needs them
    std::optional<PictureQuality> quality;   // of the picture; none without a modality rgb
};

/// Everything a format writes from: the dataset but for the images themselves.
struct DatasetContents {
    const Scene& scene;
    CameraParams camera;
    ModalitySet modalities;            // whose images are in the dataset
    std::vector<DatasetFrame> frames;  // by index
    CameraMotion camera_motion = {};   // through the whole trajectory, of which frames are a part
    double frame_interval_s = 0.1;     // of that trajectory
    double imu_rate_hz = 200.0;
    ScoreWeights score = {};
    std::vector<int> flow_distances = {1};  // in frames, each at least 1
    double stereo_baseline_m = 0.1;
    std::vector<ObjectMotion> motions = {};  // of the objects that move
    FoldSettings folds = {};
    SensorParams sensor = {};
    LightParams light = {};
    Rig rig = {};                       // further cameras, that ride on the planned one
    std::filesystem::path folder = {};  // where the images are, for what is made from them

    /// A frame's index in the trajectory: what numbers its random numbers, so that a part of the
    /// frames has the bytes that all would have.
    [[nodiscard]] int sourceFrame(int index) const {
        return frames[static_cast<std::size_t>(index)].source_frame;
    }

    /// What other files show or refer to: the colour pictures, else the sensor's, else the first
    /// there are, else the first of what is no picture.
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
