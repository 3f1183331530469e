#pragma once

#include "app/cli/plan/planned_scene.h"
#include "engine/camera/trajectory.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"
#include "render/dataset/frame_folds.h"
#include "render/dataset/frame_range.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack::cli {

/// A room's trajectory, which becomes a dataset of its own.
struct RoomExport {
    std::string room;  // its name, and its folder's
    nlohmann::json about;
    Trajectory trajectory;
};

/// The trajectories of a plan that has one a room; none where it has one for all. A dataset's
/// frames, poses and times then belong to one motion, as readers of TUM and COCO files take for
/// granted: each begins at time 0. Rooms without frames are left out. Error: BadInput.
Result<std::vector<RoomExport>> roomExports(const PlannedScene& planned);

/// Whether every room has frames in the range, and enough for the folds: asked before the first is
/// rendered. Error: Usage, with the room's name.
Status checkRooms(const std::vector<RoomExport>& exports, const render::FrameRange& range,
                  const render::FoldSettings& folds);

/// Makes the folder of the rooms' folders and writes rooms.json there, which lists them. Before the
/// first frame, so that even what is interrupted can be told from other folders. No link below
/// `root` is followed. Errors: CannotWrite, also when a dataset of all rooms is there.
Status claimForRooms(const std::filesystem::path& folder, const std::filesystem::path& root,
                     const std::vector<RoomExport>& exports);

/// Whether claimForRooms() was there.
bool holdsRooms(const std::filesystem::path& folder);

/// The folders of the rooms that rooms.json lists, whether they are there or not. Error: BadInput.
Result<std::vector<std::filesystem::path>> roomFolders(const std::filesystem::path& folder);

/// A job's context for `count` of its `total` frames, `before` of which are done.
JobContext countedOn(const JobContext& job, std::shared_ptr<const std::atomic<bool>> cancel_flag,
                     int before, int count, int total);

}  // namespace dollytrack::cli
