#include "render/verify/compare/filled_mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::verify {
namespace {

using Mask = std::vector<std::uint8_t>;

/// Flood fill over neighbours for which a predicate holds, marking all pixels reached.
class Flood {
  public:
    Flood(int width, int height, bool diagonal)
        : width_(width),
          height_(height),
          steps_(diagonal ? 8 : 4),
          reached_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

    /// Fills from a pixel and returns the number of pixels reached.
    template <class IsPassable>
    int from(int x, int y, const IsPassable& isPassable) {
        int count = 0;
        visit(x, y, isPassable);
        while (!waiting_.empty()) {
            const auto [px, py] = waiting_.back();
            waiting_.pop_back();
            ++count;
            for (int i = 0; i < steps_; ++i) {
                visit(px + kSteps[i][0], py + kSteps[i][1], isPassable);
            }
        }
        return count;
    }
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(x) * static_cast<std::size_t>(height_) +
               static_cast<std::size_t>(y);
    }
    [[nodiscard]] bool reached(std::size_t at) const { return reached_[at] != 0; }

  private:
    static constexpr std::array<std::array<int, 2>, 8> kSteps = {
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

    template <class IsPassable>
    void visit(int x, int y, const IsPassable& isPassable) {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
        if (reached_[at(x, y)] != 0 || !isPassable(at(x, y))) return;
        reached_[at(x, y)] = 1;
        waiting_.push_back({x, y});
    }

    int width_, height_, steps_;
    Mask reached_;
    std::vector<std::array<int, 2>> waiting_;
};

}  // namespace

Mask shownBy(const Image16& ids, int object_id) {
    Mask mask;
    mask.reserve(ids.values.size());
    for (int x = 0; x < ids.width; ++x) {
        for (int y = 0; y < ids.height; ++y) mask.push_back(ids.at(x, y) == object_id ? 1 : 0);
    }
    return mask;
}

void fillPolygon(std::span<const double> corners, int width, int height, Mask& mask) {
    const std::size_t count = corners.size() / 2;
    for (int x = 0; x < width; ++x) {
        // Crossings of the polygon's edges with the column's centre line; inside is between the
        // first and second, the third and fourth, and so on.
        const double middle = x + 0.5;
        std::vector<double> crossings;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t next = (i + 1) % count;
            const double x0 = corners[2 * i];
            const double x1 = corners[2 * next];
            if ((x0 < middle) == (x1 < middle)) continue;
            const double y0 = corners[2 * i + 1];
            const double y1 = corners[2 * next + 1];
            crossings.push_back(y0 + (middle - x0) / (x1 - x0) * (y1 - y0));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            const double first = std::ceil(std::clamp(crossings[i], 0.0, height + 0.5) - 0.5);
            const double end = std::ceil(std::clamp(crossings[i + 1], 0.0, height + 0.5) - 0.5);
            for (int y = static_cast<int>(first); y < static_cast<int>(end) && y < height; ++y) {
                mask[static_cast<std::size_t>(x) * static_cast<std::size_t>(height) +
                     static_cast<std::size_t>(y)] = 1;
            }
        }
    }
}

std::vector<int> partSizes(const Mask& mask, int width, int height) {
    Flood flood(width, height, false);
    std::vector<int> sizes;
    for (int x = 0; x < width; ++x) {
        for (int y = 0; y < height; ++y) {
            const std::size_t at = flood.at(x, y);
            if (mask[at] == 0 || flood.reached(at)) continue;
            sizes.push_back(flood.from(x, y, [&](std::size_t i) { return mask[i] != 0; }));
        }
    }
    return sizes;
}

std::string partProblem(const Mask& outlined, const Mask& mask, int width, int height) {
    const Mask filled = withoutHoles(mask, width, height);
    const std::size_t h = height;
    int outlined_px = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (outlined[i] == 0) continue;
        ++outlined_px;
        if (filled[i] == 0) {
            return fmt::format("its outline contains pixel ({}, {}), which is not part of it",
                               i / h, i % h);
        }
        const bool last_row = i % h + 1 == h;
        const bool last_column = i + h >= mask.size();
        for (const auto& [next, there] : {std::pair{i - 1, i % h > 0},
                                          {i + 1, !last_row},
                                          {i - h, i >= h},
                                          {i + h, !last_column}}) {
            if (!there || mask[i] == 0 || mask[next] == 0 || outlined[next] != 0) continue;
            return fmt::format("its outline misses pixel ({}, {})", next / h, next % h);
        }
    }
    const std::vector<int> sizes = partSizes(mask, width, height);
    const int largest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
    if (outlined_px >= largest && outlined_px > 0) return {};
    return fmt::format("its outline contains {} px of {}", outlined_px, largest);
}

Mask withoutHoles(const Mask& mask, int width, int height) {
    Flood outside(width, height, true);
    const auto empty = [&](std::size_t i) { return mask[i] == 0; };
    for (int x = 0; x < width; ++x) {
        outside.from(x, 0, empty);
        outside.from(x, height - 1, empty);
    }
    for (int y = 0; y < height; ++y) {
        outside.from(0, y, empty);
        outside.from(width - 1, y, empty);
    }
    Mask filled(mask.size());
    for (std::size_t i = 0; i < filled.size(); ++i) filled[i] = outside.reached(i) ? 0 : 1;
    return filled;
}

}  // namespace dollytrack::verify
