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

Result<PictureLayers> TracedPictures::take(const View& view, int frame, int first_sample,
                                           int samples) {
    PathTracer::Picture picture = pictureAt(frame);
    picture.width = view.intrinsics.width;
    picture.height = view.intrinsics.height;
    picture.first_sample = first_sample;
    picture.samples = samples;
    const auto ray = [&](double x, double y) { return view.rayThrough(x, y); };
    return tracerAt(frame).take(ray, view.near_m, picture, job_);
}

Result<PictureLayers> TracedPictures::take(const View& view, int frame) {
    return take(view, frame, 0, samples_);
}

Result<PictureLayers> TracedPictures::takePart(const View& view, int frame, int number, int parts) {
    int samples = (samples_ + parts - 1) / parts;
    if (denoises_) samples = std::max(2, samples + samples % 2);
    return take(view, frame, number * samples, samples);
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
    PathTracer::Picture picture = pictureAt(frame);
    picture.width = lens.width();
    picture.height = lens.height();
    return tracerAt(frame).take(rayThrough, near_m, picture, job_);
}

PathTracer::Picture TracedPictures::pictureAt(int frame) const {
    PathTracer::Picture picture;
    picture.samples = samples_;
    picture.scale = exposureAt(frame) * std::numbers::pi_v<float>;
    picture.denoises = denoises_;
    return picture;
}

}  // namespace dollytrack::render
