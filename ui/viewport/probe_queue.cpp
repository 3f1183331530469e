#include "ui/viewport/probe_queue.h"

#include "render/draw/scene_renderer.h"
#include "render/gl/context.h"
#include "ui/viewport/view_canvas.h"

#include <cstdint>
#include <utility>

namespace dollytrack::ui {

bool ProbeQueue::request(std::shared_ptr<const Views> views) {
    if (views_ == views) return false;
    views_ = std::move(views);
    classes_.clear();
    return true;
}

void ProbeQueue::restart() {
    classes_.clear();
    drawable_ = true;
}

Result<render::PictureQuality> ProbeQueue::draw(const render::View& view,
                                                render::SceneRenderer& renderer) {
    Status status = fitTarget(target_, view.intrinsics);
    if (status) status = renderer.draw(view, *target_);
    std::vector<std::uint8_t> rgb;
    if (status) {
        target_->readRgb(rgb);
        status = gl::checkErrors("drawing a small image");
    }
    if (!status) return tl::unexpected(std::move(status.error()));
    return render::pictureQuality(target_->width(), target_->height(), rgb);
}

bool ProbeQueue::finish(const Probe& probe, const Result<render::PictureQuality>& quality) {
    constexpr std::size_t kShowsEvery = 16;  // probes
    if (!quality) {
        views_.reset();
        return true;
    }
    if (views_ != probe.views || classes_.size() != probe.index) return false;
    classes_.push_back(*quality);
    return classes_.size() == views_->size() || probe.index % kShowsEvery == 0;
}

}  // namespace dollytrack::ui
