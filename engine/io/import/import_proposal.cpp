#include "engine/io/import/import_proposal.h"

#include "engine/io/orientation/frame_evidence.h"
#include "engine/io/orientation/unit_judgement.h"
#include "engine/io/orientation/up_judgement.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack {
namespace {

const UpAxis kWorldUp('z');

/// The axis of the file that points along an axis of the world; what was levelled lies askew.
UpAxis inFile(UpAxis in_world, const Scene& scene) {
    const Eigen::Vector3d along = scene.source_from_world.linear() * in_world.direction();
    Eigen::Index axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    return UpAxis("xyz"[axis], along[axis] < 0.0);
}

std::string upDoubt(UpAxis likelier, const Scene& scene) {
    return fmt::format(
        "the upward axis is doubtful: {} ({}) is up, but floors and what stands on them say {}",
        scene.report.up_axis, scene.report.up_source, likelier.text());
}

void doubtAxis(const FrameEvidence& evidence, const Scene& scene, ImportProposal& proposal) {
    const std::vector<UpEvidence> ranked = judgeUp(evidence);
    if (!contradicts(evidence, ranked, kWorldUp)) return;
    proposal.up_axis = inFile(ranked.front().axis, scene);
    proposal.up_doubt = upDoubt(*proposal.up_axis, scene);
}

void doubtUnit(const FrameEvidence& evidence, const Scene& scene, ImportProposal& proposal) {
    const double unit_m = scene.report.unit_m;
    // On its side nothing is as high as it looks.
    const UpAxis up = proposal.up_axis ? judgeUp(evidence).front().axis : kWorldUp;
    const UnitEvidence sizes = measureForUnit(evidence, up, unit_m);
    if (!isUnitDoubtful(sizes, unit_m)) return;
    const double likelier = likeliestUnit(sizes);
    if (likelier > 1.2 * unit_m || unit_m > 1.2 * likelier) proposal.unit_m = likelier;
    const bool by_file = scene.report.unit_source == "file";
    proposal.unit_doubt =
        fmt::format("the unit is doubtful: {}1 unit = {:.3g} m, which makes the {}",
                    by_file ? "the file says " : "", unit_m, scoreUnit(sizes, unit_m).evidence);
}

}  // namespace

ImportProposal proposeImport(const Scene& scene, bool classes_by_shape) {
    ImportProposal proposal;
    const bool axis_given = scene.report.up_source == "given";
    const bool unit_given = scene.report.unit_source == "given";
    if (axis_given && unit_given) return proposal;
    const FrameEvidence evidence = collectEvidence(scene, classes_by_shape);
    if (evidence.core.isEmpty()) return proposal;
    if (!axis_given) doubtAxis(evidence, scene, proposal);
    if (!unit_given) doubtUnit(evidence, scene, proposal);
    return proposal;
}

void proposeUp(UpAxis likelier, const Scene& scene, ImportProposal& proposal) {
    proposal = {};
    proposal.up_axis = likelier;
    proposal.up_doubt = upDoubt(likelier, scene);
}

std::string settingsText(const ImportProposal& proposal) {
    std::string text;
    if (proposal.unit_m) text = fmt::format("1 unit = {:.4g} m", *proposal.unit_m);
    if (proposal.unit_m && proposal.up_axis) text += ", ";
    if (proposal.up_axis) text += proposal.up_axis->text() + " up";
    return text;
}

std::vector<std::string> describe(const ImportProposal& proposal) {
    std::vector<std::string> lines;
    if (!proposal.up_doubt.empty()) {
        lines.push_back(
            fmt::format("{}; likelier is --up {}", proposal.up_doubt, proposal.up_axis->text()));
    }
    if (!proposal.unit_doubt.empty()) {
        lines.push_back(proposal.unit_doubt +
                        (proposal.unit_m
                             ? fmt::format("; likelier is --unit {:.4g}", *proposal.unit_m)
                             : "; give metres per unit if it is wrong"));
    }
    return lines;
}

}  // namespace dollytrack
