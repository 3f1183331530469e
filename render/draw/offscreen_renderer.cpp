#include "render/draw/offscreen_renderer.h"

namespace dollytrack::render {

Result<OffscreenRenderer> OffscreenRenderer::create(std::unique_ptr<gl::Context> context,
                                                    const Scene& scene, const LightVolume& light,
                                                    int width, int height) {
    OffscreenRenderer result;
    result.context_ = std::move(context);
    Result<SceneRenderer> renderer = SceneRenderer::create(scene, light);
    if (!renderer) return tl::unexpected(renderer.error());
    result.scene_ = std::make_unique<SceneRenderer>(std::move(*renderer));
    Result<RenderTarget> target = RenderTarget::create(width, height);
    if (!target) return tl::unexpected(target.error());
    result.target_ = std::make_unique<RenderTarget>(std::move(*target));
    return result;
}

Result<FrameRecord> OffscreenRenderer::render(const View& view) {
    if (Status status = context_->makeCurrent(); !status) return tl::unexpected(status.error());
    if (Status status = scene_->draw(view, *target_); !status) {
        return tl::unexpected(status.error());
    }
    FrameRecord record;
    record.pose = view.pose;
    record.width = target_->width();
    record.height = target_->height();
    target_->readRgb(record.rgb);
    target_->readDepth(record.depth_m);
    target_->readIds(record.instance);
    return record;
}

}  // namespace dollytrack::render
