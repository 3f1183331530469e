#include "engine/scene/object_size.h"

#include <algorithm>

namespace dollytrack {
namespace {

constexpr double kRestGap = 0.05;  // m between an object and its supporting surface

/// Whether the object stands on the carrier or is inside its box (on a shelf, in a cabinet).
bool isCarriedBy(const Object& thing, const Object& carrier) {
    const double bottom = thing.box.center.z() - thing.box.half_size.z();
    const double carrier_bottom = carrier.box.center.z() - carrier.box.half_size.z();
    const double carrier_top = carrier.box.center.z() + carrier.box.half_size.z();
    if (bottom > carrier_top + kRestGap || bottom < carrier_bottom + kRestGap) return false;
    Eigen::Vector3d level = thing.centroid;
    level.z() = carrier.box.center.z();
    return carrier.box.contains(level);
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
                   other.box.volume() >= size_ratio * volume && isCarriedBy(object, other);
        });
    }
}

}  // namespace dollytrack
