#pragma once

#include "engine/core/random.h"
#include "engine/generate/room_layout.h"
#include "engine/io/homes/model_library.h"

#include <optional>
#include <vector>

namespace dollytrack::generate {

/// The surface of a piece that carries things: its top, its boards, its open compartments.
class CarrierSurface {
  public:
    CarrierSurface(const homes::FurnitureModel& model, const PlacedPiece& placed);

    /// Where a thing stands.
    struct Rest {
        double height = 0.0;            // its elevation
        std::optional<UprightBox> way;  // from the front; nothing where it is open above
    };
    /// How a thing stands at its place, if it can: its corners and its middle are carried, no
    /// triangle of the carrier reaches into it, and a hand could have put it there, straight down
    /// from above or straight in from the front. One height by chance of several.
    [[nodiscard]] std::optional<Rest> restFor(const PlacedPiece& thing, Random& random) const;

  private:
    using Nearby = std::vector<const TriangleInRoom*>;
    [[nodiscard]] Nearby trianglesIn(const UprightBox& box) const;
    [[nodiscard]] bool isFree(const UprightBox& box) const;
    /// What the thing passes on its way in from the front.
    [[nodiscard]] UprightBox wayIn(const UprightBox& box) const;

    UprightBox carrier_;
    std::vector<TriangleInRoom> triangles_;
};

}  // namespace dollytrack::generate
