#include "engine/scene/object_size.h"

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kRestGap = 0.05;  // m between an object and its supporting surface

/// Whether the object stands on the supporting object or is inside its box (on a shelf, in a
/// cabinet).
bool isSupportedBy(const Object& object, const Object& support) {
    const double bottom = object.box.center.z() - object.box.half_size.z();
    const double support_bottom = support.box.center.z() - support.box.half_size.z();
    const double support_top = support.box.center.z() + support.box.half_size.z();
    if (bottom > support_top + kRestGap || bottom < support_bottom + kRestGap) return false;
    Eigen::Vector3d level = object.centroid;
    level.z() = support.box.center.z();
    return support.box.contains(level);
}

}  // namespace

void sortBySize(std::vector<Object>& objects, double small_volume_m3, double size_ratio) {
    for (Object& object : objects) {
        if (object.size_given) continue;
        const double volume = object.box.volume();
        object.large = volume >= small_volume_m3;
        if (!object.large || object.structure) continue;
        object.large = std::none_of(objects.begin(), objects.end(), [&](const Object& other) {
            return other.id != object.id && !other.structure &&
                   other.box.volume() >= size_ratio * volume && isSupportedBy(object, other);
        });
    }
}

}  // namespace dollytrack
