#include "render/draw/passes/view_uniforms.h"

#include <GL/glew.h>

#include <array>

namespace dollytrack::render {

Eigen::Matrix3f cameraFromWorld(const View& view) {
    return view.pose.rotation.conjugate().toRotationMatrix().cast<float>();
}

void setRotation(unsigned program, int location, const Eigen::Matrix3f& rotation) {
    glProgramUniformMatrix3fv(program, location, 1, GL_FALSE, rotation.data());
}

void setCamera(unsigned program, const View& view) {
    const Intrinsics& lens = view.intrinsics;
    const Eigen::Vector3f position = view.pose.position.cast<float>();
    setRotation(program, 0, cameraFromWorld(view));
    glProgramUniform3fv(program, 1, 1, position.data());
    const double fx = view.orthographic ? view.orthographic->px_per_m : lens.fx;
    const double fy = view.orthographic ? view.orthographic->px_per_m : lens.fy;
    glProgramUniform4f(program, 2, static_cast<float>(2.0 * fx / lens.width),
                       static_cast<float>(2.0 * fy / lens.height),
                       static_cast<float>(2.0 * lens.cx / lens.width - 1.0),
                       static_cast<float>(2.0 * lens.cy / lens.height - 1.0));
    setDepthSpan(program, 3, view);
}

void setDepthSpan(unsigned program, int location, const View& view) {
    glProgramUniform2f(program, location, static_cast<float>(view.near_m),
                       static_cast<float>(view.orthographic ? view.orthographic->depth_m : 0.0));
}

void setUnproject(unsigned program, int location, const View& view) {
    const Intrinsics& lens = view.intrinsics;
    const double fx = view.orthographic ? view.orthographic->px_per_m : lens.fx;
    const double fy = view.orthographic ? view.orthographic->px_per_m : lens.fy;
    glProgramUniform4f(program, location, static_cast<float>(1.0 / fx),
                       static_cast<float>(1.0 / fy), static_cast<float>(-lens.cx / fx),
                       static_cast<float>(-lens.cy / fy));
}

void setClipBox(unsigned program, int low_location, int high_location, const View& view) {
    const Eigen::AlignedBox3d everything(Eigen::Vector3d::Constant(-1e9),
                                         Eigen::Vector3d::Constant(1e9));
    const Eigen::AlignedBox3f box = view.clip_box.value_or(everything).cast<float>();
    glProgramUniform3fv(program, low_location, 1, box.min().data());
    glProgramUniform3fv(program, high_location, 1, box.max().data());
}

namespace {

using Plane = std::pair<Eigen::Vector3d, double>;  // inside: normal * p + offset >= 0

/// The view volume as planes in the camera frame: its four sides and the near plane.
std::array<Plane, 5> limitsOf(const View& view) {
    const Intrinsics& lens = view.intrinsics;
    const Plane near = {{0.0, 0.0, 1.0}, -view.near_m};
    if (view.orthographic) {
        const double scale = view.orthographic->px_per_m;
        return {{{{scale, 0.0, 0.0}, lens.cx},
                 {{-scale, 0.0, 0.0}, lens.width - lens.cx},
                 {{0.0, scale, 0.0}, lens.cy},
                 {{0.0, -scale, 0.0}, lens.height - lens.cy},
                 near}};
    }
    return {{{{lens.fx, 0.0, lens.cx}, 0.0},
             {{-lens.fx, 0.0, lens.width - lens.cx}, 0.0},
             {{0.0, lens.fy, lens.cy}, 0.0},
             {{0.0, -lens.fy, lens.height - lens.cy}, 0.0},
             near}};
}

}  // namespace

std::vector<bool> objectsInView(const GpuScene& scene, const View& view) {
    std::array<Plane, 5> planes = limitsOf(view);
    for (auto& [normal, offset] : planes) {
        offset /= normal.norm();
        normal = view.pose.rotation * normal.normalized();
        offset -= normal.dot(view.pose.position);
    }

    std::vector<bool> visible(scene.bounds.size(), false);
    for (std::size_t i = 0; i < scene.bounds.size(); ++i) {
        if (i + 1 < view.hidden.size() && view.hidden[i + 1]) continue;
        if (scene.bounds[i].isEmpty()) continue;
        const Eigen::Vector3d center = scene.bounds[i].center().cast<double>();
        // Grown by 0.1 mm, so that rounding does not drop objects at a border.
        const Eigen::Vector3d half =
            0.5 * scene.bounds[i].sizes().cast<double>() + Eigen::Vector3d::Constant(1e-4);
        bool inside = true;
        for (const auto& [normal, offset] : planes) {
            if (normal.dot(center) + offset + normal.cwiseAbs().dot(half) < 0.0) {
                inside = false;
                break;
            }
        }
        visible[i] = inside;
    }
    return visible;
}

}  // namespace dollytrack::render
