#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/light_params.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/light/light_volume.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace dollytrack::render {

/// Light of each frame of a dataset. If LightParams::light_varies is set, light depends on the
/// frame's number in the whole trajectory. Irradiance grids of lamps, emission, sky and sun are
/// baked once and summed with weights per frame. The exposure suits the nominal light, so stronger
/// light gives a brighter image; LightParams::exposure_ev may vary it.
class FrameLights {
  public:
    /// Bakes the grids. The volume is empty if the job was cancelled.
    FrameLights(const Scene& scene, const RayCaster& rays,
                std::span<const Eigen::AlignedBox3d> rooms, const LightParams& light,
                const LightVolumeParams& params = {}, const JobContext& job = {});

    /// Whether light differs between frames.
    [[nodiscard]] bool vary() const { return !parts_.empty(); }
    /// Light volume of the nominal light, without variation.
    [[nodiscard]] const LightVolume& volume() const { return volume_; }
    /// Light volume of a frame for SceneRenderer::changeLight(). Its `lamps` grid is empty, because
    /// it is the same in all frames.
    [[nodiscard]] LightVolume volumeAt(int trajectory_frame) const;
    /// Light rig of a frame for the path tracer; see balanced().
    [[nodiscard]] LightRig rigAt(int trajectory_frame) const;
    [[nodiscard]] float exposureAt(int trajectory_frame) const;

  private:
    enum class Source { Lamps, Emission, Sky, Sun };
    struct Part {
        Source source;
        std::vector<Eigen::Vector3f> ambient;
        std::vector<Eigen::Vector3f> slope;
    };
    /// Factor of a baked part in a frame with this rig and these drawn parameters.
    [[nodiscard]] Eigen::Vector3f weight(Source source, const LightRig& rig,
                                         const LightParams& drawn) const;

    LightParams light_;
    LightParams drawn_;  // random values drawn for the nominal light
    LightRig rig_;
    LightVolume volume_;
    std::vector<Part> parts_;  // empty: all frames have the nominal light
};

}  // namespace dollytrack::render
