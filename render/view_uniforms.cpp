#include "render/view_uniforms.h"

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
    glProgramUniform4f(program, 2, static_cast<float>(2.0 * lens.fx / lens.width),
                       static_cast<float>(2.0 * lens.fy / lens.height),
                       static_cast<float>(2.0 * lens.cx / lens.width - 1.0),
                       static_cast<float>(2.0 * lens.cy / lens.height - 1.0));
    glProgramUniform1f(program, 3, static_cast<float>(view.near_m));
}

void setUnproject(unsigned program, int location, const View& view) {
    const Intrinsics& lens = view.intrinsics;
    glProgramUniform4f(program, location, static_cast<float>(1.0 / lens.fx),
                       static_cast<float>(1.0 / lens.fy), static_cast<float>(-lens.cx / lens.fx),
                       static_cast<float>(-lens.cy / lens.fy));
}

std::vector<bool> objectsInView(const GpuScene& scene, const View& view) {
    const Intrinsics& lens = view.intrinsics;
    // Inward normals of the pyramid's sides, in the camera's frame; the near plane is z >= near.
    const std::array<Eigen::Vector3d, 4> sides = {{
        {lens.fx, 0.0, lens.cx},
        {-lens.fx, 0.0, lens.width - lens.cx},
        {0.0, lens.fy, lens.cy},
        {0.0, -lens.fy, lens.height - lens.cy},
    }};
    std::array<std::pair<Eigen::Vector3d, double>, 5> planes;  // normal * p + offset >= 0
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Eigen::Vector3d normal = view.pose.rotation * sides[i].normalized();
        planes[i] = {normal, -normal.dot(view.pose.position)};
    }
    const Eigen::Vector3d forward = view.pose.forward();
    planes[4] = {forward, -forward.dot(view.pose.position) - view.near_m};

    std::vector<bool> visible(scene.bounds.size(), false);
    for (std::size_t i = 0; i < scene.bounds.size(); ++i) {
        if (i + 1 < view.hidden.size() && view.hidden[i + 1]) continue;
        if (scene.bounds[i].isEmpty()) continue;
        const Eigen::Vector3d center = scene.bounds[i].center().cast<double>();
        // A hair larger: rounding must not drop what touches a border.
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
