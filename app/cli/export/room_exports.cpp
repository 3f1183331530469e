#include "app/cli/export/room_exports.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/guarded_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "rooms.json";

/// Whether a name from a file can be a folder name; it must not lead out of the folder.
bool isPlain(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find_first_of("/\\") == std::string::npos;
}

RoomExport takeRoom(const nlohmann::json& room, const Trajectory& all) {
    RoomExport one{room.at("name").get<std::string>(), room, {all.frame_interval_s, {}}};
    one.about.erase("paths");  // path indices of the whole trajectory
    const auto paths = room.at("paths").get<std::set<int>>();
    const TrajectoryFrame* last = nullptr;  // frame of the room
    double time_s = 0.0;
    for (const std::size_t i : motionOrder(all)) {
        TrajectoryFrame frame = motionFrame(all, i);
        if (!paths.contains(frame.path)) continue;
        // Time begins at the first frame with images.
        if (last == nullptr && i >= all.frames.size()) continue;
        // Frames of other rooms are cut out, with their time.
        if (last != nullptr) {
            time_s += frame.path == last->path ? frame.time_s - last->time_s : all.frame_interval_s;
        }
        last = &motionFrame(all, i);
        frame.time_s = time_s;
        (i < all.frames.size() ? one.trajectory.frames : one.trajectory.left_out).push_back(frame);
    }
    return one;
}

}  // namespace

Result<std::vector<RoomExport>> roomExports(const PlannedScene& planned) {
    std::vector<RoomExport> exports;
    const auto rooms = planned.metrics.find("rooms");
    if (rooms == planned.metrics.end()) return exports;
    try {
        for (const nlohmann::json& room : *rooms) {
            RoomExport one = takeRoom(room, planned.trajectory);
            if (!isPlain(one.room)) {
                return fail(ErrorCode::BadInput,
                            fmt::format("'{}' cannot be a folder's name.", one.room),
                            "metrics.rooms");
            }
            if (!one.trajectory.frames.empty()) exports.push_back(std::move(one));
        }
    } catch (const nlohmann::json::exception& e) {
        return fail(ErrorCode::BadInput,
                    fmt::format("A field is missing or of the wrong type ({}).", plainReason(e)),
                    "metrics.rooms");
    }
    return exports;
}

Status checkRooms(const std::vector<RoomExport>& exports, const render::FrameRange& range,
                  const render::FoldSettings& folds) {
    for (const RoomExport& one : exports) {
        const int available = static_cast<int>(one.trajectory.frames.size());
        const int count = static_cast<int>(render::framesOf(range, available).size());
        if (count == 0) {
            return fail(
                ErrorCode::Usage,
                fmt::format("the range contains none of the {} frames of {}; no room was rendered",
                            available, one.room),
                "--range");
        }
        if (count < folds.count) {
            return fail(ErrorCode::Usage,
                        fmt::format("{} has {} frame{}, too few for {} folds; lower --folds or "
                                    "raise the number of frames; no room was rendered",
                                    one.room, count, count == 1 ? "" : "s", folds.count),
                        "--folds");
        }
    }
    return {};
}

Status claimForRooms(const fs::path& folder, const fs::path& root,
                     const std::vector<RoomExport>& exports) {
    std::error_code error;
    if (fs::exists(folder / "dataset.json", error)) {
        return fail(ErrorCode::CannotWrite,
                    "the folder contains one dataset of all rooms; choose another folder for a "
                    "dataset per room, or plan with rooms=joined",
                    folder.string());
    }
    const Result<GuardedFolder> own = GuardedFolder::makeBelow(folder, root);
    if (!own) return tl::unexpected(own.error());
    nlohmann::json list = {{"rooms", nlohmann::json::array()}};
    for (const RoomExport& one : exports) list["rooms"].push_back(one.about);
    return own->write(kList, list.dump(2) + "\n");
}

bool holdsRooms(const fs::path& folder) {
    const auto list = readBoundedJson(folder / kList).value_or(nlohmann::json());
    return list.is_object() && list.contains("rooms");
}

Result<std::vector<fs::path>> roomFolders(const fs::path& folder) {
    std::vector<fs::path> folders;
    const Result<nlohmann::json> list = readBoundedJson(folder / kList);
    if (!list) return tl::unexpected(list.error());
    try {
        for (const nlohmann::json& room : list->at("rooms")) {
            const auto name = room.at("name").get<std::string>();
            if (!isPlain(name)) {
                return fail(ErrorCode::BadInput,
                            fmt::format("'{}' cannot be a room's folder.", name),
                            (folder / kList).string());
            }
            folders.push_back(folder / name);
        }
    } catch (const nlohmann::json::exception& e) {
        return fail(ErrorCode::BadInput, fmt::format("It is damaged ({}).", plainReason(e)),
                    (folder / kList).string());
    }
    if (folders.empty()) {
        return fail(ErrorCode::BadInput, "It lists no room.", (folder / kList).string());
    }
    return folders;
}

Status refuseRooms(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder / "dataset.json", error) || !holdsRooms(folder)) return {};
    const Result<std::vector<fs::path>> rooms = roomFolders(folder);
    if (!rooms) return tl::unexpected(rooms.error());
    std::vector<std::string> names;
    for (const fs::path& room : *rooms) names.push_back(room.filename().string());
    return fail(
        ErrorCode::BadInput,
        fmt::format("The folder contains one dataset per room; give the folder of one of them: {}.",
                    fmt::join(names, ", ")),
        folder.string());
}

JobContext countedOn(const JobContext& job, std::shared_ptr<const std::atomic<bool>> cancel_flag,
                     int before, int count, int total) {
    const auto share = [total](int frames) {
        return total > 0 ? static_cast<double>(frames) / total : 1.0;
    };
    const JobContext whole(
        std::move(cancel_flag),
        [job](double fraction, std::string_view stage) {
            job.stage(0.0, 1.0, stage).report(fraction);
        },
        [job, before, total](int done, int) {
            job.stage(0.0, 1.0, "frames").reportItems(before + done, total);
        });
    return whole.stage(share(before), share(before + count), "");
}

}  // namespace dollytrack::cli
