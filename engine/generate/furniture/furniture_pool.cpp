#include "engine/generate/furniture/furniture_pool.h"

#include <algorithm>

namespace dollytrack::generate {
namespace {

// Some libraries contain sculpted models, with which a room would be slow to plan and render.
constexpr std::size_t kFinest = 80'000;  // triangles

}  // namespace

FurniturePool::FurniturePool(const FurnitureCatalog& catalog) : catalog_(catalog) {
    for (const Archive* archive : catalog.files()) {
        models_.emplace_back(std::vector<const FileSource*>{archive});
    }
    for (const RoleRule& rule : builtInRoles()) {
        for (const CatalogPiece& piece : catalog_.pieces()) {
            if (rule.admits(piece)) pieces_[static_cast<std::size_t>(rule.role)].push_back(&piece);
        }
    }
}

const std::vector<const CatalogPiece*>& FurniturePool::piecesOf(FurnitureRole role) const {
    return pieces_[static_cast<std::size_t>(role)];
}

bool FurniturePool::hasPieces() const {
    return std::ranges::any_of(pieces_, [](const auto& of_role) { return !of_role.empty(); });
}

bool FurniturePool::isUsable(const CatalogPiece& piece, const JobContext& job) {
    if (job.cancelled()) return false;  // reading a model can take a second
    const homes::FurnitureModel* model = modelOf(piece, job);
    if (!model) return false;
    // Some models refer to textures that their library does not contain.
    for (const TextureRequest& picture : model->raw.textures) {
        if (picture.embedded.empty()) return false;
    }
    std::size_t triangles = 0;
    for (const MeshPart& part : model->raw.parts) triangles += part.triangles.size();
    return triangles <= kFinest;
}

const homes::FurnitureModel* FurniturePool::modelOf(const CatalogPiece& piece,
                                                    const JobContext& job) {
    std::string why;
    return models_[piece.archive].find(piece.model, job, why);
}

}  // namespace dollytrack::generate
