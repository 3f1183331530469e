#include "ui/viewport/render_thread.h"

#include "engine/scene/scene.h"
#include "render/draw/scene_renderer.h"
#include "render/gl/picture_texture.h"
#include "render/light/traced_reflections.h"
#include "render/overlays/overlay_renderer.h"
#include "ui/viewport/adaptive_resolution.h"
#include "ui/viewport/false_color.h"
#include "ui/viewport/image_relay.h"
#include "ui/viewport/layer_cache.h"
#include "ui/viewport/plain_light.h"
#include "ui/viewport/probe_queue.h"
#include "ui/viewport/view_canvas.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace dollytrack::ui {
namespace {

struct PreviewRequest {
    render::View view;
    int frame = -1;
    double time_s = 0.0;
    Modality modality = Modality::Rgb;
};

}  // namespace

struct RenderThread::Impl {
    std::unique_ptr<gl::Context> context;
    std::function<void()> wake;

    mutable std::mutex mutex;
    std::condition_variable arrived;
    std::optional<SceneRequest> next_scene;
    std::optional<ViewRequest> next_view;
    std::optional<PreviewRequest> next_preview;
    ProbeQueue probes;
    ImageRelay<ViewImage> views;
    ImageRelay<PreviewImage> previews;
    std::string error;
    std::string renderer_name;
    bool stopping = false;
    bool busy = false;
    bool final_light = false;

    // Used by the render thread only.
    std::shared_ptr<const Scene> scene;
    std::uint64_t geometry = 0;
    std::shared_ptr<const render::LightVolume> lit_by;
    std::shared_ptr<const RayCaster> rays;
    std::optional<render::TracedReflections> reflections;  // set if any surface reflects
    std::optional<render::SceneRenderer> renderer;
    std::vector<MovedObject> moved;  // how `renderer` has placed objects
    int anisotropy = 0;
    bool plain = false;        // the renderer has no textures yet: they follow the first image
    bool stays_plain = false;  // they did not fit into memory
    ViewCanvas whole;
    ViewCanvas coarse;
    std::optional<render::RenderTarget> preview_target;
    std::optional<render::OverlayRenderer> overlays;
    LayerCache layers;
    std::uint64_t serial = 0;
    AdaptiveResolution resolution;
    std::optional<render::View> last_view;
    std::optional<ViewRequest> owed;  // drawn coarsely, full image due; guarded by `mutex`

    // Used by the window's thread only: the last requests, to skip identical ones.
    std::optional<ViewRequest> asked_view;
    std::optional<PreviewRequest> asked_preview;
    gl::PictureTexture view_picture;
    gl::PictureTexture preview_picture;

    std::thread thread;

    void loop();
    void release();
    Status loadScene(SceneRequest request);
    /// Without textures if they do not fit into memory; this also returns an error.
    Status createRenderer(render::Detail detail);
    /// Gives a new renderer its reflections and texture filtering.
    void finishRenderer();
    /// Adds the textures and simplified meshes to a plain scene, unless another scene or light is
    /// waiting.
    Status completeScene();
    /// Places objects where the request wants them; returns whether any is placed anew.
    bool placeObjects(const std::vector<MovedObject>& wanted);
    Status drawView(ViewRequest request);
    /// Returns whether the scene was drawn again, rather than only the overlays.
    Result<bool> drawOn(ViewCanvas& canvas, const ViewRequest& request, int shrink);
    Status drawPreview(const PreviewRequest& request);
    /// Whether a probe can be drawn now: with all textures, and with every object where the scene
    /// has it. Requires a locked mutex.
    [[nodiscard]] bool probeIsDue() const {
        return final_light && !plain && moved.empty() && !next_scene && probes.isWaiting();
    }
    /// Draws and classifies the next probe, if one is due.
    void drawProbe();
    void say(const Status& status) {
        if (status) return;
        const std::lock_guard lock(mutex);
        error = status.error().message;
    }
};

void RenderThread::Impl::loop() {
    Status current = context->makeCurrent();
    if (current) current = gl::loadFunctions();
    say(current);
    if (current) {
        const std::lock_guard lock(mutex);
        renderer_name = gl::rendererName();
    }
    std::unique_lock lock(mutex);
    while (true) {
        busy = false;
        const auto news = [this] { return stopping || next_scene || next_view || next_preview; };
        bool rests = false;
        if (owed) {
            rests = !arrived.wait_until(lock, resolution.restsAt(), news);
        } else {
            arrived.wait(lock, [&] { return news() || probeIsDue(); });
        }
        if (stopping) break;
        if (!rests && !news()) {
            lock.unlock();
            drawProbe();
            lock.lock();
            continue;
        }
        busy = true;
        auto scene_request = std::exchange(next_scene, std::nullopt);
        auto view_request = std::exchange(rests ? owed : next_view, std::nullopt);
        if (scene_request || view_request) owed.reset();
        auto preview_request = std::exchange(next_preview, std::nullopt);
        lock.unlock();
        if (current) {
            if (scene_request) say(loadScene(std::move(*scene_request)));
            if (view_request && renderer) say(drawView(*view_request));
            if (plain && (view_request || preview_request)) {
                wake();
                say(completeScene());
                const std::lock_guard guard(mutex);
                owed = std::move(view_request);
            }
            if (preview_request && renderer) say(drawPreview(*preview_request));
        }
        wake();
        lock.lock();
        probes.setDrawable(current && (!scene || (renderer && !stays_plain)));
    }
    lock.unlock();
    release();
}

void RenderThread::Impl::release() {
    renderer.reset();
    whole = {};
    coarse = {};
    preview_target.reset();
    probes.release();
    layers.entries.clear();
    overlays.reset();
    context.reset();
}

Status RenderThread::Impl::loadScene(SceneRequest request) {
    const bool same = renderer && request.scene && request.geometry == geometry;
    if (!same || request.light_is_coarse) {
        const std::lock_guard lock(mutex);
        final_light = false;
    }
    scene = request.scene;
    geometry = request.geometry;
    whole.drawn.reset();
    coarse.drawn.reset();
    if (!same) resolution.forget();
    if (renderer) renderer->setReflections(nullptr);
    reflections.reset();
    rays = request.rays;
    if (!scene) {
        renderer.reset();
        lit_by.reset();
        plain = stays_plain = false;
        return {};
    }
    const bool relit = request.light != lit_by;
    lit_by = request.light;
    anisotropy = request.anisotropy;
    Status status;
    if (!same) {
        plain = !stays_plain && (plain || !renderer);  // an edited scene keeps its look
        const bool textured = !plain && !stays_plain;
        status = createRenderer(textured ? render::Detail::FullAndCoarse : render::Detail::Plain);
    } else if (relit) {
        status = renderer->setLight(lit_by ? *lit_by : plainLight(*scene));
    }
    if (!renderer || (same && !status)) return status;
    if (rays && lit_by && render::TracedReflections::any(*scene, Reflections::All)) {
        reflections.emplace(*scene, *rays, *lit_by);
    }
    finishRenderer();
    const std::lock_guard lock(mutex);
    final_light = lit_by != nullptr && !request.light_is_coarse;
    return status;
}

Status RenderThread::Impl::createRenderer(render::Detail detail) {
    renderer.reset();  // released first: both may not fit into memory
    moved.clear();
    Result<render::SceneRenderer> made =
        render::SceneRenderer::create(*scene, lit_by ? *lit_by : plainLight(*scene), detail);
    if (made) {
        renderer.emplace(std::move(*made));
        return {};
    }
    Error failure = std::move(made.error());
    if (detail == render::Detail::Plain) {
        plain = false;
    } else {
        stays_plain = true;
        if (createRenderer(render::Detail::Plain)) {
            failure.message += "; the viewport shows the scene without textures";
        }
    }
    return tl::unexpected(std::move(failure));
}

void RenderThread::Impl::finishRenderer() {
    renderer->setReflections(reflections ? &*reflections : nullptr);
    renderer->setAnisotropy(anisotropy);
}

Status RenderThread::Impl::completeScene() {
    {
        const std::lock_guard lock(mutex);
        if (next_scene) return {};
    }
    plain = false;
    whole.drawn.reset();
    coarse.drawn.reset();
    resolution.forget();
    Status status = createRenderer(render::Detail::FullAndCoarse);
    if (!renderer) {
        const std::lock_guard lock(mutex);
        final_light = false;
        return status;
    }
    finishRenderer();
    return status;
}

bool RenderThread::Impl::placeObjects(const std::vector<MovedObject>& wanted) {
    if (moved == wanted) return false;
    for (const MovedObject& one : moved) {
        renderer->place(one.object_id, Eigen::Isometry3d::Identity());
    }
    for (const MovedObject& one : wanted) renderer->place(one.object_id, one.motion);
    moved = wanted;
    whole.drawn.reset();
    coarse.drawn.reset();
    return true;
}

Status RenderThread::Impl::drawView(ViewRequest request) {
    const auto begin = std::chrono::steady_clock::now();
    if (!overlays) {
        Result<render::OverlayRenderer> made = render::OverlayRenderer::create();
        if (!made) return tl::unexpected(std::move(made.error()));
        overlays.emplace(std::move(*made));
    }
    const bool placed = placeObjects(request.moved);
    const bool same = !placed && last_view && samePicture(*last_view, request.view);
    const int shrink = resolution.shrinkFor(same, begin);
    const Result<bool> drawn = drawOn(shrink == 1 ? whole : coarse, request, shrink);
    if (!drawn) return tl::unexpected(drawn.error());
    last_view = request.view;
    const auto end = std::chrono::steady_clock::now();
    ViewImage& image = views.images[views.drawn];
    image.geometry = geometry;
    image.view = request.view;
    image.serial = ++serial;
    image.milliseconds = std::chrono::duration<double, std::milli>(end - begin).count();
    resolution.drew(shrink, same, *drawn, image.milliseconds, end);
    const std::lock_guard lock(mutex);
    if (shrink > 1) owed = std::move(request);
    std::swap(views.drawn, views.finished);
    views.news = true;
    return {};
}

Result<bool> RenderThread::Impl::drawOn(ViewCanvas& on, const ViewRequest& request, int shrink) {
    render::View view = shrunk(request.view, shrink);
    view.coarse = shrink > 1 || plain;
    const Intrinsics& size = view.intrinsics;
    const bool draws = !on.drawn || !samePicture(*on.drawn, view);
    if (draws) {
        on.drawn.reset();
        Status status = on.fit(size);
        if (status) status = renderer->draw(view, *on.target);
        if (!status) return tl::unexpected(std::move(status.error()));
        on.drawn = view;
    }
    const std::vector<render::OverlayLayer> prepared = layers.prepare(request.layers);
    if (Status status =
            overlays->draw(prepared, view, *on.target, *on.canvas, request.pixel_scale / shrink);
        !status) {
        return tl::unexpected(std::move(status.error()));
    }
    ViewImage& image = views.images[views.drawn];
    on.target->readDepth(image.depth_m);
    on.target->readIds(image.ids);
    on.canvas->readRgba(image.rgba);
    image.width = size.width;
    image.height = size.height;
    return draws;
}

Status RenderThread::Impl::drawPreview(const PreviewRequest& request) {
    if (Status status = fitTarget(preview_target, request.view.intrinsics); !status) return status;
    if (Status status = renderer->draw(request.view, *preview_target); !status) return status;
    PreviewImage& image = previews.images[previews.drawn];
    render::FrameRecord& record = image.record;
    record.index = request.frame;
    record.time_s = request.time_s;
    record.pose = request.view.pose;
    record.width = preview_target->width();
    record.height = preview_target->height();
    preview_target->readRgb(record.rgb);
    preview_target->readDepth(record.depth_m);
    preview_target->readIds(record.instance);
    record.labelClasses(*scene);
    image.rgba = falseColor(record, request.view, request.modality);
    image.width = record.width;
    image.height = record.height;
    image.modality = request.modality;
    image.frame = request.frame;
    image.view = request.view;
    image.serial = ++serial;
    const std::lock_guard lock(mutex);
    std::swap(previews.drawn, previews.finished);
    previews.news = true;
    return gl::checkErrors("drawing the preview");
}

void RenderThread::Impl::drawProbe() {
    std::unique_lock lock(mutex);
    if (!probeIsDue()) return;
    const ProbeQueue::Probe probe = probes.next();
    lock.unlock();
    const Result<render::PictureQuality> quality =
        renderer ? probes.draw((*probe.views)[probe.index], *renderer)
                 : fail(ErrorCode::NoOpenGl, "There is no scene to draw.");
    lock.lock();
    if (!quality) error = quality.error().message;
    // The image shows another scene than the one that may have arrived meanwhile.
    if (quality && next_scene) return;
    const bool shows = probes.finish(probe, quality);
    lock.unlock();
    if (shows) wake();
}

RenderThread::RenderThread(std::unique_ptr<gl::Context> context, std::function<void()> wake)
    : impl_(std::make_unique<Impl>()) {
    impl_->context = std::move(context);
    impl_->wake = std::move(wake);
    impl_->thread = std::thread([this] { impl_->loop(); });
}

RenderThread::~RenderThread() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stopping = true;
    }
    impl_->arrived.notify_one();
    impl_->thread.join();
}

void RenderThread::setScene(SceneRequest request) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->next_scene = std::move(request);
        // Pending requests belong to the previous scene.
        impl_->next_view.reset();
        impl_->next_preview.reset();
        impl_->probes.restart();
    }
    impl_->asked_view.reset();
    impl_->asked_preview.reset();
    impl_->arrived.notify_one();
}

void RenderThread::requestView(ViewRequest request) {
    const std::optional<ViewRequest>& last = impl_->asked_view;
    if (last && samePicture(last->view, request.view) && last->layers == request.layers &&
        last->pixel_scale == request.pixel_scale && last->moved == request.moved) {
        return;
    }
    impl_->asked_view = request;
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->next_view = std::move(request);
    }
    impl_->arrived.notify_one();
}

void RenderThread::requestPreview(const render::View& view, int frame, double time_s,
                                  Modality modality) {
    const std::optional<PreviewRequest>& last = impl_->asked_preview;
    if (last && samePicture(last->view, view) && last->frame == frame &&
        last->modality == modality) {
        return;
    }
    impl_->asked_preview = PreviewRequest{view, frame, time_s, modality};
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->next_preview = impl_->asked_preview;
    }
    impl_->arrived.notify_one();
}

void RenderThread::requestProbes(std::shared_ptr<const Views> views) {
    {
        const std::lock_guard lock(impl_->mutex);
        if (!impl_->probes.request(std::move(views))) return;
    }
    impl_->arrived.notify_one();
}

std::vector<render::PictureQuality> RenderThread::probes() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->probes.classes();
}

std::size_t RenderThread::probesDone() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->probes.classes().size();
}

bool RenderThread::probing() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->probes.isActive();
}

void RenderThread::takeNews() {
    impl_->views.takeNews(impl_->mutex, impl_->view_picture);
    impl_->previews.takeNews(impl_->mutex, impl_->preview_picture);
}

const ViewImage& RenderThread::view() const {
    return impl_->views.newest();
}

const PreviewImage& RenderThread::preview() const {
    return impl_->previews.newest();
}

bool RenderThread::finalLight() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->final_light && !impl_->next_scene;
}

bool RenderThread::busy() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->busy || impl_->next_scene || impl_->next_view || impl_->next_preview ||
           impl_->owed;
}

std::string RenderThread::takeError() {
    const std::lock_guard lock(impl_->mutex);
    return std::exchange(impl_->error, {});
}

std::string RenderThread::rendererName() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->renderer_name;
}

}  // namespace dollytrack::ui
