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

/// How a planned trajectory becomes a dataset. What the parameters decide of the settings is filled
/// in by the functions below.
struct ExportOrder {
    render::DatasetSettings settings;
    bool still = false;  // objects that have a track stay where the plan has them
    std::string scene;   // as errors name it; empty: the scene file
    BackendOption backend;
};

/// One dataset that was written.
struct ExportedDataset {
    std::string room;  // whose it is; empty: of all rooms
    std::string folder;
    render::DatasetSummary summary;
};

/// A sensor that was set just now and that nothing is taken with was meant for something else.
/// Error: Usage.
Status checkSensor(const std::vector<std::string>& assignments,
                   const render::DatasetSettings& settings);

/// The cameras of a file (empty: none), then those given as text. Errors: BadInput, Usage.
Result<Rig> rigOf(const std::string& file, const std::vector<std::string>& cameras);

/// Whether an export into the folder could begin. Errors as render::checkSettings().
Status checkFolder(const render::DatasetSettings& settings);

/// Fits the lens of the sensor's preset to the camera. Error: Usage where it shows nothing.
Status fitSensor(OpenedScene& opened, const render::DatasetSettings& settings);

/// Renders the trajectory into the folder, or each room's into a folder of its own. `on_written` is
/// called after each dataset. Errors: Failed where there is no frame; as render::exportDataset().
Result<std::vector<ExportedDataset>> exportPlanned(
    const OpenedScene& opened, const PlannedScene& planned, ExportOrder order,
    std::unique_ptr<gl::Context> context,
    const std::function<void(const ExportedDataset&)>& on_written,
    std::shared_ptr<const std::atomic<bool>> cancel_flag, const JobContext& job);

/// The frames of the trajectory, all rooms together, without any file. `rays` are the scene's and
/// must outlive them, as must `planned`.
Result<render::FrameSeries> beginFrames(const OpenedScene& opened, const PlannedScene& planned,
                                        const RayCaster& rays, ExportOrder order,
                                        std::unique_ptr<gl::Context> context,
                                        const JobContext& job);

/// What `export --json` prints of it.
nlohmann::json exportJson(const ExportOrder& order, const std::vector<ExportedDataset>& datasets,
                          const nlohmann::json& planned);

}  // namespace dollytrack::cli
