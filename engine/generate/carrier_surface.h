#pragma once

#include "engine/core/random.h"
#include "engine/generate/room_layout.h"
#include "engine/io/homes/model_library.h"

#include <optional>
#include <vector>

namespace dollytrack::generate {

/// The triangles of a piece of furniture, to place objects on its top or shelves.
class CarrierSurface {
  public:
    CarrierSurface(const homes::FurnitureModel& model, const PlacedPiece& placed);

    /// A resting height of an object.
    struct Rest {
        double height = 0.0;            // elevation of the object's bottom
        std::optional<UprightBox> way;  // free box to the front; null if it is free above
    };
    /// The height at which the object can stand at its position, randomly chosen if there are
    /// several; null if there is none. The surface must support the object's centre and four
    /// points towards its corners, no triangle may intersect the object, and the object must be
    /// accessible straight from above or straight from the front.
    [[nodiscard]] std::optional<Rest> restFor(const PlacedPiece& thing, Random& random) const;

  private:
    using Nearby = std::vector<const TriangleInRoom*>;
    [[nodiscard]] Nearby trianglesIn(const UprightBox& box) const;
    [[nodiscard]] bool isFree(const UprightBox& box) const;
    /// The box that the object sweeps when it is inserted from the front.
    [[nodiscard]] UprightBox wayIn(const UprightBox& box) const;

    UprightBox carrier_;
    std::vector<TriangleInRoom> triangles_;
};

}  // namespace dollytrack::generate
