#include "engine/io/object_parts/piece_merge.h"

#include "engine/core/disjoint_sets.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

namespace dollytrack {
namespace {

constexpr float kNearGap = 0.03F;      // m: what floats belongs to what is as near as this
constexpr float kCrumb = 0.05F;        // m: too small to be a thing of its own in a merged scene
constexpr float kBothLarge = 1.2F;     // m, diagonal: furniture that stands side by side
constexpr float kLargestThing = 3.5F;  // m, diagonal: what grows beyond is a chain, no thing

struct Piece {
    Eigen::AlignedBox3f box;
    std::vector<SurfaceView> surfaces;
    bool structure = false;
    bool loose = false;        // its name says nothing of its own
    bool named = false;        // somebody named it
    bool is_part = false;      // its name says that it is a part
    bool by_material = false;  // may be one material of an object
    std::size_t triangles = 0;
};

/// Names that modelling programs give when nobody does.
bool isProgramName(const std::string& name) {
    static constexpr std::array<std::string_view, 22> kShapes = {
        "mesh",   "object",  "geometry", "circle", "plane",   "cube", "sphere", "cylinder",
        "torus",  "grid",    "cone",     "curve",  "surface", "text", "group",  "icosphere",
        "bezier", "default", "material", "node",   "line",    "shape"};
    const std::vector<std::string> words = splitWords(name);
    if (words.empty()) return true;
    const auto isShape = [](const std::string& word) {
        return std::find(kShapes.begin(), kShapes.end(), word) != kShapes.end();
    };
    return isShape(words.back()) || (words.size() == 1 && words[0].size() <= 2);
}

/// "shelf_0_3" is piece 3 of "shelf_0"; "shelf_0_node" is "shelf_0" itself.
std::string stemOf(std::string name) {
    if (name.ends_with("_node")) return name.substr(0, name.size() - 5);
    const auto last = name.find_last_not_of("0123456789");
    if (last == std::string::npos || last + 1 == name.size()) return name;
    if (name[last] != '_' && name[last] != '.' && name[last] != '-') return name;
    return name.substr(0, last);
}

/// A plain board cannot be the shelf or cabinet that its name says, but a piece of it can.
bool isBoard(const Piece& piece, const ObjectDraft& draft) {
    constexpr std::array<int, 9> kBuiltOfBoards = {3, 4, 5, 7, 10, 14, 15, 17, 32};
    return draft.label.kind == LabelKind::Target && piece.triangles <= 24 &&
           piece.box.sizes().minCoeff() < 0.08F &&
           std::find(kBuiltOfBoards.begin(), kBuiltOfBoards.end(), draft.label.nyu40) !=
               kBuiltOfBoards.end();
}

bool areBoardsOfOneThing(const Piece& a, const ObjectDraft& draft_a, const Piece& b,
                         const ObjectDraft& draft_b) {
    if (!isBoard(a, draft_a) || !isBoard(b, draft_b)) return false;
    if (draft_a.label.nyu40 != draft_b.label.nyu40) return false;
    const std::string stem_a = stemOf(draft_a.name);
    const std::string stem_b = stemOf(draft_b.name);
    const bool a_is_base = stem_b != draft_b.name && draft_a.name == stem_b;
    const bool b_is_base = stem_a != draft_a.name && draft_b.name == stem_a;
    return stem_a == stem_b || a_is_base || b_is_base;
}

bool mayJoin(const Piece& a, const ObjectDraft& draft_a, const Piece& b,
             const ObjectDraft& draft_b) {
    if (a.structure && b.structure) return false;
    if (a.structure || b.structure) {
        const Piece& other = a.structure ? b : a;
        const ObjectDraft& structure = a.structure ? draft_a : draft_b;
        return other.is_part &&
               (structure.label.nyu40 == kNyuDoor || structure.label.nyu40 == kNyuWindow);
    }
    if (!a.loose && !b.loose) return false;
    const bool both_named =
        draft_a.label.kind == LabelKind::Target && draft_b.label.kind == LabelKind::Target;
    if (!both_named) return true;
    if (draft_a.label.nyu40 != draft_b.label.nyu40) return false;
    return !(a.by_material || b.by_material) || liesInside(a.box, b.box) ||
           liesInside(b.box, a.box);
}

class Groups {
  public:
    Groups(const std::vector<Piece>& pieces, const std::vector<ObjectDraft>& drafts)
        : pieces_(pieces), drafts_(drafts), groups_(pieces.size()), classed_(pieces.size()) {
        for (const Piece& piece : pieces) boxes_.push_back(piece.box);
        for (std::size_t i = 0; i < drafts.size(); ++i) {
            if (drafts[i].label.kind == LabelKind::Target) classed_[i] = i;
        }
    }
    std::size_t find(std::size_t i) { return groups_.find(i); }
    void join(std::size_t a, std::size_t b, bool certain = false) {
        a = find(a);
        b = find(b);
        if (a == b) return;
        if (!certain && (standSideBySide(boxes_[a], boxes_[b]) || areOfTwoObjects(a, b))) return;
        const Eigen::AlignedBox3f together = boxes_[a].merged(boxes_[b]);
        const float largest = std::max(boxes_[a].diagonal().norm(), boxes_[b].diagonal().norm());
        if (together.diagonal().norm() > std::max(kLargestThing, 1.05F * largest)) return;
        const auto [first, second] = std::minmax(a, b);
        groups_.join(first, second);
        boxes_[first] = together;
        if (!classed_[first] ||
            (classed_[second] && sizeOf(*classed_[second]) > sizeOf(*classed_[first]))) {
            classed_[first] = classed_[second];
        }
    }

  private:
    [[nodiscard]] float sizeOf(std::size_t piece) const {
        return pieces_[piece].box.diagonal().norm();
    }

    /// Where objects are split by material, a third piece must not join a table to a chair.
    [[nodiscard]] bool areOfTwoObjects(std::size_t a, std::size_t b) const {
        if (!classed_[a] || !classed_[b]) return false;
        const Piece& one = pieces_[*classed_[a]];
        const Piece& other = pieces_[*classed_[b]];
        return (one.by_material || other.by_material) &&
               !mayJoin(one, drafts_[*classed_[a]], other, drafts_[*classed_[b]]);
    }

    /// Two large things that share little ground: a cupboard beside a fireplace, flush with it.
    static bool standSideBySide(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
        if (std::min(a.diagonal().norm(), b.diagonal().norm()) < kBothLarge) return false;
        const Eigen::Vector3f common =
            (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).cwiseMax(0.0F).array() +
            kContactGap;
        const auto ground = [](const Eigen::Vector3f& size) {
            return (size.x() + kContactGap) * (size.y() + kContactGap);
        };
        return ground(common) < 0.5F * std::min(ground(a.sizes()), ground(b.sizes()));
    }

    const std::vector<Piece>& pieces_;
    const std::vector<ObjectDraft>& drafts_;
    DisjointSets<> groups_;
    std::vector<Eigen::AlignedBox3f> boxes_;
    std::vector<std::optional<std::size_t>> classed_;  // each group's largest piece with a class
};

std::vector<Piece> describePieces(const RawScene& raw, const std::vector<bool>& structure,
                                  const std::vector<ObjectDraft>& drafts,
                                  const std::vector<bool>& by_material) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        Piece piece;
        piece.box = boundsOf(raw, drafts[i]);
        piece.surfaces = surfacesOf(raw, drafts[i]);
        for (const SurfaceView& surface : piece.surfaces) {
            piece.triangles += surface.triangles.size();
        }
        piece.structure = structure[i];
        piece.is_part = drafts[i].label.kind == LabelKind::Part;
        piece.named = !drafts[i].loose && !isProgramName(drafts[i].name);
        piece.by_material = !by_material.empty() && by_material[i];
        piece.loose = !piece.named || piece.is_part || piece.by_material;
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

struct Candidate {
    std::size_t a;
    std::size_t b;
    bool touches = false;
    bool joins = false;
    bool boards = false;    // of one shelf, by their names
    bool a_stands = false;  // on b
    bool b_stands = false;  // on a
    float size = 0.0F;      // of the smaller: small pieces find their place first
};

/// Leaves that reach into a cupboard are still the plant's: a part with neighbours of its own size
/// does not join far larger ones as well.
void preferOwnSize(const std::vector<Piece>& pieces, std::vector<Candidate>& candidates) {
    constexpr float kFarLarger = 2.5F;
    const auto isFarLarger = [&](std::size_t other, std::size_t part) {
        return pieces[other].box.diagonal().norm() >
               kFarLarger * pieces[part].box.diagonal().norm();
    };
    std::vector<bool> has_own(pieces.size(), false);
    for (const Candidate& c : candidates) {
        if (!c.joins) continue;
        if (pieces[c.a].is_part && !isFarLarger(c.b, c.a)) has_own[c.a] = true;
        if (pieces[c.b].is_part && !isFarLarger(c.a, c.b)) has_own[c.b] = true;
    }
    for (Candidate& c : candidates) {
        if ((has_own[c.a] && isFarLarger(c.b, c.a)) || (has_own[c.b] && isFarLarger(c.a, c.b))) {
            c.joins = false;
        }
    }
}

/// Books that stand side by side on one board are things of their own, even if each is a mesh of
/// one material.
void separateNeighbours(const std::vector<Piece>& pieces, std::vector<Candidate>& candidates) {
    std::vector<std::set<std::size_t>> supports(pieces.size());
    for (const Candidate& c : candidates) {
        if (c.a_stands && !pieces[c.b].structure) supports[c.a].insert(c.b);
        if (c.b_stands && !pieces[c.a].structure) supports[c.b].insert(c.a);
    }
    for (Candidate& c : candidates) {
        if (!c.joins || !pieces[c.a].by_material || !pieces[c.b].by_material) continue;
        c.joins = std::ranges::none_of(supports[c.a],
                                       [&](std::size_t s) { return supports[c.b].contains(s); });
    }
}

/// Whether a piece that nothing holds may be a part of the other one. Between surfaces
/// where it has a name: boxes know nothing of the air in a crate.
bool floatsBeside(const Piece& piece, const Piece& other) {
    if (piece.by_material && liesInside(piece.box, other.box)) return true;
    return !piece.named || !findContact(piece.surfaces, other.surfaces, kNearGap).empty();
}

/// Nothing floats in a room: a loose piece that nothing touches but things lying on it is a part
/// of the nearest other one (a table top on hidden brackets, a leaf beside its stem).
void joinFloating(const std::vector<Piece>& pieces, const std::vector<ObjectDraft>& drafts,
                  const std::vector<Candidate>& candidates, Groups& groups) {
    std::vector<bool> held(pieces.size(), false);
    for (const Candidate& candidate : candidates) {
        if (!candidate.touches || groups.find(candidate.a) == groups.find(candidate.b)) continue;
        const Piece& a = pieces[candidate.a];
        const Piece& b = pieces[candidate.b];
        // What lies on top does not hold.
        const bool a_lies_on_b = a.box.min().z() > b.box.max().z() - 0.01F;
        const bool b_lies_on_a = b.box.min().z() > a.box.max().z() - 0.01F;
        if (!a_lies_on_b) held[groups.find(candidate.b)] = true;
        if (!b_lies_on_a) held[groups.find(candidate.a)] = true;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        if (groups.find(i) != i || held[i] || piece.structure || !piece.loose) continue;
        std::size_t nearest = pieces.size();
        float best = kNearGap;
        for (std::size_t j = 0; j < pieces.size(); ++j) {
            if (groups.find(j) == i || !mayJoin(piece, drafts[i], pieces[j], drafts[j])) continue;
            const auto distance = static_cast<float>(piece.box.exteriorDistance(pieces[j].box));
            const bool closer_around = piece.by_material && distance == best &&
                                       nearest < pieces.size() &&
                                       liesInside(piece.box, pieces[j].box) &&
                                       pieces[j].box.volume() < pieces[nearest].box.volume();
            if ((distance < best || closer_around) && floatsBeside(piece, pieces[j])) {
                best = distance;
                nearest = j;
            }
        }
        if (nearest < pieces.size()) groups.join(i, nearest);
    }
}

}  // namespace

bool standsOn(const Eigen::AlignedBox3f& upper, const Eigen::AlignedBox3f& lower,
              const std::vector<Eigen::Vector3f>& contact) {
    const auto footprint = [](const Eigen::AlignedBox3f& box) {
        return std::max(box.sizes().x(), 1e-4F) * std::max(box.sizes().y(), 1e-4F);
    };
    const float height = upper.sizes().z();
    const float sole = upper.min().z() + std::max(0.01F, 0.12F * height);
    for (const Eigen::Vector3f& p : contact) {
        if (p.z() > sole) return false;
    }
    if (footprint(upper) > 0.7F * footprint(lower)) return false;
    const float width = std::max(upper.sizes().x(), upper.sizes().y());
    return height < 5.0F * width;
}

std::vector<SurfaceView> surfacesOf(const RawScene& raw, const ObjectDraft& draft) {
    std::vector<SurfaceView> surfaces;
    for (const std::size_t part : draft.parts) {
        surfaces.push_back({raw.parts[part].positions, raw.parts[part].triangles});
    }
    return surfaces;
}

bool liesInside(const Eigen::AlignedBox3f& smaller, const Eigen::AlignedBox3f& larger) {
    constexpr float kThin_m = 0.01F;
    const Eigen::Vector3f size = smaller.sizes().cwiseMax(kThin_m);
    if (size.prod() > larger.sizes().cwiseMax(kThin_m).prod()) return false;
    const Eigen::Vector3f low = smaller.min().cwiseMax(larger.min());
    const Eigen::Vector3f high = smaller.max().cwiseMin(larger.max());
    if (((high - low).array() < 0.0F).any()) return false;
    return (high - low).cwiseMax(kThin_m).prod() >= 0.5F * size.prod();
}

int nameRank(const ObjectDraft& draft, bool named) {
    switch (draft.label.kind) {
        case LabelKind::Structure:
            return 6;
        case LabelKind::Target:
            return 5;
        case LabelKind::Part:
            return draft.label.nyu40 != 0 ? 4 : 1;
        case LabelKind::Weak:
            return 3;
        case LabelKind::None:
            return named ? 2 : 0;
    }
    return 0;
}

std::vector<MergedPiece> mergePieces(const RawScene& raw, const std::vector<bool>& structure,
                                     std::vector<ObjectDraft>& drafts,
                                     const std::vector<bool>& by_material) {
    const std::vector<Piece> pieces = describePieces(raw, structure, drafts, by_material);
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = i + 1; j < pieces.size(); ++j) {
            if (pieces[i].box.exteriorDistance(pieces[j].box) > kContactGap) continue;
            // Walls are asked too: what touches one does not float.
            if (!pieces[i].loose && !pieces[j].loose &&
                !areBoardsOfOneThing(pieces[i], drafts[i], pieces[j], drafts[j])) {
                continue;
            }
            candidates.push_back(
                {i, j, false, false, false, false, false,
                 std::min(pieces[i].box.diagonal().norm(), pieces[j].box.diagonal().norm())});
        }
    }
    parallelFor(candidates.size(), [&](std::size_t k) {
        Candidate& candidate = candidates[k];
        const Piece& a = pieces[candidate.a];
        const Piece& b = pieces[candidate.b];
        const auto contact = findContact(a.surfaces, b.surfaces, kContactGap);
        if (contact.empty()) return;
        candidate.touches = true;
        candidate.a_stands = standsOn(a.box, b.box, contact);
        candidate.b_stands = standsOn(b.box, a.box, contact);
        const ObjectDraft& draft_a = drafts[candidate.a];
        const ObjectDraft& draft_b = drafts[candidate.b];
        candidate.boards = areBoardsOfOneThing(a, draft_a, b, draft_b);
        if (!candidate.boards && !mayJoin(a, draft_a, b, draft_b)) return;
        const bool crumb = a.loose && b.loose &&
                           std::min(a.box.sizes().maxCoeff(), b.box.sizes().maxCoeff()) < kCrumb;
        candidate.joins = candidate.boards || crumb || a.is_part || b.is_part ||
                          (!candidate.a_stands && !candidate.b_stands);
    });
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.size < b.size; });
    preferOwnSize(pieces, candidates);
    separateNeighbours(pieces, candidates);
    Groups groups(pieces, drafts);
    for (const Candidate& candidate : candidates) {
        if (candidate.joins) groups.join(candidate.a, candidate.b, candidate.boards);
    }
    joinFloating(pieces, drafts, candidates, groups);

    std::vector<std::vector<std::size_t>> members(drafts.size());
    for (std::size_t i = 0; i < drafts.size(); ++i) members[groups.find(i)].push_back(i);
    std::vector<ObjectDraft> result;
    std::vector<MergedPiece> merges;
    for (const auto& group : members) {
        if (group.empty()) continue;
        const auto better = [&](std::size_t a, std::size_t b) {
            return std::tuple(nameRank(drafts[a], pieces[a].named),
                              pieces[a].box.diagonal().norm()) <
                   std::tuple(nameRank(drafts[b], pieces[b].named),
                              pieces[b].box.diagonal().norm());
        };
        const std::size_t best = *std::max_element(group.begin(), group.end(), better);
        ObjectDraft merged = drafts[best];
        merged.parts.clear();
        for (const std::size_t i : group) {
            if (i != best) merges.push_back({pieces[i].named ? drafts[i].name : "", result.size()});
            merged.parts.insert(merged.parts.end(), drafts[i].parts.begin(), drafts[i].parts.end());
        }
        if (group.size() > 1 && merged.label.kind == LabelKind::Part && merged.label.nyu40 != 0) {
            merged.label.kind = LabelKind::Target;
        }
        result.push_back(std::move(merged));
    }
    drafts = std::move(result);
    return merges;
}

}  // namespace dollytrack
