#pragma once

#include "engine/generate/furniture/furniture_role.h"
#include "engine/io/homes/model_library.h"
#include "engine/jobs/job.h"

#include <array>
#include <vector>

namespace dollytrack::generate {

/// The pieces of all libraries by role, and their models; each model is read once for many rooms.
class FurniturePool {
  public:
    /// `catalog` must outlive this object.
    explicit FurniturePool(const FurnitureCatalog& catalog);

    /// The pieces of a role, in the catalogue's order.
    [[nodiscard]] const std::vector<const CatalogPiece*>& piecesOf(FurnitureRole role) const;
    /// Whether at least one piece has a role.
    [[nodiscard]] bool hasPieces() const;
    /// Whether the model can be read, has all its textures and at most 80,000 triangles. False if
    /// the job was cancelled.
    bool isUsable(const CatalogPiece& piece, const JobContext& job);
    /// The model of a piece; null if it cannot be read.
    const homes::FurnitureModel* modelOf(const CatalogPiece& piece, const JobContext& job);

  private:
    const FurnitureCatalog& catalog_;
    std::vector<homes::ModelLibrary> models_;  // one per library, because names may be equal
    std::array<std::vector<const CatalogPiece*>, kRoleCount> pieces_;
};

}  // namespace dollytrack::generate
