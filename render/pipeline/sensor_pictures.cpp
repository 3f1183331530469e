#include "render/pipeline/sensor_pictures.h"

#include "engine/math/quantile.h"

#include <algorithm>
#include <tuple>

namespace dollytrack::render {

std::optional<double> focusDepthOf(const SensorParams& params, const Scene& scene,
                                   const FrameRecord& frame) {
    if (params.focus_m > 0.0) return params.focus_m;
    std::vector<float> of_targets;
    std::vector<float> of_all;
    for (int y = frame.height / 4; y < frame.height - frame.height / 4; ++y) {
        for (int x = frame.width / 4; x < frame.width - frame.width / 4; ++x) {
            const auto i = static_cast<std::size_t>(y) * frame.width + static_cast<std::size_t>(x);
            if (!(frame.depth_m[i] > 0.0F)) continue;
            of_all.push_back(frame.depth_m[i]);
            const int id = frame.instance[i];
            if (id > 0 && scene.object(id).role == Role::Target) {
                of_targets.push_back(frame.depth_m[i]);
            }
        }
    }
    std::vector<float>& depths = of_targets.empty() ? of_all : of_targets;
    if (depths.empty()) return std::nullopt;
    return upperMedian(std::move(depths));
}

Result<SensorPictures> SensorPictures::create(const FrameContext& context,
                                              const ObjectPaths& objects, Reflections reflections) {
    SensorPictures pictures(context, objects, reflections);
    const Intrinsics& drawn = context.sensor_lens->drawn();
    Result<RenderTarget> target = RenderTarget::create(drawn.width, drawn.height);
    if (!target) return tl::unexpected(target.error());
    pictures.target_.emplace(std::move(*target));
    return pictures;
}

View SensorPictures::viewOf(const ExposureSample& sample, const FrameRecord& frame,
                            std::optional<double> focus) const {
    const DatasetContents& contents = context_.contents;
    const std::size_t source = contents.sourceFrame(frame.index);
    View view = makeView(contents.camera, contents.camera_motion.poseAt(source, sample.after_s));
    view.intrinsics = context_.sensor_lens->drawn();
    view.reflections = reflections_;
    if (contents.sensor.aperture_mm > 0.0 && focus) {
        const Eigen::Vector2d lens = 0.0005 * contents.sensor.aperture_mm * sample.aperture;
        view.pose.position = view.pose.toWorld({lens.x(), lens.y(), 0.0});
        view.intrinsics.cx += view.intrinsics.fx * lens.x() / *focus;
        view.intrinsics.cy += view.intrinsics.fy * lens.y() / *focus;
    }
    return view;
}

Status SensorPictures::take(const FrameRecord& frame, SceneRenderer& renderer,
                            TracedPictures* traced, std::vector<float>& light) {
    const DatasetContents& contents = context_.contents;
    const SensorLens& lens = *context_.sensor_lens;
    const Exposure exposure(contents.sensor, contents.camera.height_px,
                            contents.sourceFrame(frame.index));
    const std::optional<double> focus = contents.sensor.aperture_mm > 0.0
                                            ? focusDepthOf(contents.sensor, contents.scene, frame)
                                            : std::nullopt;
    if (traced) return trace(frame, exposure, focus, *traced, light);

    LightSum sum;
    sum.lens = lens.drawn();
    sum.distortion = distortionOf(contents.sensor);
    const Intrinsics sensor = makeIntrinsics(contents.camera);
    sum.s_per_bent = exposure.rowStepSeconds() * sensor.fy;
    sum.sample_step_s = exposure.sampleStepSeconds();
    sum.row_exposure_s = exposure.rowExposureSeconds();
    if (Status status = renderer.beginLight(*target_); !status) return status;
    for (const ExposureSample& sample : exposure.samples()) {
        View view = viewOf(sample, frame, focus);
        view.intrinsics.cx -= sample.aside_px.x();
        view.intrinsics.cy -= sample.aside_px.y();
        if (objects_.any()) {
            for (const ObjectPaths::Placed& one : objects_.at(frame.time_s + sample.after_s)) {
                renderer.place(one.object_id, one.motion);
            }
        }
        sum.after_s = sample.after_s;
        sum.first_row = 0;
        sum.last_row = lens.drawn().height;
        if (exposure.rolls()) {
            const double reach = exposure.sampleStepSeconds() + 0.5 * exposure.rowExposureSeconds();
            const auto rowAt = [&](double time_s) {
                return time_s / exposure.rowStepSeconds() + 0.5 * sensor.height;
            };
            std::tie(sum.first_row, sum.last_row) =
                lens.drawnRows(rowAt(sample.after_s - reach), rowAt(sample.after_s + reach));
        }
        if (Status status = renderer.addLight(view, sum, *target_); !status) return status;
    }
    target_->readLight(light);
    return {};
}

/// Traces every sample; each row averages the samples of its own exposure.
Status SensorPictures::trace(const FrameRecord& frame, const Exposure& exposure,
                             std::optional<double> focus, TracedPictures& traced,
                             std::vector<float>& light) const {
    const DatasetContents& contents = context_.contents;
    const Intrinsics& drawn = context_.sensor_lens->drawn();
    const Intrinsics sensor = makeIntrinsics(contents.camera);
    const LensDistortion distortion = distortionOf(contents.sensor);
    const auto pixels =
        static_cast<std::size_t>(drawn.width) * static_cast<std::size_t>(drawn.height);
    std::vector<Eigen::Vector3f> sum(pixels, Eigen::Vector3f::Zero());
    std::vector<float> weights(pixels, 0.0F);
    int number = 0;
    for (const ExposureSample& sample : exposure.samples()) {
        const Result<PictureLayers> seen = traced.takePart(
            viewOf(sample, frame, focus), frame.index, number++, contents.sensor.looks);
        if (!seen) return tl::unexpected(seen.error());
        std::size_t i = 0;
        for (int y = 0; y < drawn.height; ++y) {
            for (int x = 0; x < drawn.width; ++x, ++i) {
                const Eigen::Vector2d straight = drawn.unproject(x + 0.5, y + 0.5).head<2>();
                const double row = sensor.fy * distortion.bend(straight).y() + sensor.cy;
                const auto weight = static_cast<float>(exposure.weight(sample, row));
                if (weight == 0.0F) continue;
                sum[i] += weight * seen->light(i);
                weights[i] += weight;
            }
        }
    }
    light.resize(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const Eigen::Vector3f mean =
            weights[i] > 0.0F ? Eigen::Vector3f(sum[i] / weights[i]) : Eigen::Vector3f::Zero();
        std::copy(mean.data(), mean.data() + 3, light.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return {};
}

}  // namespace dollytrack::render
