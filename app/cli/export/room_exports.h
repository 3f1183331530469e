#pragma once

#include "app/cli/plan/planned_scene.h"
#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/dataset/contents/frame_folds.h"
#include "render/dataset/frame_range.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// The trajectory of one room, exported as its own dataset.
struct RoomExport {
    std::string room;  // name of the room and of its folder
    nlohmann::json about;
    Trajectory trajectory;
};

/// The trajectories of a plan with one trajectory per room; empty for a single trajectory. Each
/// dataset is then one motion that starts at time 0, as readers of TUM and COCO files expect. Rooms
/// without frames are omitted. Error: BadInput if the stored rooms are damaged.
Result<std::vector<RoomExport>> roomExports(const PlannedScene& planned);

/// Checks, before rendering, that every room has frames in the range, and enough for the folds.
/// Error: Usage, with the room's name.
Status checkRooms(const std::vector<RoomExport>& exports, const render::FrameRange& range,
                  const render::FoldSettings& folds);

/// Creates the folder of the room folders and writes rooms.json, which lists them, before the first
/// frame, so that even an interrupted export is recognized. Symbolic links below `root` are not
/// followed. Error: CannotWrite, also if the folder contains a dataset of all rooms.
Status claimForRooms(const std::filesystem::path& folder, const std::filesystem::path& root,
                     const std::vector<RoomExport>& exports);

/// Whether the folder contains a rooms.json.
bool holdsRooms(const std::filesystem::path& folder);

/// The room folders that rooms.json lists; they need not exist. Error: BadInput.
Result<std::vector<std::filesystem::path>> roomFolders(const std::filesystem::path& folder);

/// Refuses a folder with one dataset per room, naming the rooms. Error: BadInput.
Status refuseRooms(const std::filesystem::path& folder);

/// A job context that reports `count` frames of a dataset as frames before .. before + count of
/// `total`.
JobContext countedOn(const JobContext& job, std::shared_ptr<const std::atomic<bool>> cancel_flag,
                     int before, int count, int total);

}  // namespace dollytrack::cli
