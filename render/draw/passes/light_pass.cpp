#include "render/draw/passes/light_pass.h"

#include "render/draw/passes/view_uniforms.h"
#include "render/gl/image.h"
#include "render/light/tone_curve.h"

#include <GL/glew.h>

#include <array>
#include <numbers>
#include <vector>

namespace dollytrack::render {
namespace {

// Macros of light.frag. Without kSamplesPerPixel and kSensor the shader makes a finished image.
constexpr unsigned kSamplesPerPixel = 1;
constexpr unsigned kSensor = 2;
constexpr unsigned kSun = 4;
constexpr unsigned kAlike = 8;
constexpr unsigned kReflections = 16;

constexpr unsigned kMaps = 1;  // macros of occlusion.frag, with the next
constexpr unsigned kFirstLook = 2;

constexpr int kSkySteps = 4096;  // from straight down to straight up

/// Fills a volume texture; `fourth` holds its alpha values (empty: 0).
void fillVolume(const gl::Texture& texture, const LightVolume& light,
                const std::vector<Eigen::Vector3f>& values, const std::vector<float>& fourth) {
    std::vector<Eigen::Vector4f> padded;
    padded.reserve(values.size());
    for (const Eigen::Vector3f& value : values) {
        padded.emplace_back(value[0], value[1], value[2],
                            fourth.empty() ? 0.0F : fourth[padded.size()]);
    }
    const auto [x, y, z] = light.cells;
    glTextureSubImage3D(texture.get(), 0, 0, 0, 0, x, y, z, GL_RGBA, GL_FLOAT, padded.data());
}

gl::Texture uploadVolume(const LightVolume& light, const std::vector<Eigen::Vector3f>& values,
                         const std::vector<float>& fourth = {}) {
    gl::Texture texture = gl::createTexture(GL_TEXTURE_3D);
    const auto [x, y, z] = light.cells;
    glTextureStorage3D(texture.get(), 1, GL_RGBA16F, x, y, z);
    fillVolume(texture, light, values, fourth);
    glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(texture.get(), axis, GL_CLAMP_TO_EDGE);
    }
    return texture;
}

/// Linear sky colours by elevation.
gl::Texture uploadSky(const Eigen::Vector3f& factor, float grey) {
    gl::Texture texture = gl::createTexture(GL_TEXTURE_1D);
    glTextureStorage1D(texture.get(), 1, GL_RGBA32F, kSkySteps);
    std::vector<Eigen::Vector4f> colors;
    for (int i = 0; i < kSkySteps; ++i) {
        const float rise = 2.0F * (static_cast<float>(i) + 0.5F) / kSkySteps - 1.0F;
        const Eigen::Vector3f color = decoded(skyBackdrop(rise, grey)).cwiseProduct(factor);
        colors.emplace_back(color.x(), color.y(), color.z(), 1.0F);
    }
    glTextureSubImage1D(texture.get(), 0, 0, kSkySteps, GL_RGBA, GL_FLOAT, colors.data());
    glTextureParameteri(texture.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    return texture;
}

}  // namespace

LightPass::LightPass()
    : no_vertices_(gl::createVertexArray()),
      lighting_("picture.vert", "light.frag",
                {"MULTISAMPLED", "SENSOR", "SUN", "ALIKE", "REFLECTIONS"}),
      occlusion_("picture.vert", "occlusion.frag", {"MAPS", "MULTISAMPLED"}),
      soften_("picture.vert", "soften.frag", {}),
      edges_("picture.vert", "smooth_edges.frag", {}),
      encode_("picture.vert", "encode.frag", {}) {}

Status LightPass::setLight(const LightVolume& light) {
    const std::vector<Eigen::Vector3f> none(light.ambient.size(), Eigen::Vector3f::Zero());
    ambient_ = uploadVolume(light, light.ambient);
    slope_ = uploadVolume(light, light.slope.empty() ? none : light.slope);
    lamps_ = uploadVolume(light, light.lamps, light.scene_lamp_share);
    sky_ = uploadSky(light.backdrop_factor, light.backdrop_grey);
    keep(light);
    sun_shadow_.reset();
    sun_shadow_is_old_ = true;
    if (!light.sun.shines()) return {};
    Result<SunShadow> shadow = SunShadow::create(light.sun);
    if (!shadow) return tl::unexpected(shadow.error());
    sun_shadow_.emplace(std::move(*shadow));
    return {};
}

void LightPass::changeLight(const LightVolume& light) {
    fillVolume(ambient_, light, light.ambient, {});
    fillVolume(slope_, light, light.slope, {});
    if (light.backdrop_factor != light_.backdrop_factor ||
        light.backdrop_grey != light_.backdrop_grey) {
        sky_ = uploadSky(light.backdrop_factor, light.backdrop_grey);
    }
    keep(light);
    if (sun_shadow_) sun_shadow_->setIrradiance(light.sun.irradiance);
}

/// Keeps the volume's settings; its grid values stay on the graphics card only.
void LightPass::keep(const LightVolume& light) {
    light_ = light;
    light_.ambient.clear();
    light_.slope.clear();
    light_.lamps.clear();
    light_.scene_lamp_share.clear();
}

void LightPass::setReflections(const std::vector<Eigen::Vector4f>& image, const View& view,
                               int first_row, int last_row) {
    const int width = view.intrinsics.width;
    const int height = view.intrinsics.height;
    if (width != reflections_width_ || height != reflections_height_) {
        reflections_ = gl::createImage(GL_RGBA32F, width, height);
        reflections_width_ = width;
        reflections_height_ = height;
    }
    glTextureSubImage2D(reflections_.get(), 0, 0, first_row, width, last_row - first_row, GL_RGBA,
                        GL_FLOAT, image.data() + static_cast<std::ptrdiff_t>(first_row) * width);
    reflects_ = true;
}

/// Macros that all current variants of light.frag share.
unsigned LightPass::everyKind() const {
    return (sun_shadow_ ? kSun : 0U) | (reflects_ ? kReflections : 0U);
}

unsigned LightPass::lightProgram(unsigned kind) const {
    return lighting_.get(kind | everyKind());
}

Status LightPass::prepare(const GpuScene& scene) {
    for (const unsigned kind : {0U, kSamplesPerPixel, kSamplesPerPixel | kAlike, kSensor}) {
        if (Status status = lighting_.link(kind | everyKind()); !status) return status;
    }
    const unsigned maps = scene.has_maps ? kMaps : 0U;
    for (const unsigned words : {maps, maps | kFirstLook}) {
        if (Status status = occlusion_.link(words); !status) return status;
    }
    for (gl::ProgramVariants* program : {&soften_, &edges_, &encode_}) {
        if (Status status = program->link(0); !status) return status;
    }
    if (sun_shadow_ && sun_shadow_is_old_) sun_shadow_->draw(scene);
    sun_shadow_is_old_ = false;
    return {};
}

void LightPass::draw(const gl::Framebuffer& frame, int width, int height, unsigned program) const {
    glBindFramebuffer(GL_FRAMEBUFFER, frame.get());
    glViewport(0, 0, width, height);
    glUseProgram(program);
    glBindVertexArray(no_vertices_.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void LightPass::drawOcclusion(const GpuScene& scene, const View& view, RenderTarget& target) {
    glBindTextureUnit(1, target.normal_.get());
    glBindTextureUnit(2, target.surface_.get());
    drawOcclusion(view, occlusion_.get(scene.has_maps ? kMaps : 0U), target);
}

void LightPass::drawOcclusion(const GpuScene& scene, const View& view,
                              const MultisampleBuffer& samples, RenderTarget& target) {
    const unsigned program = occlusion_.get((scene.has_maps ? kMaps : 0U) | kFirstLook);
    glBindTextureUnit(1, samples.normal_.get());
    glBindTextureUnit(2, samples.depth_.get());
    setDepthSpan(program, 4, view);
    drawOcclusion(view, program, target);
}

void LightPass::skipOcclusion(RenderTarget& target) {
    const std::array<float, 4> open = {1.0F, 1.0F, 1.0F, 1.0F};
    glClearNamedFramebufferfv(target.soft_frame_.get(), GL_COLOR, 0, open.data());
    glBindTextureUnit(1, target.normal_.get());
    glBindTextureUnit(2, target.surface_.get());
    glBindTextureUnit(3, target.soft_occlusion_.get());
}

void LightPass::drawOcclusion(const View& view, unsigned occlusion, RenderTarget& target) {
    const int width = (target.width() + 1) / 2;
    const int height = (target.height() + 1) / 2;
    setRotation(occlusion, 0, cameraFromWorld(view));
    setUnproject(occlusion, 1, view);
    const double scale = view.orthographic ? view.orthographic->px_per_m : view.intrinsics.fx;
    glProgramUniform1f(occlusion, 2, static_cast<float>(scale));
    glProgramUniform1i(occlusion, 3, view.orthographic ? 1 : 0);
    draw(target.occlusion_frame_, width, height, occlusion);
    glBindTextureUnit(3, target.occlusion_.get());
    draw(target.soft_frame_, width, height, soften_.get(0));
    glBindTextureUnit(3, target.soft_occlusion_.get());
}

void LightPass::setLightOf(const View& view, float shine, unsigned program, RenderTarget& target) {
    const Eigen::Vector3f position = view.pose.position.cast<float>();
    const Eigen::Vector3f low = light_.low.cast<float>();
    Eigen::Vector3f scale;
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis] = static_cast<float>(1.0 / (light_.cell_m * light_.cells[axis]));
    }
    setRotation(program, 0, cameraFromWorld(view).transpose());
    setUnproject(program, 1, view);
    glProgramUniform3fv(program, 2, 1, position.data());
    glProgramUniform3fv(program, 3, 1, low.data());
    glProgramUniform3fv(program, 4, 1, scale.data());
    glProgramUniform1f(program, 5, static_cast<float>(light_.cell_m));
    glProgramUniform1f(program, 6, light_.exposure);
    glProgramUniform3fv(program, 7, 1, light_.lamp_color.data());
    Eigen::Vector4f backdrop = Eigen::Vector4f::Zero();
    if (view.backdrop) {
        const Eigen::Vector3f plain = decoded(*view.backdrop);
        backdrop = {plain.x(), plain.y(), plain.z(), 1.0F};
    }
    glProgramUniform4fv(program, 8, 1, backdrop.data());
    glProgramUniform1i(program, 9, view.orthographic ? 1 : 0);
    glProgramUniform2f(program, 17, static_cast<float>(target.width()),
                       static_cast<float>(target.height()));
    glProgramUniform1f(program, 10,
                       std::numbers::pi_v<float> * light_.exposure * light_.dimmed * shine);
    glProgramUniform3fv(program, 24, 1, light_.scene_lamp_color.data());
    if (sun_shadow_) sun_shadow_->use(program);
    if (reflects_) glBindTextureUnit(14, reflections_.get());
    glBindTextureUnit(0, target.color_.get());
    glBindTextureUnit(4, ambient_.get());
    glBindTextureUnit(5, lamps_.get());
    glBindTextureUnit(6, slope_.get());
    glBindTextureUnit(13, sky_.get());
}

void LightPass::drawPicture(const View& view, float shine, RenderTarget& target) {
    const unsigned program = lightProgram(0);
    setLightOf(view, shine, program, target);
    draw(target.lit_frame_, target.width(), target.height(), program);
    glBindTextureUnit(0, 0);  // the next pass renders into this texture
}

void LightPass::drawSum(RenderTarget& target, unsigned program) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    draw(target.sum_frame_, target.width(), target.height(), program);
    glDisable(GL_BLEND);
    glBindTextureUnit(0, 0);
}

void LightPass::addSamples(const View& view, float shine, float share,
                           const MultisampleBuffer& samples, RenderTarget& target) {
    std::array<float, 2 * MultisampleBuffer::kSamplesPerPixel> aside{};
    for (std::size_t i = 0; i < MultisampleBuffer::kSamplesPerPixel; ++i) {
        aside[2 * i] = static_cast<float>(samples.offsets()[i].x());
        aside[2 * i + 1] = static_cast<float>(samples.offsets()[i].y());
    }
    // The first pass shades agreeing pixels and marks them in the depth buffer; the second pass
    // shades the pixels without a mark.
    const float no_mark = 0.0F;
    glClearNamedFramebufferfv(target.sum_frame_.get(), GL_DEPTH, 0, &no_mark);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    for (const unsigned kind : {kSamplesPerPixel | kAlike, kSamplesPerPixel}) {
        const unsigned program = lightProgram(kind);
        setLightOf(view, shine, program, target);
        glProgramUniform1f(program, 11, share);
        glProgramUniform2fv(program, 25, MultisampleBuffer::kSamplesPerPixel, aside.data());
        setDepthSpan(program, 12, view);
        glBindTextureUnit(0, samples.color_.get());
        glBindTextureUnit(1, samples.normal_.get());
        glBindTextureUnit(2, samples.depth_.get());
        drawSum(target, program);
    }
    glDisable(GL_DEPTH_TEST);
}

void LightPass::addLight(const View& view, float shine, const LightSum& sum, RenderTarget& target) {
    const unsigned program = lightProgram(kSensor);
    setLightOf(view, shine, program, target);
    const auto set = [&](int location, double a, double b, double c, double d) {
        glProgramUniform4f(program, location, static_cast<float>(a), static_cast<float>(b),
                           static_cast<float>(c), static_cast<float>(d));
    };
    const Intrinsics& lens = sum.lens;
    set(13, 1.0 / lens.fx, 1.0 / lens.fy, -lens.cx / lens.fx, -lens.cy / lens.fy);
    set(14, sum.distortion.k1, sum.distortion.k2, sum.distortion.p1, sum.distortion.p2);
    glProgramUniform1f(program, 15, static_cast<float>(sum.distortion.k3));
    // In units of the time between exposure samples, which keeps the numbers small.
    if (sum.s_per_bent > 0.0) {
        set(16, sum.s_per_bent / sum.sample_step_s, -sum.after_s / sum.sample_step_s,
            0.5 * sum.row_exposure_s / sum.sample_step_s, 0.0);
    } else {
        set(16, 0.0, 0.0, 0.5, 0.0);
    }
    drawSum(target, program);
}

void LightPass::encodeSum(RenderTarget& target) {
    glBindTextureUnit(0, target.sum_.get());
    draw(target.picture_frame_, target.width(), target.height(), encode_.get(0));
}

void LightPass::smoothEdges(RenderTarget& target) {
    glBindTextureUnit(0, target.lit_.get());
    draw(target.picture_frame_, target.width(), target.height(), edges_.get(0));
}

}  // namespace dollytrack::render
