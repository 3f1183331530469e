#include "app/gather/layouts/layout.h"
#include "engine/core/log.h"

#include <fmt/format.h>

#include <map>

namespace dollytrack::gather {
namespace {

constexpr std::array<const char*, 1> kTartanAirRequired = {"tartanair"};
constexpr const char* kTartanAirClasses = "seg_left";
constexpr const char* kTartanAirFlow = "flow";
constexpr std::array<const char*, 2> kTartanAirFiles = {"pose_left.txt", "pose_right.txt"};
constexpr std::array<const char*, 6> kTartanAirCopied = {
    "image_left/", "depth_left/", "seg_left/", "flow/", "pose_left.txt", "pose_right.txt"};
constexpr std::array<const char*, 1> kTartanAirTasks = {"depth-estimation"};

/// Each scene becomes an environment, named after its first dataset, and each of its datasets a
/// trajectory.
class TartanAirLayout : public Layout {
  public:
    explicit TartanAirLayout(LayoutInput input) : input_(std::move(input)) {
        if (input_.classes.keepsIds()) return;
        log::warn("gather",
                  fmt::format("{} is left out: its pixels have the datasets' class ids, but the "
                              "class map replaces them",
                              kTartanAirClasses));
    }

    Status beginPart(PartIndex part) override {
        part_ = kParts[part];
        return {};
    }

    Status add(const OpenedSource& source, std::size_t begin, std::size_t end) override {
        if (begin == 0) {
            if (Status begun = beginTrajectory(source); !begun) return begun;
        }
        const auto flowFiles = [&](std::size_t frame) {
            return frame + 1 < source.source.frames ? 2 : 0;  // flow and mask to the next frame
        };
        for (const std::string folder :
             {"image_left", "depth_left", kTartanAirClasses, kTartanAirFlow}) {
            if (folder == kTartanAirClasses && !input_.classes.keepsIds()) continue;
            Status copied = input_.files.copyFrames(
                source, folder, begin, end,
                [&](std::size_t frame) { return folder == kTartanAirFlow ? flowFiles(frame) : 1; },
                folder_ + "/" + folder, input_.job);
            if (!copied) return copied;
        }
        return {};
    }

    Status endPart() override { return {}; }

  private:
    struct Environment {
        std::string name;
        int trajectories = 0;
    };

    Status beginTrajectory(const OpenedSource& source) {
        Environment& environment = environments_[source.source.scene_number];
        if (environment.trajectories == 0) environment.name = source.source.name;
        folder_ =
            fmt::format("{}/{}/Easy/P{:03}", part_, environment.name, environment.trajectories++);
        std::vector<FileCopy> files;
        for (const char* name : kTartanAirFiles) files.push_back({name, name});
        return input_.files.copyFiles(source, files, folder_, input_.job);
    }

    LayoutInput input_;
    std::string part_;
    std::string folder_;                               // of the current trajectory
    std::map<std::size_t, Environment> environments_;  // by the scene's number
};

}  // namespace

const LayoutKind kTartanAirLayout = {
    .name = "tartanair",
    .text = "TartanAir's folders PART/ENV/Easy/P000/ with images, depth, classes, flow and poses",
    .content = LayoutContent::Copied,
    .tasks = kTartanAirTasks,
    .make = makeLayout<TartanAirLayout>,
    .labels = "depth, classes, optical flow and poses",
    .how_to_read =
        "Readers of TartanAir take `train/` as the folder of environments. An environment is a "
        "scene, named after its first source dataset, and `P000`, `P001` ... are the datasets of "
        "that scene. `pose_left.txt` is in a north-east-down world, `depth_left` in metres.",
    .data_files = nullptr,
    .required = kTartanAirRequired,
    .copied = kTartanAirCopied,
};

}  // namespace dollytrack::gather
