#include "render/scene_renderer.h"

#include "render/gl/context.h"
#include "render/gl/shader.h"
#include "render/glass_order.h"
#include "render/gpu_scene.h"
#include "render/silhouette_counter.h"
#include "render/sun_shadow.h"
#include "render/view_uniforms.h"

#include <GL/glew.h>

#include <array>
#include <map>
#include <numbers>
#include <optional>

namespace dollytrack::render {
namespace {

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

/// `fourth`: of each cell beside its values; empty: none.
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

/// Where in a pixel its colour is looked at, px from its middle: the sample positions of Direct3D
/// 11. Their mean is the middle, so that pictures and labels lie on each other.
std::vector<Eigen::Vector2d> looksOf(Antialias antialias) {
    std::vector<Eigen::Vector2d> sixteenths;
    if (antialias == Antialias::Samples4) sixteenths = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    if (antialias == Antialias::Samples8) {
        sixteenths = {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    }
    for (Eigen::Vector2d& look : sixteenths) look /= 16.0;
    return sixteenths;
}

void drawPicture(const gl::Framebuffer& frame, int width, int height, const gl::Program& program) {
    glBindFramebuffer(GL_FRAMEBUFFER, frame.get());
    glViewport(0, 0, width, height);
    glUseProgram(program.get());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace

struct SceneRenderer::Impl {
    GpuScene scene;
    LightVolume light;  // without its cells
    gl::Texture ambient;
    gl::Texture slope;
    gl::Texture lamps;
    gl::VertexArray no_vertices;
    gl::Program surface;
    gl::Program mapped;  // surfaces with maps
    gl::Program glass;
    GlassOrder glass_order;
    gl::Program label;
    gl::Program occlusion;
    gl::Program soften;
    gl::Program lighting;
    gl::Program sunny;                    // the same with a sun; made when first needed
    std::optional<SunShadow> sun_shadow;  // where there is a sun
    bool sun_shadow_is_old = true;
    gl::Program edges;
    gl::Program encode;
    SilhouetteCounter silhouettes;
    WholeMaskDrawer whole_masks;
    std::map<int, RestingObject> resting;  // of the objects that were placed elsewhere

    std::vector<GLsizei> counts;  // kept between frames
    std::vector<const void*> offsets;

    Status setLight(const LightVolume& new_light) {
        ambient = uploadVolume(new_light, new_light.ambient);
        slope = uploadVolume(new_light, new_light.slope.empty()
                                            ? std::vector<Eigen::Vector3f>(new_light.ambient.size(),
                                                                           Eigen::Vector3f::Zero())
                                            : new_light.slope);
        lamps = uploadVolume(new_light, new_light.lamps, new_light.own_share);
        light = new_light;
        light.ambient.clear();
        light.slope.clear();
        light.lamps.clear();
        light.own_share.clear();
        sun_shadow.reset();
        sun_shadow_is_old = true;
        if (!light.sun.shines()) return {};
        Result<SunShadow> shadow = SunShadow::create(light.sun);
        if (!shadow) return tl::unexpected(shadow.error());
        sun_shadow.emplace(std::move(*shadow));
        if (sunny.get() != 0) return {};
        Result<gl::Program> linked = gl::linkProgram("picture.vert", "light.frag", "SUN");
        if (!linked) return tl::unexpected(linked.error());
        sunny = std::move(*linked);
        return {};
    }

    void changeLight(const LightVolume& changed) {
        fillVolume(ambient, changed, changed.ambient, {});
        fillVolume(slope, changed, changed.slope, {});
        light = changed;
        light.ambient.clear();
        light.slope.clear();
        light.lamps.clear();
        light.own_share.clear();
        if (sun_shadow) sun_shadow->setIrradiance(light.sun.irradiance);
    }

    [[nodiscard]] const gl::Program& lightProgram() const { return sun_shadow ? sunny : lighting; }

    /// Before anything is drawn that the sun may shine on.
    void updateSunShadow() {
        if (!sun_shadow || !sun_shadow_is_old) return;
        sun_shadow->draw(scene);
        sun_shadow_is_old = false;
    }

    void drawSurfaces(const View& view, RenderTarget& target) {
        begin(target.surfaces_frame_, target.width(), target.height(), 4);
        const std::array<unsigned, 4> no_id{};
        glClearBufferuiv(GL_COLOR, 4, no_id.data());
        const std::vector<bool> visible = objectsInView(scene, view);
        drawOpaque(view, visible, /*lit=*/true);
        tintByGlass(view, visible);
        // Only label depth and label of glass and of holes.
        for (unsigned i = 0; i < 3; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        for (const Batch& batch : scene.batches) {
            if (batch.surface != Surface::Opaque) drawBatch(batch, view, visible, glass, 0);
        }
        for (unsigned i = 0; i < 3; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDisable(GL_DEPTH_TEST);
        glBindVertexArray(no_vertices.get());
    }

    /// Every sheet of glass before the first thing that is none tints the colour behind it.
    void tintByGlass(const View& view, const std::vector<bool>& visible) {
        if (scene.glass.empty()) return;
        for (unsigned i = 1; i < 5; ++i) glColorMaski(i, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glColorMaski(0, GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
        glEnablei(GL_BLEND, 0);
        glBlendFunci(0, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        glDepthMask(GL_FALSE);
        glass_order.visit(scene, view, visible,
                          [&](const Batch& batch, std::uint32_t first, std::uint32_t count) {
                              counts = {static_cast<GLsizei>(count)};
                              offsets = {reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                                  static_cast<std::uintptr_t>(first) * sizeof(std::uint32_t))};
                              bindBatch(batch, glass, 1.0F);
                              drawCounted(view, glass);
                          });
        glDepthMask(GL_TRUE);
        glDisablei(GL_BLEND, 0);
        for (unsigned i = 0; i < 5; ++i) glColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }

    /// What drawSurfaces puts into the images of labels. What may be glass or have holes comes last
    /// there, too.
    void drawLabels(const View& view, RenderTarget& target) {
        begin(target.labels_frame_, target.width(), target.height(), 0);
        const std::array<float, 4> zero{};
        const std::array<unsigned, 4> no_id{};
        glClearBufferfv(GL_COLOR, 3, zero.data());
        glClearBufferuiv(GL_COLOR, 4, no_id.data());
        const std::vector<bool> visible = objectsInView(scene, view);
        for (const bool opaque : {true, false}) {
            for (const Batch& batch : scene.batches) {
                if ((batch.surface == Surface::Opaque) != opaque) continue;
                drawShapes(batch, view, visible, label);
            }
        }
        glDisable(GL_DEPTH_TEST);
        glBindVertexArray(no_vertices.get());
    }

    /// The same surfaces in the same order, so that of two at one depth the same one is on top.
    void drawMaterials(const View& view, const gl::Framebuffer& frame, int width, int height) {
        begin(frame, width, height, 2);
        const std::vector<bool> visible = objectsInView(scene, view);
        drawOpaque(view, visible, /*lit=*/false);
        for (const Batch& batch : scene.batches) {
            if (batch.surface != Surface::Opaque) drawBatch(batch, view, visible, surface, 0);
        }
        glDisable(GL_DEPTH_TEST);
    }

    /// Clears depth and the first so many colour images; depth is reversed: 0 is far.
    void begin(const gl::Framebuffer& frame, int width, int height, int images) {
        glBindFramebuffer(GL_FRAMEBUFFER, frame.get());
        glViewport(0, 0, width, height);
        const std::array<float, 4> zero{};
        for (int i = 0; i < images; ++i) glClearBufferfv(GL_COLOR, i, zero.data());
        glClearBufferfv(GL_DEPTH, 0, zero.data());
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GEQUAL);
        glBindVertexArray(scene.layout.get());
    }

    /// What emission in the surface buffer is a share of.
    [[nodiscard]] float shine() const {
        return std::max({light.lamps_shine, light.outside_shines, 1.0F});
    }

    /// All but glass; of what has holes, what is there. Maps and the light's changes are of
    /// pictures alone.
    void drawOpaque(const View& view, const std::vector<bool>& visible, bool lit) {
        for (const gl::Program* program : {&surface, &mapped}) {
            glProgramUniform2f(program->get(), 13, lit ? light.lamps_shine / shine() : 1.0F,
                               lit ? std::max(light.outside_shines, 1.0F) / shine() : 1.0F);
            glProgramUniform1f(program->get(), 14,
                               lit ? std::sqrt(std::min(light.outside_shines, 1.0F)) : 1.0F);
        }
        for (const Batch& batch : scene.batches) {
            if (batch.surface == Surface::Glass) continue;
            const float alpha_cut = batch.surface == Surface::CutOut ? 0.5F : 0;
            if (lit && batch.maps) {
                bindMaps(*batch.maps);
                drawBatch(batch, view, visible, mapped, alpha_cut);
            } else {
                drawBatch(batch, view, visible, surface, alpha_cut);
            }
        }
    }

    void bindMaps(const BatchMaps& maps) const {
        const std::array<unsigned, 4> textures = {maps.normal, maps.roughness, maps.metallic,
                                                  maps.emission};
        std::array<GLint, 4> there{};
        for (unsigned i = 0; i < textures.size(); ++i) {
            there[i] = textures[i] != 0 ? 1 : 0;
            if (textures[i] != 0) glBindTextureUnit(9 + i, textures[i]);
        }
        glProgramUniform4iv(mapped.get(), 10, 1, there.data());
        glProgramUniform1f(mapped.get(), 11, maps.normal_scale);
        glProgramUniform3fv(mapped.get(), 12, 1, maps.emission_factor.data());
    }

    static void bindBatch(const Batch& batch, const gl::Program& program, float alpha) {
        glProgramUniform1i(program.get(), 4, batch.texture != 0 ? 1 : 0);
        glProgramUniform1f(program.get(), 5, alpha);
        if (batch.texture != 0) glBindTextureUnit(0, batch.texture);
    }

    void drawBatch(const Batch& batch, const View& view, const std::vector<bool>& visible,
                   const gl::Program& program, float alpha) {
        bindBatch(batch, program, alpha);
        drawShapes(batch, view, visible, program);
    }

    void drawShapes(const Batch& batch, const View& view, const std::vector<bool>& visible,
                    const gl::Program& program) {
        counts.clear();
        offsets.clear();
        for (const Piece& piece : batch.pieces) {
            if (!visible[static_cast<std::size_t>(piece.object_id) - 1]) continue;
            counts.push_back(static_cast<GLsizei>(piece.index_count));
            offsets.push_back(reinterpret_cast<const void*>(  // NOLINT: OpenGL's offsets
                static_cast<std::uintptr_t>(piece.first_index) * sizeof(std::uint32_t)));
        }
        if (!counts.empty()) drawCounted(view, program);
    }

    /// What counts and offsets name.
    void drawCounted(const View& view, const gl::Program& program) const {
        glUseProgram(program.get());
        setCamera(program.get(), view);
        const StructureCut structure_cut = view.structure_cut.value_or(StructureCut{});
        const Eigen::Vector4f cut = structure_cut.plane.cast<float>();
        glProgramUniform1f(program.get(), 8, static_cast<float>(structure_cut.keep_below_z));
        glProgramUniform1f(program.get(), 9, static_cast<float>(structure_cut.ceiling_z));
        glProgramUniform4fv(program.get(), 6, 1, cut.data());
        const Eigen::Vector3f eye = view.pose.position.cast<float>();
        glProgramUniform3fv(program.get(), 7, 1, eye.data());
        glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                            static_cast<GLsizei>(counts.size()));
    }

    void drawOcclusion(const View& view, RenderTarget& target) {
        const int width = (target.width() + 1) / 2;
        const int height = (target.height() + 1) / 2;
        glBindTextureUnit(1, target.normal_.get());
        glBindTextureUnit(2, target.surface_.get());
        setRotation(occlusion.get(), 0, cameraFromWorld(view));
        setUnproject(occlusion.get(), 1, view);
        const double scale = view.orthographic ? view.orthographic->px_per_m : view.intrinsics.fx;
        glProgramUniform1f(occlusion.get(), 2, static_cast<float>(scale));
        glProgramUniform1i(occlusion.get(), 3, view.orthographic ? 1 : 0);
        drawPicture(target.occlusion_frame_, width, height, occlusion);
        glBindTextureUnit(3, target.occlusion_.get());
        drawPicture(target.soft_frame_, width, height, soften);
        glBindTextureUnit(3, target.soft_occlusion_.get());
    }

    /// How the looks of a sensor are weighed, see light.frag.
    void setSum(const LightSum& sum) const {
        const unsigned name = lightProgram().get();
        const auto set = [&](int location, double a, double b, double c, double d) {
            glProgramUniform4f(name, location, static_cast<float>(a), static_cast<float>(b),
                               static_cast<float>(c), static_cast<float>(d));
        };
        const Intrinsics& lens = sum.lens;
        set(13, 1.0 / lens.fx, 1.0 / lens.fy, -lens.cx / lens.fx, -lens.cy / lens.fy);
        set(14, sum.distortion.k1, sum.distortion.k2, sum.distortion.p1, sum.distortion.p2);
        glProgramUniform1f(name, 15, static_cast<float>(sum.distortion.k3));
        // In units of the time between looks: small numbers.
        if (sum.s_per_bent > 0.0) {
            set(16, sum.s_per_bent / sum.look_step_s, -sum.after_s / sum.look_step_s,
                0.5 * sum.row_exposure_s / sum.look_step_s, 0.0);
        } else {
            set(16, 0.0, 0.0, 0.5, 0.0);
        }
    }

    void addLight(const View& view, const LightSum& sum, RenderTarget& target) {
        if (sum.first_row >= sum.last_row) return;
        updateSunShadow();
        // What darkens corners looks so far beyond the rows.
        constexpr int kBeyond = 160;
        const int first = std::max(sum.first_row - kBeyond, 0);
        const int count = sum.last_row - first + kBeyond;
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, first, target.width(), count);
        drawSurfaces(view, target);
        glScissor(0, first / 2, target.width(), count / 2 + 1);
        drawOcclusion(view, target);
        glScissor(0, sum.first_row, target.width(), sum.last_row - sum.first_row);
        setSum(sum);
        glProgramUniform1i(lightProgram().get(), 12, 1);
        drawLight(view, target, 1.0F);
        glProgramUniform1i(lightProgram().get(), 12, 0);
        glDisable(GL_SCISSOR_TEST);
    }

    /// The light of one look, added to the others of the pixel when it has a share of them.
    void drawLight(const View& view, RenderTarget& target, float share) {
        const unsigned name = lightProgram().get();
        const Eigen::Vector3f position = view.pose.position.cast<float>();
        const Eigen::Vector3f low = light.low.cast<float>();
        Eigen::Vector3f scale;
        for (int axis = 0; axis < 3; ++axis) {
            scale[axis] = static_cast<float>(1.0 / (light.cell_m * light.cells[axis]));
        }
        setRotation(name, 0, cameraFromWorld(view).transpose());
        setUnproject(name, 1, view);
        glProgramUniform3fv(name, 2, 1, position.data());
        glProgramUniform3fv(name, 3, 1, low.data());
        glProgramUniform3fv(name, 4, 1, scale.data());
        glProgramUniform1f(name, 5, static_cast<float>(light.cell_m));
        glProgramUniform1f(name, 6, light.exposure);
        glProgramUniform3fv(name, 7, 1, light.lamp_color.data());
        Eigen::Vector4f backdrop = Eigen::Vector4f::Zero();
        if (view.backdrop) backdrop << *view.backdrop, 1.0F;
        glProgramUniform4fv(name, 8, 1, backdrop.data());
        glProgramUniform1i(name, 9, view.orthographic ? 1 : 0);
        glProgramUniform1f(name, 10,
                           std::numbers::pi_v<float> * light.exposure * light.dimmed * shine());
        glProgramUniform1f(name, 11, share);
        glProgramUniform3fv(name, 24, 1, light.own_color.data());
        glProgramUniform3fv(name, 17, 1, light.backdrop_factor.data());
        if (sun_shadow) sun_shadow->use(name);
        glBindTextureUnit(0, target.color_.get());
        glBindTextureUnit(4, ambient.get());
        glBindTextureUnit(5, lamps.get());
        glBindTextureUnit(6, slope.get());
        if (share > 0.0F) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
            drawPicture(target.sum_frame_, target.width(), target.height(), lightProgram());
            glDisable(GL_BLEND);
        } else {
            drawPicture(target.lit_frame_, target.width(), target.height(), lightProgram());
        }
        glBindTextureUnit(0, 0);  // the next look draws into it
    }

    void finish(const gl::Texture& image, const gl::Program& program, RenderTarget& target) {
        glBindTextureUnit(0, image.get());
        drawPicture(target.picture_frame_, target.width(), target.height(), program);
    }

    /// The mean of several looks; depth and labels are those of the pixels' middles.
    void drawLooks(const View& view, const std::vector<Eigen::Vector2d>& looks,
                   RenderTarget& target) {
        const std::array<float, 4> zero{};
        target.makeSum();
        glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
        View moved = view;
        for (std::size_t i = 0; i < looks.size(); ++i) {
            moved.intrinsics.cx = view.intrinsics.cx - looks[i].x();
            moved.intrinsics.cy = view.intrinsics.cy - looks[i].y();
            drawSurfaces(moved, target);
            // It is soft: that of one look is good for all.
            if (i == 0) drawOcclusion(moved, target);
            drawLight(moved, target, 1.0F / static_cast<float>(looks.size()));
        }
        drawLabels(view, target);
        finish(target.sum_, encode, target);
    }
};

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

Result<SceneRenderer> SceneRenderer::create(const Scene& scene, const LightVolume& light) {
    auto impl = std::make_unique<Impl>();
    Result<GpuScene> uploaded = uploadScene(scene);
    if (!uploaded) return tl::unexpected(uploaded.error());
    impl->scene = std::move(*uploaded);
    if (Status status = impl->setLight(light); !status) return tl::unexpected(status.error());
    impl->no_vertices = gl::createVertexArray();

    struct Wanted {
        gl::Program* program;
        const char* vertex;
        const char* fragment;
        const char* define = "";
    };
    const std::array<Wanted, 9> programs = {{
        {&impl->surface, "surface.vert", "surface.frag"},
        {&impl->mapped, "surface.vert", "surface.frag", "MAPS"},
        {&impl->glass, "surface.vert", "glass.frag"},
        {&impl->label, "surface.vert", "label.frag"},
        {&impl->occlusion, "picture.vert", "occlusion.frag"},
        {&impl->soften, "picture.vert", "soften.frag"},
        {&impl->lighting, "picture.vert", "light.frag"},
        {&impl->edges, "picture.vert", "smooth_edges.frag"},
        {&impl->encode, "picture.vert", "encode.frag"},
    }};
    for (const auto& [program, vertex, fragment, define] : programs) {
        Result<gl::Program> linked = gl::linkProgram(vertex, fragment, define);
        if (!linked) return tl::unexpected(linked.error());
        *program = std::move(*linked);
    }
    Result<SilhouetteCounter> silhouettes = SilhouetteCounter::create();
    if (!silhouettes) return tl::unexpected(silhouettes.error());
    impl->silhouettes = std::move(*silhouettes);
    Result<WholeMaskDrawer> whole_masks = WholeMaskDrawer::create();
    if (!whole_masks) return tl::unexpected(whole_masks.error());
    impl->whole_masks = std::move(*whole_masks);
    // Depth runs from 1 at the near plane to 0 at infinity.
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (Status status = gl::checkErrors("preparing to draw"); !status) {
        return tl::unexpected(status.error());
    }
    return SceneRenderer(std::move(impl));
}

Status SceneRenderer::setLight(const LightVolume& light) {
    return impl_->setLight(light);
}

void SceneRenderer::changeLight(const LightVolume& light) {
    impl_->changeLight(light);
}

Status SceneRenderer::draw(const View& view, RenderTarget& target) {
    glDisable(GL_CULL_FACE);
    impl_->updateSunShadow();
    if (const auto looks = looksOf(view.antialias); !looks.empty()) {
        impl_->drawLooks(view, looks, target);
    } else {
        impl_->drawSurfaces(view, target);
        impl_->drawOcclusion(view, target);
        impl_->drawLight(view, target, 0.0F);
        impl_->finish(target.lit_, impl_->edges, target);
    }
    return gl::checkErrors("drawing");
}

Status SceneRenderer::beginLight(RenderTarget& target) {
    const std::array<float, 4> zero{};
    target.makeSum();
    glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
    // Looks at some rows see what is around these: nothing of frames before.
    glClearNamedFramebufferfv(target.surfaces_frame_.get(), GL_COLOR, 1, zero.data());
    glClearNamedFramebufferfv(target.surfaces_frame_.get(), GL_COLOR, 2, zero.data());
    glClearNamedFramebufferfv(target.occlusion_frame_.get(), GL_COLOR, 0, zero.data());
    glClearNamedFramebufferfv(target.soft_frame_.get(), GL_COLOR, 0, zero.data());
    return gl::checkErrors("preparing to add light");
}

Status SceneRenderer::addLight(const View& view, const LightSum& sum, RenderTarget& target) {
    glDisable(GL_CULL_FACE);
    impl_->addLight(view, sum, target);
    return gl::checkErrors("adding light");
}

Status SceneRenderer::drawSurfaces(const View& view, SurfaceTarget& target) {
    glDisable(GL_CULL_FACE);
    impl_->drawMaterials(view, target.frame_, target.width(), target.height());
    return gl::checkErrors("drawing surfaces");
}

Result<std::vector<WholeMask>> SceneRenderer::drawWhole(const View& view,
                                                        std::span<const int> object_ids) {
    return impl_->whole_masks.draw(impl_->scene, view, object_ids);
}

void SceneRenderer::place(int object_id, const Eigen::Isometry3d& motion) {
    auto resting = impl_->resting.find(object_id);
    if (resting == impl_->resting.end()) {
        resting = impl_->resting.emplace(object_id, copyOf(impl_->scene, object_id)).first;
    }
    render::place(impl_->scene, resting->second, motion);
    impl_->sun_shadow_is_old = true;
}

std::vector<bool> SceneRenderer::inView(const View& view) const {
    return objectsInView(impl_->scene, view);
}

Status SceneRenderer::startSilhouettes(const View& view, std::span<const int> object_ids,
                                       int beyond) {
    return impl_->silhouettes.start(impl_->scene, view, object_ids, beyond);
}

std::vector<std::uint64_t> SceneRenderer::finishSilhouettes() {
    return impl_->silhouettes.finish();
}

}  // namespace dollytrack::render
