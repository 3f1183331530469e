#include "planning/plan_params.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <variant>

namespace dollytrack::planning::plan_params_test {
namespace {

/// Sets the field to a different value.
void change(const Field& field) {
    if (const auto* choice = std::get_if<Field::Choice>(&field.value)) {
        choice->set((choice->get() + 1) % static_cast<int>(choice->info.names.size()));
    } else if (const auto* on_off = std::get_if<Field::Switch>(&field.value)) {
        *on_off->value = !*on_off->value;
    } else if (const auto* whole = std::get_if<Field::Integer>(&field.value)) {
        *whole->value += *whole->value < whole->info.max ? 1 : -1;
    } else {
        const auto& real = std::get<Field::Real>(field.value);
        *real.value += *real.value < real.info.max ? 0.001 : -0.001;
    }
}

TEST(PlanParams, EveryNameIsThereOnce) {
    PlanParams params;
    std::set<std::string> names;
    for (const Field& field : listFields(params)) {
        EXPECT_TRUE(names.insert(field.name).second) << field.name;
    }
}

// A condition names a field that exists, and values that it can have.
TEST(PlanParams, HaveAnEffectWhereTheirConditionsHold) {
    PlanParams params;
    const FieldList fields = listFields(params);
    int conditions = 0;
    for (const Field& field : fields) {
        const std::string condition(field.onlyWith());
        if (condition.empty()) continue;
        ++conditions;
        const std::size_t sign = condition.find_first_of("=>");
        ASSERT_NE(sign, std::string::npos) << field.name;
        std::istringstream values(condition.substr(sign + 1));
        for (std::string value; std::getline(values, value, '|');) {
            if (condition[sign] == '>') value = "1";
            const std::string assignment = condition.substr(0, sign) + "=" + value;
            EXPECT_TRUE(setField(fields, assignment)) << field.name << " " << assignment;
            EXPECT_EQ(withoutEffectBy(fields, field), "") << field.name << " " << assignment;
        }
    }
    EXPECT_GT(conditions, 10);
    ASSERT_TRUE(setField(fields, "shake=none"));
    ASSERT_TRUE(setField(fields, "max_frames=0"));
    const auto idle = [&](const char* name) {
        return withoutEffectBy(fields, *std::ranges::find(fields, name, &Field::name));
    };
    EXPECT_EQ(idle("shake_hz"), "shake=none");
    EXPECT_EQ(idle("max_repeat_rate"), "max_frames=0");
    EXPECT_EQ(idle("fill"), "");
}

// A plan does not depend on parameters that only affect images and files; it depends on all others.
TEST(PlanParams, KnowWhatAPlanDependsOn) {
    const std::set<std::string> without_a_say = {"imu", "stereo", "picture", "light", "sensor"};
    const PlanParams standard;
    PlanParams params;
    const std::size_t count = listFields(params).size();
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < count; ++i) {
        PlanParams changed;
        const Field field = listFields(changed)[i];
        change(field);
        EXPECT_FALSE(changed == standard) << field.name;
        EXPECT_EQ(affectsOnlyImages(field.section), without_a_say.contains(field.section))
            << field.name;
        EXPECT_EQ(makeSamePlan(standard, changed), without_a_say.contains(field.section))
            << field.name;
        ++seen[field.section];
    }
    for (const std::string& section : without_a_say) EXPECT_GT(seen[section], 0) << section;
}

TEST(PlanParams, APresetSetsOthersAndWhatIsNamedBesideItChangesSingleOnes) {
    PlanParams params;
    // JSON sorts its names: k1 comes before sensor_preset there.
    ASSERT_TRUE(
        setFromJson(listFields(params), {{"sensor", {{"k1", 0.25}, {"sensor_preset", "webcam"}}}}));
    SensorParams expected = sensorPreset(SensorPreset::Webcam);
    expected.k1 = 0.25;
    EXPECT_EQ(params.sensor, expected);
    PlanParams again;
    ASSERT_TRUE(setFromJson(listFields(again), toJson(listFields(params))));
    EXPECT_EQ(again, params);
    ASSERT_TRUE(setField(listFields(params), "sensor_preset=ideal"));
    EXPECT_EQ(params.sensor, sensorPreset(SensorPreset::Ideal));

    ASSERT_TRUE(setFromJson(listFields(params),
                            {{"light", {{"exposure_ev", 1.5}, {"light_preset", "night"}}}}));
    LightParams night = lightPreset(LightPreset::Night);
    night.exposure_ev = 1.5;
    EXPECT_EQ(params.light, night);
}

}  // namespace
}  // namespace dollytrack::planning::plan_params_test
