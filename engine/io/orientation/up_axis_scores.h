#pragma once

#include "engine/io/orientation/frame_evidence.h"
#include "engine/math/up_axis.h"

#include <array>
#include <vector>

namespace dollytrack {

/// Evidence for a direction being up. Each value is from -1 (against) to 1 (for); 0 if unknown.
struct UpEvidence {
    UpAxis axis;
    double named = 0.0;     // floors, mats and doors are at the bottom, ceilings at the top
    double level = 0.0;     // share of surfaces perpendicular to it: floors, ceilings, table tops
    double lowest = 0.0;    // the room's extent along it is the smallest
    double standing = 0.0;  // the lower ends of objects, not the upper ones, are at equal heights
    double resting = 0.0;   // objects rest on others and do not hang from them
    double support = 0.0;   // another object's surface is right below the lowest points of objects
    double round = 0.0;     // cups, pots and lamps are rotationally symmetric about it
    double tops = 0.0;      // the tops of furniture are in the lower half of the room
    double floor = 0.0;     // there is a floor rather than a ceiling
    double shapes = 0.0;    // seats and beds have more area in their lower part, tables above
    double score = 0.0;     // weighted sum of all values
};

/// All six directions by decreasing score. In furnished rooms the right direction leads by 3 or
/// more, in sparse rooms by 1; with hardly any evidence a wrong one leads by at most 0.4.
std::vector<UpEvidence> scoreUpAxes(const FrameEvidence& evidence);

/// How far the score of `axis` is above the best of the other five; negative if below. `ranked`:
/// from scoreUpAxes().
[[nodiscard]] double leadOf(const std::vector<UpEvidence>& ranked, UpAxis axis);

/// The smallest lead with which `best` is proposed in place of the axis that a file's format
/// specifies: `otherwise`, but more if the file would be upside down. Few files are, and lamps that
/// hang from a ceiling resemble objects on a floor.
[[nodiscard]] double leadAgainstFormat(UpAxis best, UpAxis of_file, double otherwise);

/// Whether the best direction leads `axis` by at least `lead`. Always false for fewer than four
/// objects, which may lie on their side. Also false if the best direction is the opposite one, no
/// names of floors and ceilings tell the two apart, and fewer than four objects are not sides of
/// the room: an empty room looks the same upside down.
[[nodiscard]] bool contradicts(const FrameEvidence& evidence, const std::vector<UpEvidence>& ranked,
                               UpAxis axis, double lead = 1.0);

}  // namespace dollytrack
