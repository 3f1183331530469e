// Compares each pixel with ray casts into the scene's triangles.
#include "render/verify/check/check_list.h"
#include "render/verify/compare/frame_rays.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

std::string seen(const RayHit& hit) {
    if (hit.object_id == 0) return "nothing";
    return fmt::format("object {} at {:.4f} m", hit.object_id, hit.distance);
}

/// Compares one of the frame's depths. `file` is named in findings.
void checkDepth(const Subject& subject, FrameImages& images, const Image16& ids,
                const FrameImages::Depth& depth, const std::string& file, Findings& findings) {
    FrameRays rays(subject, images.stored(), images.stored().pose);
    std::vector<RayHit> hits;
    WrongPixels wrong;
    for (int y = 0; y < ids.height; ++y) {
        rays.castRow(y, hits);
        for (int x = 0; x < ids.width; ++x) {
            const RayHit& hit = hits[x];
            const int id = ids.at(x, y);
            const double metres = depth.metres.at(x, y);
            const double off = std::abs(hit.distance - metres);
            const double allowed = depth.rounding_m + FrameRays::kDrawing * (1.0 + metres);
            if (id == hit.object_id && (id == 0 || off <= allowed)) continue;
            // Too far for the image; another check verifies that depth is missing there.
            if (id != 0 && metres == 0.0) continue;
            if (rays.mayShow(x, y, id, metres, depth.rounding_m)) continue;
            wrong.add(x, y, [&] {
                return WrongPixels::Text{
                    id == 0 ? "nothing" : fmt::format("object {} at {:.4f} m", id, metres),
                    seen(hit)};
            });
        }
    }
    wrong.report(file, images.frame(), findings);
}

}  // namespace

CheckWork beginSurface(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&subject](FrameImages& images, Findings& findings) {
        const Image16* ids = images.image16("instance");
        if (!ids) return;
        std::string_view modality = "instance";
        for (const FrameImages::Depth* depth : images.depths()) {
            checkDepth(subject, images, *ids, *depth, imageFile(modality, images.frame()),
                       findings);
            modality = "depth";
        }
    };
    return work;
}

}  // namespace dollytrack::verify
