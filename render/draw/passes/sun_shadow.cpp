#include "render/draw/passes/sun_shadow.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/context.h"
#include "render/gl/shader.h"
#include "render/materials/surface_kind.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::render {
namespace {

constexpr double kTexel_m = 0.004;  // wanted; larger if the map would exceed kLargest_px
constexpr int kSmallest_px = 256;
constexpr int kLargest_px = 4096;
constexpr double kBlur_m = 0.008;  // penumbra of the sun's disc at about two metres

/// Orthographic view along the sunlight, over all shadow casters.
View viewFromSun(const SunLight& sun) {
    View view;
    const Eigen::Vector3d forward = -sun.way;
    const Eigen::Vector3d aside =
        std::abs(forward.z()) < 0.99 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d right = forward.cross(aside).normalized();
    Eigen::Matrix3d axes;
    axes << right, forward.cross(right), forward;
    Eigen::AlignedBox3d box;  // in those axes
    for (int corner = 0; corner < 8; ++corner) {
        box.extend(Eigen::Vector3d(
            axes.transpose() *
            sun.shades.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))));
    }
    const Eigen::Vector3d size = box.sizes();
    const double wide = std::max({size.x(), size.y(), 0.1});
    // Clamped as a double: a file's extent may exceed the range of int.
    const int pixels = static_cast<int>(std::clamp(64.0 * std::ceil(wide / kTexel_m / 64.0),
                                                   1.0 * kSmallest_px, 1.0 * kLargest_px));
    view.pose.rotation = Eigen::Quaterniond(axes);
    view.pose.position =
        axes * Eigen::Vector3d(box.center().x(), box.center().y(), box.min().z() - 0.01);
    const double middle = 0.5 * pixels;
    view.intrinsics = {pixels, pixels, 1.0, 1.0, middle, middle};
    view.near_m = 0.0;
    view.orthographic = Orthographic{pixels / wide, size.z() + 0.02};
    return view;
}

gl::Texture makeMap(unsigned format, int pixels, const std::array<float, 4>& beyond) {
    gl::Texture texture = gl::createTexture(GL_TEXTURE_2D);
    glTextureStorage2D(texture.get(), 1, format, pixels, pixels);
    glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glTextureParameterfv(texture.get(), GL_TEXTURE_BORDER_COLOR, beyond.data());
    return texture;
}

}  // namespace

Result<SunShadow> SunShadow::create(const SunLight& sun) {
    SunShadow shadow;
    shadow.sun_ = sun;
    if (sun.shades.isEmpty()) {  // there is no object
        shadow.sun_.shades = Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    }
    shadow.view_ = viewFromSun(shadow.sun_);
    const int pixels = shadow.view_.intrinsics.width;
    // Reversed depth: the border value 0 means no shadow caster.
    shadow.depth_ = makeMap(GL_DEPTH_COMPONENT32F, pixels, {0, 0, 0, 0});
    glTextureParameteri(shadow.depth_.get(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(shadow.depth_.get(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    shadow.let_through_ = makeMap(GL_R8, pixels, {1, 1, 1, 1});
    shadow.frame_ = gl::createFramebuffer();
    const unsigned frame = shadow.frame_.get();
    glNamedFramebufferTexture(frame, GL_DEPTH_ATTACHMENT, shadow.depth_.get(), 0);
    glNamedFramebufferTexture(frame, GL_COLOR_ATTACHMENT0, shadow.let_through_.get(), 0);
    Result<gl::Program> program = gl::linkProgram("surface.vert", "sun_shadow.frag");
    if (!program) return tl::unexpected(program.error());
    shadow.program_ = std::move(*program);
    if (Status status = gl::checkErrors("preparing the sun's shadows"); !status) {
        return tl::unexpected(status.error());
    }
    return shadow;
}

void SunShadow::draw(const GpuScene& scene) {
    const int pixels = view_.intrinsics.width;
    glBindFramebuffer(GL_FRAMEBUFFER, frame_.get());
    glViewport(0, 0, pixels, pixels);
    const float nothing = 0.0F;
    const std::array<float, 4> all = {1, 1, 1, 1};
    glClearBufferfv(GL_DEPTH, 0, &nothing);
    glClearBufferfv(GL_COLOR, 0, all.data());
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);
    glBindVertexArray(scene.layout.get());
    glUseProgram(program_.get());
    setCamera(program_.get(), view_);
    const Eigen::Vector3f eye = view_.pose.position.cast<float>();
    const Eigen::Vector3f low = sun_.shades.min().cast<float>();
    const Eigen::Vector3f high = sun_.shades.max().cast<float>();
    glUniform3fv(6, 1, eye.data());
    glUniform3fv(7, 1, low.data());
    glUniform3fv(8, 1, high.data());
    for (const bool glass : {false, true}) {
        if (glass) {  // only panes with nothing between them and the sun
            glDepthMask(GL_FALSE);
            glEnablei(GL_BLEND, 0);
            glBlendFunci(0, GL_ZERO, GL_SRC_COLOR);
        }
        glUniform1i(9, glass ? 1 : 0);
        for (const Batch& batch : scene.batches) {
            if ((batch.surface == Surface::Glass) != glass) continue;
            glUniform1i(4, batch.texture != 0 ? 1 : 0);
            glUniform1f(5, batch.surface == Surface::CutOut ? kHoleBelow : 0.0F);
            if (batch.texture != 0) glBindTextureUnit(0, batch.texture);
            for (const Piece& piece : batch.pieces) {
                const auto index = static_cast<std::size_t>(piece.object_id) - 1;
                if (glass ? scene.windows[index] : scene.whole_windows[index]) continue;
                glDrawElements(
                    GL_TRIANGLES, static_cast<GLsizei>(piece.index_count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                        static_cast<std::uintptr_t>(piece.first_index) * sizeof(std::uint32_t)));
            }
        }
    }
    glDisablei(GL_BLEND, 0);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

void SunShadow::use(unsigned program) const {
    const double scale = view_.orthographic->px_per_m;
    const auto per_m = static_cast<float>(scale / view_.intrinsics.width);
    const Eigen::Vector3f way = sun_.way.cast<float>();
    const Eigen::Vector3f eye = view_.pose.position.cast<float>();
    glProgramUniform3fv(program, 18, 1, sun_.irradiance.data());
    glProgramUniform3fv(program, 19, 1, way.data());
    setRotation(program, 20, cameraFromWorld(view_));
    glProgramUniform3fv(program, 21, 1, eye.data());
    glProgramUniform4f(program, 22, per_m, per_m,
                       static_cast<float>(1.0 / view_.orthographic->depth_m),
                       static_cast<float>(1.0 / scale));
    glProgramUniform1f(program, 23, static_cast<float>(std::max(kBlur_m, 0.7 / scale)));
    glBindTextureUnit(7, depth_.get());
    glBindTextureUnit(8, let_through_.get());
}

}  // namespace dollytrack::render
