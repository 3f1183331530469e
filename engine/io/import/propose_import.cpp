#include "engine/io/import/propose_import.h"

#include "engine/io/orientation/frame_evidence.h"
#include "engine/io/orientation/unit_estimate.h"
#include "engine/io/orientation/up_axis_scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace dollytrack {
namespace {

const UpAxis kWorldUp('z');
// With hardly any evidence a wrong axis leads by at most this; see scoreUpAxes().
constexpr double kUnconfirmingLead = 0.4;

/// The file's axis nearest to an axis of the world; levelled scenes are rotated by any angle.
UpAxis inFile(UpAxis in_world, const Scene& scene) {
    const Eigen::Vector3d along = scene.source_from_world.linear() * in_world.direction();
    Eigen::Index axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    return UpAxis("xyz"[axis], along[axis] < 0.0);
}

std::string upDoubt(UpAxis likelier, const Scene& scene) {
    return fmt::format(
        "the upward axis is doubtful: {} ({}) is up, but floors and the objects on them indicate "
        "{}",
        scene.report.up_axis, scene.report.up_source, likelier.text());
}

void doubtAxis(const FrameEvidence& evidence, const Scene& scene, ImportProposal& proposal) {
    const std::vector<UpEvidence> ranked = scoreUpAxes(evidence);
    constexpr double kLead = 1.0;
    constexpr double kLeadAgainstFound = 1.5;  // both by evidence, once with the file's parts
    const double lead = scene.report.up_source == "file"
                            ? leadAgainstFormat(ranked.front().axis, kWorldUp, kLead)
                            : kLeadAgainstFound;
    if (!contradicts(evidence, ranked, kWorldUp, lead)) {
        proposal.up_unconfirmed = leadOf(ranked, kWorldUp) <= kUnconfirmingLead;
        return;
    }
    proposal.up_axis = inFile(ranked.front().axis, scene);
    proposal.up_doubt = upDoubt(*proposal.up_axis, scene);
}

/// The unit to propose if only the room's size is known. A moderate difference proposes none,
/// because halls and dioramas are not unusual. An enormous one proposes the nearest common unit, if
/// one is near.
std::optional<double> unitByRoomAlone(double unit_m, double likelier) {
    constexpr double kModerate = 2.5;
    constexpr double kEnormous = 100.0;
    const double ratio = std::max(unit_m / likelier, likelier / unit_m);
    if (ratio < kModerate) return std::nullopt;
    if (ratio < kEnormous) return likelier;
    const auto distance = [&](double unit) { return std::abs(std::log(unit / likelier)); };
    const double usual = *std::ranges::min_element(kUsualUnits, std::less(), distance);
    return distance(usual) < std::log(kModerate) ? usual : likelier;
}

/// Whether the targets reach only into the lower part of the building, as in one with a high roof.
bool isHighAboveTargets(const Scene& scene) {
    constexpr double kLowerPart = 0.4;
    double top = scene.room_bounds.min().z();
    for (const Object& object : scene.objects) {
        if (object.role != Role::Target) continue;
        top = std::max(top, object.box.center.z() + object.box.half_size.z());
    }
    return top - scene.room_bounds.min().z() < kLowerPart * scene.room_bounds.sizes().z();
}

void doubtUnit(const FrameEvidence& evidence, const Scene& scene, ImportProposal& proposal) {
    const double unit_m = scene.report.unit_m;
    // With a wrong up axis, measured heights are not heights.
    const UpAxis up = proposal.up_axis ? scoreUpAxes(evidence).front().axis : kWorldUp;
    UnitEvidence sizes = measureForUnit(evidence, up, unit_m);
    // The core leaves out the highest of few objects, such as a cupboard between low walls.
    const double whole = scene.room_bounds.sizes().z() / unit_m;
    if (up == kWorldUp && sizes.room_height == 0.0 && sizes.height * unit_m < kLowestRoom_m &&
        whole * unit_m >= kLowestRoom_m && whole * unit_m <= kHighestRoom_m) {
        sizes.height = sizes.storey_height = whole;
    }
    if (!isUnitDoubtful(sizes, unit_m)) return;
    const UnitScore score = scoreUnit(sizes, unit_m);
    const double likelier = likeliestUnit(sizes);
    // A high hall is doubtful, but a smaller unit does not suit furniture of usual sizes.
    const bool furniture_fits =
        sizes.kinds.size() >= 3 && score.furniture >= kUsualSizes && likelier < unit_m;
    const bool differs = likelier > 1.2 * unit_m || unit_m > 1.2 * likelier;
    const bool high = likelier < unit_m && isHighAboveTargets(scene);
    if (differs && !furniture_fits && !high) {
        proposal.unit_m = sizes.kinds.empty() ? unitByRoomAlone(unit_m, likelier) : likelier;
    }
    const bool by_file = scene.report.unit_source == "file";
    proposal.unit_doubt =
        fmt::format("the unit is doubtful: {}1 unit = {:.3g} m, which makes {}",
                    by_file ? "the file says " : "", unit_m, describeSizes(sizes, unit_m));
}

}  // namespace

ImportProposal proposeImport(const Scene& scene, const FrameChoice& frame, bool classes_by_shape) {
    ImportProposal proposal;
    const bool unit_given = scene.report.unit_source == "given";
    if (!frame.up_is_certain || !unit_given) {
        const FrameEvidence evidence = collectEvidence(scene, classes_by_shape);
        if (!frame.up_is_certain && !evidence.core.isEmpty()) doubtAxis(evidence, scene, proposal);
        if (!unit_given && !evidence.core.isEmpty()) doubtUnit(evidence, scene, proposal);
    }
    if (frame.likelier_up && proposal.up_doubt.empty()) {
        // Heights measured along the wrong axis are no evidence for the unit.
        proposal = {};
        proposal.up_axis = frame.likelier_up;
        proposal.up_doubt = upDoubt(*frame.likelier_up, scene);
    } else if (frame.other_unit_m && !proposal.up_axis) {
        proposal.unit_doubt = frame.unit_doubt;
        proposal.unit_m = frame.other_unit_m;
    } else if (proposal.unit_doubt.empty() || (!frame.unit_doubt.empty() && !proposal.unit_m)) {
        proposal.unit_doubt = frame.unit_doubt;
    }
    return proposal;
}

}  // namespace dollytrack
