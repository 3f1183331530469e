// Checks the rig's images: their consistency, the objects' boxes, and ray casts into the scene.
#include "render/verify/check/check_list.h"
#include "render/verify/compare/frame_rays.h"
#include "render/verify/compare/interpolated_normal.h"
#include "render/verify/compare/label_alignment_check.h"
#include "render/verify/read/stored_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace dollytrack::verify {
namespace {

constexpr double kCamerasRounding = 0.0005 + 1e-6;  // of depth in millimetres, m
constexpr double kCamerasFarthest = 65.5355;        // m, limit of a depth image
// In smaller or wide-angle images objects are a few pixels wide; there only blank images are
// reported.
constexpr int kLeastPixelsToCompare = 160 * 120;
constexpr double kNudge = 1e-3;  // px: different ways to compute a ray differ by far less

using Rays = std::vector<std::optional<StoredRay>>;

/// A camera and the rays through its pixel centres.
struct CameraRays {
    StoredCamera camera;
    Rays rays;
    std::unique_ptr<LabelAlignmentCheck> pictures;
};

std::string text(const Eigen::Vector3d& v) {
    return fmt::format("({:.4f}, {:.4f}, {:.4f})", v.x(), v.y(), v.z());
}

void checkPose(const StoredCamera& camera, const StoredFrame& planned, int frame,
               Findings& findings) {
    const std::size_t i = frame;
    const auto tell = [&](std::string found, std::string expected) {
        findings.add({"dataset.json",
                      frame,
                      {},
                      fmt::format("camera {}: {}", camera.name, found),
                      std::move(expected)});
    };
    if (i == 0 && !(std::abs(camera.mount_length - 1.0) <= 1e-9)) {
        tell(fmt::format("a quaternion of its mount of length {:.9g}", camera.mount_length), "1");
    }
    if (std::abs(camera.quaternion_lengths[i] - 1.0) > 1e-9) {
        tell(fmt::format("a quaternion of length {:.9g}", camera.quaternion_lengths[i]), "1");
    }
    const Pose expected = camera.expectedPose(planned.pose);
    const Pose& is = camera.poses[i];
    if ((is.position - expected.position).norm() > 1e-6) {
        tell("its position is " + text(is.position),
             text(expected.position) + ", by the planned camera's pose and its mount");
    }
    if (angleBetween(is.rotation, expected.rotation) > 1e-6) {
        tell("its orientation differs from the planned camera's orientation and its mount",
             "that of the planned camera and its mount");
    }
}

/// One camera's images of one frame.
class CameraFrame {
  public:
    CameraFrame(const StoredDataset& dataset, const CameraRays& of, const StoredFrame& frame,
                int index)
        : dataset_(dataset),
          camera_(of.camera),
          rays_(of.rays),
          frame_(frame),
          index_(index),
          pose_(of.camera.poses[index]) {}

    /// Reads the images. Returns whether all are usable.
    bool read(Findings& findings) {
        bool good = take(readImage8(path("rgb"), 3), "rgb", rgb_, findings);
        good = take(readImage16(path("depth"), 1), "depth", depth_, findings) && good;
        good = take(readImage16(path("instance"), 1), "instance", ids_, findings) && good;
        good = take(readClasses(path("semantic"), dataset_.classes().isWide()), "semantic",
                    classes_, findings) &&
               good;
        return take(readImage16(path("normal_world"), 3), "normal_world", normals_, findings) &&
               good;
    }

    void checkItself(Findings& findings) {
        WrongPixels classes, holes, circle, boxes, normals;
        forPixels([&](int x, int y, const std::optional<StoredRay>& ray) {
            const int id = ids_.at(x, y);
            if (!ray) return checkOutside(x, y, circle);
            const StoredObject* object = dataset_.object(id);
            const int expected = dataset_.pixelClass(id);
            if (id != 0 && !object) {
                classes.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("object {}", id), "one of the list"};
                });
            } else if (classes_.at(x, y) != expected) {
                classes.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("class {}", classes_.at(x, y)),
                                             fmt::format("{}, that of object {}", expected, id)};
                });
            }
            checkNormal(x, y, *ray, normals);
            if (depth_.at(x, y) != 0) {
                checkBox(x, y, *ray, object, boxes);
            } else if (object && !mayBeFar(*object)) {
                holes.add(x, y, [&] {
                    return WrongPixels::Text{"no depth", fmt::format("that of object {}", id)};
                });
            }
        });
        classes.report(file("semantic"), index_, findings);
        holes.report(file("depth"), index_, findings);
        circle.report(file("instance"), index_, findings);
        boxes.report(file("depth"), index_, findings);
        normals.report(file("normal_world"), index_, findings);
        if (camera_.width * camera_.height < kLeastPixelsToCompare && isBlank(rgb_) &&
            outlinesOf(ids_, true).count() >= kFewestPlaces) {
            findings.add({file("rgb"), index_, {}, kBlank, "edges at the object borders"});
        }
    }

    void showTo(LabelAlignmentCheck& alignment) const {
        if (camera_.width * camera_.height < kLeastPixelsToCompare) return;
        alignment.addFrame(static_cast<std::size_t>(index_), rgb_, ids_);
    }

    void checkScene(const Subject& subject, Findings& findings) {
        const FrameRays frame_rays(subject, frame_, pose_);
        const RayCaster& caster = frame_rays.rays();
        WrongPixels labels, normals;
        std::size_t compared = 0;
        forPixels([&](int x, int y, const std::optional<StoredRay>& ray) {
            if (!ray) return;
            const RayHit hit = cast(caster, *ray);
            if (!agrees(hit, x, y) && !agreesNearby(caster, x, y)) {
                labels.add(x, y, [&] {
                    return WrongPixels::Text{shown(ids_.at(x, y), 0.001 * depth_.at(x, y)),
                                             shown(hit.object_id, hit.distance)};
                });
            }
            if (hit.object_id == 0 || hit.object_id != ids_.at(x, y)) return;
            // The scene holds vertex normals of unmoved objects only.
            if (frame_.movement(hit.object_id)) return;
            ++compared;
            const Eigen::Vector3d along = (pose_.rotation * ray->direction).normalized();
            const Eigen::Vector3d place =
                pose_.toWorld(ray->origin + hit.distance * ray->direction);
            const Eigen::Vector3d expected = interpolatedNormal(*subject.scene, hit, place, along);
            if (expected.norm() < 0.5) return;
            if (normalAt(x, y).dot(expected) >= std::cos(3.0 * std::numbers::pi / 180.0)) return;
            normals.add(x, y, [&] {
                return WrongPixels::Text{text(normalAt(x, y)), text(expected) + ", by the scene"};
            });
        });
        labels.report(file("instance"), index_, findings);
        // On shared surfaces the ray may hit either of two triangles.
        if (normals.count() > 10 + compared / 50) {
            normals.report(file("normal_world"), index_, findings);
        }
    }

  private:
    [[nodiscard]] std::string file(const char* image) const { return camera_.file(image, index_); }
    [[nodiscard]] std::filesystem::path path(const char* image) const {
        return dataset_.folder / file(image);
    }
    static std::string shown(int id, double metres) {
        return id == 0 ? "nothing" : fmt::format("object {} at {:.4f} m", id, metres);
    }

    template <class T>
    bool take(Result<Image<T>> read, const char* image, Image<T>& into, Findings& findings) {
        std::string problem;
        if (!read) {
            problem = read.error().message;
        } else if (read->width != camera_.width || read->height != camera_.height) {
            problem = fmt::format("it is {} x {} px, expected {} x {}", read->width, read->height,
                                  camera_.width, camera_.height);
        }
        if (problem.empty()) {
            into = std::move(*read);
            return true;
        }
        findings.add({file(image), index_, {}, problem, {}});
        return false;
    }

    template <class Use>
    void forPixels(Use&& use) const {
        std::size_t pixel = 0;
        for (int y = 0; y < camera_.height; ++y) {
            for (int x = 0; x < camera_.width; ++x) use(x, y, rays_[pixel++]);
        }
    }

    void checkOutside(int x, int y, WrongPixels& circle) const {
        const std::uint8_t* colour = rgb_.pixel(x, y);
        const std::uint16_t* normal = normals_.pixel(x, y);
        if (ids_.at(x, y) == 0 && depth_.at(x, y) == 0 &&
            classes_.at(x, y) == dataset_.classes().voidClass().id &&
            colour[0] + colour[1] + colour[2] == 0 && normal[0] + normal[1] + normal[2] == 0) {
            return;
        }
        circle.add(x, y, [] {
            return WrongPixels::Text{"a value outside the lens's image circle",
                                     "0 in all images, void in classes"};
        });
    }

    [[nodiscard]] Eigen::Vector3d normalAt(int x, int y) const {
        const std::uint16_t* n = normals_.pixel(x, y);
        return Eigen::Vector3d(n[0], n[1], n[2]) * (2.0 / 65535.0) - Eigen::Vector3d::Ones();
    }

    void checkNormal(int x, int y, const StoredRay& ray, WrongPixels& wrong) const {
        const std::uint16_t* n = normals_.pixel(x, y);
        const bool none = n[0] == 0 && n[1] == 0 && n[2] == 0;
        if (none != (ids_.at(x, y) == 0)) {
            return wrong.add(x, y, [&] {
                return WrongPixels::Text{none ? "no normal" : "a normal",
                                         "a normal exactly where an object is"};
            });
        }
        if (none) return;
        const Eigen::Vector3d normal = normalAt(x, y);
        const Eigen::Vector3d along = (pose_.rotation * ray.direction).normalized();
        if (std::abs(normal.norm() - 1.0) <= 1e-4 && normal.dot(along) <= 0.01) return;
        wrong.add(x, y, [&] {
            return WrongPixels::Text{text(normal), "a unit normal on the camera's side"};
        });
    }

    void checkBox(int x, int y, const StoredRay& ray, const StoredObject* object,
                  WrongPixels& wrong) const {
        const double metres = 0.001 * depth_.at(x, y);
        if (!object) {
            return wrong.add(x, y, [&] {
                return WrongPixels::Text{fmt::format("{:.3f} m", metres), "none without an object"};
            });
        }
        Eigen::Vector3d point = pose_.toWorld(ray.origin + metres * ray.direction);
        if (const Eigen::Isometry3d* moved = frame_.movement(object->id)) {
            point = moved->inverse() * point;
        }
        const double margin = kCamerasRounding * ray.direction.norm() + 0.001 + 1e-5 * metres;
        if (object->box.contains(point, margin)) return;
        wrong.add(x, y, [&] {
            return WrongPixels::Text{
                fmt::format("{:.4g} m, which is {:.3g} m outside the box of object {} ({})", metres,
                            object->box.distance(point), object->id, object->name),
                "a point of the object"};
        });
    }

    [[nodiscard]] bool mayBeFar(const StoredObject& object) const {
        const double reach = object.box.half_size.norm();
        if (const Eigen::Isometry3d* moved = frame_.movement(object.id)) {
            return (*moved * object.box.center - pose_.position).norm() + reach > kCamerasFarthest;
        }
        return (object.box.center - pose_.position).norm() + reach > kCamerasFarthest;
    }

    [[nodiscard]] RayHit cast(const RayCaster& caster, const StoredRay& ray) const {
        return caster.cast(pose_.toWorld(ray.origin), pose_.rotation * ray.direction,
                           std::numeric_limits<double>::infinity(), dataset_.near_m);
    }

    [[nodiscard]] bool agrees(const RayHit& hit, int x, int y) const {
        if (hit.object_id != ids_.at(x, y)) return false;
        const double metres = 0.001 * depth_.at(x, y);
        if (hit.object_id == 0) return metres == 0.0;
        if (hit.distance > kCamerasFarthest - kCamerasRounding && metres == 0.0) return true;
        return std::abs(hit.distance - metres) <= kCamerasRounding + 1e-5 * metres;
    }

    /// Whether a ray close to the pixel's centre agrees. At object edges rounding decides, and of
    /// coincident surfaces either may be hit.
    [[nodiscard]] bool agreesNearby(const RayCaster& caster, int x, int y) const {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto ray = camera_.rayThrough(x + 0.5 + kNudge * dx, y + 0.5 + kNudge * dy);
                if (!ray) continue;
                if (agrees(cast(caster, *ray), x, y)) return true;
            }
        }
        const int id = ids_.at(x, y);
        const StoredRay& ray = *rays_[static_cast<std::size_t>(y) * camera_.width + x];
        const double metres = 0.001 * depth_.at(x, y);
        const RayHit hit = cast(caster, ray);
        if (id == 0 || !dataset_.object(id) ||
            std::abs(hit.distance - metres) > 2.0 * kCamerasRounding) {
            return false;
        }
        const Eigen::Vector3d start =
            ray.origin + (metres - 2.0 * kCamerasRounding) * ray.direction;
        return caster.meetsObject(id, pose_.toWorld(start), pose_.rotation * ray.direction,
                                  4.0 * kCamerasRounding);
    }

    const StoredDataset& dataset_;
    const StoredCamera& camera_;
    const Rays& rays_;
    const StoredFrame& frame_;
    int index_;
    const Pose& pose_;
    Image8 rgb_;
    Image16 classes_;
    Image16 depth_, ids_, normals_;
};

CameraRays withRays(StoredCamera camera, std::size_t frames) {
    CameraRays result{std::move(camera), {}, std::make_unique<LabelAlignmentCheck>(frames, true)};
    const StoredCamera& of = result.camera;
    for (int y = 0; y < of.height; ++y) {
        for (int x = 0; x < of.width; ++x) {
            result.rays.push_back(of.rayThrough(x + 0.5, y + 0.5));
        }
    }
    return result;
}

}  // namespace

CheckWork beginCameras(const Subject& subject, Findings& findings) {
    auto rig = readStoredRig(subject.dataset);
    if (!rig) {
        findings.add({"dataset.json", {}, {}, rig.error().message, "the rig's cameras"});
        return {};
    }
    auto cameras = std::make_shared<std::vector<CameraRays>>();
    for (StoredCamera& camera : *rig)
        cameras->push_back(withRays(std::move(camera), subject.dataset.frames.size()));
    CheckWork work;
    work.frame = [&subject, cameras](FrameImages& images, Findings& found) {
        for (const CameraRays& one : *cameras) {
            checkPose(one.camera, images.stored(), images.frame(), found);
            CameraFrame frame(subject.dataset, one, images.stored(), images.frame());
            if (!frame.read(found)) continue;
            frame.checkItself(found);
            frame.showTo(*one.pictures);
            if (subject.rays) frame.checkScene(subject, found);
        }
    };
    work.finish = [&subject, cameras](Findings& found, const JobContext&) {
        for (const CameraRays& one : *cameras) {
            const StoredCamera& camera = one.camera;
            const auto path = [&](const char* image, int frame) {
                return subject.dataset.folder / camera.file(image, frame);
            };
            one.pictures->report(
                {[&](int frame) { return camera.file("rgb", frame); },
                 [&](int frame) { return readImage8(path("rgb", frame), 3).value_or(Image8()); },
                 [&](int frame) {
                     return readImage16(path("instance", frame), 1).value_or(Image16());
                 }},
                found);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
