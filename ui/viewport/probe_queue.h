#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/render_target.h"
#include "render/pictures/picture_quality.h"
#include "render/view/view.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::render {
class SceneRenderer;
}

namespace dollytrack::ui {

/// Small images of many views ("probes"), which RenderThread draws one by one and classifies while
/// nothing else is waiting. All functions but draw() and release() require its mutex to be locked.
class ProbeQueue {
  public:
    using Views = std::vector<render::View>;

    /// Replaces the views, which are compared by pointer; null: none are wanted. Returns whether
    /// they differ.
    bool request(std::shared_ptr<const Views> views);
    /// Forgets the classes, which belong to another scene.
    void restart();
    /// False: the scene cannot be drawn with its textures.
    void setDrawable(bool drawable) { drawable_ = drawable; }

    /// Whether views are wanted and can be drawn.
    [[nodiscard]] bool isActive() const { return drawable_ && views_ != nullptr; }
    /// Whether any of them is not drawn yet.
    [[nodiscard]] bool isWaiting() const { return isActive() && classes_.size() < views_->size(); }
    /// Of the first views, as far as they are drawn.
    [[nodiscard]] const std::vector<render::PictureQuality>& classes() const { return classes_; }

    struct Probe {
        std::shared_ptr<const Views> views;
        std::size_t index = 0;
    };
    /// The next view to draw. Requires isWaiting().
    [[nodiscard]] Probe next() const { return {views_, classes_.size()}; }
    /// Draws and classifies a view. To be called on the render thread. Errors: those of
    /// RenderTarget::create(), SceneRenderer::draw() and OpenGL.
    [[nodiscard]] Result<render::PictureQuality> draw(const render::View& view,
                                                      render::SceneRenderer& renderer);
    /// Takes the class of a probe, unless it is no longer the next one; after an error, no views
    /// are wanted. Returns whether the window should show this.
    bool finish(const Probe& probe, const Result<render::PictureQuality>& quality);

    /// Releases the memory on the GPU, on the render thread.
    void release() { target_.reset(); }

  private:
    std::shared_ptr<const Views> views_;
    std::vector<render::PictureQuality> classes_;
    bool drawable_ = true;
    std::optional<render::RenderTarget> target_;  // used by the render thread only
};

}  // namespace dollytrack::ui
