#pragma once

#include "engine/io/orientation/frame_evidence.h"
#include "engine/math/up_axis.h"

#include <array>
#include <string>
#include <vector>

namespace dollytrack {

/// The range of plausible room heights, m; outside it, the unit is doubtful.
inline constexpr double kLowestRoom_m = 1.8;
inline constexpr double kHighestRoom_m = 6.0;

/// Common units of scene files, m.
inline constexpr std::array<double, 5> kUsualUnits = {1.0, 0.01, 0.001, 0.0254, 0.3048};

/// Measurements of a scene for estimating its unit, in source units.
struct UnitEvidence {
    /// The median longest side of a class of furniture, and its typical range in metres.
    struct Kind {
        int nyu40 = 0;
        double size = 0.0;
        double low_m = 0.0;
        double high_m = 0.0;
        [[nodiscard]] double fitIn(
            double unit_m) const;  // 1 inside the range, decreasing with the distance from it
    };
    std::vector<Kind> kinds;
    double height = 0.0;         // of the core
    double storey_height = 0.0;  // median distance between floors; `height` for a single storey
    double length = 0.0;         // of the core's longest side
    double room_height = 0.0;    // largest distance between levels of floors and ceilings; 0: no
                                 // closed room
};

/// Measures `evidence`. If it is in metres already, `evidence_m` is the number of metres per source
/// unit.
UnitEvidence measureForUnit(const FrameEvidence& evidence, UpAxis up, double evidence_m = 1.0);

/// How plausible the sizes of room and furniture are with a unit.
struct UnitScore {
    double score = 0.0;      // 0..1
    double furniture = 0.0;  // 0..1, of furniture only; 0 without furniture
    std::string evidence;    // "room height 2.6 m, 5 kinds of furniture"
};
/// The height of the room and the furniture of unusual size, for messages: "the room 5.7 m high
/// (longest sides of furniture: table 3.9 m, chair 2.1 m)".
std::string describeSizes(const UnitEvidence& evidence, double unit_m);

/// UnitScore::furniture if all kinds have about their usual sizes.
inline constexpr double kUsualSizes = 0.95;
UnitScore scoreUnit(const UnitEvidence& evidence, double unit_m);

/// Whether furniture and room are too small or too large by a factor of 1.6 with this unit, or the
/// room's height is implausible (below 1.8 m, or above 6 m between floors). Unless a room with
/// floor and ceiling is too low, the height is ignored if at least three kinds of furniture
/// together have about their typical size. If each of them has and the storey height is plausible,
/// the unit is never doubtful. With three kinds of furniture, rooms up to 4.5 m are usual. Levels
/// nearer to each other than 70 % of the height are not taken for floor and ceiling.
bool isUnitDoubtful(const UnitEvidence& evidence, double unit_m);

/// The most likely number of metres per source unit: the weighted median over the kinds of
/// furniture (a narrower typical range has more weight) and the room's height. Rounded to a common
/// unit if one is near, otherwise to two digits.
double likeliestUnit(const UnitEvidence& evidence);

}  // namespace dollytrack
