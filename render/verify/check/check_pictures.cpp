#include "render/verify/check_list.h"
#include "render/verify/picture_judge.h"

#include <memory>

namespace dollytrack::verify {

CheckWork beginPictures(const Subject& subject, Findings& /*findings*/) {
    const StoredDataset& dataset = subject.dataset;
    const auto judge = std::make_shared<PictureJudge>(dataset.frames.size(), false);
    CheckWork work;
    work.frame = [judge](FrameImages& images, Findings&) {
        const Image8* picture = images.image8("rgb");
        const Image16* ids = images.image16("instance");
        if (!picture || !ids) return;
        judge->look(static_cast<std::size_t>(images.frame()), *picture, *ids);
    };
    work.finish = [judge, &dataset](Findings& findings, const JobContext&) {
        judge->judge({[](int frame) { return imageFile("rgb", frame); },
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
