#include "engine/io/object_parts/draft_pieces.h"

#include "engine/geometry/piece_finder.h"

#include <cstdint>

namespace dollytrack {
namespace {

constexpr std::uint32_t kNotUsed = 0xFFFFFFFFU;

/// Copies triangles of a part as a new part. `renumbered` is scratch memory: one entry per vertex
/// of the part, kNotUsed before and after the call.
MeshPart extract(const MeshPart& part, const std::vector<std::size_t>& triangles,
                 std::vector<std::uint32_t>& renumbered) {
    MeshPart piece;
    piece.name = part.name;
    piece.node = part.node;
    piece.material = part.material;
    for (const std::size_t t : triangles) {
        Triangle triangle;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = part.triangles[t][i];
            if (renumbered[v] == kNotUsed) {
                renumbered[v] = static_cast<std::uint32_t>(piece.positions.size());
                piece.positions.push_back(part.positions[v]);
                piece.normals.push_back(part.normals[v]);
                piece.uvs.push_back(part.uvs[v]);
                piece.bounds.extend(part.positions[v]);
            }
            triangle[i] = renumbered[v];
        }
        piece.triangles.push_back(triangle);
    }
    for (const std::size_t t : triangles) {
        for (const std::uint32_t v : part.triangles[t]) renumbered[v] = kNotUsed;
    }
    return piece;
}

}  // namespace

std::vector<DraftPiece> findDraftPieces(const RawScene& raw, const ObjectDraft& draft,
                                        std::size_t least, std::size_t most) {
    std::size_t corners = 0;
    for (const std::size_t part : draft.parts) corners += raw.parts[part].positions.size();
    PieceFinder finder(corners);
    std::vector<std::vector<std::uint32_t>> places(draft.parts.size());
    for (std::size_t k = 0; k < draft.parts.size(); ++k) {
        const MeshPart& part = raw.parts[draft.parts[k]];
        for (const auto& p : part.positions) places[k].push_back(finder.add(p));
        for (const Triangle& t : part.triangles) {
            finder.join(places[k][t[0]], places[k][t[1]]);
            finder.join(places[k][t[0]], places[k][t[2]]);
        }
    }
    // Pieces in the order of their first triangles, for a deterministic result.
    std::vector<std::vector<std::vector<std::size_t>>> members;  // piece, part, triangles
    std::vector<std::int64_t> piece_of(corners, -1);
    for (std::size_t k = 0; k < draft.parts.size(); ++k) {
        const MeshPart& part = raw.parts[draft.parts[k]];
        for (std::size_t t = 0; t < part.triangles.size(); ++t) {
            const std::uint32_t root = finder.find(places[k][part.triangles[t][0]]);
            if (piece_of[root] < 0) {
                piece_of[root] = static_cast<std::int64_t>(members.size());
                members.emplace_back(draft.parts.size());
            }
            members[piece_of[root]][k].push_back(t);
        }
    }
    if (members.size() < least || members.size() > most) return {};
    std::vector<std::vector<std::uint32_t>> renumbered;
    for (const std::size_t part : draft.parts) {
        renumbered.emplace_back(raw.parts[part].positions.size(), kNotUsed);
    }
    std::vector<DraftPiece> pieces;
    for (const auto& by_part : members) {
        DraftPiece& piece = pieces.emplace_back();
        for (std::size_t k = 0; k < by_part.size(); ++k) {
            if (by_part[k].empty()) continue;
            piece.meshes.push_back(extract(raw.parts[draft.parts[k]], by_part[k], renumbered[k]));
            piece.box.extend(piece.meshes.back().bounds);
        }
    }
    return pieces;
}

}  // namespace dollytrack
