#include "engine/scene/light_params.h"

#include "engine/scene/resolved_light.h"
#include "engine/scene/varied_materials.h"
#include "tests/support/scene_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace dollytrack::light_params_test {
namespace {

TEST(LightParams, APresetSetsTheLightAndWhatFollowsChangesIt) {
    LightParams params;
    ASSERT_TRUE(setField(listLightFields(params), "sun_azimuth_deg=30"));
    ASSERT_TRUE(setField(listLightFields(params), "light_seed=7"));
    ASSERT_TRUE(setField(listLightFields(params), "lamp_strength=3"));
    ASSERT_TRUE(setField(listLightFields(params), "light_preset=night"));
    EXPECT_EQ(params.lamp_strength, 1.0);  // from the preset
    EXPECT_EQ(params.sky_strength, 0.0);
    EXPECT_EQ(params.sun_azimuth_deg, 30.0);  // not in presets
    EXPECT_EQ(params.light_seed, 7);
    ASSERT_TRUE(setField(listLightFields(params), "lamp_strength=0.5"));
    EXPECT_EQ(params.lamp_strength, 0.5);
    EXPECT_EQ(params.light_preset, LightPreset::Night);
    EXPECT_EQ(lightPreset(LightPreset::Neutral), LightParams{});
    EXPECT_FALSE(setField(listLightFields(params), "light_preset=noon"));
    EXPECT_FALSE(setField(listLightFields(params), "lamp_strength=11"));
}

TEST(LightParams, TheListHoldsEveryFieldAndGoesToFilesAndBack) {
    LightParams params;
    const FieldList fields = listLightFields(params);
    EXPECT_EQ(fields.size(), 12U);
    std::set<std::string> names;
    for (const Field& field : fields) {
        EXPECT_EQ(field.section, "light");
        names.insert(field.name);
    }
    EXPECT_EQ(names.size(), fields.size());
    LightParams other = lightPreset(LightPreset::Evening);
    other.light_variation = 0.25;
    other.light_seed = 12;
    other.own_lamps = 3.0;
    other.light_varies = LightVaries::Frame;
    other.sun_azimuth_deg = -90.0;
    ASSERT_TRUE(setFromJson(fields, toJson(listLightFields(other))));
    EXPECT_EQ(params, other);
}

// The recorded temperature is the one used for rendering.
TEST(ResolvedLight, NothingGlowsColderThanABlackBodyThatIsKnown) {
    LightParams params;
    params.lamp_temperature_K = 500.0;
    EXPECT_EQ(resolved(params).drawn.lamp_temperature_K, 1000.0);
    params.lamp_temperature_K = 1500.0;
    EXPECT_EQ(resolved(params).drawn.lamp_temperature_K, 1500.0);
}

// The default parameters do not change the neutral light in any bit.
TEST(ResolvedLight, TheDefaultChangesNothing) {
    const ResolvedLight light = resolved({});
    EXPECT_EQ(light.drawn, LightParams{});
    EXPECT_EQ(light.sun_irradiance, Eigen::Vector3f(Eigen::Vector3f::Zero()));
    EXPECT_EQ(light.sky_factor, Eigen::Vector3f(Eigen::Vector3f::Ones()));
    EXPECT_EQ(light.backdrop_factor, Eigen::Vector3f(Eigen::Vector3f::Ones()));
    EXPECT_EQ(light.backdrop_grey, 0.0F);
    EXPECT_EQ(light.lamp_factor, 1.0F);
    EXPECT_FALSE(light.lamp_color);
    EXPECT_EQ(light.exposure_ev, 0.0);
    LightParams dim;
    dim.time_of_day_h = 18.0;
    EXPECT_NE(resolved(dim).sky_factor, Eigen::Vector3f(Eigen::Vector3f::Ones()));
}

TEST(ResolvedLight, TheSunGoesItsWay) {
    EXPECT_NEAR(sunElevationDeg(12.0), 45.0, 1e-9);
    EXPECT_NEAR(sunElevationDeg(6.0), 0.0, 1e-9);
    EXPECT_NEAR(sunElevationDeg(18.0), 0.0, 1e-9);
    EXPECT_NEAR(sunElevationDeg(0.0), -45.0, 1e-9);
    LightParams params = lightPreset(LightPreset::Day);
    params.sun_azimuth_deg = 90.0;
    params.time_of_day_h = 12.0;
    const ResolvedLight noon = resolved(params);
    EXPECT_LT((noon.to_sun - Eigen::Vector3d(0.0, std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-9);
    params.time_of_day_h = 17.5;
    const ResolvedLight late = resolved(params);
    EXPECT_LT(late.sun_irradiance.mean(), noon.sun_irradiance.mean());
    const auto redness = [](const Eigen::Vector3f& color) { return color[0] / color[2]; };
    EXPECT_GT(redness(late.sun_irradiance), 1.5F * redness(noon.sun_irradiance));
    params.time_of_day_h = 18.5;
    EXPECT_EQ(resolved(params).sun_irradiance.maxCoeff(), 0.0F);
    params.time_of_day_h = 1.0;
    EXPECT_EQ(resolved(params).sky_factor.maxCoeff(), 0.0F);
}

// CIE 015: a black body of 6504 K has about daylight's white; 2856 K is illuminant A, whose linear
// sRGB follows from its chromaticity x 0.44757, y 0.40745.
TEST(ResolvedLight, BlackBodiesHaveTheirColours) {
    const Eigen::Vector3f white = blackBodyColor(6504.0);
    EXPECT_NEAR(white[0], 1.0F, 0.06F);
    EXPECT_NEAR(white[1], 1.0F, 0.03F);
    EXPECT_NEAR(white[2], 1.0F, 0.06F);
    const double x = 0.44757;
    const double y = 0.40745;
    const Eigen::Vector3d xyz(x / y, 1.0, (1.0 - x - y) / y);
    const Eigen::Vector3d a(3.2406 * xyz[0] - 1.5372 * xyz[1] - 0.4986 * xyz[2],
                            -0.9689 * xyz[0] + 1.8758 * xyz[1] + 0.0415 * xyz[2],
                            0.0557 * xyz[0] - 0.2040 * xyz[1] + 1.0570 * xyz[2]);
    EXPECT_LT((blackBodyColor(2856.0).cast<double>() - a).norm(), 0.03);
    EXPECT_GT((blackBodyColor(3500.0).cast<double>() - a).norm(), 0.1);
}

TEST(ResolvedLight, TheVariationIsSeededAndStaysInRange) {
    LightParams params = lightPreset(LightPreset::Evening);
    EXPECT_EQ(resolved(params).drawn, params);
    params.light_variation = 1.0;
    std::set<double> times;
    for (int seed = 0; seed < 200; ++seed) {
        params.light_seed = seed;
        LightParams drawn = resolved(params).drawn;
        EXPECT_EQ(drawn, resolved(params).drawn);
        times.insert(drawn.time_of_day_h);
        EXPECT_LE(std::abs(drawn.time_of_day_h - params.time_of_day_h), 2.5);
        EXPECT_LE(std::abs(std::log2(drawn.lamp_strength / params.lamp_strength)), 1.0 + 1e-9);
        EXPECT_LE(std::abs(drawn.exposure_ev - params.exposure_ev), 0.7);
        for (const Field& field : listLightFields(drawn)) {
            if (const auto* real = std::get_if<Field::Real>(&field.value)) {
                EXPECT_GE(*real->value, real->info.min) << field.name;
                EXPECT_LE(*real->value, real->info.max) << field.name;
            }
        }
    }
    EXPECT_GT(times.size(), 190U);
    // Half the variation gives half the deviation.
    params.light_seed = 3;
    const double far = resolved(params).drawn.exposure_ev - params.exposure_ev;
    params.light_variation = 0.5;
    EXPECT_NEAR(resolved(params).drawn.exposure_ev - params.exposure_ev, 0.5 * far, 1e-12);
    // A night has no daylight: factors of 0 stay 0.
    LightParams night = lightPreset(LightPreset::Night);
    night.light_variation = 1.0;
    EXPECT_EQ(resolved(night).sky_factor.maxCoeff(), 0.0F);
    EXPECT_EQ(resolved(night).sun_irradiance.maxCoeff(), 0.0F);
}

TEST(ResolvedLight, IsWrittenAsNumbers) {
    const nlohmann::ordered_json json = toJson(resolved(lightPreset(LightPreset::Day)));
    EXPECT_EQ(json.at("light_preset"), "day");
    EXPECT_EQ(json.at("time_of_day_h"), 14.0);
    EXPECT_EQ(json.at("sun_irradiance").size(), 3U);
    EXPECT_FALSE(json.contains("light_seed"));
}

TEST(VariedMaterials, ALittleAndTheSameForTheSameSeed) {
    const Scene scene = test::furnishedRoom();
    LightParams params;
    Scene same = scene;
    varyMaterials(same, params);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        EXPECT_EQ(same.materials[i].base_color, scene.materials[i].base_color);
    }
    params.light_variation = 1.0;
    Scene varied = scene;
    Scene again = scene;
    varyMaterials(varied, params);
    varyMaterials(again, params);
    bool any = false;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& before = scene.materials[i];
        const Material& after = varied.materials[i];
        EXPECT_EQ(after.base_color, again.materials[i].base_color);
        EXPECT_EQ(after.roughness, again.materials[i].roughness);
        EXPECT_LE(std::abs(after.roughness - before.roughness), 0.15F + 1e-6F);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(after.base_color[c], std::min(1.2F * before.base_color[c] + 1e-6F, 1.0F));
            EXPECT_GE(after.base_color[c], before.base_color[c] / 1.2F - 1e-6F);
        }
        any = any || after.base_color != before.base_color;
    }
    EXPECT_TRUE(any);
    params.light_seed = 2;
    Scene other = scene;
    varyMaterials(other, params);
    EXPECT_NE(other.materials[0].base_color, varied.materials[0].base_color);
}

TEST(LightParams, LampsAreOfAThousandKelvinAtLeastOrNone) {
    for (const auto& [given, nearest] : {std::pair{0.0, 0.0},
                                         {1.0, 1000.0},
                                         {999.0, 1000.0},
                                         {1000.0, 1000.0},
                                         {2700.0, 2700.0}}) {
        LightParams light;
        const FieldList fields = listLightFields(light);
        const Status set = setField(fields, fmt::format("lamp_temperature_K={}", given));
        EXPECT_EQ(set.has_value(), given == nearest) << given;
        const auto field = std::ranges::find(fields, "lamp_temperature_K", &Field::name);
        const auto& real = std::get<Field::Real>(field->value);
        EXPECT_EQ(real.info.range().nearest(given), nearest);
        EXPECT_EQ(field->rangeText(), "0, or 1000 .. 20000");
        EXPECT_EQ(light.lamp_temperature_K, set ? given : 0.0);
    }
}

}  // namespace
}  // namespace dollytrack::light_params_test
