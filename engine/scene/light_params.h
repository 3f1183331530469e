#pragma once

#include "engine/core/field_list.h"

namespace dollytrack {

/// Sets of settings that belong together. Neutral is lamps and a little daylight without a sun, in
/// any room the same.
enum class LightPreset { Neutral, Day, Evening, Night, Overcast };

/// What a variation is drawn for: once, or again for each frame what needs no other shadows.
enum class LightVaries { Scene, Frame };

/// The light that colour pictures are made in; depth, labels and all else are the same. Strengths
/// are shares of what the neutral light has, the sun's of a clear noon. How bright a picture comes
/// out follows the light in the rooms and exposure_ev.
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
                     "Sets time, strengths, lamps' temperature and exposure; what is named beside "
                     "it changes single ones"});
    visit("time_of_day_h", p.time_of_day_h,
          FieldInfo{0, 24, "h",
                    "Height and colour of the sun, brightness of the sky: 6 is sunrise, 12 noon, "
                    "18 sunset"});
    visit("sun_azimuth_deg", p.sun_azimuth_deg,
          FieldInfo{-360, 360, "deg",
                    "Where the sun stands, from the world's x axis towards its y axis"});
    visit("sun_strength", p.sun_strength,
          FieldInfo{0, 10, "", "Direct sun through windows: 1 is a clear day's, 0 none"});
    visit("sky_strength", p.sky_strength,
          FieldInfo{0, 20, "", "The sky's light through windows; 1 as in the neutral light"});
    visit("lamp_strength", p.lamp_strength,
          FieldInfo{0, 10, "", "Lamps and what else shines by itself; 1 as in the neutral light"});
    visit("lamp_temperature_K", p.lamp_temperature_K,
          FieldInfo{0,
                    20000,
                    "K",
                    "Colour of the lamps as a black body's, warm from 2700; 0 as in the neutral "
                    "light",
                    {},
                    1000});
    visit("own_lamps", p.own_lamps,
          FieldInfo{0, 10, "",
                    "The light of the scene's own lamps that stand, or hang beside a room's "
                    "middle, times lamp_strength: 0 none"});
    visit("exposure_ev", p.exposure_ev,
          FieldInfo{-10, 10, "EV", "Brighter than the automatic exposure by powers of two"});
    visit("light_variation", p.light_variation,
          FieldInfo{0, 1, "",
                    "Draws time, sun, strengths, temperature, exposure and, a little, colour and "
                    "roughness of materials around what is set: 0 none, 1 the widest"});
    visit("light_varies", p.light_varies,
          ChoiceInfo{{"scene", "frame"},
                     "What is drawn for: the scene, or each frame anew its strengths of sun, sky "
                     "and lamps, temperature and exposure; time, azimuth and materials stay the "
                     "scene's, and so does the light that the editor shows"});
    visit("light_seed", p.light_seed, FieldInfo{0, 2e9, "", "Of the variation"});
}

/// The values of a preset; what it does not set (azimuth, variation, seed) is as by default.
[[nodiscard]] LightParams lightPreset(LightPreset preset);

/// Where light_preset is set in the list, from now on all is set in `params` that belongs to it.
void letLightPresetSetOthers(FieldList& fields, LightParams& params);

/// The fields, for files. Points into `params`.
[[nodiscard]] FieldList listLightFields(LightParams& params);

}  // namespace dollytrack
