#include "engine/generate/placed_model.h"

#include "engine/generate/model_files.h"
#include "engine/io/homes/furniture_placement.h"

namespace dollytrack::generate {

using Eigen::Vector3d;

homes::HomePiece homePiece(const PlacedPiece& placed, const std::string& name) {
    const CatalogPiece& catalog = *placed.piece;
    homes::HomePiece piece;
    piece.kind = catalog.opening ? homes::PieceKind::Opening : homes::PieceKind::Furniture;
    piece.name = name;
    piece.catalog_id = catalog.id;
    piece.model = nameInHome(catalog.archive, catalog.model);
    piece.position = placed.at;
    piece.elevation = placed.elevation;
    piece.angle = placed.angle;
    piece.width = catalog.width;
    piece.depth = catalog.depth;
    piece.height = catalog.height;
    piece.model_rotation = catalog.model_rotation;
    if (catalog.opening) piece.wall_cut_out = catalog.cut_out;
    return piece;
}

std::vector<TriangleInRoom> trianglesOf(const homes::FurnitureModel& model,
                                        const PlacedPiece& placed) {
    const homes::HomePiece piece = homePiece(placed, placed.piece->name);
    const Eigen::Affine3d to_source =
        homes::sourceFromModel(piece, homes::boundsOf(model, piece), 0.0);
    std::vector<TriangleInRoom> triangles;
    for (const MeshPart& part : model.raw.parts) {
        std::vector<Vector3d> points;
        points.reserve(part.positions.size());
        for (const Eigen::Vector3f& p : part.positions) {
            const Vector3d q = to_source * p.cast<double>();
            points.emplace_back(q.x(), q.z(), q.y());  // y is the height in the source's axes
        }
        for (const Triangle& t : part.triangles) {
            triangles.push_back({points[t[0]], points[t[1]], points[t[2]]});
        }
    }
    return triangles;
}

}  // namespace dollytrack::generate
