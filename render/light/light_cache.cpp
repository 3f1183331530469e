#include "render/light/light_cache.h"

#include "engine/core/program_file.h"
#include "engine/io/files/cache_eviction.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/user_cache.h"
#include "render/scene/scene_hash.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dollytrack::render {
namespace {

constexpr const char* kExtension = ".light";
constexpr std::size_t kSumLength = 64;  // hexadecimal SHA-256 at the end of each file

/// Types stored as raw bytes: numbers and Eigen vectors of fixed size.
template <class T>
constexpr bool kPlain = std::is_arithmetic_v<T> || std::is_same_v<T, Eigen::Vector3f> ||
                        std::is_same_v<T, Eigen::Vector3d> || std::is_same_v<T, std::array<int, 3>>;

class Writer {
  public:
    template <class T>
    requires kPlain<T>
    void operator()(const T& value) { append(&value, sizeof(value)); }
    template <class T>
    void operator()(const std::vector<T>& values) {
        static_assert(kPlain<T>);
        (*this)(std::uint64_t{values.size()});
        append(values.data(), sizeof(T) * values.size());
    }
    std::string bytes;

  private:
    void append(const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    }
};

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    template <class T>
    requires kPlain<T>
    void operator()(T& value) { take(&value, sizeof(value)); }
    template <class T>
    void operator()(std::vector<T>& values) {
        std::uint64_t count = 0;
        (*this)(count);
        if (count > rest_.size() / sizeof(T)) {
            whole_ = false;
            return;
        }
        values.resize(count);
        take(values.data(), sizeof(T) * count);
    }
    /// Whether all reads succeeded and nothing is left.
    [[nodiscard]] bool whole() const { return whole_ && rest_.empty(); }

  private:
    void take(void* data, std::size_t size) {
        if (size > rest_.size()) {
            whole_ = false;
            return;
        }
        if (size > 0) std::memcpy(data, rest_.data(), size);  // an empty vector has no data
        rest_ = rest_.subspan(size);
    }
    std::span<const std::uint8_t> rest_;
    bool whole_ = true;
};

template <class Visit, class Sun>
void visitSun(Visit& visit, Sun& sun) {
    visit(sun.way);
    visit(sun.irradiance);
    visit(sun.shades.min());
    visit(sun.shades.max());
}

template <class Visit, class Volume>
void visitVolume(Visit& visit, Volume& volume) {
    visit(volume.low);
    visit(volume.cell_m);
    visit(volume.cells);
    visit(volume.ambient);
    visit(volume.slope);
    visit(volume.lamps);
    visit(volume.scene_lamp_share);
    visit(volume.lamp_color);
    visit(volume.scene_lamp_color);
    visit(volume.dimmed);
    visit(volume.exposure);
    visit(volume.lamps_shine);
    visit(volume.outside_shines);
    visit(volume.backdrop_factor);
    visit(volume.backdrop_grey);
    visitSun(visit, volume.sun);
}

void writeRig(Writer& write, const LightRig& rig) {
    write(std::uint64_t{rig.lamps.size()});
    for (const Lamp& lamp : rig.lamps) {
        write(lamp.position);
        write(lamp.radius_m);
        write(lamp.intensity);
    }
    write(std::uint64_t{rig.lamps_per_point});
    write(std::uint64_t{rig.scene_lamps.size()});
    for (const SceneLamp& lamp : rig.scene_lamps) {
        write(lamp.position);
        write(lamp.radius_m);
        write(lamp.intensity);
        write(lamp.shade.center);
        write(lamp.shade.half_size);
        write(lamp.shade.yaw);
        write(lamp.object_id);
    }
    write(rig.lamp_color);
    write(rig.sky_color);
    write(rig.sky_strength);
    write(rig.ground_share);
    write(rig.emission_scale);
    write(rig.lamp_factor);
    write(rig.emission_factor);
    write(rig.sky_factor);
    write(rig.backdrop_factor);
    write(rig.backdrop_grey);
    write(rig.exposure_ev);
    visitSun(write, rig.sun);
}

/// Scene data that neither geometryHash() nor appearanceHash() covers.
void writeScene(Writer& write, const Scene& scene) {
    write(scene.room_bounds.min());
    write(scene.room_bounds.max());
    for (const Object& object : scene.objects) {
        write(object.structure);
        write(object.first_triangle);
        write(object.triangle_count);
    }
}

void writeProgram(Writer& write) {
    struct stat file {};
    if (::stat(ownContent().c_str(), &file) != 0) return;
    write(std::uint64_t{file.st_ino});
    write(std::int64_t{file.st_size});
    write(std::int64_t{file.st_mtim.tv_sec});
    write(std::int64_t{file.st_mtim.tv_nsec});
}

}  // namespace

std::optional<LightCache> LightCache::ofUser() {
    std::optional<UserCache> cache = userCache("light");
    if (!cache) return std::nullopt;
    return LightCache(std::move(cache->folder), cache->most_bytes);
}

std::string LightCache::keyOf(const Scene& scene, const LightRig& rig,
                              const LightVolumeParams& params) {
    Writer write;
    writeProgram(write);
    writeScene(write, scene);
    writeRig(write, rig);
    write(params.cell_m);
    write(params.max_cells);
    write(params.rays_per_cell);
    write(params.bounces);
    write(params.limit_slopes);
    Sha256 hash;
    hash.add(geometryHash(scene) + appearanceHash(scene));
    hash.add(write.bytes);
    return hash.finish();
}

std::optional<LightVolume> LightCache::find(const std::string& key) const {
    const Result<InputFile> file = folder_.openInput(key + kExtension);
    if (!file) return std::nullopt;
    const Result<std::string> bytes = file->readAll(most_bytes_);
    if (!bytes || bytes->size() < kSumLength) return std::nullopt;
    const std::span data(reinterpret_cast<const std::uint8_t*>(bytes->data()),
                         bytes->size() - kSumLength);
    if (!bytes->ends_with(sha256Of(data))) return std::nullopt;
    LightVolume volume;
    Reader read(data);
    visitVolume(read, volume);
    if (!read.whole()) return std::nullopt;
    ::futimens(file->descriptor(), nullptr);  // marks the file as recently used
    return volume;
}

bool LightCache::has(const std::string& key) const {
    return folder_.openInput(key + kExtension).has_value();
}

void LightCache::keep(const std::string& key, const LightVolume& volume) const {
    Writer write;
    visitVolume(write, volume);
    write.bytes += sha256Of(write.bytes);
    if (write.bytes.size() > most_bytes_) return;
    evictOldest(folder_, {kExtension}, most_bytes_ - write.bytes.size());
    (void)folder_.write(key + kExtension, write.bytes, Durability::Renamed);
}

LightVolume lightVolumeOf(const Scene& scene, const RayCaster& rays, const LightRig& rig,
                          const LightVolumeParams& params, const JobContext& job) {
    const std::optional<LightCache> cache = LightCache::ofUser();
    if (!cache) return bakeLightVolume(scene, rays, rig, params, job);
    const std::string key = LightCache::keyOf(scene, rig, params);
    if (std::optional<LightVolume> kept = cache->find(key)) return std::move(*kept);
    LightVolume volume = bakeLightVolume(scene, rays, rig, params, job);
    if (!job.cancelled()) cache->keep(key, volume);
    return volume;
}

bool isLightVolumeKept(const Scene& scene, const LightRig& rig, const LightVolumeParams& params) {
    const std::optional<LightCache> cache = LightCache::ofUser();
    return cache && cache->has(LightCache::keyOf(scene, rig, params));
}

}  // namespace dollytrack::render
