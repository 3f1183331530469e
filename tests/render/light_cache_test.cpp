#include "render/light/light_cache.h"

#include "tests/render/sunny_room.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

namespace dollytrack::render::light_cache_test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kPlenty = 1U << 30U;

LightVolumeParams coarse() {
    LightVolumeParams params;
    params.max_cells = 500;
    return params;
}

class LightCacheTest : public testing::Test {
  protected:
    LightCacheTest() : scene_(fixture::sunnyRoom(fixture::Hole::Window)), rays_(scene_) {
        LightParams light;
        light.sun_strength = 1.0;
        rig_ = makeLightRig(scene_, rays_, {}, resolved(light));
        volume_ = bakeLightVolume(scene_, rays_, rig_, coarse());
    }

    GuardedFolder cacheFolder() const { return *GuardedFolder::open(folder_.path()); }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_.path()), {}));
    }

    dollytrack::test::TempFolder folder_;
    Scene scene_;
    RayCaster rays_;
    LightRig rig_;
    LightVolume volume_;
};

TEST_F(LightCacheTest, GivesBackWhatWasBakedToTheLastBit) {
    const LightCache cache(cacheFolder(), kPlenty);
    const std::string key = LightCache::keyOf(scene_, rig_, coarse());
    EXPECT_FALSE(cache.find(key));
    cache.keep(key, volume_);
    const std::optional<LightVolume> kept = cache.find(key);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->low, volume_.low);
    EXPECT_EQ(kept->cell_m, volume_.cell_m);
    EXPECT_EQ(kept->cells, volume_.cells);
    EXPECT_EQ(kept->ambient, volume_.ambient);
    EXPECT_EQ(kept->slope, volume_.slope);
    EXPECT_EQ(kept->lamps, volume_.lamps);
    EXPECT_EQ(kept->scene_lamp_share, volume_.scene_lamp_share);
    EXPECT_EQ(kept->exposure, volume_.exposure);
    EXPECT_EQ(kept->dimmed, volume_.dimmed);
    EXPECT_EQ(kept->lamp_color, volume_.lamp_color);
    EXPECT_EQ(kept->sun.irradiance, volume_.sun.irradiance);
    EXPECT_EQ(kept->sun.way, volume_.sun.way);
    EXPECT_EQ(kept->sun.shades.max(), volume_.sun.shades.max());
    EXPECT_TRUE(kept->sun.shines());
    EXPECT_FALSE(cache.find(LightCache::keyOf(scene_, rig_, {})));
}

TEST_F(LightCacheTest, HasOnlyKeysThatWereKept) {
    const LightCache cache(cacheFolder(), kPlenty);
    const std::string key = LightCache::keyOf(scene_, rig_, coarse());
    EXPECT_FALSE(cache.has(key));
    cache.keep(key, volume_);
    EXPECT_TRUE(cache.has(key));
}

// The editor pauses baking in the progress reports while plans are made.
TEST_F(LightCacheTest, BakingReportsProgressAndCanBeCancelledThere) {
    LightVolumeParams params;
    params.max_cells = 40'000;  // several pieces
    std::vector<double> reports;
    const JobContext job(nullptr,
                         [&](double fraction, std::string_view) { reports.push_back(fraction); });
    const LightVolume whole = bakeLightVolume(scene_, rays_, rig_, params, job);
    EXPECT_FALSE(whole.ambient.empty());
    EXPECT_GE(reports.size(), 6U);
    EXPECT_TRUE(std::ranges::is_sorted(reports));
    EXPECT_LE(reports.back(), 1.0);

    const auto cancelled = std::make_shared<std::atomic<bool>>(false);
    const JobContext stopped(cancelled, [&](double fraction, std::string_view) {
        if (fraction > 0.1) *cancelled = true;
    });
    EXPECT_TRUE(bakeLightVolume(scene_, rays_, rig_, params, stopped).ambient.empty());
}

TEST_F(LightCacheTest, WhateverChangesTheLightHasAnotherName) {
    std::set<std::string> keys = {LightCache::keyOf(scene_, rig_, coarse())};
    EXPECT_FALSE(keys.insert(LightCache::keyOf(scene_, rig_, coarse())).second);
    std::size_t changes = 0;
    const auto changedRig = [&](auto&& change) {
        LightRig rig = rig_;
        change(rig);
        EXPECT_TRUE(keys.insert(LightCache::keyOf(scene_, rig, coarse())).second) << changes;
        ++changes;
    };
    changedRig([](LightRig& rig) { rig.lamps[0].position.x() += 0.01; });
    changedRig([](LightRig& rig) { rig.lamps.clear(); });
    changedRig([](LightRig& rig) { rig.lamps_per_point = 16; });
    changedRig([](LightRig& rig) { rig.scene_lamps.emplace_back(); });
    changedRig([](LightRig& rig) { rig.sky_factor.x() *= 0.5F; });
    changedRig([](LightRig& rig) { rig.lamp_factor *= 0.5F; });
    changedRig([](LightRig& rig) { rig.emission_factor *= 0.5F; });
    changedRig([](LightRig& rig) { rig.exposure_ev += 0.1; });
    changedRig([](LightRig& rig) { rig.sun.way = -rig.sun.way; });
    const auto changedScene = [&](auto&& change) {
        Scene scene = scene_;
        change(scene);
        EXPECT_TRUE(keys.insert(LightCache::keyOf(scene, rig_, coarse())).second) << changes;
        ++changes;
    };
    changedScene([](Scene& scene) { scene.positions[0].x() += 0.01F; });
    changedScene([](Scene& scene) { scene.materials[0].base_color.x() *= 0.5F; });
    changedScene([](Scene& scene) { scene.materials[0].emission.x() += 1.0F; });
    changedScene([](Scene& scene) { scene.objects[0].structure = !scene.objects[0].structure; });
    changedScene([](Scene& scene) { scene.objects[0].nyu40 = 39; });
    changedScene([](Scene& scene) { scene.room_bounds.extend(Eigen::Vector3d(50, 50, 50)); });
    LightVolumeParams params = coarse();
    params.bounces = 3;
    EXPECT_TRUE(keys.insert(LightCache::keyOf(scene_, rig_, params)).second);
}

TEST_F(LightCacheTest, PassesOverWhatIsDamagedOrCutOff) {
    const LightCache cache(cacheFolder(), kPlenty);
    cache.keep("one", volume_);
    const fs::path file = fs::directory_iterator(folder_.path())->path();
    const auto size = fs::file_size(file);
    {
        std::fstream change(file, std::ios::in | std::ios::out | std::ios::binary);
        change.seekp(static_cast<std::streamoff>(size / 2));
        change.put('\x5a');
        change.put('\xa5');
    }
    EXPECT_FALSE(cache.find("one"));
    cache.keep("one", volume_);
    EXPECT_TRUE(cache.find("one"));
    fs::resize_file(file, size - 10);
    EXPECT_FALSE(cache.find("one"));
    fs::resize_file(file, 0);
    EXPECT_FALSE(cache.find("one"));
}

TEST_F(LightCacheTest, TheOldestMakesRoom) {
    LightCache(cacheFolder(), kPlenty).keep("a", volume_);
    const auto size = fs::file_size(folder_.path() / "a.light");
    const LightCache cache(cacheFolder(), 2 * size + size / 2);
    const auto age = [&](const char* key, int hours) {
        fs::last_write_time(folder_.path() / (std::string(key) + ".light"),
                            fs::file_time_type::clock::now() - std::chrono::hours(hours));
    };
    cache.keep("b", volume_);
    age("a", 2);
    age("b", 1);
    ASSERT_TRUE(cache.find("a"));  // is now the most recently used
    cache.keep("c", volume_);
    EXPECT_TRUE(cache.find("a"));
    EXPECT_FALSE(cache.find("b"));
    EXPECT_TRUE(cache.find("c"));
    EXPECT_EQ(files(), 2U);
    LightCache(cacheFolder(), size - 1).keep("d", volume_);  // never fits
    EXPECT_EQ(files(), 2U);
}

}  // namespace
}  // namespace dollytrack::render::light_cache_test
