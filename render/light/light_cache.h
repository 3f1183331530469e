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

/// A disk cache of light volumes, one file each. Damaged files are ignored.
class LightCache {
  public:
    /// The user's cache, see userCache(); none if it is unavailable.
    [[nodiscard]] static std::optional<LightCache> ofUser();

    /// Stores at most `most_bytes`; the oldest files are deleted to make room.
    LightCache(GuardedFolder folder, std::uint64_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// Cache key: a hash of the scene, the light and the program file, because another build may
    /// bake differently.
    [[nodiscard]] static std::string keyOf(const Scene& scene, const LightRig& rig,
                                           const LightVolumeParams& params);

    [[nodiscard]] std::optional<LightVolume> find(const std::string& key) const;
    /// Whether a volume is stored under this key. find() may still reject it as damaged.
    [[nodiscard]] bool has(const std::string& key) const;
    /// Stores a volume. Failures are ignored.
    void keep(const std::string& key, const LightVolume& volume) const;

  private:
    GuardedFolder folder_;
    std::uint64_t most_bytes_;
};

/// Returns bakeLightVolume()'s result, from the user's cache if possible.
[[nodiscard]] LightVolume lightVolumeOf(const Scene& scene, const RayCaster& rays,
                                        const LightRig& rig, const LightVolumeParams& params = {},
                                        const JobContext& job = {});

/// Whether lightVolumeOf() would take this volume from the user's cache.
[[nodiscard]] bool isLightVolumeKept(const Scene& scene, const LightRig& rig,
                                     const LightVolumeParams& params = {});

}  // namespace dollytrack::render
