#include "render/verify/check/check_list.h"
#include "render/verify/read/amodal_masks.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace dollytrack::verify {
namespace {

std::string text(const std::array<int, 4>& box) {
    return fmt::format("[{}, {}, {}, {}]", box[0], box[1], box[2], box[3]);
}

std::array<int, 4> boundsOf(const std::vector<std::uint8_t>& inside, int height) {
    ObjectPixels bounds;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i] == 0) continue;
        const int x = static_cast<int>(i) / height;
        const int y = static_cast<int>(i) % height;
        if (bounds.count++ == 0) {
            bounds.x0 = x;
            bounds.y0 = y;
            bounds.y1 = y;
        }
        bounds.x1 = x;
        bounds.y0 = std::min(bounds.y0, y);
        bounds.y1 = std::max(bounds.y1, y);
    }
    return {bounds.x0, bounds.y0, bounds.x1 - bounds.x0 + 1, bounds.y1 - bounds.y0 + 1};
}

void compare(const AmodalMask& mask, const Image16& ids, int frame, Findings& findings) {
    const auto add = [&](std::optional<std::array<int, 2>> pixel, std::string found,
                         std::string expected) {
        findings.add({amodalFile(frame), frame, pixel,
                      fmt::format("object {}: {}", mask.object_id, found), std::move(expected)});
    };
    const auto pixels = insideOf(mask, ids.width, ids.height);
    if (pixels.empty()) {
        return add({}, "run lengths that do not add up to the image",
                   fmt::format("{}", ids.values.size()));
    }
    const auto bounds = boundsOf(pixels, ids.height);
    if (mask.box != bounds) add({}, "bbox " + text(mask.box), text(bounds));
    auto inside = pixels.begin();
    for (int x = 0; x < ids.width; ++x) {
        for (int y = 0; y < ids.height; ++y, ++inside) {
            if (*inside != 0 || ids.at(x, y) != mask.object_id) continue;
            return add(std::array{x, y}, "outside the amodal mask",
                       "inside, because it is visible there");
        }
    }
}

}  // namespace

CheckWork beginAmodal(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        const int frame = images.frame();
        const std::string file = amodalFile(frame);
        const auto masks =
            readAmodal(dataset.folder / file, dataset.lens.width, dataset.lens.height);
        if (!masks) {
            findings.add({file, frame, {}, masks.error().message, "masks"});
            return;
        }
        const Image16* ids = images.image16("instance");
        if (!ids) return;
        std::set<int> whole;
        for (const AmodalMask& mask : *masks) {
            whole.insert(mask.object_id);
            if (!dataset.object(mask.object_id)) {
                findings.add({file,
                              frame,
                              {},
                              fmt::format("object {}", mask.object_id),
                              "an object of dataset.json"});
            }
            compare(mask, *ids, frame, findings);
        }
        for (const auto& [id, seen] : images.seen()) {
            const StoredObject* object = dataset.object(id);
            if (!object || object->role != "target" || whole.contains(id)) continue;
            findings.add({file, frame, std::array{seen.x0, seen.y0},
                          fmt::format("no mask of object {}", id), "one, because it is visible"});
        }
    };
    return work;
}

}  // namespace dollytrack::verify
