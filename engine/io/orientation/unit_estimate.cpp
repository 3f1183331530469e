#include "engine/io/orientation/unit_estimate.h"

#include "engine/core/text_lists.h"
#include "engine/math/quantile.h"
#include "engine/scene/furniture_sizes.h"
#include "engine/scene/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace dollytrack {
namespace {

constexpr double kUsualRoomLow_m = 2.2;
constexpr double kUsualRoomHigh_m = 3.4;
constexpr double kHighRoom_m = 4.5;   // of offices, schools and shops
constexpr double kUnusualFit = 0.75;  // of UnitEvidence::Kind::fitIn()
constexpr double kFactor = 1.6;     // largest deviation of furniture and room sizes from usual ones
constexpr double kRoomShare = 0.3;  // of the height; the sides of a thick floor are nearer together
constexpr double kHandleShare = 0.15;  // of the height; smaller doors are only their handles
constexpr double kFloorShare = 0.3;    // smallest area of a storey, relative to the largest floor

/// 1 inside the range; outside it, the inverse square of the ratio to the nearer end.
double believable(double length, double low, double high) {
    if (!(length > 0.0)) return 0.0;
    const double off = length < low ? low / length : length > high ? length / high : 1.0;
    return 1.0 / (off * off);
}

/// The distances from one storey's floor to the next. Floor and ceiling of a single room are two
/// levels and one distance.
std::vector<double> storeyHeights(const LevelAreas& levels, double height) {
    const double largest = *std::ranges::max_element(levels.floors);
    std::vector<double> gaps;
    double last = -1.0;
    for (std::size_t i = 0; i < levels.floors.size(); ++i) {
        if (!(levels.floors[i] > kFloorShare * largest)) continue;
        const double at = height * (static_cast<double>(i) + 0.5) / LevelAreas::kSteps;
        // Nearby levels are the two sides of a slab.
        if (last >= 0.0 && at - last > 0.15 * height) gaps.push_back(at - last);
        last = at;
    }
    return gaps;
}

struct Vote {
    double unit_m;
    double weight;
};

double weightedMedian(std::vector<Vote> votes) {
    std::ranges::sort(votes, std::less(), &Vote::unit_m);
    double total = 0.0;
    for (const Vote& vote : votes) total += vote.weight;
    double sum = 0.0;
    for (const Vote& vote : votes) {
        sum += vote.weight;
        if (sum >= 0.5 * total) return vote.unit_m;
    }
    return 1.0;
}

/// The geometric centre of the units that bring a size into its usual range; narrow ranges have
/// more weight.
Vote voteOf(double size, double low_m, double high_m) {
    return {std::sqrt(low_m * high_m) / size, 1.0 / std::log(high_m / low_m)};
}

/// Weighted median of all votes, in metres per unit. `highest_m`: of usual rooms; 0: only furniture
/// votes.
double medianVote(const UnitEvidence& evidence, double highest_m) {
    std::vector<Vote> votes;
    for (const auto& kind : evidence.kinds) {
        votes.push_back(voteOf(kind.size, kind.low_m, kind.high_m));
    }
    if (highest_m > 0.0 && evidence.storey_height > 0.0) {
        votes.push_back(voteOf(evidence.storey_height, kUsualRoomLow_m, highest_m));
    }
    return weightedMedian(std::move(votes));
}

}  // namespace

double UnitEvidence::Kind::fitIn(double unit_m) const {
    return believable(size * unit_m, low_m, high_m);
}

UnitEvidence measureForUnit(const FrameEvidence& evidence, UpAxis up, double evidence_m) {
    UnitEvidence result;
    result.height = evidence.core.sizes()[up.index()] / evidence_m;
    result.length = evidence.core.sizes().maxCoeff() / evidence_m;
    for (const FurnitureSize& usual : kFurnitureSizes) {
        std::vector<double> sizes;
        for (const MeasuredObject& object : evidence.objects) {
            if (object.nyu40 != usual.nyu40) continue;
            if (object.building && usual.nyu40 != kNyuDoor) continue;
            const double size = object.box.sizes().maxCoeff() / evidence_m;
            // A door higher than the building is all its doors in one mesh, a tiny one is a handle.
            const bool like_door = size > kHandleShare * result.height && size <= result.height;
            if (usual.nyu40 == kNyuDoor && !like_door) continue;
            sizes.push_back(size);
        }
        if (sizes.empty()) continue;
        const double size = upperMedian(std::move(sizes));
        if (size > 0.0) result.kinds.push_back({usual.nyu40, size, usual.low, usual.high});
    }
    std::vector<double> storeys = storeyHeights(evidence.levels[up.index()], result.height);
    const double gap = storeys.empty() ? 0.0 : *std::ranges::max_element(storeys);
    if (gap > kRoomShare * result.height) result.room_height = gap;
    result.storey_height = storeys.size() < 2 ? result.height : upperMedian(std::move(storeys));
    return result;
}

UnitScore scoreUnit(const UnitEvidence& evidence, double unit_m) {
    UnitScore result;
    const double height = evidence.height * unit_m;
    result.score =
        (2.0 * believable(height, 2.0, 4.0) + believable(evidence.length * unit_m, 2.5, 25.0)) /
        3.0;
    result.evidence = fmt::format("room height {:.3g} m", height);
    if (evidence.kinds.empty()) return result;
    const auto kinds = static_cast<double>(evidence.kinds.size());
    for (const auto& kind : evidence.kinds) result.furniture += kind.fitIn(unit_m) / kinds;
    // A single kind is unreliable (an unusual model, or all lamps in one node); several kinds are
    // reliable.
    const double weight = 2.0 * kinds / (kinds + 2.0);
    result.score = (result.score + weight * result.furniture) / (1.0 + weight);
    result.evidence += fmt::format(", {} {} of furniture", kinds, kinds == 1 ? "kind" : "kinds");
    return result;
}

std::string describeSizes(const UnitEvidence& evidence, double unit_m) {
    constexpr std::size_t kShown = 4;
    std::vector<std::string> unusual;
    for (const auto& kind : evidence.kinds) {
        if (kind.fitIn(unit_m) >= kUnusualFit) continue;
        unusual.push_back(fmt::format("{} {:.2g} m", nyu40Name(kind.nyu40), kind.size * unit_m));
    }
    std::string furniture;
    if (!unusual.empty()) {
        furniture = fmt::format(" (longest sides of furniture: {})", listOf(unusual, kShown));
    } else if (!evidence.kinds.empty()) {
        furniture = ", with furniture of usual size";
    }
    const bool storeys = evidence.storey_height < 0.7 * evidence.height;
    return fmt::format("the {} {:.3g} m high{}", storeys ? "building" : "room",
                       evidence.height * unit_m, furniture);
}

bool isUnitDoubtful(const UnitEvidence& evidence, double unit_m) {
    const auto near = [&](double likelier) {
        return likelier < kFactor * unit_m && unit_m < kFactor * likelier;
    };
    const double storey_m = evidence.storey_height * unit_m;
    // Levels that are nearer to each other may be those of tables.
    constexpr double kWholeHeight = 0.7;
    if (evidence.room_height > kWholeHeight * evidence.height &&
        evidence.room_height * unit_m < kLowestRoom_m) {
        return true;
    }
    if (evidence.kinds.size() >= 3 && storey_m >= kLowestRoom_m && storey_m <= kHighestRoom_m &&
        scoreUnit(evidence, unit_m).furniture >= kUsualSizes) {
        return false;
    }
    const bool usual_furniture =
        !evidence.kinds.empty() &&
        std::ranges::all_of(evidence.kinds, [&](const UnitEvidence::Kind& kind) {
            return kind.fitIn(unit_m) >= kUnusualFit;
        });
    if (usual_furniture && storey_m >= kUsualRoomLow_m && storey_m <= kHighRoom_m) return false;
    // A single class of furniture is weak evidence: it may be a part or a toy. A room of usual
    // height outweighs it.
    const double height_m = evidence.height * unit_m;
    if (evidence.kinds.size() == 1 && height_m >= kUsualRoomLow_m && height_m <= kUsualRoomHigh_m) {
        return false;
    }
    constexpr std::size_t kEnoughKinds = 3;
    const bool furnished = evidence.kinds.size() >= kEnoughKinds;
    const bool may_be_high = furnished && storey_m <= kHighestRoom_m;
    if (!near(medianVote(evidence, may_be_high ? kHighRoom_m : kUsualRoomHigh_m))) return true;
    if (furnished && near(medianVote(evidence, 0.0))) return false;
    return evidence.height * unit_m < kLowestRoom_m ||
           evidence.storey_height * unit_m > kHighestRoom_m;
}

double likeliestUnit(const UnitEvidence& evidence) {
    const double unit = medianVote(evidence, kUsualRoomHigh_m);
    for (const double usual : kUsualUnits) {
        if (std::abs(std::log(unit / usual)) < std::log(1.25) && !isUnitDoubtful(evidence, usual)) {
            return usual;
        }
    }
    const double digits = std::pow(10.0, std::floor(std::log10(unit)) - 1.0);
    return std::round(unit / digits) * digits;
}

}  // namespace dollytrack
