#pragma once

#include "engine/core/result.h"
#include "render/frames/frame_record.h"
#include "render/gl/context.h"
#include "render/light/light_volume.h"
#include "render/overlays/overlay.h"
#include "render/pictures/picture_quality.h"
#include "render/view/view.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dollytrack {
class RayCaster;
struct Scene;
}  // namespace dollytrack

namespace dollytrack::ui {

/// An overlay on the viewport's image. Layers are cached by pointer: the same pointer must mean the
/// same content, which is uploaded to the GPU once.
struct ViewLayer {
    std::shared_ptr<const render::Overlay> overlay;
    float opacity = 1.0F;
    float hidden_opacity = 0.22F;  // opacity behind a surface of the scene
    bool operator==(const ViewLayer&) const = default;
};

/// An object that is drawn elsewhere than in the scene: p = motion * p_scene, world frame.
struct MovedObject {
    int object_id = 0;
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    bool operator==(const MovedObject& other) const {
        return object_id == other.object_id && motion.matrix() == other.motion.matrix();
    }
};

/// A viewport image to be drawn. A newer request replaces a waiting one. If only the layers differ
/// from the previous image, the scene is not drawn again.
struct ViewRequest {
    render::View view;
    std::vector<ViewLayer> layers;  // drawn in this order
    double pixel_scale = 1.0;       // scale of widths given in pixels
    std::vector<MovedObject> moved = {};
};

/// A finished viewport image.
struct ViewImage {
    unsigned texture = 0;  // in the window's OpenGL context, row 0 at the top
    render::View view;     // the requested view; its size is the pane's
    int width = 0;         // of the data below; less than the view's if drawn coarsely
    int height = 0;
    std::vector<std::uint8_t> rgba;
    std::vector<float> depth_m;
    std::vector<std::uint16_t> ids;
    double milliseconds = 0.0;
    std::uint64_t geometry = 0;  // SceneRequest::geometry
    std::uint64_t serial = 0;    // increases with every image; 0: none yet
};

/// The modality shown in the preview.
enum class Modality { Rgb, Depth, Instance, Semantic, Normal };

/// A frame rendered as export would render it, except for light that varies by frame, and one of
/// its modalities as a texture.
struct PreviewImage {
    unsigned texture = 0;  // in the window's OpenGL context, row 0 at the top
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
    Modality modality = Modality::Rgb;
    int frame = -1;
    render::View view;  // the view used for drawing
    render::FrameRecord record;
    std::uint64_t serial = 0;
};

/// The scene to draw from now on; a null scene draws nothing.
struct SceneRequest {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const RayCaster> rays;             // ray caster for mirrors; may be null
    std::shared_ptr<const render::LightVolume> light;  // null: uniform light
    int anisotropy = 0;                                // see SceneRenderer::setAnisotropy()
    std::uint64_t geometry = 0;    // identifies the geometry; uploaded only if it changes
    bool light_is_coarse = false;  // a finer light follows, see RenderThread::finalLight()
};

/// Renders the viewport and the preview on a thread with its own OpenGL context, so that large
/// scenes and their uploads never block the window. The first image of a scene shows plain
/// geometry; textures and simplified meshes follow unless they do not fit into memory. If drawing
/// is too slow to follow the mouse, the view is drawn at lower resolution while it moves and at
/// full resolution when it rests. The two contexts share no objects, because Mesa's software driver
/// occasionally crashes when two contexts use the same object; images are passed as pixels.
class RenderThread {
  public:
    /// `context` must not be current on any thread. The render thread calls `wake` whenever a new
    /// image or error is available.
    RenderThread(std::unique_ptr<gl::Context> context, std::function<void()> wake);
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    void setScene(SceneRequest request);
    void requestView(ViewRequest request);
    void requestPreview(const render::View& view, int frame, double time_s, Modality modality);

    using Views = std::vector<render::View>;
    /// Draws these views one by one while nothing else is waiting, and classifies their images
    /// (pictureQuality()): in the final light, after the scene's first image, and not while an
    /// object is drawn elsewhere (ViewRequest::moved). Replaces an earlier request; null: no views.
    /// Views are compared by pointer.
    void requestProbes(std::shared_ptr<const Views> views);
    /// The classes of the views requested last, in their order, as far as they are drawn.
    [[nodiscard]] std::vector<render::PictureQuality> probes() const;
    /// How many of them are drawn.
    [[nodiscard]] std::size_t probesDone() const;
    /// False if no views are wanted, or if they cannot be drawn (see takeError()).
    [[nodiscard]] bool probing() const;

    /// Takes the finished images and uploads them to textures. To be called once per window frame
    /// before drawing: earlier images and their textures become invalid. Only on the window's
    /// thread, with its context current.
    void takeNews();
    /// The newest images, unchanged until takeNews().
    [[nodiscard]] const ViewImage& view() const;
    [[nodiscard]] const PreviewImage& preview() const;

    /// Whether the scene is on the GPU with its computed light.
    [[nodiscard]] bool finalLight() const;
    /// Whether anything remains to be drawn, including the full-resolution image of a resting view.
    [[nodiscard]] bool busy() const;
    /// The latest error since the last call; empty if there was none.
    std::string takeError();
    [[nodiscard]] std::string rendererName() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::ui
