#include "engine/io/orientation/frame_guess.h"

#include "engine/io/orientation/frame_evidence.h"
#include "engine/io/orientation/unit_estimate.h"
#include "engine/io/orientation/up_axis_scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack {
namespace {

constexpr double kClearLead = 0.5;     // smallest difference of up axis scores without a doubt
constexpr double kDoubtfulLead = 0.7;  // lead from which another axis is proposed
constexpr double kOverwhelming = 2.0;  // lead from which the file's axis is ignored

/// Prior score of an axis: most files have y up or z up.
double habit(UpAxis axis) {
    const double letter = axis.letter == 'x' ? -0.3 : axis.letter == 'y' ? 0.05 : 0.0;
    return letter - (axis.negative ? 0.3 : 0.0);
}

/// The six axes by decreasing score, including the prior.
std::vector<UpEvidence> rankAxes(const FrameEvidence& evidence) {
    std::vector<UpEvidence> ranked = scoreUpAxes(evidence);
    for (UpEvidence& one : ranked) one.score += habit(one.axis);
    std::ranges::stable_sort(ranked, std::greater(), &UpEvidence::score);
    return ranked;
}

/// rankAxes() with the right way up first unless the evidence for upside down is strong: few files
/// are, and in a room without furniture rounding errors would decide.
std::vector<UpEvidence> rankUpright(const FrameEvidence& evidence) {
    std::vector<UpEvidence> ranked = rankAxes(evidence);
    const UpAxis best = ranked[0].axis;
    if (!best.negative) return ranked;
    const auto upright = std::ranges::find(ranked, UpAxis(best.letter, false), &UpEvidence::axis);
    if (!contradicts(evidence, ranked, upright->axis, kDoubtfulLead)) {
        upright->score = ranked[0].score;
        std::rotate(ranked.begin(), upright, upright + 1);
    }
    return ranked;
}

/// Uses the file's axis unless the evidence against it is overwhelming. The axis of a dataset or
/// home is always used, because it is not an exporter's setting. proposeImport() reports smaller
/// doubts.
void weighFileAxis(const RawScene& raw, const FrameEvidence& evidence, FrameChoice& choice) {
    choice.up_axis = raw.file_up_axis;
    choice.up_source = "file";
    choice.up_is_certain = raw.up_is_certain;
    if (!raw.objects.empty() || raw.up_is_certain) return;
    const std::vector<UpEvidence> ranked = scoreUpAxes(evidence);
    if (!contradicts(evidence, ranked, raw.file_up_axis, kOverwhelming)) {
        const UpAxis best = ranked.front().axis;
        if (contradicts(evidence, ranked, raw.file_up_axis,
                        leadAgainstFormat(best, raw.file_up_axis, kDoubtfulLead))) {
            choice.likelier_up = best;
        }
        return;
    }
    choice.up_axis = ranked.front().axis;
    choice.up_source = "found by floors and the objects on them, unlike the file";
    choice.warnings.push_back(
        fmt::format("the file says {0} is up, but floors and the objects on them indicate {1}, "
                    "which was used; pass --up {0} to keep the file's axis",
                    raw.file_up_axis.text(), choice.up_axis.text()));
}

void chooseUp(const RawScene& raw, const FrameEvidence& evidence, std::optional<UpAxis> given,
              UpAxis usual_up, FrameChoice& choice) {
    if (given) {
        choice.up_axis = *given;
        choice.up_source = "given";
        choice.up_is_certain = true;
        return;
    }
    if (raw.file_up_axis.isAxis()) return weighFileAxis(raw, evidence, choice);
    std::vector<UpEvidence> ranked = rankUpright(evidence);
    choice.up_source = "found by floors, ceilings and the objects on them";
    const auto usual = std::ranges::find(ranked, usual_up, &UpEvidence::axis);
    if (usual != ranked.end() && usual != ranked.begin() &&
        ranked[0].score - usual->score < kClearLead) {
        choice.up_source = "usual for the format";
        std::rotate(ranked.begin(), usual, usual + 1);
    }
    choice.up_axis = ranked[0].axis;
    const std::string axis = choice.up_axis.text();
    const auto other = std::ranges::find_if(
        ranked, [&](const UpEvidence& one) { return one.axis.letter != choice.up_axis.letter; });
    if (std::abs(ranked[0].score - other->score) < kClearLead) {
        choice.warnings.push_back(fmt::format(
            "the upward axis is doubtful: by floors, ceilings and the objects on them, "
            "{} and {} are about equally likely; {} is used, pass --up {} if it is wrong",
            axis, other->axis.text(), axis, other->axis.text()));
    } else if (choice.up_axis.negative) {
        choice.warnings.push_back(
            fmt::format("the file is upside down for its format: floors and the objects on them "
                        "indicate that {} is up; pass --up {} if not",
                        axis, axis.substr(1)));
    }
}

/// If the best usual unit makes the room lower than 1.8 m, takes the most likely unit of any size
/// instead, provided that it scores clearly better.
void preferStandingHeight(const UnitEvidence& evidence, double& unit, UnitScore& score) {
    constexpr double kLowest_m = 1.8;
    constexpr double kUnusual = 0.8;
    if (evidence.height * unit >= kLowest_m) return;
    const double likeliest = likeliestUnit(evidence);
    const UnitScore another = scoreUnit(evidence, likeliest);
    if (evidence.height * likeliest < kLowest_m || kUnusual * another.score <= score.score) return;
    unit = likeliest;
    score = another;
}

void chooseUnit(const RawScene& raw, const FrameEvidence& all, std::optional<double> given,
                FrameChoice& choice) {
    if (given) {
        choice.unit_m = *given;
        choice.unit_source = "given";
        return;
    }
    const UnitEvidence evidence = measureForUnit(all, choice.up_axis);
    // The unit of a dataset or home is not an exporter's setting, so it is always used.
    if (raw.file_unit_m && !raw.objects.empty()) {
        choice.unit_m = *raw.file_unit_m;
        choice.unit_source = "file";
        return;
    }
    constexpr double kDoubtfulScore = 0.35;
    constexpr double kBelievable = 0.9;  // score from which a file's unit is not questioned
    double best_unit = 1.0;
    UnitScore best;
    best.score = -1.0;
    const UnitScore in_metres = scoreUnit(evidence, 1.0);
    bool maybe_feet = false;
    for (const double unit : kUsualUnits) {
        UnitScore score = scoreUnit(evidence, unit);
        if (unit == 0.0254 || unit == 0.3048) score.score *= 0.8;  // inches and feet are rarer
        // A hall in metres looks like a room in feet; only furniture can distinguish them.
        if (unit == 0.3048 && !(score.furniture > in_metres.furniture)) {
            maybe_feet = best_unit == 1.0 && score.score > best.score;
            continue;
        }
        if (score.score > best.score) {
            best = score;
            best_unit = unit;
        }
    }
    if (raw.file_unit_m) {
        const double unit = *raw.file_unit_m;
        const UnitScore by_file = scoreUnit(evidence, unit);
        // Wrong units of exporters are more frequent than scenes of unusual size.
        bool replaces =
            by_file.score < 0.15 && best.score >= 0.5 && best.score >= 3.0 * by_file.score;
        UnitScore another = best;
        double another_unit = best_unit;
        preferStandingHeight(evidence, another_unit, another);
        // Without a ceiling, low walls make any unit doubtful.
        const bool closed = evidence.room_height > 0.0;
        replaces = replaces && !(closed && isUnitDoubtful(evidence, another_unit));
        if (!replaces) {
            choice.unit_m = unit;
            choice.unit_source = "file";
            // Height alone does not suggest another unit, because a house may have several storeys.
            const bool another_fits_better = best_unit != unit && best.score > by_file.score;
            if (by_file.score < kDoubtfulScore ||
                (by_file.score < kBelievable && another_fits_better)) {
                choice.unit_doubt = fmt::format(
                    "the unit is doubtful: the file says 1 unit = {:.3g} m, which "
                    "makes {}",
                    unit, describeSizes(evidence, unit));
            }
            return;
        }
        best = another;
        best_unit = another_unit;
        choice.warnings.push_back(fmt::format(
            "the file says 1 unit = {:.3g} m, which makes {}; {:.3g} m was used instead", unit,
            describeSizes(evidence, unit), best_unit));
    }
    choice.unit_m = best_unit;
    choice.unit_source = "judged: " + best.evidence;
    if (maybe_feet) {
        choice.unit_doubt = "the unit is doubtful: this may be a hall in metres (" + best.evidence +
                            "), or a room in feet";
        // Feet are proposed only if they give a usual room height.
        constexpr double kLowest_m = 2.2;
        if (0.3048 * evidence.height >= kLowest_m) choice.other_unit_m = 0.3048;
    } else if (best.score < kDoubtfulScore) {
        choice.unit_doubt = "the unit is doubtful: no usual unit gives this scene a room's size";
    }
}

}  // namespace

Eigen::Affine3d FrameChoice::worldFromSource() const {
    Eigen::Affine3d world = Eigen::Affine3d::Identity();
    world.linear() = unit_m * up_axis.zUpFromSource();
    return world;
}

FrameChoice chooseFrame(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                        std::optional<double> given_unit_m, std::optional<UpAxis> given_up_axis,
                        UpAxis usual_up) {
    FrameChoice choice;
    if (given_unit_m && given_up_axis) {
        choice.unit_m = *given_unit_m;
        choice.up_axis = *given_up_axis;
        choice.unit_source = choice.up_source = "given";
        choice.up_is_certain = true;
        return choice;
    }
    const FrameEvidence evidence = collectEvidence(raw, drafts);
    chooseUp(raw, evidence, given_up_axis, usual_up, choice);
    chooseUnit(raw, evidence, given_unit_m, choice);
    return choice;
}

}  // namespace dollytrack
