#include "render/verify/read/object_pixels.h"

#include <algorithm>

namespace dollytrack::verify {

std::map<int, ObjectPixels> objectPixels(const Image16& ids) {
    std::vector<ObjectPixels> all(65536);
    for (int y = 0; y < ids.height; ++y) {
        for (int x = 0; x < ids.width; ++x) {
            ObjectPixels& one = all[ids.at(x, y)];
            if (one.count++ == 0) {
                one.x0 = one.x1 = x;
                one.y0 = one.y1 = y;
            }
            one.x0 = std::min(one.x0, x);
            one.x1 = std::max(one.x1, x);
            one.y1 = y;
        }
    }
    std::map<int, ObjectPixels> seen;
    for (std::size_t id = 1; id < all.size(); ++id) {
        if (all[id].count > 0) seen.emplace(static_cast<int>(id), all[id]);
    }
    return seen;
}

}  // namespace dollytrack::verify
