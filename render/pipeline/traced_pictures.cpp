#include "render/pipeline/traced_pictures.h"

#include "render/rig/rig_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dollytrack::render {

struct TracedPictures::Still {
    std::shared_ptr<const RayCaster> rays;
    std::optional<MovedShape> shape;
    std::optional<LightVolume> light;  // of this frame, if light varies
    std::optional<PathTracer> tracer;
};

TracedPictures::TracedPictures(const FrameContext& context, const FrameLights& lights,
                               const PictureParams& params, JobContext job)
    : context_(context),
      lights_(lights),
      denoises_(params.render_mode == RenderMode::Traced),
      samples_(denoises_ ? params.traced_samples : params.reference_samples),
      job_(std::move(job)) {}

float TracedPictures::exposureAt(int frame) const {
    return lights_.exposureAt(context_.contents.sourceFrame(frame));
}

const PathTracer& TracedPictures::tracerAt(int frame) {
    const MovingObjects& moving = context_.moving;
    if (still_ && ((!moving.any() && !lights_.vary()) || frame == prepared_frame_))
        return *still_->tracer;
    const Scene& scene = context_.contents.scene;
    const int source = context_.contents.sourceFrame(frame);
    auto still = std::make_shared<Still>();
    still->rays = moving.raysAt(frame);
    still->shape = moving.wholeShapeAt(frame);
    PathTracerParams params;
    params.exposure = exposureAt(frame);
    if (denoises_) {
        params.end_light = &lights_.volume();
        if (lights_.vary()) {
            LightVolume& light = still->light.emplace(lights_.volumeAt(source));
            light.lamps = lights_.volume().lamps;
            light.scene_lamp_share = lights_.volume().scene_lamp_share;
            params.end_light = &light;
        }
    }
    still->tracer.emplace(scene, *still->rays, lights_.rigAt(source), params,
                          still->shape ? &*still->shape : nullptr);
    still_ = std::move(still);
    prepared_frame_ = frame;
    return *still_->tracer;
}

PictureLayers TracedPictures::finished(const LayeredImage& image, int frame) const {
    const float scale = exposureAt(frame) * std::numbers::pi_v<float>;
    return denoises_ ? denoised(image, scale) : averaged(image, scale);
}

Result<PictureLayers> TracedPictures::take(const View& view, int frame) {
    LayeredImage image;
    Status status = tracerAt(frame).add(view, samples_, image, job_);
    if (!status) return tl::unexpected(status.error());
    return finished(image, frame);
}

Result<PictureLayers> TracedPictures::takePart(const View& view, int frame, int number, int parts) {
    const int samples = std::max(2, (samples_ + parts - 1) / parts);
    LayeredImage image;
    image.first_sample = number * samples;
    Status status = tracerAt(frame).add(view, samples, image, job_);
    if (!status) return tl::unexpected(status.error());
    return finished(image, frame);
}

Result<PictureLayers> TracedPictures::take(const LensModel& lens, const Pose& pose, int frame) {
    const double near_m = context_.contents.camera.near_m;
    if (!lens.measuresRange()) return take(viewThrough(lens, pose, near_m), frame);
    const auto rayThrough = [&](double x, double y) -> std::optional<ViewRay> {
        // A pixel is in the image if its centre is; then all its samples get light.
        const auto centre = lens.ray(std::floor(x) + 0.5, std::floor(y) + 0.5);
        if (!centre) return std::nullopt;
        const LensRay ray = lens.ray(x, y).value_or(*centre);
        return ViewRay{pose.toWorld(ray.origin), pose.rotation * ray.direction};
    };
    LayeredImage image;
    image.width = lens.width();
    image.height = lens.height();
    Status status = tracerAt(frame).add(rayThrough, near_m, samples_, image, job_);
    if (!status) return tl::unexpected(status.error());
    return finished(image, frame);
}

}  // namespace dollytrack::render
