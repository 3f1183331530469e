#include "engine/io/orientation/up_axis_scores.h"

#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace dollytrack {
namespace {

constexpr double kContact = 0.004;    // of the room's longest side: largest gap of touching objects
constexpr double kEnoughTops = 0.05;  // of all surface area: enough level furniture surfaces
constexpr double kEdge = 0.1;         // of the height: range of floor and ceiling at the ends
constexpr double kSupportWeight = 2.0;
constexpr float kRestsShare = 0.5F;  // of an object's lowest points on others
constexpr int kFewestObjects = 4;    // smallest number of objects for reliable evidence
constexpr int kFloorMat = 20;        // NYU40
constexpr int kBed = 4;
constexpr int kChair = 5;
constexpr int kSofa = 6;
constexpr int kTable = 7;
constexpr int kDesk = 14;
constexpr int kToilet = 33;
constexpr int kLamp = 35;
constexpr int kBathtub = 36;

/// An object's extent along the tested up direction.
struct Upright {
    const MeasuredObject* object = nullptr;
    int nyu40 = 0;              // 0 if the class was found only by shape
    bool building = false;      // by name
    bool should_stand = false;  // neither part of the building nor a lamp or light, which may hang
    double low = 0.0;
    double high = 0.0;
};

std::vector<Upright> standUp(const std::vector<MeasuredObject>& objects, UpAxis axis) {
    std::vector<Upright> all;
    for (const MeasuredObject& object : objects) {
        const double a = axis.sign() * object.box.min()[axis.index()];
        const double b = axis.sign() * object.box.max()[axis.index()];
        const int nyu40 = object.by_shape ? 0 : object.nyu40;
        const bool building = object.building && !object.by_shape;
        const bool stands = !building && nyu40 != kLamp && !object.shines;
        all.push_back({&object, nyu40, building, stands, std::min(a, b), std::max(a, b)});
    }
    return all;
}

/// Mean of votes 1 (yes) and -1 (no), damped towards 0 for few votes.
class Ballot {
  public:
    void add(double vote) {
        sum_ += vote;
        ++count_;
    }
    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] double mean() const { return sum_ / (count_ + 1.0); }

  private:
    double sum_ = 0.0;
    int count_ = 0;
};

double judgeNames(const std::vector<Upright>& all, double bottom, double height, int axis) {
    Ballot ballot;
    for (const Upright& one : all) {
        const int nyu = one.nyu40;
        const Eigen::Vector3d size = one.object->box.sizes();
        const bool thinnest = size[axis] <= size.minCoeff() + 1e-9 * size.maxCoeff();
        const double middle = (0.5 * (one.low + one.high) - bottom) / height;
        if (nyu == kNyuFloor || nyu == kFloorMat) {
            ballot.add(!thinnest ? -1.0 : middle < 0.4 ? 1.0 : middle > 0.6 ? -1.0 : 0.0);
        }
        if (nyu == kNyuCeiling) {
            ballot.add(!thinnest ? -1.0 : middle > 0.6 ? 1.0 : middle < 0.4 ? -1.0 : 0.0);
        }
        if (nyu == kNyuDoor) {
            const bool tall = size[axis] > 0.5 * size.maxCoeff();
            const double below = one.low - bottom;
            const double above = bottom + height - one.high;
            ballot.add(!tall ? -0.5 : below < above ? 0.5 : 0.0);
        }
    }
    return ballot.mean();
}

double judgeStanding(const std::vector<Upright>& all, double height) {
    std::vector<double> lows;
    std::vector<double> highs;
    for (const Upright& one : all) {
        if (!one.should_stand) continue;
        lows.push_back(one.low);
        highs.push_back(one.high);
    }
    if (lows.size() < 4) return 0.0;
    const double tolerance = 0.01 * height;
    const auto mostAlike = [&](std::vector<double>& values) {
        std::sort(values.begin(), values.end());
        std::size_t best = 0;
        for (std::size_t i = 0, j = 0; i < values.size(); ++i) {
            while (values[i] - values[j] > tolerance) ++j;
            best = std::max(best, i - j + 1);
        }
        return static_cast<double>(best);
    };
    return (mostAlike(lows) - 0.5 * mostAlike(highs)) / static_cast<double>(lows.size());
}

/// Whether most of the smaller one's footprint lies within the larger one's.
bool liesWithin(const MeasuredObject& small, const MeasuredObject& large, int axis) {
    double share = 1.0;
    for (const int i : {(axis + 1) % 3, (axis + 2) % 3}) {
        const double size = small.box.sizes()[i];
        const double common = std::min(small.box.max()[i], large.box.max()[i]) -
                              std::max(small.box.min()[i], large.box.min()[i]);
        if (common < 0.0 || size > large.box.sizes()[i]) return false;
        share *= size > 0.0 ? common / size : 1.0;
    }
    return share > 0.7;
}

/// Compares the objects that rest on a larger one with those that hang from one: 1 if all rest, -1
/// if all hang, and closer to 0 if few objects touch another at all.
double judgeResting(const std::vector<Upright>& all, int axis, double tolerance) {
    std::vector<const Upright*> by_high;
    std::vector<const Upright*> by_low;
    for (const Upright& one : all) {
        if (!one.should_stand) continue;
        by_high.push_back(&one);
        by_low.push_back(&one);
    }
    std::ranges::sort(by_high, std::less(), [](const Upright* one) { return one->high; });
    std::ranges::sort(by_low, std::less(), [](const Upright* one) { return one->low; });
    const auto touches = [&](const std::vector<const Upright*>& sorted, double at,
                             double Upright::*edge, const Upright& one) {
        auto it = std::ranges::lower_bound(sorted, at - tolerance, std::less(),
                                           [&](const Upright* other) { return other->*edge; });
        for (; it != sorted.end() && (*it)->*edge <= at + tolerance; ++it) {
            if (*it != &one && liesWithin(*one.object, *(*it)->object, axis)) return true;
        }
        return false;
    };
    Ballot ballot;
    for (const Upright* one : by_low) {
        const bool rests = touches(by_high, one->low, &Upright::high, *one);
        const bool hangs = touches(by_low, one->high, &Upright::low, *one);
        if (rests != hangs) ballot.add(rests ? 1.0 : -1.0);
    }
    // If only few objects touch others, the contacts are accidental.
    return ballot.mean() *
           std::min(1.0, 4.0 * ballot.count() / static_cast<double>(by_low.size() + 1));
}

/// The share of standing objects that rest on others, minus half the share that would rest if the
/// scene were upside down. Objects of nearly equal size count as one, so that many equal beams
/// below a ceiling, which rest on it if the scene is turned over, do not outvote the furniture.
double judgeSupport(const std::vector<Upright>& all, UpAxis axis) {
    constexpr double kEqual = 0.01;  // of an object's longest side
    constexpr std::size_t kFewestKinds = 3;
    struct Kind {
        double rests = 0.0;
        int count = 0;
    };
    std::map<std::array<long, 4>, Kind> kinds;
    int count = 0;
    for (const Upright& one : all) {
        if (!one.should_stand) continue;
        const SideSupport& support = one.object->support;
        const Eigen::Vector3d size = one.object->box.sizes();
        const double longest = std::max(size.maxCoeff(), 1e-12);
        std::array<long, 4> key = {std::lround(std::log(longest) / kEqual)};
        for (int i = 0; i < 3; ++i) key[i + 1] = std::lround(size[i] / longest / kEqual);
        Kind& kind = kinds[key];
        kind.rests += support[sideIndex(axis.index(), axis.negative)] >= kRestsShare;
        kind.rests -= 0.5 * (support[sideIndex(axis.index(), !axis.negative)] >= kRestsShare);
        ++kind.count;
        ++count;
    }
    if (count < kFewestObjects) return 0.0;
    double rests = 0.0;
    for (const auto& [key, kind] : kinds) rests += kind.rests / kind.count;
    return rests / static_cast<double>(std::max(kinds.size(), kFewestKinds));
}

/// Share of round objects (cups, pots, lamps) whose axis of symmetry is this one, damped when there
/// are few.
double judgeRound(const std::vector<Upright>& all, int axis) {
    constexpr double kCurved = 0.3;  // share of the surface that faces along none of the axes
    constexpr double kAlike = 0.03;
    constexpr double kUnlike = 0.1;
    double round = 0.0;
    double along = 0.0;
    for (const Upright& one : all) {
        const MeasuredObject& object = *one.object;
        const double level = object.facing[0] + object.facing[1] + object.facing[2];
        if (one.building || object.area - level < kCurved * object.area) continue;
        const Eigen::Vector3d size = object.box.sizes();
        for (int i = 0; i < 3; ++i) {
            const double a = size[(i + 1) % 3];
            const double b = size[(i + 2) % 3];
            const bool is_round = std::abs(a - b) < kAlike * std::max(a, b) &&
                                  std::abs(size[i] - a) > kUnlike * std::max(size[i], a);
            round += is_round;
            along += is_round && i == axis;
        }
    }
    return along / (round + 2.0);
}

double judgeShapes(const std::vector<Upright>& all, UpAxis axis) {
    Ballot ballot;
    for (const Upright& one : all) {
        const int nyu = one.nyu40;
        const bool heavy_above = nyu == kTable || nyu == kDesk;
        const bool heavy_below = nyu == kBed || nyu == kSofa || nyu == kToilet;
        if (!heavy_above && !heavy_below && nyu != kChair && nyu != kBathtub) continue;
        const double height = one.high - one.low;
        if (!(height > 0.0)) continue;
        if (heavy_above || heavy_below) {
            const double middle =
                (axis.sign() * one.object->centroid[axis.index()] - one.low) / height - 0.5;
            ballot.add(std::clamp((heavy_above ? 8.0 : -8.0) * middle, -1.0, 1.0));
        }
    }
    return ballot.mean();
}

UpEvidence judge(const FrameEvidence& evidence, UpAxis axis) {
    UpEvidence result;
    result.axis = axis;
    const int i = axis.index();
    const Eigen::Vector3d size = evidence.core.sizes();
    const double height = std::max(size[i], 1e-12);
    const double bottom = axis.negative ? -evidence.core.max()[i] : evidence.core.min()[i];
    const std::vector<Upright> all = standUp(evidence.objects, axis);

    double flat = 0.0;
    double total = 0.0;
    for (const MeasuredObject& object : evidence.objects) {
        total += object.area;
        flat += object.facing[i];
    }
    if (total > 0.0) result.level = flat / total;
    result.lowest = size[i] <= size.minCoeff() * 1.001 ? 1.0 : 0.0;
    result.named = judgeNames(all, bottom, height, i);
    result.standing = judgeStanding(all, height);
    result.resting = judgeResting(all, i, kContact * size.maxCoeff());
    result.support = judgeSupport(all, axis);
    result.round = judgeRound(all, i);
    result.shapes = judgeShapes(all, axis);

    const LevelAreas& levels = evidence.levels[i];
    double between = 0.0;
    double moment = 0.0;
    double low = 0.0;
    double high = 0.0;
    for (std::size_t step = 0; step < LevelAreas::kSteps; ++step) {
        double at = (static_cast<double>(step) + 0.5) / LevelAreas::kSteps;
        if (axis.negative) at = 1.0 - at;
        if (at < kEdge) low += levels.all[step];
        if (at > 1.0 - kEdge) high += levels.all[step];
        if (at < kEdge || at > 1.0 - kEdge) continue;
        between += levels.furniture[step];
        moment += at * levels.furniture[step];
    }
    // If there is hardly any level surface, it may be that of a moulding.
    const double enough = kEnoughTops * total;
    if (between > 0.0) {
        result.tops = (1.0 - 2.0 * moment / between) * std::min(1.0, between / enough);
    }
    if (low + high > 0.0) result.floor = (low - high) / (low + high);
    return result;
}

}  // namespace

std::vector<UpEvidence> scoreUpAxes(const FrameEvidence& evidence) {
    std::vector<UpEvidence> all;
    for (const char letter : {'x', 'y', 'z'}) {
        for (const bool negative : {false, true}) {
            UpEvidence one = judge(evidence, UpAxis(letter, negative));
            one.score = 2.0 * one.named + 2.0 * one.level + 0.4 * one.lowest + 1.5 * one.standing +
                        1.0 * one.resting + kSupportWeight * one.support + 1.0 * one.round +
                        0.8 * one.tops + 0.4 * one.floor + 0.8 * one.shapes;
            all.push_back(one);
        }
    }
    std::ranges::stable_sort(all, std::greater(), &UpEvidence::score);
    return all;
}

double leadOf(const std::vector<UpEvidence>& ranked, UpAxis axis) {
    const auto own = std::ranges::find(ranked, axis, &UpEvidence::axis);
    return own->score - (own == ranked.begin() ? ranked[1] : ranked[0]).score;
}

double leadAgainstFormat(UpAxis best, UpAxis of_file, double otherwise) {
    constexpr double kUpsideDown = 1.5;
    return best.letter == of_file.letter ? kUpsideDown : otherwise;
}

bool contradicts(const FrameEvidence& evidence, const std::vector<UpEvidence>& ranked, UpAxis axis,
                 double lead) {
    if (evidence.objects.size() < std::size_t{kFewestObjects}) return false;
    const UpEvidence& asked = *std::ranges::find(ranked, axis, &UpEvidence::axis);
    const bool names_tell = ranked.front().named > asked.named;
    if (ranked.front().axis.letter == axis.letter && !names_tell) {
        const auto isInside = [&](const MeasuredObject& object) {
            return !isRoomSide(object, evidence.core, 0) && !isRoomSide(object, evidence.core, 1) &&
                   !isRoomSide(object, evidence.core, 2);
        };
        if (std::ranges::count_if(evidence.objects, isInside) < kFewestObjects) return false;
    }
    return ranked.front().score - asked.score >= lead;
}

}  // namespace dollytrack
