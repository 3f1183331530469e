#include "render/pipeline/frame_pipeline.h"

#include "render/draw/crack_filling.h"

#include <algorithm>
#include <utility>

namespace dollytrack::render {

namespace {

/// Images that are drawn after the frame's labels are read back.
constexpr unsigned kNeedsLater = kNeedsRight | kNeedsRig | kNeedsSensorLight;

/// A light grid that takes hardly any time, for depth, labels and all else that shows no light.
constexpr LightVolumeParams kUnlit = {.max_cells = 64, .rays_per_cell = 1, .bounces = 1};

}  // namespace

FramePipeline::FramePipeline(const FrameContext& context, const CaptureRules& rules, unsigned needs,
                             const PictureParams& picture,
                             std::map<int, std::vector<ObjectView>> restored)
    : context_(context),
      contents_(context.contents),
      needs_(needs),
      picture_(picture),
      counter_(context.contents.scene, rules),
      restored_(std::move(restored)) {
    for (int i = 0; i < frameCount(); ++i) {
        if (restored_.count(i) == 0) missing_.push_back(i);
    }
}

Status FramePipeline::prepare(const RayCaster& rays, const std::vector<Eigen::AlignedBox3d>& rooms,
                              const ObjectPaths* objects, const JobContext& job) {
    if (missing_.empty()) return {};
    const Scene& scene = contents_.scene;
    LightParams wanted = contents_.light;
    LightVolumeParams grid;
    if (!needs(kNeedsLight)) {
        wanted.light_varies = LightVaries::Scene;
        grid = kUnlit;
    }
    lights_.emplace(scene, rays, rooms, wanted, grid, job);
    LightVolume light = lights_->volume();
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
    if (picture_.render_mode != RenderMode::Fast) {
        traced_.emplace(context_, *lights_, picture_, job);
    }
    if (traced_) light.sun = {};  // the rasteriser then draws labels only
    Result<SceneRenderer> renderer = SceneRenderer::create(scene, light);
    if (!renderer) return tl::unexpected(renderer.error());
    renderer_.emplace(std::move(*renderer));
    renderer_->setAnisotropy(picture_.anisotropy);
    reflections_.emplace(context_, *lights_, picture_.reflections);
    for (auto& target : targets_) {
        Result<RenderTarget> created =
            RenderTarget::create(contents_.camera.width_px, contents_.camera.height_px);
        if (!created) return tl::unexpected(created.error());
        target.emplace(std::move(*created));
    }
    if (needs(kNeedsRgb | kNeedsLater) && !traced_) {
        Status status = renderer_->reserve(contents_.camera.width_px, contents_.camera.height_px,
                                           picture_.antialias);
        if (!status) return status;
    }
    if (needs(kNeedsRight)) {
        Result<RenderTarget> created =
            RenderTarget::create(contents_.camera.width_px, contents_.camera.height_px);
        if (!created) return tl::unexpected(created.error());
        right_.emplace(std::move(*created));
    }
    if (needs(kNeedsSensorLight)) {
        Result<SensorPictures> created =
            SensorPictures::create(context_, *objects, picture_.reflections);
        if (!created) return tl::unexpected(created.error());
        sensor_.emplace(std::move(*created));
    }
    for (std::size_t i = 0; i < targets_.size() && needs(kNeedsSurfaces); ++i) {
        Result<SurfaceTarget> created = SurfaceTarget::create(*targets_[i]);
        if (!created) return tl::unexpected(created.error());
        surfaces_[i].emplace(std::move(*created));
    }
    if (needs(kNeedsRig)) {
        rig_.emplace(contents_.camera.near_m, picture_);
        if (traced_) return {};
        for (const RigCamera& camera : contents_.rig) {
            if (Status status = rig_->prepare(LensModel(camera)); !status) return status;
        }
    }
    return {};
}

void FramePipeline::placeObjects(int index) {
    for (const ObjectMotion& motion : context_.moving.motions()) {
        renderer_->place(motion.object_id, motion.by_frame[index]);
    }
}

void FramePipeline::lightFrame(int index) {
    if (traced_) return;
    if (needs(kNeedsRgb | kNeedsLater)) renderer_->setReflections(reflections_->at(index));
    if (!lights_->vary() || lit_for_ == index) return;
    renderer_->changeLight(lights_->volumeAt(contents_.sourceFrame(index)));
    lit_for_ = index;
}

Status FramePipeline::drawMore(const View& view, FrameRecord& record) {
    if (needs(kNeedsSurfaces)) {
        const SurfaceTarget& surfaces = *surfaces_[drawn_ % surfaces_.size()];
        surfaces.readNormals(record.normals_in_world);
        surfaces.readAlbedo(record.albedo);
    }
    if (needs(kNeedsRight)) {
        View right = view;
        right.pose = rightOf(view.pose, contents_.stereo_baseline_m);
        right.antialias = picture_.antialias;
        Status status =
            traced_ ? renderer_->drawLabels(right, *right_) : renderer_->draw(right, *right_);
        if (!status) return status;
        if (!traced_) right_->readRgb(record.rgb_right);
        right_->readDrawnDepth(record.depth_right_m);
        fillRightCracks(context_.moving, right, record);
        if (traced_) {
            Result<PictureLayers> picture = traced_->take(right, record.index);
            if (!picture) return tl::unexpected(picture.error());
            record.rgb_right = developed(*picture);
        }
    }
    return needs(kNeedsRig) ? drawRig(record) : Status();
}

Status FramePipeline::drawRig(FrameRecord& record) {
    for (const RigCamera& camera : contents_.rig) {
        const LensModel lens(camera);
        const Pose pose = poseOnRig(camera, record.pose);
        std::vector<std::uint8_t>& rgb = record.rig_rgb.emplace_back();
        if (traced_) {
            Result<PictureLayers> picture = traced_->take(lens, pose, record.index);
            if (!picture) return tl::unexpected(picture.error());
            rgb = developed(*picture);
            continue;
        }
        Status status =
            rig_->draw(lens, pose, *renderer_, *context_.moving.raysAt(record.index), rgb);
        if (!status) return status;
    }
    return {};
}

/// Draws all objects' silhouettes at once; the counter gets those in `wanted`.
Result<std::vector<std::uint64_t>> FramePipeline::drawInstances(const View& view,
                                                                FrameRecord& record,
                                                                const std::vector<int>& wanted) {
    const std::vector<int> visible = visibleObjects(contents_.scene, record);
    std::vector<int> all = visible;
    for (const int id : wanted) {
        if (!std::ranges::binary_search(visible, id)) all.push_back(id);
    }
    if (Status status = renderer_->startSilhouettes(view, all); !status) {
        return tl::unexpected(status.error());
    }
    const std::vector<std::uint64_t> counts = renderer_->finishSilhouettes();
    const auto countOf = [&](int id) { return counts[std::ranges::find(all, id) - all.begin()]; };
    Result<std::vector<RenderedAmodalMask>> masks = renderer_->drawWhole(view, visible);
    if (!masks) return tl::unexpected(masks.error());
    record.whole = std::move(*masks);
    for (const RenderedAmodalMask& mask : record.whole) {
        record.whole_px.push_back(countOf(mask.object_id));
    }
    std::vector<std::uint64_t> for_counter;
    for (const int id : wanted) for_counter.push_back(countOf(id));
    return for_counter;
}

Status FramePipeline::count(int index, std::span<const std::uint64_t> silhouettes_px,
                            FrameLedger* ledger) {
    counter_.addSilhouettes(silhouettes_px, !quality_ || *quality_ == PictureQuality::Usable);
    const std::span<const ObjectView> views = counter_.lastViews();
    return ledger->addCounted(index, {views.begin(), views.end()}, counter_.wellShown(), quality_);
}

View FramePipeline::viewOf(int index) const {
    View view = makeView(contents_.camera, contents_.frames[index].camera.pose);
    view.reflections = picture_.reflections;
    return view;
}

FrameRecord FramePipeline::emptyRecord(int index) const {
    const TrajectoryFrame& camera = contents_.frames[index].camera;
    FrameRecord record;
    record.index = index;
    record.time_s = camera.time_s;
    record.pose = camera.pose;
    record.width = contents_.camera.width_px;
    record.height = contents_.camera.height_px;
    return record;
}

Status FramePipeline::startNext() {
    const std::size_t place = started_ % targets_.size();
    SurfaceTarget* surfaces = needs(kNeedsSurfaces) ? &*surfaces_[place] : nullptr;
    placeObjects(missing_[started_]);
    lightFrame(missing_[started_]);
    View view = viewOf(missing_[started_++]);
    if (!needs(kNeedsRgb) || traced_) {  // path-traced images are drawn later
        return renderer_->drawLabels(view, *targets_[place], surfaces);
    }
    view.antialias = picture_.antialias;
    return renderer_->draw(view, *targets_[place], surfaces);
}

Status FramePipeline::drawNext(const TakeFrame& take, FrameLedger* ledger) {
    while (started_ < std::min(drawn_ + targets_.size(), missing_.size())) {
        if (Status status = startNext(); !status) return status;
    }
    RenderTarget& target = *targets_[drawn_ % targets_.size()];
    FrameRecord record = emptyRecord(missing_[drawn_]);
    target.readIds(record.instance);
    const View view = viewOf(record.index);
    std::vector<float> depth_m;
    target.readDrawnDepth(depth_m);
    const std::vector<CrackPixel> cracks =
        findCracks(view, record.instance, depth_m, *context_.moving.raysAt(record.index));
    // Ids must be filled before counting.
    fillCracks(cracks, contents_.scene, context_.moving, view, record);
    if (Status status = countLast(ledger); !status) return status;
    // Which silhouettes a frame needs depends on earlier frames, so all frames are counted in
    // order, whether drawn or restored.
    countRestored(record.index);
    std::vector<int> wanted;
    if (ledger != nullptr) wanted = counter_.addFrame(record);
    placeObjects(record.index);
    if (needs(kNeedsLater)) lightFrame(record.index);
    std::vector<std::uint64_t> silhouettes_px;
    if (needs(kNeedsWhole)) {
        Result<std::vector<std::uint64_t>> counts = drawInstances(view, record, wanted);
        if (!counts) return tl::unexpected(counts.error());
        silhouettes_px = std::move(*counts);
    } else {
        if (Status status = renderer_->startSilhouettes(view, wanted); !status) return status;
        if (ledger != nullptr) silhouettes_of_ = record.index;
    }
    if (needs(kNeedsRgb) && !traced_) target.readRgb(record.rgb);
    const bool focuses = needs(kNeedsSensorLight) && focusesByDepth(contents_.sensor);
    if (needs(kNeedsDepth) || focuses) record.depth_m = std::move(depth_m);
    if (Status status = drawMore(view, record); !status) return status;
    fillCracks(cracks, contents_.scene, context_.moving, view, record);
    if (traced_ && needs(kNeedsRgb | kNeedsLayers)) {
        Result<PictureLayers> picture = traced_->take(view, record.index);
        if (!picture) return tl::unexpected(picture.error());
        if (needs(kNeedsRgb)) record.rgb = developed(*picture);
        if (needs(kNeedsLayers)) record.layers = std::move(*picture);
    }
    quality_.reset();
    if (!record.rgb.empty()) quality_ = pictureQuality(record.width, record.height, record.rgb);
    if (needs(kNeedsWhole) && ledger != nullptr) {
        if (Status status = count(record.index, silhouettes_px, ledger); !status) return status;
    }
    if (needs(kNeedsSensorLight)) {
        Status status =
            sensor_->take(record, *renderer_, traced_ ? &*traced_ : nullptr, record.sensor_light);
        if (!status) return status;
        // Later steps may draw this frame again or other frames at their own times.
        placeObjects(record.index);
    }
    ++drawn_;
    return take(std::move(record));
}

Status FramePipeline::countLast(FrameLedger* ledger) {
    if (silhouettes_of_ < 0) return {};
    return count(std::exchange(silhouettes_of_, -1), renderer_->finishSilhouettes(), ledger);
}

void FramePipeline::countRestored(int before) {
    for (; restored_until_ < before; ++restored_until_) {
        const auto views = restored_.find(restored_until_);
        if (views != restored_.end()) counter_.addCounted(views->second);
    }
}

const std::vector<ObjectView>& FramePipeline::views() {
    countRestored(frameCount());
    return counter_.views();
}

}  // namespace dollytrack::render
