#include "engine/io/homes/furniture_placement.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::homes {
namespace {

using Eigen::Affine3d;
using Eigen::AlignedBox3d;
using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector3d;

AlignedBox3d moved(const AlignedBox3d& box, const Affine3d& transform) {
    AlignedBox3d result;
    for (int i = 0; i < 8; ++i) {
        result.extend(transform * box.corner(static_cast<AlignedBox3d::CornerType>(i)));
    }
    return result;
}

Affine3d turnOf(const HomePiece& piece) {
    Affine3d turn = Affine3d::Identity();
    if (piece.model_rotation) turn.linear() = *piece.model_rotation;
    return turn;
}

/// The transform of a model to a box of size 1, centred at the origin.
Affine3d unitFromModel(const HomePiece& piece, const ModelBounds& bounds) {
    Affine3d centred = turnOf(piece) * Translation3d(-bounds.own.center());
    if (piece.model_rotation && piece.centered_at_origin) {
        centred = Translation3d(-bounds.turned.center()) * centred;
    }
    const Vector3d size = bounds.turned.sizes().cwiseMax(1e-3);
    return Eigen::Scaling(Vector3d(size.cwiseInverse())) * centred;
}

}  // namespace

ModelBounds boundsOf(const FurnitureModel& model, const HomePiece& piece) {
    const Affine3d turn = turnOf(piece) * Translation3d(-model.bounds.center());
    ModelBounds bounds{model.bounds, {}};
    if (!piece.model_rotation) {
        bounds.turned = moved(model.bounds, turn);
        return bounds;
    }
    for (const MeshPart& part : model.raw.parts) {
        if (part.triangles.empty()) continue;
        for (const Eigen::Vector3f& p : part.positions) {
            bounds.turned.extend(turn * p.cast<double>());
        }
    }
    return bounds;
}

Affine3d sourceFromModel(const HomePiece& piece, const ModelBounds& bounds,
                         double level_elevation) {
    const Vector3d size(piece.mirrored ? -piece.width : piece.width, piece.height, piece.depth);
    Affine3d sized = Eigen::Scaling(size) * unitFromModel(piece, bounds);
    double height = piece.height;
    if (piece.pitch != 0.0 || piece.roll != 0.0) {
        const Affine3d tilt(piece.pitch != 0.0 ? AngleAxisd(-piece.pitch, Vector3d::UnitX())
                                               : AngleAxisd(-piece.roll, Vector3d::UnitZ()));
        const AlignedBox3d box = moved(bounds.own, tilt * sized);
        sized = Translation3d(-box.center()) * tilt * sized;
        height = box.sizes().y();
    }
    const Vector3d place(piece.position.x(), level_elevation + piece.elevation + 0.5 * height,
                         piece.position.y());
    // Angles are clockwise on the page, and so negative about the up axis.
    return Translation3d(place) * AngleAxisd(-piece.angle, Vector3d::UnitY()) * sized;
}

Vector3d frontOf(const HomePiece& piece) {
    return {-std::sin(piece.angle), 0.0, std::cos(piece.angle)};
}

}  // namespace dollytrack::homes
