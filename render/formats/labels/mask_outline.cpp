#include "render/formats/labels/mask_outline.h"

#include <array>
#include <cstddef>

namespace dollytrack::render {
namespace {

// Edge directions between pixel corners: right, down, left, up; each is a right turn from the
// previous.
constexpr std::array<int, 4> kStepX = {1, 0, -1, 0};
constexpr std::array<int, 4> kStepY = {0, 1, 0, -1};

/// Edges that start at each pixel corner, one bit per direction.
class EdgeMap {
  public:
    EdgeMap(int width, int height, std::span<const std::uint8_t> mask)
        : stride_(width + 1),
          bits_(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1)) {
        const auto inside = [&](int x, int y) {
            return x >= 0 && y >= 0 && x < width && y < height &&
                   mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(x)] != 0;
        };
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (!inside(x, y)) continue;
                if (!inside(x, y - 1)) at(x, y) |= 1U;
                if (!inside(x + 1, y)) at(x + 1, y) |= 2U;
                if (!inside(x, y + 1)) at(x + 1, y + 1) |= 4U;
                if (!inside(x - 1, y)) at(x, y + 1) |= 8U;
            }
        }
    }

    std::uint8_t& at(int x, int y) {
        return bits_[static_cast<std::size_t>(y) * static_cast<std::size_t>(stride_) +
                     static_cast<std::size_t>(x)];
    }

    /// Follows edges from the given one until the outline closes, and removes them.
    Outline take(int x, int y, int direction) {
        Outline outline;
        const int first_x = x, first_y = y;
        int before = -1;
        do {
            if (direction != before) outline.corners.emplace_back(x, y);
            at(x, y) &= static_cast<std::uint8_t>(~(1U << static_cast<unsigned>(direction)));
            x += kStepX[direction];
            y += kStepY[direction];
            before = direction;
            // Where two outlines meet at a corner, a right turn stays with the same pixel.
            for (const int turn : {1, 0, 3}) {
                const int next = (before + turn) % 4;
                if ((at(x, y) >> static_cast<unsigned>(next) & 1U) != 0) {
                    direction = next;
                    break;
                }
            }
        } while (x != first_x || y != first_y);
        return outline;
    }

  private:
    int stride_;
    std::vector<std::uint8_t> bits_;
};

}  // namespace

std::vector<Outline> outlinesOf(int width, int height, std::span<const std::uint8_t> mask) {
    EdgeMap edges(width, height, mask);
    std::vector<Outline> outlines;
    for (int y = 0; y <= height; ++y) {
        for (int x = 0; x <= width; ++x) {
            // In row order an outline is first met at its topmost edge, which runs right. A hole's
            // top edge runs left and is met at its end, where an edge runs down.
            while ((edges.at(x, y) & 1U) != 0) outlines.push_back(edges.take(x, y, 0));
            while ((edges.at(x, y) & 2U) != 0) {
                outlines.push_back(edges.take(x, y, 1));
                outlines.back().hole = true;
            }
        }
    }
    return outlines;
}

std::vector<Outline> outlinesOfCounts(int width, int height,
                                      std::span<const std::uint32_t> counts) {
    const std::size_t rows = height;
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(width) * rows);
    std::size_t place = 0;
    for (std::size_t run = 0; run < counts.size(); ++run) {
        for (std::uint32_t i = 0; i < counts[run]; ++i, ++place) {
            if (run % 2 == 1 && place < mask.size()) {
                mask[place % rows * static_cast<std::size_t>(width) + place / rows] = 1;
            }
        }
    }
    return outlinesOf(width, height, mask);
}

}  // namespace dollytrack::render
