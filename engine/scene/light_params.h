#pragma once

#include "engine/core/field_list.h"

namespace dollytrack {

/// Predefined light settings. Neutral has lamps and a little daylight but no sun, and looks the
/// same in any room.
enum class LightPreset { Neutral, Day, Evening, Night, Overcast };

/// How often the random variation is drawn: once for the scene, or anew for each frame. Per frame,
/// only values that leave shadows unchanged vary.
enum class LightVaries { Scene, Frame };

/// The light of colour images; depth and labels do not depend on it. Strengths are relative to the
/// neutral light, that of the sun to a clear noon. The exposure adapts to the light in the rooms;
/// exposure_ev is added to it.
struct LightParams {
    LightPreset light_preset = LightPreset::Neutral;
    double time_of_day_h = 12.0;
    double sun_azimuth_deg = 225.0;
    double sun_strength = 0.0;
    double sky_strength = 1.0;
    double lamp_strength = 1.0;
    double lamp_temperature_K = 0.0;
    double own_lamps = 1.0;
    double exposure_ev = 0.0;
    double light_variation = 0.0;
    LightVaries light_varies = LightVaries::Scene;
    int light_seed = 1;

    bool operator==(const LightParams&) const = default;
};

template <class Params, class Visitor>
void visitLightParams(Params& p, Visitor&& visit) {
    visit("light_preset", p.light_preset,
          ChoiceInfo{{"neutral", "day", "evening", "night", "overcast"},
                     "Lighting: sets time, strengths, lamp temperature and exposure; parameters "
                     "set explicitly override it"});
    visit("time_of_day_h", p.time_of_day_h,
          FieldInfo{0, 24, "h",
                    "Time of day, which sets the sun's height and colour and the sky's brightness: "
                    "6: sunrise, 12: noon, 18: sunset"});
    visit("sun_azimuth_deg", p.sun_azimuth_deg,
          FieldInfo{-360, 360, "deg",
                    "Direction of the sun, measured from the world's x axis towards its y axis"});
    visit("sun_strength", p.sun_strength,
          FieldInfo{0, 10, "", "Direct sunlight through windows; 1: a clear day, 0: none"});
    visit("sky_strength", p.sky_strength,
          FieldInfo{0, 20, "", "Skylight through windows; 1: as in the neutral light"});
    visit("lamp_strength", p.lamp_strength,
          FieldInfo{0, 10, "",
                    "Light of lamps and other emitting surfaces; 1: as in the neutral light"});
    visit("lamp_temperature_K", p.lamp_temperature_K,
          FieldInfo{0,
                    20000,
                    "K",
                    "Colour temperature of the lamps, 2700 is warm; 0: as in the neutral light",
                    {},
                    1000});
    visit("own_lamps", p.own_lamps,
          FieldInfo{0, 10, "",
                    "Light of the scene's lamps that stand or hang away from a room's middle, as a "
                    "factor on lamp_strength; 0: none"});
    visit("exposure_ev", p.exposure_ev,
          FieldInfo{-10, 10, "EV",
                    "Added to the automatic exposure; each step doubles the brightness"});
    visit(
        "light_variation", p.light_variation,
        FieldInfo{0, 1, "",
                  "Random variation of time, sun, strengths, temperature and exposure around their "
                  "values and, slightly, of material colour and roughness; 0: none, 1: widest"});
    visit(
        "light_varies", p.light_varies,
        ChoiceInfo{{"scene", "frame"},
                   "Scope of light_variation: scene: the same random values in all frames; frame: "
                   "new sun, sky and lamp strengths, temperature and exposure in each frame. Time, "
                   "azimuth, materials and the editor's view always have the scene's values",
                   "light_variation>0"});
    visit(
        "light_seed", p.light_seed,
        FieldInfo{0, 2e9, "", "Random seed of the light variation"}.onlyWith("light_variation>0"));
}

/// The values of a preset. Values that presets do not set (azimuth, variation, seed) are the
/// defaults.
[[nodiscard]] LightParams lightPreset(LightPreset preset);

/// Makes the field light_preset of the list, when it is set, also set all values of the preset in
/// `params`.
void letLightPresetSetOthers(FieldList& fields, LightParams& params);

/// The list of all fields, for reading and writing. It points into `params`.
[[nodiscard]] FieldList listLightFields(LightParams& params);

}  // namespace dollytrack
