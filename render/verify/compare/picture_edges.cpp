#include "render/verify/compare/picture_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace dollytrack::verify {
namespace {

// Valid images of twelve rooms by day and by night have ranks of at least 0.58, mostly 0.95. With
// outlines of another frame the rank is 0.5; for nine in ten it is at most 0.65 under any shift.
constexpr double kClearlyMore = 0.1;
constexpr double kLessUnexplained = 0.4;
constexpr double kMostStrong = 0.75;

constexpr int kFarthestMove = 16;  // px
constexpr int kMoveStep = 4;

int changeOf(const std::uint8_t* a, const std::uint8_t* b) {
    int most = 0;
    for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[c] - b[c]));
    return most;
}

}  // namespace

bool isBlank(const Image8& picture) {
    for (std::size_t i = 3; i + 2 < picture.values.size(); i += 3) {
        if (!std::equal(picture.values.begin(), picture.values.begin() + 3,
                        picture.values.begin() + static_cast<std::ptrdiff_t>(i))) {
            return false;
        }
    }
    return true;
}

Outlines outlinesOf(const Image16& ids, bool objects_only) {
    return outlinesOf(ids, [&](int a, int b) { return !objects_only || (a != 0 && b != 0); });
}

Outlines outlinesOf(const Image16& ids, const std::function<bool(int id, int other)>& counts) {
    Outlines outlines;
    outlines.width = ids.width;
    outlines.height = ids.height;
    const auto differ = [&](int a, int b) { return a != b && counts(a, b); };
    for (int y = 0; y < ids.height; ++y) {
        for (int x = 0; x < ids.width; ++x) {
            const int id = ids.at(x, y);
            if (x > 0 && x + 2 < ids.width && differ(id, ids.at(x + 1, y))) {
                outlines.across.push_back({x, y});
            }
            if (y > 0 && y + 2 < ids.height && differ(id, ids.at(x, y + 1))) {
                outlines.down.push_back({x, y});
            }
        }
    }
    return outlines;
}

Outlines mirrored(const Outlines& outlines, bool left_right, bool upside_down) {
    Outlines result = outlines;
    const auto mirror = [&](std::array<int, 2>& place, int wide, int high) {
        if (left_right) place[0] = outlines.width - wide - place[0];
        if (upside_down) place[1] = outlines.height - high - place[1];
    };
    for (auto& place : result.across) mirror(place, 2, 1);
    for (auto& place : result.down) mirror(place, 1, 2);
    return result;
}

// The change is measured between the pixels just outside the pair, because antialiasing smooths the
// pair itself.
GradientMap::Direction GradientMap::changesAlong(const Image8& picture, int dx, int dy) {
    Direction direction;
    direction.change.resize(static_cast<std::size_t>(picture.width) *
                            static_cast<std::size_t>(picture.height));
    std::array<std::size_t, 256> counts = {};
    std::size_t all = 0;
    for (int y = dy; y + 2 * dy < picture.height; ++y) {
        for (int x = dx; x + 2 * dx < picture.width; ++x) {
            const int change =
                changeOf(picture.pixel(x - dx, y - dy), picture.pixel(x + 2 * dx, y + 2 * dy));
            direction.change[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(change);
            ++counts[change];
            ++all;
        }
    }
    std::size_t less = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        direction.rank[i] =
            static_cast<float>((static_cast<double>(less) + 0.5 * static_cast<double>(counts[i])) /
                               static_cast<double>(std::max<std::size_t>(all, 1)));
        less += counts[i];
    }
    return direction;
}

GradientMap::GradientMap(const Image8& picture)
    : width_(picture.width),
      height_(picture.height),
      across_(changesAlong(picture, 1, 0)),
      down_(changesAlong(picture, 0, 1)),
      blank_(isBlank(picture)) {
    std::size_t strong = 0;
    for (std::size_t i = 0; i < across_.change.size(); ++i) {
        if (std::max(across_.change[i], down_.change[i]) >= kEdge) ++strong;
    }
    structure_ = static_cast<double>(strong) /
                 static_cast<double>(std::max<std::size_t>(across_.change.size(), 1));
}

Fit GradientMap::fit(const Outlines& outlines, int dx, int dy) const {
    double sum = 0.0;
    std::size_t strong = 0;
    Fit fit;
    const auto look = [&](const std::vector<std::array<int, 2>>& places, const Direction& direction,
                          int wide, int high) {
        for (const auto& place : places) {
            const int x = place[0] + dx, y = place[1] + dy;
            if (x < wide || y < high || x + 2 * wide >= width_ || y + 2 * high >= height_) continue;
            if (x >= width_ || y >= height_) continue;
            const std::uint8_t change =
                direction.change[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(x)];
            sum += direction.rank[change];
            strong += change >= kEdge ? 1 : 0;
            ++fit.count;
        }
    };
    look(outlines.across, across_, 1, 0);
    look(outlines.down, down_, 0, 1);
    if (fit.count == 0) return fit;
    fit.rank = sum / static_cast<double>(fit.count);
    fit.strong = static_cast<double>(strong) / static_cast<double>(fit.count);
    return fit;
}

bool explainsBetter(const Fit& other, const Fit& own) {
    return other.count >= kFewestPlaces / 2 && other.strong >= kMostStrong &&
           other.rank - own.rank >= kClearlyMore &&
           1.0 - other.rank <= kLessUnexplained * (1.0 - own.rank);
}

OutlineAlignment alignmentOf(const GradientMap& picture, const Outlines& outlines) {
    OutlineAlignment alignment;
    alignment.own = picture.fit(outlines);
    alignment.best = alignment.own.rank;
    alignment.fit_elsewhere = alignment.own;
    const auto consider = [&](const Fit& fit, const auto& name) {
        if (fit.count < kFewestPlaces / 2) return;
        alignment.best = std::max(alignment.best, fit.rank);
        if (fit.rank <= alignment.fit_elsewhere.rank || !explainsBetter(fit, alignment.own)) return;
        alignment.fit_elsewhere = fit;
        alignment.elsewhere = name();
    };
    for (const auto& [left_right, upside_down, name] :
         {std::tuple(true, false, "mirrored left to right"),
          std::tuple(false, true, "mirrored upside down"),
          std::tuple(true, true, "turned by 180 degrees")}) {
        consider(picture.fit(mirrored(outlines, left_right, upside_down)),
                 [&, text = name] { return std::string(text); });
    }
    for (int dy = -kFarthestMove; dy <= kFarthestMove; dy += kMoveStep) {
        for (int dx = -kFarthestMove; dx <= kFarthestMove; dx += kMoveStep) {
            consider(picture.fit(outlines, dx, dy),
                     [&] { return fmt::format("moved by about ({}, {}) px", dx, dy); });
        }
    }
    return alignment;
}

std::string textOf(const Fit& own) {
    return fmt::format(
        "at object borders of its instance image, colours change more than in {:.0f} % of the "
        "image; 50 % would be chance",
        100.0 * own.rank);
}

std::string textOf(const OutlineAlignment& alignment) {
    return fmt::format(
        "at object borders of its instance image, colours change more than in {:.0f} % of the "
        "image; with the instance image {}, in {:.0f} %",
        100.0 * alignment.own.rank, alignment.elsewhere, 100.0 * alignment.fit_elsewhere.rank);
}

}  // namespace dollytrack::verify
