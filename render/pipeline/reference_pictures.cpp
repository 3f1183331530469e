#include "render/pipeline/reference_pictures.h"

#include "render/rig/rig_pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace dollytrack::render {

struct ReferencePictures::Still {
    std::shared_ptr<const RayCaster> rays;
    std::optional<MovedShape> shape;
    std::optional<PathTracer> tracer;
};

ReferencePictures::ReferencePictures(const FrameContext& context, const FrameLights& lights,
                                     int samples, JobContext job)
    : context_(context), lights_(lights), samples_(samples), job_(std::move(job)) {}

float ReferencePictures::exposureAt(int frame) const {
    return lights_.exposureAt(context_.contents.sourceFrame(frame));
}

const PathTracer& ReferencePictures::tracerAt(int frame) {
    const MovingObjects& moving = context_.moving;
    if (still_ && ((!moving.any() && !lights_.vary()) || frame == prepared_frame_))
        return *still_->tracer;
    const Scene& scene = context_.contents.scene;
    auto still = std::make_shared<Still>();
    still->rays = moving.raysAt(frame);
    still->shape = moving.wholeShapeAt(frame);
    PathTracerParams params;
    params.exposure = exposureAt(frame);
    still->tracer.emplace(scene, *still->rays, lights_.rigAt(context_.contents.sourceFrame(frame)),
                          params, still->shape ? &*still->shape : nullptr);
    still_ = std::move(still);
    prepared_frame_ = frame;
    return *still_->tracer;
}

Status ReferencePictures::take(const View& view, int frame, std::vector<std::uint8_t>& rgb) {
    RadianceImage image;
    if (Status status = tracerAt(frame).add(view, samples_, image, job_); !status) return status;
    rgb = developed(image, exposureAt(frame));
    return {};
}

Status ReferencePictures::takePart(const View& view, int frame, int number, int parts,
                                   std::vector<Eigen::Vector3f>& light) {
    const int samples = (samples_ + parts - 1) / parts;
    RadianceImage image;
    image.samples = number * samples;
    if (Status status = tracerAt(frame).add(view, samples, image, job_); !status) return status;
    light = std::move(image.sum);
    const float scale = exposureAt(frame) * std::numbers::pi_v<float> / static_cast<float>(samples);
    for (Eigen::Vector3f& one : light) one *= scale;
    return {};
}

Status ReferencePictures::take(const LensModel& lens, const Pose& pose, int frame,
                               std::vector<std::uint8_t>& rgb) {
    const double near_m = context_.contents.camera.near_m;
    if (!lens.measuresRange()) return take(viewThrough(lens, pose, near_m), frame, rgb);
    const auto rayThrough = [&](double x, double y) -> std::optional<ViewRay> {
        // A pixel is in the image if its centre is; then all its samples get light.
        const auto centre = lens.ray(std::floor(x) + 0.5, std::floor(y) + 0.5);
        if (!centre) return std::nullopt;
        const LensRay ray = lens.ray(x, y).value_or(*centre);
        return ViewRay{pose.toWorld(ray.origin), pose.rotation * ray.direction};
    };
    RadianceImage image;
    image.width = lens.width();
    image.height = lens.height();
    Status status = tracerAt(frame).add(rayThrough, near_m, samples_, image, job_);
    if (status) rgb = developed(image, exposureAt(frame));
    return status;
}

}  // namespace dollytrack::render
