// Checks images that follow from depth, pose and the objects' boxes.
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr double kSurfacesSteps = 65535.0;

using Share = std::array<double, 3>;

std::string text(const Share& share) {
    return fmt::format("({:.4f}, {:.4f}, {:.4f})", share[0], share[1], share[2]);
}

/// A point's coordinates in its object's box, 0 to 1 along each axis, and their largest error.
struct InBox {
    Share share;
    Share off;
};

InBox inBox(const StoredObject& object, const StoredFrame& frame, const Eigen::Vector3d& along,
            double metres, double rounding_m) {
    const Eigen::Isometry3d* moved = frame.movement(object.id);
    const auto to_rest = [&](const Eigen::Vector3d& world) -> Eigen::Vector3d {
        return moved ? Eigen::Vector3d(moved->inverse() * world) : world;
    };
    const Eigen::Vector3d here = object.box.toBox(to_rest(frame.pose.toWorld(metres * along)));
    const Eigen::Vector3d beside =
        object.box.toBox(to_rest(frame.pose.toWorld((metres + rounding_m) * along)));
    InBox result{};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const double size = std::max(2.0 * object.box.half_size[axis], 1e-6);
        const std::size_t i = axis;
        result.share[i] = std::clamp(here[axis] / size + 0.5, 0.0, 1.0);
        result.off[i] = (std::abs(beside[axis] - here[axis]) + 1e-5) / size + 1.0 / kSurfacesSteps;
    }
    return result;
}

}  // namespace

CheckWork beginObjectCoordinates(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        const Image16* image = images.image16("object_coordinates");
        const Image16* ids = images.image16("instance");
        const FrameImages::Depth* depth = images.depth();
        if (!image || !ids || !depth) return;
        WrongPixels none, wrong;
        for (int y = 0; y < image->height; ++y) {
            for (int x = 0; x < image->width; ++x) {
                const std::uint16_t* pixel = image->pixel(x, y);
                const StoredObject* object = dataset.object(ids->at(x, y));
                if (!object) {
                    if (pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0) continue;
                    none.add(x, y, [&] {
                        return WrongPixels::Text{"coordinates", "0, because no object is visible"};
                    });
                    continue;
                }
                const double metres = depth->metres.at(x, y);
                if (metres <= 0.0) continue;
                const Share found = {pixel[0] / kSurfacesSteps, pixel[1] / kSurfacesSteps,
                                     pixel[2] / kSurfacesSteps};
                const InBox expected =
                    inBox(*object, images.stored(), dataset.lens.unproject(x + 0.5, y + 0.5),
                          metres, depth->rounding_m);
                bool same = true;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double off = std::abs(found[axis] - expected.share[axis]);
                    same = same && off <= expected.off[axis];
                }
                if (same) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{
                        text(found), fmt::format("{} in the box of object {}, by depth and pose",
                                                 text(expected.share), object->id)};
                });
            }
        }
        const std::string file = imageFile("object_coordinates", images.frame());
        none.report(file, images.frame(), findings);
        wrong.report(file, images.frame(), findings);
    };
    return work;
}

CheckWork beginExactDepth(const Subject& /*subject*/, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [](FrameImages& images, Findings& findings) {
        const ImageF* exact = images.imageF("depth_exr");
        const Image16* rounded = images.image16("depth");
        if (!exact || !rounded) return;
        const std::string exact_file = imageFile("depth_exr", images.frame());
        const std::string rounded_file = imageFile("depth", images.frame());
        WrongPixels wrong;
        for (int y = 0; y < exact->height; ++y) {
            for (int x = 0; x < exact->width; ++x) {
                const double metres = exact->at(x, y);
                const std::uint16_t millimetres = rounded->at(x, y);
                if (isRounded(metres, millimetres)) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{
                        fmt::format("{:.6f} m in {}, {:.3f} m in {}", metres, exact_file,
                                    millimetres * 0.001, rounded_file),
                        "the same depth in both; either may be wrong"};
                });
            }
        }
        wrong.report(exact_file + ", " + rounded_file, images.frame(), findings);
    };
    return work;
}

}  // namespace dollytrack::verify
