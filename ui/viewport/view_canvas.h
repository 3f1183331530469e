#pragma once

#include "engine/core/result.h"
#include "render/draw/passes/render_target.h"
#include "render/overlays/overlay_renderer.h"
#include "render/view/view.h"

#include <optional>
#include <utility>

namespace dollytrack::ui {

/// Makes a render target of an image's size; keeps one that has this size. Errors: those of
/// RenderTarget::create().
inline Status fitTarget(std::optional<render::RenderTarget>& target, const Intrinsics& image) {
    if (target && target->width() == image.width && target->height() == image.height) return {};
    target.reset();
    Result<render::RenderTarget> made = render::RenderTarget::create(image.width, image.height);
    if (!made) return tl::unexpected(std::move(made.error()));
    target.emplace(std::move(*made));
    return {};
}

/// Render targets of the viewport at one resolution.
struct ViewCanvas {
    std::optional<render::RenderTarget> target;
    std::optional<render::OverlayCanvas> canvas;
    std::optional<render::View> drawn;  // the view in `target`, if it is valid

    /// Makes both targets for an image of this size. Errors: those of RenderTarget::create() and
    /// OverlayCanvas::create().
    Status fit(const Intrinsics& image) {
        if (Status status = fitTarget(target, image); !status) return status;
        if (canvas && canvas->width() == image.width && canvas->height() == image.height) return {};
        Result<render::OverlayCanvas> made =
            render::OverlayCanvas::create(image.width, image.height);
        if (!made) return tl::unexpected(std::move(made.error()));
        canvas.emplace(std::move(*made));
        return {};
    }
};

}  // namespace dollytrack::ui
