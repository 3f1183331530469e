#pragma once

#include "engine/io/orientation/frame_evidence.h"
#include "engine/math/up_axis.h"

#include <string>
#include <vector>

namespace dollytrack {

/// What is measured of a scene to judge its unit, in source units.
struct UnitEvidence {
    /// The median longest side of a class of furniture, and its usual range in metres.
    struct Kind {
        int nyu40 = 0;
        double size = 0.0;
        double low_m = 0.0;
        double high_m = 0.0;
        [[nodiscard]] double fitIn(
            double unit_m) const;  // 1 inside the range, less the further outside
    };
    std::vector<Kind> kinds;
    double height = 0.0;         // of the core
    double storey_height = 0.0;  // from floor to floor where there are several, else the height
    double length = 0.0;         // of the core's longest side
};

/// `evidence_m`: metres per source unit where the evidence is in metres already.
UnitEvidence measureForUnit(const FrameEvidence& evidence, UpAxis up, double evidence_m = 1.0);

/// How believable one unit makes the sizes of room and furniture.
struct UnitScore {
    double score = 0.0;      // 0 to 1
    double furniture = 0.0;  // how well furniture alone fits; 0 without any
    std::string evidence;    // "room height 2.6 m, 5 kinds of furniture"
};
UnitScore scoreUnit(const UnitEvidence& evidence, double unit_m);

/// Whether the unit makes furniture and room too small or too large by a factor of 1.6, or the room
/// alone too low or too high to be one (1.8 to 6 m from floor to floor). Where three kinds of
/// furniture have about their usual size, a cut-away room is believed; where every kind has, so is a
/// high hall.
bool isUnitDoubtful(const UnitEvidence& evidence, double unit_m);

/// Metres per source unit as the median of votes: of each kind of furniture, the narrower its usual
/// range the weightier, and of the room's height. A usual unit where one is near, else two digits.
double likeliestUnit(const UnitEvidence& evidence);

}  // namespace dollytrack
