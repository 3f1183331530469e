#pragma once

#include "engine/geometry/ray_caster.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/light/light_rig.h"
#include "render/light/light_volume.h"

#include <optional>
#include <string>

namespace dollytrack::render {

/// Keeps light volumes, a file each. What is damaged or cut off is passed over.
class LightCache {
  public:
    /// The user's, see io::userCache().
    [[nodiscard]] static std::optional<LightCache> ofUser();

    /// The oldest files go where all would be larger than `most_bytes`.
    LightCache(io::GuardedFolder folder, std::uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// Names what bakeLightVolume() gives: by all that the scene and the light are, and by this
    /// program's file, for another one may light otherwise.
    [[nodiscard]] static std::string keyOf(const Scene& scene, const LightRig& rig,
                                           const LightVolumeParams& params);

    [[nodiscard]] std::optional<LightVolume> find(const std::string& key) const;
    /// Without a word where it cannot be kept.
    void keep(const std::string& key, const LightVolume& volume) const;

  private:
    io::GuardedFolder folder_;
    std::uint64_t most_bytes_;
};

/// What bakeLightVolume() gives, from the user's cache where it was computed before.
[[nodiscard]] LightVolume lightVolumeOf(const Scene& scene, const RayCaster& rays,
                                        const LightRig& rig, const LightVolumeParams& params = {},
                                        const JobContext& job = {});

}  // namespace dollytrack::render
