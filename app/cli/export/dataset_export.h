#pragma once

#include "app/cli/export/backend_option.h"
#include "app/cli/plan/planned_scene.h"
#include "engine/geometry/ray_caster.h"
#include "render/dataset/dataset_job.h"
#include "render/dataset/frame_drawing.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// Settings of an export. Those that come from the plan's parameters are filled in by the functions
/// below.
struct ExportOrder {
    render::DatasetSettings settings;
    bool still = false;  // objects with a track stay at their planned poses
    std::string scene;   // scene name in error messages; empty: the scene file
    BackendOption backend;
};

/// A written dataset.
struct ExportedDataset {
    std::string room;  // its room; empty: all rooms
    std::string folder;
    render::DatasetSummary summary;
};

/// Refuses sensor parameters on the command line if no sensor modality is exported. Error: Usage.
Status checkSensor(const std::vector<std::string>& assignments,
                   const render::DatasetSettings& settings);

/// The rig of additional cameras: those of the file (empty: none), then those given as text.
/// Errors: BadInput, Usage.
Result<Rig> rigOf(const std::string& file, const std::vector<std::string>& cameras);

/// Checks whether an export into the folder can start. Errors: those of render::checkSettings().
Status checkFolder(const render::DatasetSettings& settings);

/// Fits the lens distortion of the sensor's preset to the camera. Error: Usage if the lens leaves
/// nothing visible.
Status fitSensor(OpenedScene& opened, const render::DatasetSettings& settings);

/// Renders the trajectory into the folder, or each room's trajectory into a folder of its own.
/// `on_written` is called after each dataset. Errors: Failed if there are no frames; those of
/// render::exportDataset().
Result<std::vector<ExportedDataset>> exportPlanned(
    const OpenedScene& opened, const PlannedScene& planned, ExportOrder order,
    std::unique_ptr<gl::Context> context,
    const std::function<void(const ExportedDataset&)>& on_written,
    std::shared_ptr<const std::atomic<bool>> cancel_flag, const JobContext& job);

/// Begins rendering the frames of the whole trajectory in memory, without files. `rays` (of the
/// scene) and `planned` must outlive the result.
Result<render::FrameSeries> beginFrames(const OpenedScene& opened, const PlannedScene& planned,
                                        const RayCaster& rays, ExportOrder order,
                                        std::unique_ptr<gl::Context> context,
                                        const JobContext& job);

/// The output of `export --json`.
nlohmann::json exportJson(const ExportOrder& order, const std::vector<ExportedDataset>& datasets,
                          const nlohmann::json& planned);

}  // namespace dollytrack::cli
