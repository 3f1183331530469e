#pragma once

#include "engine/generate/furniture_role.h"
#include "engine/io/homes/model_library.h"
#include "engine/jobs/job.h"

#include <array>
#include <vector>

namespace dollytrack::generate {

/// The pieces of a library by role, and their models; both looked up once for many rooms.
class FurniturePool {
  public:
    /// `catalog` has to outlive this object.
    explicit FurniturePool(const FurnitureCatalog& catalog);

    /// The role's pieces, in the catalogue's order.
    [[nodiscard]] const std::vector<const CatalogPiece*>& piecesOf(FurnitureRole role) const;
    /// Whether any piece has a role.
    [[nodiscard]] bool hasPieces() const;
    /// Whether the model can be read, has all its pictures and is not too fine.
    bool isUsable(const CatalogPiece& piece, const JobContext& job);
    /// Null when it cannot be read.
    const homes::FurnitureModel* modelOf(const CatalogPiece& piece, const JobContext& job);

  private:
    const FurnitureCatalog& catalog_;
    std::vector<homes::ModelLibrary> models_;  // of each archive: names may be the same
    std::array<std::vector<const CatalogPiece*>, kRoleCount> pieces_;
};

}  // namespace dollytrack::generate
