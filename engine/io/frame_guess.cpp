#include "engine/io/frame_guess.h"

#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace dollytrack {
namespace {

struct Thing {
    Eigen::AlignedBox3d box;  // source axes and unit
    const Label* label = nullptr;
    std::array<double, 6> facing{};
    double area = 0.0;
};

std::vector<Thing> measureThings(const RawScene& raw, const std::vector<ObjectDraft>& drafts) {
    std::vector<Thing> things;
    for (const ObjectDraft& draft : drafts) {
        Thing thing;
        thing.label = &draft.label;
        for (const std::size_t part : draft.parts) {
            thing.box.extend(raw.parts[part].bounds.cast<double>());
            thing.area += raw.parts[part].area;
            for (std::size_t i = 0; i < 6; ++i) {
                thing.facing[i] += raw.parts[part].facing_area[i];
            }
        }
        things.push_back(thing);
    }
    return things;
}

/// The part of the scene that holds nearly all things: 5 % of them at each end may be strays.
Eigen::AlignedBox3d coreOf(const std::vector<Thing>& things) {
    Eigen::AlignedBox3d core;
    if (things.size() < 8) {
        for (const Thing& thing : things) core.extend(thing.box);
        return core;
    }
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> lows;
        std::vector<double> highs;
        for (const Thing& thing : things) {
            lows.push_back(thing.box.min()[axis]);
            highs.push_back(thing.box.max()[axis]);
        }
        std::sort(lows.begin(), lows.end());
        std::sort(highs.begin(), highs.end());
        const std::size_t cut = std::max<std::size_t>(1, things.size() / 20);
        core.min()[axis] = lows[cut];
        core.max()[axis] = highs[highs.size() - 1 - cut];
    }
    return core;
}

/// Usual longest side of a thing, m; what has no usual size tells nothing.
struct UsualSize {
    int nyu40;
    double low;
    double high;
};
constexpr std::array<UsualSize, 20> kUsualSizes = {{{3, 0.4, 3.0},    // cabinet
                                                    {4, 1.1, 2.4},    // bed
                                                    {5, 0.4, 1.4},    // chair
                                                    {6, 0.8, 3.6},    // sofa
                                                    {7, 0.4, 2.8},    // table
                                                    {8, 1.8, 2.6},    // door
                                                    {9, 0.5, 3.0},    // window
                                                    {10, 0.6, 2.6},   // bookshelf
                                                    {11, 0.1, 2.0},   // picture
                                                    {14, 0.8, 2.4},   // desk
                                                    {17, 0.5, 2.0},   // dresser
                                                    {18, 0.25, 0.9},  // pillow
                                                    {23, 0.1, 0.5},   // books
                                                    {24, 0.8, 2.2},   // refrigerator
                                                    {25, 0.4, 2.2},   // television
                                                    {32, 0.3, 0.9},   // night stand
                                                    {33, 0.5, 1.1},   // toilet
                                                    {34, 0.3, 1.3},   // sink
                                                    {35, 0.15, 2.0},  // lamp
                                                    {36, 1.2, 2.2}}};

/// How believable a length is: 1 inside its usual range, less the further (in ratio) outside.
double believable(double length, double low, double high) {
    if (!(length > 0.0)) return 0.0;
    const double off = length < low ? low / length : length > high ? length / high : 1.0;
    return 1.0 / (off * off);
}

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

struct UnitScore {
    double score = 0.0;
    double furniture = 0.0;  // how well named furniture fits; 0 without any
    std::string evidence;
};

UnitScore scoreUnit(const std::vector<Thing>& things, const Eigen::AlignedBox3d& core, int up,
                    double unit_m) {
    UnitScore result;
    // Named furniture says most, each class once.
    std::array<double, kNyu40Count + 1> sum{};
    std::array<int, kNyu40Count + 1> count{};
    for (const Thing& thing : things) {
        if (thing.label->kind != LabelKind::Target && thing.label->nyu40 != kNyuDoor) continue;
        for (const UsualSize& usual : kUsualSizes) {
            if (usual.nyu40 != thing.label->nyu40) continue;
            const double longest = thing.box.sizes().maxCoeff() * unit_m;
            sum[static_cast<std::size_t>(usual.nyu40)] +=
                believable(longest, usual.low, usual.high);
            ++count[static_cast<std::size_t>(usual.nyu40)];
        }
    }
    double classes = 0.0;
    double fit = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        if (count[i] == 0) continue;
        classes += 1.0;
        fit += sum[i] / count[i];
    }
    const double height = core.sizes()[up] * unit_m;
    const double length = core.sizes().maxCoeff() * unit_m;
    result.score = (2.0 * believable(height, 2.0, 4.0) + believable(length, 2.5, 25.0)) / 3.0;
    result.evidence = "room height " + number(height) + " m";
    if (classes > 0.0) {
        // One kind may be an odd model, or all lamps of a room in one node; many do not err.
        const double weight = 2.0 * classes / (classes + 2.0);
        result.furniture = fit / classes;
        result.score = (result.score + weight * result.furniture) / (1.0 + weight);
        result.evidence += ", " + number(classes) + " kinds of furniture";
    }
    return result;
}

/// How much speaks for an axis being up.
double scoreUp(const std::vector<Thing>& things, const Eigen::AlignedBox3d& core, int axis) {
    double score = 0.0;
    double floor = 0.0;
    double total = 0.0;
    for (const Thing& thing : things) {
        total += thing.area;
        const double flat = thing.facing[static_cast<std::size_t>(2 * axis)] +
                            thing.facing[static_cast<std::size_t>(2 * axis + 1)];
        floor += flat;
        const int nyu = thing.label->nyu40;
        const Eigen::Vector3d size = thing.box.sizes();
        const bool thinnest = size[axis] <= size.minCoeff() + 1e-9 * size.maxCoeff();
        const bool thick = size[axis] > 0.5 * size.maxCoeff();
        const double middle =
            (thing.box.center()[axis] - core.min()[axis]) / std::max(1e-12, core.sizes()[axis]);
        if (nyu == kNyuFloor || nyu == 20) score += thinnest && middle < 0.4 ? 1.0 : -1.0;
        if (nyu == kNyuCeiling) score += thinnest && middle > 0.6 ? 1.0 : -1.0;
        if (nyu == kNyuDoor) score += thick ? 0.5 : -0.5;
        if (nyu == 4 || nyu == 6 || nyu == 7) score += !thick ? 0.1 : -0.1;
    }
    // Floors, ceilings and table tops face up and down; a room is lower than it is long.
    if (total > 0.0) score += 2.0 * floor / total;
    const Eigen::Vector3d size = core.sizes();
    if (size[axis] <= size.minCoeff() * 1.001) score += 0.4;

    // Gravity: things stand at the same height, and not all at the same height above.
    const double tolerance = 0.01 * std::max(size[axis], 1e-12);
    std::vector<double> lows;
    std::vector<double> highs;
    for (const Thing& thing : things) {
        if (thing.label->kind == LabelKind::Structure) continue;
        lows.push_back(thing.box.min()[axis]);
        highs.push_back(thing.box.max()[axis]);
    }
    const auto mostAlike = [&](std::vector<double>& values) {
        std::sort(values.begin(), values.end());
        std::size_t best = 0;
        for (std::size_t i = 0, j = 0; i < values.size(); ++i) {
            while (values[i] - values[j] > tolerance) ++j;
            best = std::max(best, i - j + 1);
        }
        return static_cast<double>(best);
    };
    if (lows.size() >= 4) {
        const double n = static_cast<double>(lows.size());
        score += 1.5 * (mostAlike(lows) - 0.5 * mostAlike(highs)) / n;
    }
    return score;
}

void chooseUp(const RawScene& raw, const std::vector<Thing>& things,
              const Eigen::AlignedBox3d& core, std::optional<char> given, FrameChoice& choice) {
    if (given) {
        choice.up_axis = *given;
        choice.up_source = "given";
        return;
    }
    if (raw.file_up_axis != 0) {
        choice.up_axis = raw.file_up_axis;
        choice.up_source = "file";
        return;
    }
    std::array<double, 3> scores{};
    for (int axis = 0; axis < 3; ++axis) {
        scores[static_cast<std::size_t>(axis)] = scoreUp(things, core, axis);
    }
    scores[0] -= 0.3;  // rare
    scores[1] += 0.05;
    const auto best = std::max_element(scores.begin(), scores.end()) - scores.begin();
    choice.up_axis = "xyz"[best];
    choice.up_source = "judged from floors, ceilings and what stands on them";
    std::sort(scores.begin(), scores.end());
    if (scores[2] - scores[1] < 0.15) {
        choice.warnings.push_back(std::string("the upward axis is doubtful: ") + choice.up_axis +
                                  " is only slightly likelier than the next; give it if wrong");
    }
}

void chooseUnit(const RawScene& raw, const std::vector<Thing>& things,
                const Eigen::AlignedBox3d& core, std::optional<double> given, FrameChoice& choice) {
    if (given) {
        choice.unit_m = *given;
        choice.unit_source = "given";
        return;
    }
    // A data set's or home's own unit is no setting of an exporter.
    if (raw.file_unit_m && !raw.objects.empty()) {
        choice.unit_m = *raw.file_unit_m;
        choice.unit_source = "file";
        return;
    }
    const int up = choice.up_axis - 'x';
    constexpr double kDoubtful = 0.35;
    constexpr double kBelievable = 0.9;  // of what a file says; rooms of usual sizes score 1
    constexpr std::array<double, 5> kUnits = {1.0, 0.01, 0.001, 0.0254, 0.3048};
    double best_unit = 1.0;
    UnitScore best;
    best.score = -1.0;
    const UnitScore in_metres = scoreUnit(things, core, up, 1.0);
    bool maybe_feet = false;
    for (const double unit : kUnits) {
        UnitScore score = scoreUnit(things, core, up, unit);
        if (unit == 0.0254 || unit == 0.3048) score.score *= 0.8;  // inches and feet are rarer
        // A hall in metres is a room in feet; only furniture can tell them apart.
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
        const UnitScore by_file = scoreUnit(things, core, up, *raw.file_unit_m);
        // Exporters write wrong units often enough; a dolls' house is rarer.
        if (by_file.score >= 0.15 || best.score < 0.5 || best.score < 3.0 * by_file.score) {
            choice.unit_m = *raw.file_unit_m;
            choice.unit_source = "file";
            // Several storeys and attics are high; that alone speaks for no other unit.
            const bool another_fits_better =
                best_unit != *raw.file_unit_m && best.score > by_file.score;
            if (by_file.score < kDoubtful || (by_file.score < kBelievable && another_fits_better)) {
                choice.warnings.push_back(
                    "the unit is doubtful: the file says 1 unit = " + number(*raw.file_unit_m) +
                    " m, which makes the " + by_file.evidence +
                    "; give metres per unit if it is wrong");
            }
            return;
        }
        choice.warnings.push_back("the file says 1 unit = " + number(*raw.file_unit_m) +
                                  " m, which makes the " + by_file.evidence + "; " +
                                  number(best_unit) + " m was taken instead");
    }
    choice.unit_m = best_unit;
    choice.unit_source = "judged: " + best.evidence;
    if (maybe_feet) {
        choice.warnings.push_back("the unit is doubtful: this is a hall in metres (" +
                                  best.evidence +
                                  "), or a room in feet; give 0.3048 metres per unit for feet");
    } else if (best.score < kDoubtful) {
        choice.warnings.push_back(
            "the unit is doubtful: no usual unit gives this scene a room's "
            "size; give metres per unit if it is wrong");
    }
}

}  // namespace

Eigen::Affine3d FrameChoice::worldFromSource() const {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    if (up_axis == 'y') turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (up_axis == 'x') turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    Eigen::Affine3d world = Eigen::Affine3d::Identity();
    world.linear() = unit_m * turn;
    return world;
}

FrameChoice chooseFrame(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                        std::optional<double> given_unit_m, std::optional<char> given_up_axis) {
    FrameChoice choice;
    const std::vector<Thing> things = measureThings(raw, drafts);
    const Eigen::AlignedBox3d core = coreOf(things);
    chooseUp(raw, things, core, given_up_axis, choice);
    chooseUnit(raw, things, core, given_unit_m, choice);
    return choice;
}

}  // namespace dollytrack
