// Checks TartanAir's images, depth, classes, flow and right camera; left poses are checked
// elsewhere.
#include "engine/io/files/text_file.h"
#include "engine/io/trajectories/pose_list.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/motion_check.h"
#include "render/verify/compare/stereo_pair.h"
#include "render/verify/read/numpy_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr const char* kRightPoses = "pose_right.txt";
constexpr double kTartanAirTolerance = 1e-6;  // m and radians
constexpr double kNothing_m = 10'000.0;

/// The right camera of each frame is the left one moved along its x axis by one baseline.
void checkRightPoses(const StoredDataset& dataset, Findings& findings) {
    PoseFile file{dataset.folder / kRightPoses, {}};
    Result<std::string> text = readText(file.path);
    if (!text) return findings.add({kRightPoses, {}, {}, text.error().message, "poses"});
    file.text = std::move(*text);
    const Result<PoseList> list = readTartanAir(file);
    if (!list) return findings.add({kRightPoses, {}, {}, describe(list.error()), "poses"});
    if (list->poses.size() != dataset.frames.size()) {
        return findings.add({kRightPoses,
                             {},
                             {},
                             fmt::format("{} poses", list->poses.size()),
                             fmt::format("{}", dataset.frames.size())});
    }
    std::optional<double> baseline = baselineOf(dataset);
    const Eigen::Vector3d world_from_ned(1.0, -1.0, -1.0);
    for (std::size_t i = 0; i < list->poses.size(); ++i) {
        const FilePose& read = list->poses[i];
        const Pose& left = dataset.frames[i].pose;
        const Eigen::Vector3d offset = left.toCamera(world_from_ned.cwiseProduct(read.position));
        if (!baseline) baseline = std::max(offset.x(), 0.0);  // only the sign can be checked
        const Eigen::Matrix3d rotation = world_from_ned.asDiagonal() * read.rotation;
        const double turned = (rotation - left.rotation.toRotationMatrix()).norm() / std::sqrt(2.0);
        const double away = (offset - Eigen::Vector3d(*baseline, 0.0, 0.0)).norm();
        if (away <= kTartanAirTolerance && turned <= kTartanAirTolerance) continue;
        findings.add({fmt::format("{}:{}", kRightPoses, read.line),
                      static_cast<int>(i),
                      {},
                      fmt::format("({:.6f}, {:.6f}, {:.6f}) m from the left camera, in its axes, "
                                  "turned by {:.3g} rad",
                                  offset.x(), offset.y(), offset.z(), turned),
                      fmt::format("({:.6f}, 0, 0), not turned", *baseline)});
    }
}

class TartanAirFrameCheck {
  public:
    TartanAirFrameCheck(const Subject& subject, FrameImages& images, Findings& findings)
        : subject_(subject),
          dataset_(subject.dataset),
          images_(images),
          frame_(images.frame()),
          findings_(findings) {}

    void run() {
        comparePicture();
        compareDepth();
        compareClasses();
        if (frame_ + 1 < static_cast<int>(dataset_.frames.size())) compareMotions();
    }

  private:
    template <class Read>
    [[nodiscard]] bool usable(const Read& image, const std::string& file) {
        return isUsable(image, dataset_, file, frame_, findings_);
    }

    void comparePicture() {
        const std::string file = fmt::format("image_left/{:06}_left.png", frame_);
        const Result<Image8> found = readImage8(dataset_.folder / file, 3);
        const Image8* rgb = images_.image8("rgb");
        if (!usable(found, file) || !rgb) return;
        WrongPixels wrong;
        for (int y = 0; y < rgb->height; ++y) {
            for (int x = 0; x < rgb->width; ++x) {
                const std::uint8_t* a = found->pixel(x, y);
                const std::uint8_t* b = rgb->pixel(x, y);
                if (std::equal(a, a + 3, b)) continue;
                const auto text = [](const std::uint8_t* c) {
                    return fmt::format("({}, {}, {})", c[0], c[1], c[2]);
                };
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{text(a),
                                             text(b) + ", as in " + imageFile("rgb", frame_)};
                });
            }
        }
        wrong.report(file, frame_, findings_);
    }

    void compareDepth() {
        const std::string file = fmt::format("depth_left/{:06}_left_depth.npy", frame_);
        const Result<ImageF> found = readNumpyF(dataset_.folder / file, 1);
        const FrameImages::Depth* depth = images_.depth();
        if (!usable(found, file) || !depth) return;
        // An image in millimetres does not cover depth beyond its range.
        const bool exact = std::string_view(depth->modality) == "depth_exr";
        WrongPixels wrong;
        for (int y = 0; y < found->height; ++y) {
            for (int x = 0; x < found->width; ++x) {
                const double metres = found->at(x, y);
                const double stored = depth->metres.at(x, y);
                const double expected = stored > 0.0 ? stored : kNothing_m;
                if (std::abs(metres - expected) <= depth->rounding_m) continue;
                if (!exact && stored == 0.0 && metres > 65.535) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("{:.6f} m", metres),
                                             fmt::format("{:.6f} m, as in {}", expected,
                                                         imageFile(depth->modality, frame_))};
                });
            }
        }
        wrong.report(file, frame_, findings_);
    }

    void compareClasses() {
        const std::string file = fmt::format("seg_left/{:06}_left_seg.npy", frame_);
        const bool wide = dataset_.classes().isWide();
        const Result<Image16> found = wide ? readNumpy16(dataset_.folder / file, 1)
                                           : widened(readNumpy8(dataset_.folder / file, 1));
        const Image16* ids = images_.image16("instance");
        const Image16* semantic = images_.classes();
        if (!usable(found, file) || (!ids && !semantic)) return;
        WrongPixels wrong;
        for (int y = 0; y < found->height; ++y) {
            for (int x = 0; x < found->width; ++x) {
                const int expected =
                    semantic ? semantic->at(x, y) : dataset_.pixelClass(ids->at(x, y));
                if (found->at(x, y) == expected) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("class {}", found->at(x, y)),
                                             fmt::format("class {}", expected)};
                });
            }
        }
        wrong.report(file, frame_, findings_);
    }

    void compareMotions() {
        const std::string stem = fmt::format("flow/{:06}_{:06}", frame_, frame_ + 1);
        const std::string flow_file = stem + "_flow.npy";
        const std::string mask_file = stem + "_mask.npy";
        const Result<ImageF> flow = readNumpyF(dataset_.folder / flow_file, 2);
        Result<Image8> mask = readNumpy8(dataset_.folder / mask_file, 1);
        const bool flow_fits = usable(flow, flow_file);
        const bool mask_fits = usable(mask, mask_file);
        const FrameImages::Depth* depth = images_.depth();
        if (!depth) return;
        FrameImages& next = images_.other(frame_ + 1);
        const OtherView to{next.stored().pose, next.stored()};
        const auto reprojected = reprojectAll(dataset_, images_, *depth, to);
        if (flow_fits) checkMotions(*flow, *depth, reprojected, {flow_file, frame_}, findings_);
        if (!mask_fits) return;
        toVisibility(*depth, *mask);
        checkVisibilityMask(subject_, *mask, *depth, reprojected, to, next.depth(),
                            {mask_file, frame_}, findings_);
    }

    /// TartanAir's 100 means outside the image as well as no surface.
    static void toVisibility(const FrameImages::Depth& depth, Image8& mask) {
        for (std::size_t i = 0; i < mask.values.size(); ++i) {
            std::uint8_t& value = mask.values[i];
            const bool nothing = !(depth.metres.values[i] > 0.0F);
            switch (value) {
                case 0:
                    value = kSeen;
                    break;
                case 10:
                    value = kOccluded;
                    break;
                case 100:
                    value = nothing ? kNothing : kOutside;
                    break;
                default:
                    value = kUnknownVisibility;
            }
        }
    }

    static constexpr std::uint8_t kUnknownVisibility = 254;  // not a mask value

    const Subject& subject_;
    const StoredDataset& dataset_;
    FrameImages& images_;
    int frame_;
    Findings& findings_;
};

}  // namespace

CheckWork beginTartanAir(const Subject& subject, Findings& findings) {
    checkRightPoses(subject.dataset, findings);
    CheckWork work;
    work.frame = [&subject](FrameImages& images, Findings& found) {
        TartanAirFrameCheck(subject, images, found).run();
    };
    return work;
}

}  // namespace dollytrack::verify
