#include "render/light/frame_lights.h"

#include "engine/scene/resolved_light.h"
#include "render/light/light_cache.h"
#include "render/materials/surface_kind.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack::render {
namespace {

bool anyEmission(const Scene& scene) {
    return std::ranges::any_of(scene.materials, [&](const Material& material) {
        return meanEmission(scene, material).maxCoeff() > 0.0F;
    });
}

float ratio(double now, double baked) {
    return baked > 0.0 ? static_cast<float>(now / baked) : 0.0F;
}

}  // namespace

FrameLights::FrameLights(const Scene& scene, const RayCaster& rays,
                         std::span<const Eigen::AlignedBox3d> rooms, const LightParams& light,
                         const LightVolumeParams& params, const JobContext& job)
    : light_(light) {
    const ResolvedLight resolved_light = resolved(light);
    drawn_ = resolved_light.drawn;
    rig_ = makeLightRig(scene, rays, rooms, resolved_light);
    volume_ = lightVolumeOf(scene, rays, rig_, params, job);
    if (!variesByFrame(light)) return;
    LightRig dark = rig_;
    dark.lamp_factor = dark.emission_factor = 0.0F;
    dark.scene_lamps.clear();
    dark.sky_factor.setZero();
    dark.sun.irradiance.setZero();
    std::vector<std::pair<Source, LightRig>> wanted;
    const auto want = [&](Source source) -> LightRig& {
        return wanted.emplace_back(source, dark).second;
    };
    if (rig_.lamp_factor > 0.0F) {
        LightRig& lamps = want(Source::Lamps);
        lamps.scene_lamps = rig_.scene_lamps;
        lamps.lamp_factor = 1.0F;
        lamps.lamp_color.setOnes();
    }
    if (rig_.emission_factor > 0.0F && anyEmission(scene)) {
        want(Source::Emission).emission_factor = 1.0F;
    }
    if (rig_.sky_factor.maxCoeff() > 0.0F) want(Source::Sky).sky_factor = rig_.sky_factor;
    if (rig_.sun.shines()) want(Source::Sun).sun = rig_.sun;
    LightVolumeParams of_parts = params;
    of_parts.limit_slopes = false;
    for (const auto& [source, rig] : wanted) {
        LightVolume baked = lightVolumeOf(scene, rays, rig, of_parts, job);
        parts_.push_back({source, std::move(baked.ambient), std::move(baked.slope)});
    }
    // Even without any light frames may differ in exposure.
    if (parts_.empty()) parts_.push_back({Source::Sky, volume_.ambient, volume_.slope});
}

Eigen::Vector3f FrameLights::weight(Source source, const LightRig& rig,
                                    const LightParams& drawn) const {
    const auto all = [](float value) { return Eigen::Vector3f(Eigen::Vector3f::Constant(value)); };
    switch (source) {
        case Source::Lamps:
            return rig.lampLight();
        case Source::Emission:
            return all(rig.emission_factor);
        case Source::Sky:
            return all(ratio(drawn.sky_strength, drawn_.sky_strength));
        case Source::Sun:
            return all(ratio(drawn.sun_strength, drawn_.sun_strength));
    }
    return all(0.0F);
}

LightVolume FrameLights::volumeAt(int trajectory_frame) const {
    if (!vary()) return volume_;
    const ResolvedLight light = resolvedAt(light_, trajectory_frame);
    LightRig rig = rig_;
    setLight(rig, light);
    LightVolume result;
    result.low = volume_.low;
    result.cell_m = volume_.cell_m;
    result.cells = volume_.cells;
    result.dimmed = volume_.dimmed;
    setStrengths(rig, result);
    result.exposure = exposureAt(trajectory_frame);
    result.sun = balanced(rig, volume_).sun;
    const std::size_t count = volume_.ambient.size();
    result.ambient.assign(count, Eigen::Vector3f::Zero());
    result.slope.assign(count, Eigen::Vector3f::Zero());
    for (const Part& part : parts_) {
        const Eigen::Vector3f times = weight(part.source, rig, light.drawn);
        for (std::size_t i = 0; i < count; ++i) {
            const Eigen::Vector3f ambient = part.ambient[i].cwiseProduct(times);
            result.ambient[i] += ambient;
            result.slope[i] += part.slope[i] * ambient.mean();
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        const float mean = result.ambient[i].mean();
        if (mean <= 0.0F) continue;
        result.slope[i] = limited(result.slope[i] / mean);
    }
    return result;
}

LightRig FrameLights::rigAt(int trajectory_frame) const {
    LightRig rig = rig_;
    if (vary()) setLight(rig, resolvedAt(light_, trajectory_frame));
    return balanced(rig, volume_);
}

float FrameLights::exposureAt(int trajectory_frame) const {
    if (!vary()) return volume_.exposure;
    const double more =
        resolvedAt(light_, trajectory_frame).exposure_ev - resolved(light_).exposure_ev;
    return volume_.exposure * static_cast<float>(std::exp2(more));
}

}  // namespace dollytrack::render
