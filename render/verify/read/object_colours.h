#pragma once

#include "render/verify/read/image_files.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace dollytrack::verify {

/// An image and its ids, reduced to 40 x 30 cells.
struct SmallFrame {
    static constexpr int kColumns = 40;
    static constexpr int kRows = 30;
    static constexpr std::size_t kCells = std::size_t{kColumns} * kRows;

    SmallFrame(const Image8& picture, const Image16& ids);

    std::array<std::array<std::uint8_t, 3>, kCells> colours;  // mean of each cell
    std::array<std::uint16_t, kCells> ids;                    // at each cell's centre
};

/// Mean colour of each object over many frames.
class ObjectColours {
  public:
    void add(const SmallFrame& frame);

    /// How much an image's colours differ from those that its objects have in all other frames, if
    /// the ids of `labels` were its own: mean over cells and channels, of 255. Negative if too few
    /// of these objects occur elsewhere. Both frames must have been added.
    [[nodiscard]] double distance(const SmallFrame& picture, const SmallFrame& labels) const;

    using Mean = std::array<double, 3>;
    /// The mean colours of an image's objects in all other frames, of those that occur there. The
    /// frame must have been added.
    [[nodiscard]] std::map<std::uint16_t, Mean> meansElsewhere(const SmallFrame& frame) const;

  private:
    struct Sum {
        std::array<double, 3> colour = {};
        double count = 0.0;
    };
    static std::map<std::uint16_t, Sum> sumsOf(const SmallFrame& frame);
    /// Sums over all frames except `without`, of the objects in `ids`.
    template <class Ids>
    [[nodiscard]] std::map<std::uint16_t, Sum> sumsElsewhere(const SmallFrame& without,
                                                             const Ids& ids) const;

    std::map<std::uint16_t, Sum> all_;
};

}  // namespace dollytrack::verify
