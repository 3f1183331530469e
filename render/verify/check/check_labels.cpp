// Checks that the images that label a pixel agree with each other.
#include "render/verify/check/check_list.h"
#include "render/verify/compare/frame_rays.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr int kUnknownObject = -1;

/// The class of each possible id.
std::vector<int> classesById(const StoredDataset& dataset) {
    std::vector<int> classes(65536, kUnknownObject);
    classes[0] = dataset.classes().voidClass().id;
    for (const StoredObject& object : dataset.objects) {
        if (object.id > 0 && object.id < 65536) {
            classes[object.id] = object.class_id;
        }
    }
    return classes;
}

/// Largest depth that the object can have in the camera, m.
double farthestDepth(const StoredFrame& frame, const StoredObject& object) {
    double farthest = 0.0;
    const Eigen::Isometry3d* moved = frame.movement(object.id);
    for (const Eigen::Vector3d& corner : object.box.corners()) {
        const Eigen::Vector3d now = moved ? *moved * corner : corner;
        farthest = std::max(farthest, frame.pose.toCamera(now).z());
    }
    return farthest;
}

void checkBoxes(const StoredDataset& dataset, FrameImages& images, const Image16& ids,
                const FrameImages::Depth& depth, Findings& findings) {
    const StoredFrame& frame = images.stored();
    WrongPixels wrong;
    for (int y = 0; y < ids.height; ++y) {
        for (int x = 0; x < ids.width; ++x) {
            const StoredObject* object = dataset.object(ids.at(x, y));
            const double metres = depth.metres.at(x, y);
            if (!object || metres <= 0.0) continue;
            const Eigen::Vector3d along = dataset.lens.unproject(x + 0.5, y + 0.5);
            Eigen::Vector3d point = frame.pose.toWorld(metres * along);
            if (const Eigen::Isometry3d* moved = frame.movement(object->id)) {
                point = moved->inverse() * point;
            }
            // The box is exact, while depth is rounded by the file and by rasterisation, and
            // rasterisation places borders slightly off.
            const double margin = along.norm() * (depth.rounding_m + FrameRays::kDrawn_m +
                                                  FrameRays::kDrawing * (1.0 + metres) +
                                                  FrameRays::kNudge_px * metres / dataset.lens.fx);
            if (object->box.contains(point, margin)) continue;
            wrong.add(x, y, [&] {
                return WrongPixels::Text{
                    fmt::format("{:.4g} m, which is {:.3g} m outside the box of object {} ({})",
                                metres, object->box.distance(point), object->id, object->name),
                    "a point of the object"};
            });
        }
    }
    wrong.report(imageFile(depth.modality, images.frame()), images.frame(), findings);
}

/// @param farthest_m  range of the depth image
template <class T>
void checkHoles(const StoredDataset& dataset, FrameImages& images, const Image16& ids,
                const Image<T>& depth, double farthest_m, const char* modality,
                Findings& findings) {
    // Cached by object: whether it may be too far for the image.
    std::vector<int> may_be_far(65536, -1);
    WrongPixels wrong;
    for (int y = 0; y < ids.height; ++y) {
        for (int x = 0; x < ids.width; ++x) {
            const int id = ids.at(x, y);
            const double value = depth.at(x, y);
            const bool none = value == 0.0;
            const bool is_depth = std::isfinite(value) && value >= 0.0;
            if (is_depth && none == (id == 0)) continue;
            if (none) {
                int& far_away = may_be_far[id];
                const StoredObject* object = dataset.object(id);
                if (far_away < 0) {
                    far_away = object && farthestDepth(images.stored(), *object) >= farthest_m;
                }
                if (far_away != 0) continue;
            }
            wrong.add(x, y, [&] {
                return WrongPixels::Text{
                    none ? "no depth" : fmt::format("depth {:g}", value),
                    id != 0 ? fmt::format("that of object {}", id)
                            : std::string("none, because the pixel shows no object")};
            });
        }
    }
    wrong.report(imageFile(modality, images.frame()), images.frame(), findings);
}

}  // namespace

CheckWork beginClasses(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset, classes = classesById(subject.dataset)](
                     FrameImages& images, Findings& findings) {
        const Image16* ids = images.image16("instance");
        if (!ids) return;
        const Image16* semantic = images.classes();
        WrongPixels unknown, other;
        for (int y = 0; y < ids->height; ++y) {
            for (int x = 0; x < ids->width; ++x) {
                const int id = ids->at(x, y);
                const int expected = classes[id];
                if (expected == kUnknownObject) {
                    unknown.add(x, y, [&] {
                        return WrongPixels::Text{fmt::format("object {}", id),
                                                 fmt::format("1 .. {}", dataset.objects.size())};
                    });
                } else if (semantic && semantic->at(x, y) != expected) {
                    other.add(x, y, [&] {
                        return WrongPixels::Text{
                            fmt::format("class {}", semantic->at(x, y)),
                            fmt::format("class {} of object {}", expected, id)};
                    });
                }
            }
        }
        unknown.report(imageFile("instance", images.frame()), images.frame(), findings);
        other.report(imageFile("semantic", images.frame()), images.frame(), findings);
    };
    return work;
}

CheckWork beginHoles(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        const Image16* ids = images.image16("instance");
        if (!ids) return;
        if (const Image16* depth = images.image16("depth")) {
            checkHoles(dataset, images, *ids, *depth, 65.535, "depth", findings);
        }
        if (const ImageF* depth = images.imageF("depth_exr")) {
            checkHoles(dataset, images, *ids, *depth, HUGE_VAL, "depth_exr", findings);
        }
    };
    return work;
}

CheckWork beginObjectBoxes(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        const Image16* ids = images.image16("instance");
        if (!ids) return;
        for (const FrameImages::Depth* depth : images.depths()) {
            checkBoxes(dataset, images, *ids, *depth, findings);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
