#include "render/verify/check/check_list.h"

#include "engine/math/angle.h"
#include "render/verify/compare/frame_rays.h"
#include "render/verify/compare/interpolated_normal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace dollytrack::verify {
namespace {

constexpr double kNormalsSteps = 65535.0;

Eigen::Vector3d normalFrom(const std::uint16_t* pixel) {
    return Eigen::Vector3d(pixel[0], pixel[1], pixel[2]) * (2.0 / kNormalsSteps) -
           Eigen::Vector3d::Ones();
}

bool isNone(const std::uint16_t* pixel) {
    return pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0;
}

std::string normalText(const Eigen::Vector3d& n) {
    return fmt::format("({:.4f}, {:.4f}, {:.4f})", n.x(), n.y(), n.z());
}

/// Normal of the depth around a pixel, camera frame, if the surface is flat. On a plane the inverse
/// depth is linear in the image.
std::optional<Eigen::Vector3d> flatNormal(const StoredDataset& dataset,
                                          const FrameImages::Depth& depth, const Image16& ids,
                                          int x, int y) {
    constexpr int kReach = 4;  // px: with fewer, rounding to millimetres tilts the plane
    const ImageF& metres = depth.metres;
    if (!metres.holds(x - kReach, y - kReach) || !metres.holds(x + kReach, y + kReach)) {
        return std::nullopt;
    }
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d sums = Eigen::Vector3d::Zero();
    for (int dy = -kReach; dy <= kReach; dy += 2) {
        for (int dx = -kReach; dx <= kReach; dx += 2) {
            const double here = metres.at(x + dx, y + dy);
            if (here <= 0.0 || ids.at(x + dx, y + dy) != ids.at(x, y)) return std::nullopt;
            const Eigen::Vector3d row = dataset.lens.unproject(x + dx + 0.5, y + dy + 0.5);
            squares += row * row.transpose();
            sums += row / here;
        }
    }
    const Eigen::Vector3d plane = squares.ldlt().solve(sums);
    for (int dy = -kReach; dy <= kReach; dy += 2) {
        for (int dx = -kReach; dx <= kReach; dx += 2) {
            const double here = metres.at(x + dx, y + dy);
            const double fitted =
                1.0 / plane.dot(dataset.lens.unproject(x + dx + 0.5, y + dy + 0.5));
            if (!(std::abs(fitted - here) < 1.2 * depth.rounding_m + 1e-4 * here)) {
                return std::nullopt;
            }
        }
    }
    return -plane.normalized();  // towards the camera
}

/// One frame's normals.
class NormalImages {
  public:
    NormalImages(const Subject& subject, FrameImages& images)
        : subject_(subject),
          images_(images),
          in_camera_(images.image16("normal_camera")),
          in_world_(images.image16("normal_world")),
          ids_(images.image16("instance")) {}

    void check(Findings& findings) const {
        if (in_camera_) checkUnit(*in_camera_, "normal_camera", findings);
        if (in_world_) checkUnit(*in_world_, "normal_world", findings);
        if (in_camera_ && in_world_) checkTurned(findings);
        if (in_camera_ || in_world_) checkSurface(findings);
    }

  private:
    [[nodiscard]] std::string file(const char* modality) const {
        return imageFile(modality, images_.frame());
    }

    void checkUnit(const Image16& image, const char* modality, Findings& findings) const {
        // Whether the image's axes are the world's; else the camera's.
        const bool world = &image == in_world_;
        const Eigen::Quaterniond& rotation = images_.stored().pose.rotation;
        WrongPixels none, length, away;
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const std::uint16_t* pixel = image.pixel(x, y);
                const bool nothing = isNone(pixel);
                if (ids_ && nothing != (ids_->at(x, y) == 0)) {
                    none.add(x, y, [&] {
                        return nothing
                                   ? WrongPixels::Text{"no normal", fmt::format("that of object {}",
                                                                                ids_->at(x, y))}
                                   : WrongPixels::Text{normalText(normalFrom(pixel)),
                                                       "none, because the pixel shows no object"};
                    });
                }
                if (nothing) continue;
                const Eigen::Vector3d normal = normalFrom(pixel);
                Eigen::Vector3d along = subject_.dataset.lens.unproject(x + 0.5, y + 0.5);
                if (world) along = rotation * along;
                if (normal.dot(along) > 0.01) {
                    away.add(x, y, [&] {
                        return WrongPixels::Text{normalText(normal) + ", away from the camera",
                                                 "the visible side"};
                    });
                }
                const double norm = normal.norm();
                if (std::abs(norm - 1.0) <= 1e-4) continue;
                length.add(x, y, [&] {
                    return WrongPixels::Text{fmt::format("a normal of length {:.4f}", norm), "1"};
                });
            }
        }
        none.report(file(modality), images_.frame(), findings);
        length.report(file(modality), images_.frame(), findings);
        away.report(file(modality), images_.frame(), findings);
    }

    void checkTurned(Findings& findings) const {
        const Eigen::Quaterniond& rotation = images_.stored().pose.rotation;
        WrongPixels pixels;
        for (int y = 0; y < in_camera_->height; ++y) {
            for (int x = 0; x < in_camera_->width; ++x) {
                const std::uint16_t* camera = in_camera_->pixel(x, y);
                const std::uint16_t* world = in_world_->pixel(x, y);
                if (isNone(camera) || isNone(world)) continue;
                const Eigen::Vector3d expected = rotation * normalFrom(camera);
                if ((expected - normalFrom(world)).norm() <= 1e-4) continue;
                pixels.add(x, y, [&] {
                    return WrongPixels::Text{
                        normalText(normalFrom(world)),
                        normalText(expected) + ", by normal_camera and the pose"};
                });
            }
        }
        pixels.report(file("normal_world"), images_.frame(), findings);
    }

    [[nodiscard]] Eigen::Vector3d worldNormal(int x, int y) const {
        if (in_world_) return normalFrom(in_world_->pixel(x, y));
        return images_.stored().pose.rotation * normalFrom(in_camera_->pixel(x, y));
    }

    /// Compares with ray casts, or without a scene with flat parts of the depth. Models may shade
    /// flat surfaces as round, so depth alone verifies axes and signs over many pixels.
    void checkSurface(Findings& findings) const {
        const char* modality = in_world_ ? "normal_world" : "normal_camera";
        const Image16& image = in_world_ ? *in_world_ : *in_camera_;
        WrongPixels pixels;
        std::size_t compared = 0;
        const auto compare = [&](int x, int y, const Eigen::Vector3d& expected, double degrees,
                                 const char* by) {
            ++compared;
            const Eigen::Vector3d found = worldNormal(x, y);
            if (found.dot(expected) >= std::cos(degrees * kDegree)) return;
            pixels.add(x, y, [&] {
                return WrongPixels::Text{fmt::format("{} in the world", normalText(found)),
                                         fmt::format("{}, by {}", normalText(expected), by)};
            });
        };
        if (subject_.rays && images_.stored().moving.empty()) {
            compareWithScene(image, compare);
            if (pixels.count() <= 10 + compared / 50) return;
        } else {
            compareWithDepths(image, compare);
            if (pixels.count() <= 10 + compared / 4) return;
        }
        pixels.report(file(modality), images_.frame(), findings);
    }

    template <class Compare>
    void compareWithScene(const Image16& image, Compare&& compare) const {
        const Pose& pose = images_.stored().pose;
        FrameRays rays(subject_, images_.stored(), pose);
        std::vector<RayHit> hits;
        for (int y = 0; y < image.height; ++y) {
            rays.castRow(y, hits);
            for (int x = 0; x < image.width; ++x) {
                const RayHit& hit = hits[x];
                if (hit.object_id == 0 || isNone(image.pixel(x, y))) continue;
                if (ids_ && ids_->at(x, y) != hit.object_id) continue;
                const Eigen::Vector3d ahead = subject_.dataset.lens.unproject(x + 0.5, y + 0.5);
                const Eigen::Vector3d expected =
                    interpolatedNormal(*subject_.scene, hit, pose.toWorld(hit.distance * ahead),
                                       (pose.rotation * ahead).normalized());
                if (expected.norm() > 0.5) compare(x, y, expected, 3.0, "the scene");
            }
        }
    }

    template <class Compare>
    void compareWithDepths(const Image16& image, Compare&& compare) const {
        const FrameImages::Depth* depth = images_.depth();
        if (!depth || !ids_) return;
        const Eigen::Quaterniond& rotation = images_.stored().pose.rotation;
        constexpr int kStep = 3;
        for (int y = 0; y < image.height; y += kStep) {
            for (int x = 0; x < image.width; x += kStep) {
                if (isNone(image.pixel(x, y))) continue;
                const auto flat = flatNormal(subject_.dataset, *depth, *ids_, x, y);
                if (flat) compare(x, y, rotation * *flat, 75.0, "the depth around it");
            }
        }
    }

    const Subject& subject_;
    FrameImages& images_;
    const Image16* in_camera_;
    const Image16* in_world_;
    const Image16* ids_;
};

}  // namespace

CheckWork beginNormals(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&subject](FrameImages& images, Findings& findings) {
        NormalImages(subject, images).check(findings);
    };
    return work;
}

}  // namespace dollytrack::verify
