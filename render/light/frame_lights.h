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

/// The light of each frame of a dataset: the scene's, or by the frame's number in the whole
/// trajectory where LightParams::light_varies says so. Light adds up: that of the lamps, of what
/// else shines, of the sky and of the sun are each baked once, and weighed for a frame. The
/// exposure is the one that suits the scene's light as it is set: more light is a brighter picture.
class FrameLights {
  public:
    /// Empty when cancelled.
    FrameLights(const Scene& scene, const RayCaster& rays,
                std::span<const Eigen::AlignedBox3d> rooms, const LightParams& light,
                const LightVolumeParams& params = {}, const JobContext& job = {});

    /// Whether frames differ.
    [[nodiscard]] bool vary() const { return !parts_.empty(); }
    /// Of the scene's light.
    [[nodiscard]] const LightVolume& volume() const { return volume_; }
    /// For SceneRenderer::changeLight(): the light of a frame without `lamps`, which are the same
    /// in all.
    [[nodiscard]] LightVolume volumeAt(int trajectory_frame) const;
    /// For path tracing; see balanced().
    [[nodiscard]] LightRig rigAt(int trajectory_frame) const;
    [[nodiscard]] float exposureAt(int trajectory_frame) const;

  private:
    enum class Source { Lamps, Emission, Sky, Sun };
    struct Part {
        Source source;
        std::vector<Eigen::Vector3f> ambient;
        std::vector<Eigen::Vector3f> slope;
    };
    /// Times a part as it was baked.
    [[nodiscard]] Eigen::Vector3f weight(Source source, const LightRig& rig,
                                         const LightParams& drawn) const;

    LightParams light_;
    LightParams drawn_;  // for the scene
    LightRig rig_;
    LightVolume volume_;
    std::vector<Part> parts_;  // empty: all frames have the scene's light
};

}  // namespace dollytrack::render
