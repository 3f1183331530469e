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

}  // namespace

CheckWork beginFlow(const Subject& subject, Findings& findings) {
    for (const char* const modality : {"flow_forward", "flow_backward"}) {
        if (!subject.dataset.has(modality) || !flowDistances(subject.dataset, modality).empty()) {
            continue;
        }
        findings.add({"dataset.json",
                      {},
                      {},
                      fmt::format("conventions.{} has no distances", modality),
                      "numbers of frames"});
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
