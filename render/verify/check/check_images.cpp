#include "render/verify/check/check_list.h"
#include "render/verify/read/sensor_files.h"

namespace dollytrack::verify {

CheckWork beginImages(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        for (const ImageKind& kind : imageKinds()) {
            if (!dataset.has(kind.modality)) continue;
            const std::string file = storedFile(dataset, kind, images.frame());
            const std::string problem = images.problem(kind.modality);
            if (!problem.empty()) findings.add({file, images.frame(), {}, problem, {}});
            if (!kind.mask) continue;
            const std::string of_mask = images.maskProblem(kind.modality);
            if (!of_mask.empty()) {
                findings.add({file + "'s mask", images.frame(), {}, of_mask, {}});
            }
        }
    };
    return work;
}

}  // namespace dollytrack::verify
