#pragma once

#include "engine/core/result.h"
#include "render/draw/view.h"
#include "render/frames/frame_record.h"
#include "render/gl/context.h"
#include "render/light/light_volume.h"
#include "render/overlays/overlay.h"

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

/// An overlay over the viewport's picture. The same pointer means the same content: it is sent to
/// the card once.
struct ViewLayer {
    std::shared_ptr<const render::Overlay> overlay;
    float opacity = 1.0F;
    float hidden_opacity = 0.22F;  // what is left of that behind a surface of the scene
    bool operator==(const ViewLayer&) const = default;
};

/// A picture of the viewport that is to be drawn. Newer requests replace those that wait. Where
/// only the layers differ from the picture before, the scene is not drawn again.
struct ViewRequest {
    render::View view;
    std::vector<ViewLayer> layers;  // drawn in this order
    double pixel_scale = 1.0;       // of widths given in pixels
};

/// A finished picture of the viewport.
struct ViewImage {
    unsigned texture = 0;  // the window's, row 0 at the top
    render::View view;     // as asked for; its pixels are the pane's
    int width = 0;  // of what follows: less than the view's while it moves and drawing is slow
    int height = 0;
    std::vector<std::uint8_t> rgba;
    std::vector<float> depth_m;
    std::vector<std::uint16_t> ids;
    double milliseconds = 0.0;
    std::uint64_t geometry = 0;  // as setScene() was told
    std::uint64_t serial = 0;    // rises with every picture; 0: none yet
};

/// What the preview shows of a frame.
enum class Modality { Rgb, Depth, Instance, Semantic, Normal };

/// A frame exactly as export would make it, but for light that varies by frame, and one of its
/// modalities as a texture.
struct PreviewImage {
    unsigned texture = 0;  // the window's, row 0 at the top
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
    Modality modality = Modality::Rgb;
    int frame = -1;
    render::View view;  // with which it was drawn
    render::FrameRecord record;
    std::uint64_t serial = 0;
};

/// What is to be drawn from now on; no scene: nothing.
struct SceneRequest {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const RayCaster> rays;             // of it, for what mirrors show
    std::shared_ptr<const render::LightVolume> light;  // null: plain light, until this is there
    int anisotropy = 0;                                // see SceneRenderer::setAnisotropy()
    std::uint64_t geometry = 0;  // a scene of the same number as before is not uploaded again
};

/// Draws on a thread with an OpenGL context of its own, so that neither a large scene nor its
/// upload ever holds up the window. Where a picture takes too long to follow the mouse, the view is
/// drawn with fewer pixels while it moves, and whole when it rests. The two threads share nothing:
/// Mesa's software driver crashes now and then where one context asks for what another is done
/// with. Pictures travel as pixels.
class RenderThread {
  public:
    /// `context` is not current anywhere; `wake` is called from the thread when there is news.
    RenderThread(std::unique_ptr<gl::Context> context, std::function<void()> wake);
    ~RenderThread();
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    void setScene(SceneRequest request);
    void requestView(ViewRequest request);
    void requestPreview(const render::View& view, int frame, double time_s, Modality modality);

    /// Takes over what is finished, once a frame and before anything is drawn from it: pictures
    /// shown until now, and their textures, are gone afterwards. Only on the window's thread, with
    /// its context current.
    void takeNews();
    /// The newest pictures taken over, the same until takeNews().
    [[nodiscard]] const ViewImage& view() const;
    [[nodiscard]] const PreviewImage& preview() const;

    /// Whether the lit scene is on the card, so that pictures mean something.
    [[nodiscard]] bool ready() const;
    [[nodiscard]] bool finalLight() const;
    /// Also while the view rests and is yet to be drawn whole.
    [[nodiscard]] bool busy() const;
    /// What went wrong since the last call; empty when nothing did.
    std::string takeError();
    [[nodiscard]] std::string rendererName() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::ui
