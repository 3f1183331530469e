#pragma once

#include "render/materials/surface_brdf.h"
#include "render/materials/traced_surface.h"
#include "render/pathtrace/layered_image.h"

#include <Eigen/Core>

namespace dollytrack::render {

/// Light that a surface reflects in its diffuse and its glossy layer. `diffuse` does not include
/// the surface's base colour yet.
struct Reflected {
    Eigen::Vector3f diffuse = Eigen::Vector3f::Zero();
    Eigen::Vector3f glossy = Eigen::Vector3f::Zero();

    void add(const SurfaceBrdf::Layers& value, const Eigen::Vector3f& arriving) {
        diffuse += value.diffuse * arriving;
        glossy += value.glossy.cwiseProduct(arriving);
    }
    [[nodiscard]] Eigen::Vector3f sum(const Eigen::Vector3f& base) const {
        return base.cwiseProduct(diffuse) + glossy;
    }
};

/// The light that a path has gathered, and the shares that it still carries to the camera: through
/// the diffuse layer of the first surface, and in any other way.
class Gathered {
  public:
    LayeredLight light;
    bool seen = true;   // the camera sees the next surface directly or through glass
    int scattered = 0;  // number of surfaces that have scattered the path

    /// Light that arrives at the last surface, or at the camera.
    void arrive(const Eigen::Vector3f& sent) {
        if (seen) {
            light.shown += other_.cwiseProduct(sent);
            return;
        }
        (scattered == 1 ? light.direct : light.indirect) += diffuse_.cwiseProduct(sent);
        light.glossy += other_.cwiseProduct(sent);
    }
    /// Light that the surface now reached reflects. `first`: it is the surface that the layers
    /// describe.
    void reflect(const Reflected& from, const Eigen::Vector3f& base, bool first) {
        if (first) {
            light.direct += other_.cwiseProduct(base).cwiseProduct(from.diffuse);
            light.glossy += other_.cwiseProduct(from.glossy);
            return;
        }
        const Eigen::Vector3f sum = from.sum(base);
        light.indirect += diffuse_.cwiseProduct(sum);
        light.glossy += other_.cwiseProduct(sum);
    }
    /// The path goes on from the surface now reached.
    void scatter(const SurfaceBrdf::Layers& value, const Eigen::Vector3f& base, float factor,
                 bool first) {
        if (first) {
            diffuse_ = other_.cwiseProduct(base) * (value.diffuse * factor);
            other_ = other_.cwiseProduct(value.glossy) * factor;
        } else {
            const Eigen::Vector3f sum = (base * value.diffuse + value.glossy) * factor;
            diffuse_ = diffuse_.cwiseProduct(sum);
            other_ = other_.cwiseProduct(sum);
        }
        seen = false;
        ++scattered;
    }
    [[nodiscard]] float strongest() const { return (diffuse_ + other_).maxCoeff(); }
    void divide(float by) {
        diffuse_ /= by;
        other_ /= by;
    }
    /// Remembers the surface that the layers describe.
    void meet(const SurfacePoint& point, const Eigen::Vector3d& camera) {
        light.distance = static_cast<float>((point.position - camera).norm());
        light.reflectance = point.base_color * (1.0F - point.metallic);
        light.normal = point.normal.cast<float>();
        light.position = point.position.cast<float>();
        light.hits = 1.0F;
    }

  private:
    Eigen::Vector3f diffuse_ = Eigen::Vector3f::Zero();
    Eigen::Vector3f other_ = Eigen::Vector3f::Ones();
};

}  // namespace dollytrack::render
