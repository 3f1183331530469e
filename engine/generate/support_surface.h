#pragma once

#include "engine/core/random.h"
#include "engine/generate/room_layout.h"
#include "engine/io/homes/model_library.h"

#include <optional>
#include <vector>

namespace dollytrack::generate {

/// The triangles of a piece of furniture, to place objects on its top or shelves.
class SupportSurface {
  public:
    SupportSurface(const homes::FurnitureModel& model, const PlacedPiece& placed);

    /// A resting height of an object.
    struct Placement {
        double height = 0.0;               // elevation of the object's bottom
        std::optional<UprightBox> access;  // free box to the front; null if it is free above
    };
    /// The height at which the object can stand at its position, randomly chosen if there are
    /// several; null if there is none. The surface must support the object's centre and four
    /// points towards its corners, no triangle may intersect the object, and the object must be
    /// accessible straight from above or straight from the front.
    [[nodiscard]] std::optional<Placement> placementFor(const PlacedPiece& item,
                                                        Random& random) const;

  private:
    using Nearby = std::vector<const TriangleInRoom*>;
    [[nodiscard]] Nearby trianglesIn(const UprightBox& box) const;
    [[nodiscard]] bool isFree(const UprightBox& box) const;
    /// The box that the object sweeps when it is inserted from the front.
    [[nodiscard]] UprightBox accessBox(const UprightBox& box) const;

    UprightBox supporter_;
    std::vector<TriangleInRoom> triangles_;
};

}  // namespace dollytrack::generate
