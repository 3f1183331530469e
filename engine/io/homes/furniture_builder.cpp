#include "engine/io/homes/furniture_builder.h"

#include "engine/core/clean_text.h"
#include "engine/io/homes/furniture_placement.h"
#include "engine/io/homes/surface_mesh.h"
#include "engine/io/homes/wall_builder.h"
#include "engine/io/raw_scene/model_placement.h"
#include "engine/scene/label_table.h"
#include "engine/scene/labels.h"

#include <map>
#include <set>

namespace dollytrack::homes {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostTriangles = 50'000'000;

/// The name in a catalogue id: "bedsideTable" for "eTeks#bedsideTable". It is English in homes of
/// all languages.
std::string catalogWord(const std::string& id) {
    const auto at = id.rfind('#');
    return at == std::string::npos ? id : id.substr(at + 1);
}

/// A box of the piece's size.
std::vector<std::size_t> placeBox(const HomePiece& piece, double elevation,
                                  HomeMaterials& materials, RawScene& scene) {
    Eigen::AlignedBox3d box(Vector3d::Constant(-0.5), Vector3d::Constant(0.5));
    HomePiece plain = piece;
    plain.model_rotation.reset();
    const Eigen::Affine3d to_source = sourceFromModel(plain, {box, box}, elevation);
    const std::uint32_t material = materials.of(piece.surface, Eigen::Vector3f(0.5F, 0.5F, 0.5F));
    SurfaceMesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-0.5, 0.5}) {
            Vector3d normal = Vector3d::Zero();
            normal[axis] = side;
            Vector3d u = Vector3d::Zero();
            Vector3d v = Vector3d::Zero();
            u[(axis + 1) % 3] = 0.5;
            v[(axis + 2) % 3] = 0.5;
            mesh.quad(material,
                      {to_source * Vector3d(normal - u - v), to_source * Vector3d(normal + u - v),
                       to_source * Vector3d(normal + u + v), to_source * Vector3d(normal - u + v)},
                      to_source.linear() * normal);
        }
    }
    return mesh.addTo(scene, piece.name);
}

/// Whether a part is a window pane: by its name in Sweet Home 3D, or by its opacity.
bool isPane(const MeshPart& part, const Material& material) {
    return part.name.starts_with("sweethome3d_window_pane") || material.opacity < 1.0F;
}

/// Applies the piece's colours and textures: by material name, otherwise to all parts except panes.
void overlay(const HomePiece& piece, const std::vector<std::size_t>& parts,
             HomeMaterials& materials, RawScene& scene) {
    for (const std::size_t index : parts) {
        MeshPart& part = scene.parts[index];
        const auto named = piece.materials.find(scene.materials[part.material].name);
        if (named != piece.materials.end()) {
            part.material = materials.overlaid(part.material, named->second);
        } else if (!isPane(part, scene.materials[part.material])) {
            part.material = materials.overlaid(part.material, piece.surface);
        }
    }
}

int openingClass(const HomePiece& piece, const Label& label) {
    if (label.nyu40 == kNyuDoor || label.nyu40 == kNyuWindow) return label.nyu40;
    return piece.elevation > 20.0 ? kNyuWindow : kNyuDoor;
}

SourceObject describe(const HomePiece& piece, const LabelTable& labels) {
    SourceObject object;
    object.category = piece.name;
    if (labels.find(object.category).kind == LabelKind::None) {
        object.category = catalogWord(piece.catalog_id);
    }
    object.name = piece.name.empty() ? catalogWord(piece.catalog_id) : piece.name;
    const Label label = labels.find(object.category);
    object.structure = piece.kind == PieceKind::Opening || label.kind == LabelKind::Structure;
    if (piece.kind == PieceKind::Opening) object.nyu40 = openingClass(piece, label);
    if (piece.kind == PieceKind::Light && label.kind == LabelKind::None) object.category = "lamp";
    object.front = frontOf(piece);
    return object;
}

}  // namespace

Status addFurniture(const Home& home, ModelLibrary& library, HomeMaterials& materials,
                    const LabelTable& labels, RawScene& scene, const JobContext& job) {
    std::map<const FurnitureModel*, ModelPlacement> placements;
    std::map<std::string, std::pair<std::string, std::size_t>> missing;
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < home.pieces.size(); ++i) {
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "import was cancelled");
        job.report(static_cast<double>(i) / static_cast<double>(home.pieces.size()));
        const HomePiece& piece = home.pieces[i];
        const double elevation = levelElevation(home, piece.level);
        std::string why;
        const FurnitureModel* model = library.find(piece.model, job, why);
        SourceObject object = describe(piece, labels);
        if (model) {
            for (const MeshPart& part : model->raw.parts) triangles += part.triangles.size();
            if (triangles > kMostTriangles) {
                return fail(ErrorCode::BadInput,
                            "the home's furniture has more than 50 million triangles");
            }
            const auto found = placements.try_emplace(model, model->raw, scene).first;
            object.parts = found->second.place(
                object.name, sourceFromModel(piece, boundsOf(*model, piece), elevation));
            overlay(piece, object.parts, materials, scene);
        } else {
            auto& [reason, count] = missing[piece.model];
            reason = why;
            ++count;
            object.parts = placeBox(piece, elevation, materials, scene);
        }
        scene.objects.push_back(std::move(object));
    }
    for (const auto& [name, reason] : missing) {
        scene.notes.push_back(
            "the model " + cleanText(name) + " " + reason.first + "; it was replaced by a box " +
            (reason.second == 1 ? "once" : std::to_string(reason.second) + " times"));
    }
    return {};
}

}  // namespace dollytrack::homes
