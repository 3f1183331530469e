// Light that varies by frame.

#include "render/light/frame_lights.h"

#include "engine/scene/resolved_light.h"
#include "render/frames/frame_file.h"
#include "tests/render/dataset/dataset_fixture.h"
#include "tests/render/sunny_room.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace dollytrack::render::frame_lights_gl_test {
namespace {

/// A room with sun, sky, lamps and a glossy floor.
Scene brightRoom() {
    Scene scene = fixture::sunnyRoom(fixture::Hole::Window);
    scene.materials[0].emission = {0.1F, 0.06F, 0.03F};
    return scene;
}

LightParams byFrame() {
    LightParams params = lightPreset(LightPreset::Day);
    params.sun_azimuth_deg = 170.0;
    params.lamp_strength = 0.8;
    params.light_variation = 1.0;
    params.light_varies = LightVaries::Frame;
    return params;
}

TEST(FrameLights, AFrameDrawsItsStrengthsAndTheSceneItsSun) {
    const LightParams params = byFrame();
    const ResolvedLight scene = resolved(params);
    EXPECT_EQ(scene.drawn.lamp_strength, params.lamp_strength);
    EXPECT_EQ(scene.drawn.exposure_ev, params.exposure_ev);
    EXPECT_NE(scene.drawn.time_of_day_h, params.time_of_day_h);
    const ResolvedLight third = resolvedAt(params, 3);
    EXPECT_EQ(third.drawn, resolvedAt(params, 3).drawn);
    EXPECT_EQ(third.to_sun, scene.to_sun);
    EXPECT_NE(third.drawn.lamp_strength, params.lamp_strength);
    EXPECT_NE(third.drawn.lamp_strength, resolvedAt(params, 4).drawn.lamp_strength);
    EXPECT_NE(third.drawn.sun_strength, params.sun_strength);
    LightParams other = params;
    other.light_seed = 2;
    EXPECT_NE(third.drawn.exposure_ev, resolvedAt(other, 3).drawn.exposure_ev);
    other = params;
    other.light_varies = LightVaries::Scene;
    EXPECT_EQ(resolvedAt(other, 3).drawn, resolvedAt(other, 4).drawn);
    other = params;
    other.light_variation = 0.0;
    EXPECT_EQ(resolvedAt(other, 3).drawn, other);
}

class FrameLightsGl : public fixture::DatasetGlTest {
  protected:
    /// The image of a view into the room, as bytes.
    static std::vector<std::uint8_t> pictureOf(SceneRenderer& renderer, RenderTarget& target) {
        const View view =
            makeView(fixture::smallCamera(), lookAt({3.7, 2.7, 1.8}, {1.0, 1.3, 0.8}));
        std::vector<std::uint8_t> rgb;
        EXPECT_TRUE(renderer.draw(view, target));
        target.readRgb(rgb);
        return rgb;
    }
    /// The mean difference on the scale 0..255, and the share of values that differ by more than 6.
    static std::pair<double, double> apart(const std::vector<std::uint8_t>& a,
                                           const std::vector<std::uint8_t>& b) {
        if (a.size() != b.size() || a.empty()) return {255.0, 1.0};
        double sum = 0.0;
        double far = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const int off = std::abs(static_cast<int>(a[i]) - b[i]);
            sum += off;
            far += off > 6 ? 1.0 : 0.0;
        }
        return {sum / static_cast<double>(a.size()), far / static_cast<double>(a.size())};
    }

    Result<DatasetSummary> exportInto(const char* name, const LightParams& light,
                                      const Trajectory& trajectory, FrameRange range = {},
                                      bool traced = false) {
        DatasetSettings settings;
        settings.folder = folder_ / name;
        settings.light = light;
        settings.range = range;
        settings.modalities = {"rgb", "depth"};
        if (traced) {
            settings.picture.render_mode = RenderMode::Reference;
            settings.picture.reference_samples = 2;
        }
        return exportWith(settings, trajectory);
    }
    std::string picture(const char* name, int index) {
        return read(folder_ / name / frameFile("rgb", index, ".png"));
    }
};

// The sum of the parts equals the light that is baked for these values.
TEST_F(FrameLightsGl, AFramesLightIsThatOfTheSameValuesSetForTheScene) {
    const Scene scene = brightRoom();
    const RayCaster rays(scene);
    const LightParams params = byFrame();
    LightVolumeParams grid;
    grid.max_cells = 6000;
    const FrameLights lights(scene, rays, {}, params, grid);
    ASSERT_TRUE(lights.vary());
    auto renderer = OffscreenRenderer::create(std::move(context_), scene, lights.volume(),
                                              fixture::smallCamera().width_px,
                                              fixture::smallCamera().height_px);
    ASSERT_TRUE(renderer) << describe(renderer.error());
    std::vector<std::uint8_t> last;
    for (const int frame : {0, 5, 17}) {
        renderer->scene().changeLight(lights.volumeAt(frame));
        const auto changed = pictureOf(renderer->scene(), renderer->target());
        LightParams set = resolvedAt(params, frame).drawn;
        set.light_variation = 0.0;
        LightVolume baked =
            bakeLightVolume(scene, rays, makeLightRig(scene, rays, {}, resolved(set)), grid);
        // The exposure stays that of the base light, which the frames vary.
        const double ev = set.exposure_ev - params.exposure_ev;
        EXPECT_NEAR(lights.exposureAt(frame), lights.volume().exposure * std::exp2(ev), 1e-5);
        baked.exposure = lights.exposureAt(frame);
        ASSERT_TRUE(renderer->scene().setLight(baked));
        const auto expected = pictureOf(renderer->scene(), renderer->target());
        // The direction of bounced light is stored once for all sources, so only its hue may
        // differ.
        const auto [mean, far] = apart(changed, expected);
        EXPECT_LT(mean, 1.5) << frame;
        EXPECT_LT(far, 0.001) << frame;  // pixels that only one of the two edge filters changes
        if (!last.empty()) {
            EXPECT_GT(apart(changed, last).first, 4.0) << frame;
        }
        last = changed;
        ASSERT_TRUE(renderer->scene().setLight(lights.volume()));
    }
}

TEST_F(FrameLightsGl, AStillCameraSeesItChangeWhereItIsAskedTo) {
    Trajectory still = fixture::circle(1);
    while (still.frames.size() < 6) still.frames.push_back(still.frames.front());
    for (std::size_t i = 0; i < still.frames.size(); ++i) still.frames[i].time_s = 0.1 * i;
    LightParams light = byFrame();
    ASSERT_TRUE(exportInto("frame", light, still));
    light.light_varies = LightVaries::Scene;
    ASSERT_TRUE(exportInto("scene", light, still));
    for (int i = 1; i < 6; ++i) {
        EXPECT_NE(picture("frame", i), picture("frame", 0)) << i;
        EXPECT_EQ(picture("scene", i), picture("scene", 0)) << i;
        EXPECT_EQ(read(folder_ / "frame/depth/000000.png"),
                  read(folder_ / "frame" / frameFile("depth", i, ".png")));
    }
    // Exporting a part of the frames gives the same bytes as exporting all.
    light.light_varies = LightVaries::Frame;
    ASSERT_TRUE(exportInto("part", light, still, {1, 6, 2}));
    for (int i = 0; i < 3; ++i) EXPECT_EQ(picture("part", i), picture("frame", 1 + 2 * i)) << i;
    // The light of each frame is in the table.
    const std::string table = read(folder_ / "part/frames.csv");
    EXPECT_NE(
        table.find(",score,picture,lamp_strength,lamp_temperature_K,sky_strength,sun_strength,"
                   "exposure_ev\n"),
        std::string::npos);
    std::ostringstream lamp;  // six digits
    lamp << resolvedAt(light, 3).drawn.lamp_strength;
    EXPECT_NE(table.find("," + lamp.str() + ","), std::string::npos) << table;
    EXPECT_EQ(read(folder_ / "scene/frames.csv").find("lamp_strength"), std::string::npos);
}

TEST_F(FrameLightsGl, PathTracedFramesHaveTheirLightToo) {
    Trajectory still = fixture::circle(1);
    still.frames.resize(3, still.frames.front());
    for (std::size_t i = 0; i < still.frames.size(); ++i) still.frames[i].time_s = 0.1 * i;
    LightParams light = byFrame();
    ASSERT_TRUE(exportInto("frame", light, still, {}, true));
    EXPECT_NE(picture("frame", 1), picture("frame", 0));
    EXPECT_NE(picture("frame", 2), picture("frame", 1));
    ASSERT_TRUE(exportInto("part", light, still, {2, 3, 1}, true));
    EXPECT_EQ(picture("part", 0), picture("frame", 2));
    light.light_varies = LightVaries::Scene;
    ASSERT_TRUE(exportInto("scene", light, still, {}, true));
    EXPECT_EQ(picture("scene", 1), picture("scene", 0));
}

}  // namespace
}  // namespace dollytrack::render::frame_lights_gl_test
