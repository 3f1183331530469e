#pragma once

#include "render/verify/read/image_files.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace dollytrack::verify {

/// A picture and its ids in small: 40 x 30 cells.
struct SmallFrame {
    static constexpr int kColumns = 40;
    static constexpr int kRows = 30;
    static constexpr std::size_t kCells = std::size_t{kColumns} * kRows;

    SmallFrame(const Image8& picture, const Image16& ids);

    std::array<std::array<std::uint8_t, 3>, kCells> colours;  // mean of a cell
    std::array<std::uint16_t, kCells> ids;                    // at its middle
};

/// What colour each object has over many frames.
class ObjectColours {
  public:
    void add(const SmallFrame& frame);

    /// How far the colours of a picture are from those that its objects have in all other frames,
    /// were the ids of `labels` its own: mean of the cells and channels, of 255. Negative where
    /// too few of these objects are seen elsewhere. Both frames were added.
    [[nodiscard]] double distance(const SmallFrame& picture, const SmallFrame& labels) const;

  private:
    struct Sum {
        std::array<double, 3> colour = {};
        double count = 0.0;
    };
    static std::map<std::uint16_t, Sum> sumsOf(const SmallFrame& frame);

    std::map<std::uint16_t, Sum> all_;
};

}  // namespace dollytrack::verify
