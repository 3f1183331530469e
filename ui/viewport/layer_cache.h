#pragma once

#include "render/overlays/overlay_buffers.h"
#include "render/overlays/overlay_renderer.h"
#include "ui/viewport/render_thread.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace dollytrack::ui {

/// Overlays on the GPU, by pointer.
struct LayerCache {
    struct Entry {
        std::shared_ptr<const render::Overlay> overlay;  // keeps the address from being reused
        render::OverlayBuffers buffers;
    };
    std::vector<Entry> entries;

    /// Drops overlays that are no longer drawn and uploads new ones.
    std::vector<render::OverlayLayer> prepare(const std::vector<ViewLayer>& layers) {
        std::erase_if(entries, [&](const Entry& entry) {
            return std::ranges::find(layers, entry.overlay, &ViewLayer::overlay) == layers.end();
        });
        for (const ViewLayer& layer : layers) {
            if (std::ranges::find(entries, layer.overlay, &Entry::overlay) != entries.end()) {
                continue;
            }
            entries.push_back({layer.overlay, {}});
            entries.back().buffers.upload(*layer.overlay);
        }
        std::vector<render::OverlayLayer> prepared;
        for (const ViewLayer& layer : layers) {
            const auto entry = std::ranges::find(entries, layer.overlay, &Entry::overlay);
            prepared.push_back({&entry->buffers, layer.opacity, layer.hidden_opacity});
        }
        return prepared;
    }
};

}  // namespace dollytrack::ui
