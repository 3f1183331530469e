#include "render/draw/scene_renderer.h"

#include "render/amodal/silhouette_counter.h"
#include "render/draw/passes/gpu_scene.h"
#include "render/draw/passes/light_pass.h"
#include "render/draw/passes/multisample_buffer.h"
#include "render/draw/passes/occlusion_culling.h"
#include "render/draw/passes/surface_pass.h"
#include "render/draw/passes/view_uniforms.h"
#include "render/gl/context.h"
#include "render/light/traced_reflections.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <map>

namespace dollytrack::render {
namespace {

/// Image shifts, px, for each pass with four samples per pixel. The second pass's samples lie
/// between those of the first.
std::span<const Eigen::Vector2d> shiftsOf(Antialias antialias) {
    static const std::array<Eigen::Vector2d, 1> once = {Eigen::Vector2d::Zero()};
    static const std::array<Eigen::Vector2d, 2> twice = {Eigen::Vector2d(1, -1) / 16.0,
                                                         Eigen::Vector2d(-1, 1) / 16.0};
    if (antialias == Antialias::Samples4) return once;
    if (antialias == Antialias::Samples8) return twice;
    return {};
}

/// A view whose pixel centres are shifted by an offset, px.
View shiftedBy(const Eigen::Vector2d& offset, const View& view) {
    View moved = view;
    moved.intrinsics.cx -= offset.x();
    moved.intrinsics.cy -= offset.y();
    return moved;
}

}  // namespace

struct SceneRenderer::Impl {
    GpuScene scene;
    SurfacePass surfaces;
    OcclusionCulling culling;
    LightPass light;
    std::map<std::pair<int, int>, MultisampleBuffer> multisample_buffers;  // by width and height
    SilhouetteCounter silhouettes;
    AmodalMaskRenderer amodal_masks;
    std::map<int, RestingObject> resting;  // uploaded state of the objects that were moved
    const TracedReflections* reflections = nullptr;
    std::vector<Eigen::Vector4f> reflected;  // reused between images

    Status setLight(const LightVolume& volume) {
        surfaces.setLight(volume);
        return light.setLight(volume);
    }

    /// @param first_row, last_row  image rows that will be shaded
    Status prepare(const View& view, int first_row, int last_row) {
        if (reflections != nullptr && reflections->trace(view, first_row, last_row, reflected)) {
            light.setReflections(reflected, view, first_row, last_row);
        } else {
            light.blurReflections();
        }
        glDisable(GL_CULL_FACE);
        if (Status status = surfaces.prepare(scene, view); !status) return status;
        return light.prepare(scene);
    }

    /// @param labels  whether to draw labels in the same pass
    void drawPicture(const View& view, bool labels, RenderTarget& target) {
        if (labels) {
            surfaces.drawSurfaces(scene, view, target);
        } else {
            surfaces.drawShading(scene, view, target);
        }
        if (view.coarse) {
            light.skipOcclusion(target);
        } else {
            light.drawOcclusion(scene, view, target);
        }
        light.drawPicture(view, surfaces.shine(), target);
        light.smoothEdges(target);
    }

    Result<MultisampleBuffer*> multisampleBufferOf(int width, int height) {
        const auto known = multisample_buffers.find({width, height});
        if (known != multisample_buffers.end()) return &known->second;
        Result<MultisampleBuffer> made = MultisampleBuffer::create(width, height);
        if (!made) return tl::unexpected(made.error());
        return &multisample_buffers.emplace(std::pair(width, height), std::move(*made))
                    .first->second;
    }

    /// Draws the mean of several samples per pixel.
    Status drawMultisampled(const View& view, std::span<const Eigen::Vector2d> shifts,
                            RenderTarget& target) {
        const Result<MultisampleBuffer*> images =
            multisampleBufferOf(target.width(), target.height());
        if (!images) return tl::unexpected(images.error());
        const std::array<float, 4> zero{};
        target.makeSum();
        glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
        const float share =
            1.0F / static_cast<float>(MultisampleBuffer::kSamplesPerPixel * shifts.size());
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            const View shifted = shiftedBy(shifts[i], view);
            surfaces.drawMultisampled(scene, shifted, culling, **images);
            // Ambient occlusion is blurred, so one sample's result serves all.
            if (i == 0) light.drawOcclusion(scene, shifted, **images, target);
            light.addSamples(shifted, surfaces.shine(), share, **images, target);
        }
        light.encodeSum(target);
        return {};
    }

    /// @param cull  whether multisampled passes of the same view follow
    void drawLabels(const View& view, bool cull, RenderTarget& target, SurfaceTarget* materials) {
        OcclusionCulling* asked = cull ? &culling : nullptr;
        if (materials != nullptr) {
            surfaces.drawMaterials(scene, view, asked, *materials);
        } else {
            surfaces.drawLabels(scene, view, asked, target);
        }
    }

    void addLight(const View& view, const LightSum& sum, RenderTarget& target) {
        // px: ambient occlusion samples this far beyond the shaded rows.
        constexpr int kBeyond = 160;
        const int first = std::max(sum.first_row - kBeyond, 0);
        const int count = sum.last_row - first + kBeyond;
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, first, target.width(), count);
        surfaces.drawShading(scene, view, target);
        glScissor(0, first / 2, target.width(), count / 2 + 1);
        light.drawOcclusion(scene, view, target);
        glScissor(0, sum.first_row, target.width(), sum.last_row - sum.first_row);
        light.addLight(view, surfaces.shine(), sum, target);
        glDisable(GL_SCISSOR_TEST);
    }
};

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::~SceneRenderer() = default;
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;

Result<SceneRenderer> SceneRenderer::create(const Scene& scene, const LightVolume& light,
                                            Detail detail) {
    Result<GpuScene> uploaded = uploadScene(scene, detail);
    if (!uploaded) return tl::unexpected(uploaded.error());
    Result<SurfacePass> surfaces = SurfacePass::create();
    if (!surfaces) return tl::unexpected(surfaces.error());
    Result<OcclusionCulling> culling = OcclusionCulling::create();
    if (!culling) return tl::unexpected(culling.error());
    Result<SilhouetteCounter> silhouettes = SilhouetteCounter::create();
    if (!silhouettes) return tl::unexpected(silhouettes.error());
    Result<AmodalMaskRenderer> amodal_masks = AmodalMaskRenderer::create();
    if (!amodal_masks) return tl::unexpected(amodal_masks.error());
    auto impl = std::make_unique<Impl>(Impl{std::move(*uploaded),
                                            std::move(*surfaces),
                                            std::move(*culling),
                                            {},
                                            {},
                                            std::move(*silhouettes),
                                            std::move(*amodal_masks),
                                            {},
                                            nullptr,
                                            {}});
    if (Status status = impl->setLight(light); !status) return tl::unexpected(status.error());
    render::setAnisotropy(impl->scene, 0);
    // Reversed depth: 1 at the near plane, 0 at infinity.
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
    impl_->surfaces.setLight(light);
    impl_->light.changeLight(light);
}

Status SceneRenderer::draw(const View& view, RenderTarget& target, SurfaceTarget* surfaces) {
    if (Status status = impl_->prepare(view, 0, target.height()); !status) return status;
    if (const auto shifts = shiftsOf(view.antialias); !shifts.empty()) {
        impl_->drawLabels(view, true, target, surfaces);
        if (Status status = impl_->drawMultisampled(view, shifts, target); !status) return status;
    } else {
        impl_->drawPicture(view, surfaces == nullptr, target);
        if (surfaces != nullptr) impl_->drawLabels(view, false, target, surfaces);
    }
    return gl::checkErrors("drawing");
}

Status SceneRenderer::drawLabels(const View& view, RenderTarget& target, SurfaceTarget* surfaces) {
    glDisable(GL_CULL_FACE);
    if (Status status = impl_->surfaces.prepare(impl_->scene, view); !status) return status;
    impl_->drawLabels(view, false, target, surfaces);
    return gl::checkErrors("drawing labels");
}

Status SceneRenderer::beginLight(RenderTarget& target) {
    const std::array<float, 4> zero{};
    target.makeSum();
    glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
    // Later passes on part of the rows sample the rows around them; clear what earlier frames left
    // there.
    glClearNamedFramebufferfv(target.shading_frame_.get(), GL_COLOR, 1, zero.data());
    glClearNamedFramebufferfv(target.shading_frame_.get(), GL_COLOR, 2, zero.data());
    glClearNamedFramebufferfv(target.occlusion_frame_.get(), GL_COLOR, 0, zero.data());
    glClearNamedFramebufferfv(target.soft_frame_.get(), GL_COLOR, 0, zero.data());
    return gl::checkErrors("preparing to add light");
}

Status SceneRenderer::addLight(const View& view, const LightSum& sum, RenderTarget& target) {
    if (sum.first_row >= sum.last_row) return {};
    if (Status status = impl_->prepare(view, sum.first_row, sum.last_row); !status) return status;
    impl_->addLight(view, sum, target);
    return gl::checkErrors("adding light");
}

Result<std::vector<RenderedAmodalMask>> SceneRenderer::drawWhole(const View& view,
                                                                 std::span<const int> object_ids) {
    return impl_->amodal_masks.draw(impl_->scene, view, object_ids);
}

void SceneRenderer::place(int object_id, const Eigen::Isometry3d& motion) {
    auto resting = impl_->resting.find(object_id);
    if (resting == impl_->resting.end()) {
        resting = impl_->resting.emplace(object_id, copyOf(impl_->scene, object_id)).first;
    }
    render::place(impl_->scene, resting->second, motion);
    impl_->light.forgetShadow();
}

Status SceneRenderer::reserve(int width, int height, Antialias antialias) {
    if (shiftsOf(antialias).empty()) return {};
    const Result<MultisampleBuffer*> images = impl_->multisampleBufferOf(width, height);
    return images ? Status() : tl::unexpected(images.error());
}

void SceneRenderer::setReflections(const TracedReflections* reflections) {
    impl_->reflections = reflections;
}

void SceneRenderer::setAnisotropy(int samples) {
    render::setAnisotropy(impl_->scene, samples);
}

int SceneRenderer::hiddenByOthers() const {
    return impl_->culling.hidden();
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
