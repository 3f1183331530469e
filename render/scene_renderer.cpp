#include "render/scene_renderer.h"

#include "render/gl/context.h"
#include "render/gpu_scene.h"
#include "render/light_pass.h"
#include "render/silhouette_counter.h"
#include "render/surface_pass.h"
#include "render/view_uniforms.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <map>

namespace dollytrack::render {
namespace {

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

}  // namespace

struct SceneRenderer::Impl {
    GpuScene scene;
    SurfacePass surfaces;
    LightPass light;
    SilhouetteCounter silhouettes;
    WholeMaskDrawer whole_masks;
    std::map<int, RestingObject> resting;  // of the objects that were placed elsewhere

    Status setLight(const LightVolume& volume) {
        surfaces.setLight(volume);
        return light.setLight(volume);
    }

    Status prepare(const View& view) {
        glDisable(GL_CULL_FACE);
        if (Status status = surfaces.prepare(scene, view); !status) return status;
        return light.prepare(scene);
    }

    /// @param labels  whether to draw these in the same pass
    void drawPicture(const View& view, bool labels, RenderTarget& target) {
        if (labels) {
            surfaces.drawSurfaces(scene, view, target);
        } else {
            surfaces.drawLook(scene, view, target);
        }
        light.drawOcclusion(scene, view, target);
        light.drawPicture(view, surfaces.shine(), target);
        light.smoothEdges(target);
    }

    /// The mean of several looks.
    void drawLooks(const View& view, const std::vector<Eigen::Vector2d>& looks,
                   RenderTarget& target) {
        const std::array<float, 4> zero{};
        target.makeSum();
        glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
        View moved = view;
        for (std::size_t i = 0; i < looks.size(); ++i) {
            moved.intrinsics.cx = view.intrinsics.cx - looks[i].x();
            moved.intrinsics.cy = view.intrinsics.cy - looks[i].y();
            surfaces.drawLook(scene, moved, target);
            // It is soft: that of one look is good for all.
            if (i == 0) light.drawOcclusion(scene, moved, target);
            light.addLook(moved, surfaces.shine(), 1.0F / static_cast<float>(looks.size()), target);
        }
        light.encodeSum(target);
    }

    void drawLabels(const View& view, RenderTarget& target, SurfaceTarget* materials) {
        if (materials != nullptr) {
            surfaces.drawMaterials(scene, view, *materials);
        } else {
            surfaces.drawLabels(scene, view, target);
        }
    }

    void addLight(const View& view, const LightSum& sum, RenderTarget& target) {
        // What darkens corners looks so far beyond the rows.
        constexpr int kBeyond = 160;
        const int first = std::max(sum.first_row - kBeyond, 0);
        const int count = sum.last_row - first + kBeyond;
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, first, target.width(), count);
        surfaces.drawLook(scene, view, target);
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
    Result<SilhouetteCounter> silhouettes = SilhouetteCounter::create();
    if (!silhouettes) return tl::unexpected(silhouettes.error());
    Result<WholeMaskDrawer> whole_masks = WholeMaskDrawer::create();
    if (!whole_masks) return tl::unexpected(whole_masks.error());
    auto impl = std::make_unique<Impl>(Impl{std::move(*uploaded),
                                            std::move(*surfaces),
                                            {},
                                            std::move(*silhouettes),
                                            std::move(*whole_masks),
                                            {}});
    if (Status status = impl->setLight(light); !status) return tl::unexpected(status.error());
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
    impl_->surfaces.setLight(light);
    impl_->light.changeLight(light);
}

Status SceneRenderer::draw(const View& view, RenderTarget& target, SurfaceTarget* surfaces) {
    if (Status status = impl_->prepare(view); !status) return status;
    if (const auto looks = looksOf(view.antialias); !looks.empty()) {
        impl_->drawLooks(view, looks, target);
        impl_->drawLabels(view, target, surfaces);
    } else {
        impl_->drawPicture(view, surfaces == nullptr, target);
        if (surfaces != nullptr) impl_->drawLabels(view, target, surfaces);
    }
    return gl::checkErrors("drawing");
}

Status SceneRenderer::drawLabels(const View& view, RenderTarget& target, SurfaceTarget* surfaces) {
    glDisable(GL_CULL_FACE);
    if (Status status = impl_->surfaces.prepare(impl_->scene, view); !status) return status;
    impl_->drawLabels(view, target, surfaces);
    return gl::checkErrors("drawing labels");
}

Status SceneRenderer::beginLight(RenderTarget& target) {
    const std::array<float, 4> zero{};
    target.makeSum();
    glClearNamedFramebufferfv(target.sum_frame_.get(), GL_COLOR, 0, zero.data());
    // Looks at some rows see what is around these: nothing of frames before.
    glClearNamedFramebufferfv(target.looks_frame_.get(), GL_COLOR, 1, zero.data());
    glClearNamedFramebufferfv(target.looks_frame_.get(), GL_COLOR, 2, zero.data());
    glClearNamedFramebufferfv(target.occlusion_frame_.get(), GL_COLOR, 0, zero.data());
    glClearNamedFramebufferfv(target.soft_frame_.get(), GL_COLOR, 0, zero.data());
    return gl::checkErrors("preparing to add light");
}

Status SceneRenderer::addLight(const View& view, const LightSum& sum, RenderTarget& target) {
    if (sum.first_row >= sum.last_row) return {};
    if (Status status = impl_->prepare(view); !status) return status;
    impl_->addLight(view, sum, target);
    return gl::checkErrors("adding light");
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
    impl_->light.forgetShadow();
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
