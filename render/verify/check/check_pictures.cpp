#include "render/verify/check/check_list.h"
#include "render/verify/compare/label_alignment_check.h"

#include <memory>

namespace dollytrack::verify {

CheckWork beginPictures(const Subject& subject, Findings& /*findings*/) {
    const StoredDataset& dataset = subject.dataset;
    const auto alignment = std::make_shared<LabelAlignmentCheck>(dataset.frames.size(), false);
    CheckWork work;
    work.frame = [alignment, &dataset](FrameImages& images, Findings&) {
        // Dark, white or flat images show no edges; the check of usable images reads their pixels.
        if (dataset.unusable_frames.contains(images.frame())) return;
        const Image8* picture = images.image8("rgb");
        const Image16* ids = images.image16("instance");
        if (!picture || !ids) return;
        alignment->addFrame(static_cast<std::size_t>(images.frame()), *picture, *ids);
    };
    work.finish = [alignment, &dataset](Findings& findings, const JobContext&) {
        alignment->report({[](int frame) { return imageFile("rgb", frame); },
                           [&](int frame) {
                               FrameImages images(dataset, frame);
                               const Image8* picture = images.image8("rgb");
                               return picture ? *picture : Image8();
                           },
                           [&](int frame) {
                               FrameImages images(dataset, frame);
                               const Image16* ids = images.image16("instance");
                               return ids ? *ids : Image16();
                           }},
                          findings);
    };
    return work;
}

}  // namespace dollytrack::verify
