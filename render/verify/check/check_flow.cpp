#include "render/verify/check/check_list.h"
#include "render/verify/compare/motion_check.h"
#include "render/verify/read/flow_files.h"

#include <fmt/format.h>

namespace dollytrack::verify {
namespace {

/// One flow file and its mask.
class FlowPair {
  public:
    FlowPair(const Subject& subject, FrameImages& images, FrameImages& other, std::string stem)
        : subject_(subject),
          images_(images),
          other_(other),
          stem_(std::move(stem)),
          to_{other.stored().pose, other.stored()} {}

    void check(Findings& findings) {
        const StoredDataset& dataset = subject_.dataset;
        const Result<ImageF> flow = readFlow(dataset.folder / (stem_ + ".flo"));
        const Result<Image8> mask = readImage8(dataset.folder / (stem_ + "_mask.png"), 1);
        const int frame = images_.frame();
        const bool flow_fits = isUsable(flow, dataset, stem_ + ".flo", frame, findings);
        const bool mask_fits = isUsable(mask, dataset, stem_ + "_mask.png", frame, findings);
        const FrameImages::Depth* depth = images_.depth();
        if (!depth) return;
        const std::vector<ReprojectedPixel> reprojected =
            reprojectAll(dataset, images_, *depth, to_);
        if (flow_fits) checkMotions(*flow, *depth, reprojected, {stem_ + ".flo", frame}, findings);
        if (!mask_fits) return;
        checkVisibilityMask(subject_, *mask, *depth, reprojected, to_, other_.depth(),
                            {stem_ + "_mask.png", frame}, findings);
    }

  private:
    const Subject& subject_;
    FrameImages& images_;
    FrameImages& other_;
    std::string stem_;
    OtherView to_;
};

void checkDistances(const StoredDataset& dataset, const char* modality, Findings& findings) {
    if (!dataset.has(modality) || !flowDistances(dataset, modality).empty()) return;
    findings.add({"dataset.json",
                  {},
                  {},
                  fmt::format("conventions.{} has no distances", modality),
                  "numbers of frames"});
}

/// Compares scene flow with depth, poses and object motions.
void checkSceneFlow(const StoredDataset& dataset, FrameImages& images, FrameImages& other,
                    const std::string& name, Findings& findings) {
    const Result<ImageF> flow = readImageF(dataset.folder / name, 3);
    const FrameImages::Depth* depth = images.depth();
    if (!isUsable(flow, dataset, name, images.frame(), findings) || !depth) return;
    const OtherView to{other.stored().pose, other.stored()};
    const std::vector<ReprojectedPixel> reprojected = reprojectAll(dataset, images, *depth, to);
    WrongPixels pixels;
    std::size_t i = 0;
    for (int y = 0; y < flow->height; ++y) {
        for (int x = 0; x < flow->width; ++x, ++i) {
            const Eigen::Vector3f found = Eigen::Map<const Eigen::Vector3f>(flow->pixel(x, y));
            const bool unknown = found.cwiseAbs().maxCoeff() > kUnknownMotion;
            const double metres = depth->metres.values[i];
            if (!(metres > 0.0)) {
                if (unknown) continue;
                pixels.add(x, y, [] {
                    return WrongPixels::Text{"a motion", "none, because nothing is visible"};
                });
                continue;
            }
            const Eigen::Vector3d along = dataset.lens.unproject(x + 0.5, y + 0.5);
            const Eigen::Vector3d expected =
                to.camera.toCamera(reprojected[i].place) - metres * along;
            constexpr double kTolerance_m = 1e-4;
            const double allowed = kTolerance_m + 2.0 * depth->rounding_m * along.norm();
            if (!unknown && (found.cast<double>() - expected).norm() <= allowed) continue;
            pixels.add(x, y, [&] {
                return WrongPixels::Text{
                    fmt::format("({:.4f}, {:.4f}, {:.4f}) m", found.x(), found.y(), found.z()),
                    fmt::format("({:.4f}, {:.4f}, {:.4f}) m, by depth and poses", expected.x(),
                                expected.y(), expected.z())};
            });
        }
    }
    pixels.report(name, images.frame(), findings);
}

}  // namespace

CheckWork beginSceneFlow(const Subject& subject, Findings& findings) {
    checkDistances(subject.dataset, "scene_flow", findings);
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& found) {
        for (const FlowFile& file : pairFiles(dataset, "scene_flow", images.frame())) {
            checkSceneFlow(dataset, images, images.other(file.other), file.stem + ".exr", found);
        }
    };
    return work;
}

CheckWork beginFlow(const Subject& subject, Findings& findings) {
    for (const char* const modality : {"flow_forward", "flow_backward"}) {
        checkDistances(subject.dataset, modality, findings);
    }
    CheckWork work;
    work.frame = [&subject](FrameImages& images, Findings& found) {
        for (const FlowFile& file : flowFiles(subject.dataset, images.frame())) {
            FlowPair(subject, images, images.other(file.other), file.stem).check(found);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
