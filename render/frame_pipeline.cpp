#include "render/frame_pipeline.h"

#include "render/light_rig.h"
#include "render/light_volume.h"

#include <algorithm>
#include <utility>

namespace dollytrack::render {

FramePipeline::FramePipeline(const DatasetContents& contents, const CaptureRules& rules,
                             std::map<int, std::vector<ObjectView>> restored)
    : contents_(contents), counter_(contents.scene, rules), restored_(std::move(restored)) {
    for (int i = 0; i < frameCount(); ++i) {
        if (restored_.count(i) == 0) missing_.push_back(i);
    }
}

Status FramePipeline::prepare(const RayCaster& rays, const std::vector<Eigen::AlignedBox3d>& rooms,
                              const JobContext& job) {
    if (missing_.empty()) return {};
    const Scene& scene = contents_.scene;
    const LightVolume light =
        bakeLightVolume(scene, rays, makeLightRig(scene, rays, rooms), {}, job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
    Result<SceneRenderer> renderer = SceneRenderer::create(scene, light);
    if (!renderer) return tl::unexpected(renderer.error());
    renderer_.emplace(std::move(*renderer));
    for (auto& target : targets_) {
        Result<RenderTarget> created =
            RenderTarget::create(contents_.camera.width_px, contents_.camera.height_px);
        if (!created) return tl::unexpected(created.error());
        target.emplace(std::move(*created));
    }
    return {};
}

View FramePipeline::viewOf(int index) const {
    return makeView(contents_.camera,
                    contents_.frames[static_cast<std::size_t>(index)].camera.pose);
}

FrameRecord FramePipeline::emptyRecord(int index) const {
    const TrajectoryFrame& camera = contents_.frames[static_cast<std::size_t>(index)].camera;
    FrameRecord record;
    record.index = index;
    record.time_s = camera.time_s;
    record.pose = camera.pose;
    record.width = contents_.camera.width_px;
    record.height = contents_.camera.height_px;
    return record;
}

Status FramePipeline::drawNext(FrameWriter& writer, FrameLedger& ledger) {
    while (started_ < std::min(drawn_ + targets_.size(), missing_.size())) {
        RenderTarget& target = *targets_[started_ % targets_.size()];
        const View view = viewOf(missing_[started_++]);
        if (Status status = renderer_->draw(view, target); !status) return status;
    }
    RenderTarget& target = *targets_[drawn_ % targets_.size()];
    FrameRecord record = emptyRecord(missing_[drawn_]);
    target.readIds(record.instance);
    if (Status status = countLast(ledger); !status) return status;
    // What silhouettes a frame needs depends on the frames before it, so these must be counted in
    // their order, wherever they come from.
    countRestored(record.index);
    const std::vector<int> wanted = counter_.addFrame(record);
    if (Status status = renderer_->startSilhouettes(viewOf(record.index), wanted); !status) {
        return status;
    }
    silhouettes_of_ = record.index;
    if (contains(contents_.modalities, "rgb")) target.readRgb(record.rgb);
    if (contains(contents_.modalities, "depth")) target.readDepth(record.depth_m);
    ++drawn_;
    return writer.write(std::move(record));
}

Status FramePipeline::countLast(FrameLedger& ledger) {
    if (silhouettes_of_ < 0) return {};
    counter_.addSilhouettes(renderer_->finishSilhouettes());
    const std::span<const ObjectView> views = counter_.lastViews();
    return ledger.addCounted(std::exchange(silhouettes_of_, -1), {views.begin(), views.end()},
                             counter_.wellShown());
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
