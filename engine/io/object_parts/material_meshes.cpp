#include "engine/io/object_parts/material_meshes.h"

#include "engine/core/disjoint_sets.h"
#include "engine/geometry/contact.h"
#include "engine/io/object_parts/draft_pieces.h"
#include "engine/io/object_parts/piece_merge.h"
#include "engine/jobs/parallel.h"
#include "engine/scene/furniture_sizes.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>

namespace dollytrack {
namespace {

constexpr int kChair = 5;  // NYU40
constexpr int kTable = 7;
constexpr int kBooks = 23;          // a row of books is one object
constexpr float kTouch_m = 0.003F;  // largest gap of touching pieces
constexpr float kFloat_m = 0.03F;   // largest gap to the object of a piece that touches nothing
constexpr float kCrumb_m = 0.05F;   // smaller pieces are no objects
constexpr float kCrumbGap_m = 0.1F;
constexpr float kLeastObject_m = 0.3F;  // smaller objects are no evidence
constexpr float kUnsized_m = 2.0F;      // longest side of objects of classes without a typical size
constexpr float kRoom_m = 3.0F;  // smallest extent in two directions of a draft across a room
// Drafts without a class: smallest extent in x and y, as a share of the scene's shorter side.
constexpr float kAcross = 0.6F;
constexpr float kAir = 0.25F;           // largest share of such a draft's box that its objects fill
constexpr std::size_t kLeastAlike = 3;  // number of equal objects that is no coincidence
constexpr std::size_t kMostLoosePieces = 10'000;  // of all examined drafts; foliage has more
constexpr std::size_t kMostPairs = 50'000;

struct LooseSurface {
    std::size_t draft;
    DraftPiece piece;
    std::vector<SurfaceView> surfaces;
    std::size_t triangles = 0;
    double area = 0.0;
};

/// The pieces of one object.
struct FoundObject {
    std::vector<std::size_t> pieces;
    Eigen::AlignedBox3f box;
    double area = 0.0;
    bool alike = false;  // whether other objects have the same arrangement of pieces

    [[nodiscard]] float longest() const { return box.sizes().maxCoeff(); }
};

bool isUpright(const FoundObject& whole) {
    const Eigen::Vector3f size = whole.box.sizes();
    return size.z() > 1.2F * std::max(size.x(), size.y());
}

const FurnitureSize* furnitureSizeOf(const Label& label) {
    if (label.kind != LabelKind::Target && label.kind != LabelKind::Part) return nullptr;
    const auto found = std::ranges::find(kFurnitureSizes, label.nyu40, &FurnitureSize::nyu40);
    return found == kFurnitureSizes.end() ? nullptr : &*found;
}

double meshAreaOf(const MeshPart& mesh) {
    double area = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const Eigen::Vector3f& a = mesh.positions[t[0]];
        area += 0.5 * static_cast<double>(
                          (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm());
    }
    return area;
}

Eigen::AlignedBox3f boxOf(const RawScene& raw, const ObjectDraft& draft) {
    Eigen::AlignedBox3f box;
    for (const std::size_t part : draft.parts) box.extend(raw.parts[part].bounds);
    return box;
}

/// Whether a draft is larger than an object of its class should be, and therefore examined.
bool isLarge(const RawScene& raw, const ObjectDraft& draft) {
    if (draft.label.kind == LabelKind::Structure || draft.loose) return false;
    const FurnitureSize* size = furnitureSizeOf(draft.label);
    const float most = size != nullptr ? static_cast<float>(size->high) : kUnsized_m;
    return boxOf(raw, draft).sizes().maxCoeff() > most;
}

/// Whether the labels allow two pieces to belong to one object. A piece without a class may be part
/// of any object.
bool mayBeOne(const ObjectDraft& a, const ObjectDraft& b) {
    const auto isOfClass = [](const Label& label) {
        return label.nyu40 != 0 &&
               (label.kind == LabelKind::Target || label.kind == LabelKind::Part);
    };
    return !isOfClass(a.label) || !isOfClass(b.label) || a.label.nyu40 == b.label.nyu40;
}

/// The search for the objects that a scene's large drafts hold parts of.
class MaterialMeshSearch {
  public:
    MaterialMeshSearch(const RawScene& raw, const std::vector<ObjectDraft>& drafts)
        : drafts_(drafts), boxes_(drafts.size()), suspect_(drafts.size(), false) {
        for (std::size_t i = 0; i < drafts.size(); ++i) {
            boxes_[i] = boxOf(raw, drafts[i]);
            scene_box_.extend(boxes_[i]);
            suspect_[i] = isLarge(raw, drafts[i]);
        }
        findPieces(raw);
    }

    /// Determines the drafts that certainly contain parts of several objects, and these objects.
    void run() {
        if (pieces_.empty() || !findNear()) {
            suspect_.assign(drafts_.size(), false);
            return;
        }
        // Excluding a draft can remove the evidence for another one, so repeat until stable.
        for (bool changed = true; changed;) {
            changed = false;
            findWholes();
            for (std::size_t i = 0; i < drafts_.size(); ++i) {
                if (!suspect_[i]) continue;
                const Evidence evidence = weigh(i);
                if (holdsSeveral(i, evidence)) continue;
                if (mayHoldSeveral(i, evidence)) doubtful_.push_back(i);
                suspect_[i] = false;
                changed = true;
            }
        }
    }

    /// Whether each draft holds both chairs and tables: its name mentions both ("chair_tables"),
    /// and it has several equal objects of either shape. Chairs are higher than wide.
    [[nodiscard]] std::vector<bool> holdChairsAndOthers(const LabelTable& labels) const {
        std::vector<bool> both(drafts_.size(), false);
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (!suspect_[i] || !labels.mentions(drafts_[i].name, kChair) ||
                !labels.mentions(drafts_[i].name, kTable)) {
                continue;
            }
            const auto has = [&](bool upright) {
                return std::ranges::any_of(wholes_, [&](const FoundObject& whole) {
                    return whole.alike && isOf(whole, i) && isUpright(whole) == upright;
                });
            };
            both[i] = has(true) && has(false);
        }
        return both;
    }

    /// Drafts that may contain several objects, because they have equal, separate pieces.
    [[nodiscard]] const std::vector<std::size_t>& doubtful() const { return doubtful_; }
    [[nodiscard]] bool isTakenApart(std::size_t draft) const { return suspect_[draft]; }
    [[nodiscard]] const std::vector<FoundObject>& wholes() const { return wholes_; }
    [[nodiscard]] LooseSurface& piece(std::size_t i) { return pieces_[i]; }

  private:
    void findPieces(const RawScene& raw) {
        std::vector<std::vector<DraftPiece>> found(drafts_.size());
        parallelFor(drafts_.size(), [&](std::size_t i) {
            if (suspect_[i]) found[i] = findDraftPieces(raw, drafts_[i], 2, kMostLoosePieces);
        });
        std::size_t count = 0;
        for (const auto& of_draft : found) count += of_draft.size();
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (found[i].empty() || count > kMostLoosePieces) suspect_[i] = false;
            if (!suspect_[i]) continue;
            for (DraftPiece& piece : found[i]) pieces_.push_back({i, std::move(piece), {}});
        }
        for (LooseSurface& one : pieces_) {
            for (const MeshPart& mesh : one.piece.meshes) {
                one.surfaces.push_back({mesh.positions, mesh.triangles});
                one.triangles += mesh.triangles.size();
                one.area += meshAreaOf(mesh);
            }
        }
    }

    struct Pair {
        std::size_t a;
        std::size_t b;
        bool touches = false;
        bool joins = false;
        bool near = false;
    };

    /// Compares pieces whose boxes are near each other. Returns false if there are too many pairs.
    bool findNear() {
        std::vector<std::size_t> order(pieces_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        const auto low = [&](std::size_t i) { return pieces_[i].piece.box.min().x(); };
        std::ranges::stable_sort(order, {}, low);
        for (std::size_t i = 0; i < order.size(); ++i) {
            const LooseSurface& a = pieces_[order[i]];
            for (std::size_t k = i + 1; k < order.size(); ++k) {
                const LooseSurface& b = pieces_[order[k]];
                if (low(order[k]) > a.piece.box.max().x() + kFloat_m) break;
                if (a.piece.box.exteriorDistance(b.piece.box) > kFloat_m) continue;
                if (!mayBeOne(drafts_[a.draft], drafts_[b.draft])) continue;
                pairs_.push_back({std::min(order[i], order[k]), std::max(order[i], order[k])});
                if (pairs_.size() > kMostPairs) return false;
            }
        }
        std::ranges::sort(pairs_, {}, [](const Pair& pair) { return std::pair(pair.a, pair.b); });
        parallelFor(pairs_.size(), [&](std::size_t i) {
            Pair& pair = pairs_[i];
            const LooseSurface& a = pieces_[pair.a];
            const LooseSurface& b = pieces_[pair.b];
            const auto contact = findContact(a.surfaces, b.surfaces, kTouch_m);
            pair.touches = !contact.empty();
            pair.joins = pair.touches && !standsOn(a.piece.box, b.piece.box, contact) &&
                         !standsOn(b.piece.box, a.piece.box, contact);
            pair.near = pair.touches || !findContact(a.surfaces, b.surfaces, kFloat_m).empty();
        });
        return true;
    }

    [[nodiscard]] bool counts(std::size_t piece) const { return suspect_[pieces_[piece].draft]; }

    void gather() {
        std::vector<std::size_t> whole_of(pieces_.size());
        wholes_.clear();
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (!counts(i)) continue;
            if (joined_.find(i) == i) {
                whole_of[i] = wholes_.size();
                wholes_.emplace_back();
            }
            FoundObject& whole = wholes_[whole_of[joined_.find(i)]];
            whole.pieces.push_back(i);
            whole.box.extend(pieces_[i].piece.box);
            whole.area += pieces_[i].area;
        }
    }

    void findWholes() {
        joined_ = DisjointSets(pieces_.size());
        std::vector<bool> touched(pieces_.size(), false);
        for (const Pair& pair : pairs_) {
            if (!counts(pair.a) || !counts(pair.b)) continue;
            if (pair.joins) joined_.join(pair.a, pair.b);
            if (pair.touches) touched[pair.a] = touched[pair.b] = true;
        }
        for (const Pair& pair : pairs_) {
            if (!counts(pair.a) || !counts(pair.b) || !pair.near || pair.touches) continue;
            if (!touched[pair.a] || !touched[pair.b]) joined_.join(pair.a, pair.b);
        }
        gather();
        joinCrumbs();
        gather();
        findAlike();
    }

    /// Joins pieces that are too small for an object to the nearest object.
    void joinCrumbs() {
        for (const FoundObject& crumb : wholes_) {
            if (crumb.longest() >= kCrumb_m) continue;
            float best = kCrumbGap_m;
            const FoundObject* nearest = nullptr;
            for (const FoundObject& other : wholes_) {
                if (other.longest() < kCrumb_m) continue;
                const auto gap = static_cast<float>(crumb.box.exteriorDistance(other.box));
                if (gap >= best || !mayBeOne(drafts_[pieces_[crumb.pieces.front()].draft],
                                             drafts_[pieces_[other.pieces.front()].draft])) {
                    continue;
                }
                best = gap;
                nearest = &other;
            }
            if (nearest != nullptr) joined_.join(crumb.pieces.front(), nearest->pieces.front());
        }
    }

    /// Marks objects that occur at least three times: with pieces of the same drafts, the same
    /// numbers of triangles, and equal height and area.
    void findAlike() {
        using Key = std::vector<std::pair<std::size_t, std::size_t>>;
        std::vector<Key> keys(wholes_.size());
        for (std::size_t i = 0; i < wholes_.size(); ++i) {
            for (const std::size_t p : wholes_[i].pieces) {
                keys[i].emplace_back(pieces_[p].draft, pieces_[p].triangles);
            }
            std::ranges::sort(keys[i]);
        }
        std::vector<std::size_t> order(wholes_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
            return std::tie(keys[a], wholes_[a].area) < std::tie(keys[b], wholes_[b].area);
        });
        const auto isLike = [&](std::size_t a, std::size_t b) {
            const FoundObject& one = wholes_[a];
            const FoundObject& other = wholes_[b];
            return keys[a] == keys[b] && std::abs(one.area - other.area) < 0.02 * one.area &&
                   std::abs(one.box.sizes().z() - other.box.sizes().z()) < 0.02F;
        };
        for (std::size_t first = 0; first < order.size();) {
            std::size_t end = first + 1;
            while (end < order.size() && isLike(order[first], order[end])) ++end;
            for (std::size_t i = first; i < end; ++i) {
                wholes_[order[i]].alike = end - first >= kLeastAlike;
            }
            first = end;
        }
    }

    [[nodiscard]] bool isOf(const FoundObject& whole, std::size_t draft) const {
        return std::ranges::any_of(whole.pieces,
                                   [&](std::size_t p) { return pieces_[p].draft == draft; });
    }
    [[nodiscard]] bool isOfSeveral(const FoundObject& whole) const {
        return std::ranges::any_of(whole.pieces, [&](std::size_t p) {
            return pieces_[p].draft != pieces_[whole.pieces.front()].draft;
        });
    }

    /// Evidence that a draft contains parts of several objects.
    struct Evidence {
        std::size_t objects = 0;        // number of objects with pieces of the draft
        std::size_t fitting = 0;        // of these, with a typical size of the draft's class
        double area = 0.0;              // total area of the objects
        double alike_area = 0.0;        // area of the objects that occur several times
        double alike_mixed_area = 0.0;  // of these, made of several drafts
        double filled = 0.0;            // total volume of the objects' boxes
    };

    [[nodiscard]] Evidence weigh(std::size_t draft) const {
        Evidence evidence;
        const FurnitureSize* size = furnitureSizeOf(drafts_[draft].label);
        for (const FoundObject& object : wholes_) {
            if (!isOf(object, draft)) continue;
            evidence.area += object.area;
            if (object.longest() < kLeastObject_m) continue;
            ++evidence.objects;
            const auto longest = static_cast<double>(object.longest());
            evidence.fitting +=
                size != nullptr && longest >= 0.5 * size->low && longest <= 1.5 * size->high;
            if (object.alike) evidence.alike_area += object.area;
            if (object.alike && isOfSeveral(object)) evidence.alike_mixed_area += object.area;
            evidence.filled += static_cast<double>(object.box.volume());
        }
        return evidence;
    }

    [[nodiscard]] bool holdsSeveral(std::size_t draft, const Evidence& evidence) const {
        if (evidence.objects < kLeastAlike) return false;
        if (evidence.alike_mixed_area >= 0.5 * evidence.area) return true;
        const Label& label = drafts_[draft].label;
        const Eigen::Vector3f reach = boxes_[draft].sizes();
        if (const FurnitureSize* size = furnitureSizeOf(label)) {
            return size->nyu40 != kBooks &&
                   static_cast<double>(reach.maxCoeff()) > 1.5 * size->high &&
                   2 * evidence.fitting >= evidence.objects;
        }
        const float least =
            label.kind == LabelKind::Target
                ? kRoom_m
                : kAcross * std::min(scene_box_.sizes().x(), scene_box_.sizes().y());
        return (label.kind == LabelKind::Target || label.kind == LabelKind::None) &&
               std::min(reach.x(), reach.y()) > least &&
               evidence.filled < kAir * static_cast<double>(boxes_[draft].volume());
    }

    /// Whether a draft may contain several objects. Equal objects alone are not conclusive, since
    /// they may also be the slats of one object.
    [[nodiscard]] bool mayHoldSeveral(std::size_t draft, const Evidence& evidence) const {
        return evidence.objects >= kLeastAlike && evidence.alike_area >= 0.5 * evidence.area &&
               drafts_[draft].label.nyu40 != kBooks;
    }

    const std::vector<ObjectDraft>& drafts_;
    std::vector<Eigen::AlignedBox3f> boxes_;
    Eigen::AlignedBox3f scene_box_;
    std::vector<bool> suspect_;
    std::vector<std::size_t> doubtful_;
    std::vector<LooseSurface> pieces_;
    std::vector<Pair> pairs_;
    DisjointSets<> joined_;
    std::vector<FoundObject> wholes_;
};

/// Whether an object's size permits the class of the mesh in which it was found. A single connected
/// piece keeps the class even if it is too large, since there is no better name.
bool mayHave(const Label& label, const FoundObject& whole) {
    const FurnitureSize* size = furnitureSizeOf(label);
    if (size == nullptr) return false;
    const auto longest = static_cast<double>(whole.longest());
    return longest >= size->low / 3.0 && (longest <= 2.0 * size->high || whole.pieces.size() == 1);
}

/// The draft of an object, with the most specific name whose class its size permits.
ObjectDraft draftOf(const FoundObject& whole, const std::vector<ObjectDraft>& drafts,
                    MaterialMeshSearch& search, RawScene& raw, std::size_t& owner) {
    ObjectDraft made;
    std::optional<std::tuple<int, double>> best;
    bool several = false;
    for (const std::size_t p : whole.pieces) {
        LooseSurface& piece = search.piece(p);
        const std::tuple rank(nameRank(drafts[piece.draft], true), piece.area);
        several |= best && piece.draft != owner;
        if (!best || rank > *best) {
            best = rank;
            owner = piece.draft;
        }
        for (MeshPart& mesh : piece.piece.meshes) {
            made.parts.push_back(raw.parts.size());
            raw.parts.push_back(std::move(mesh));
        }
    }
    made.label = drafts[owner].label;
    made.name = drafts[owner].name;
    if (made.label.kind == LabelKind::Part && made.label.nyu40 != 0) {
        made.label.kind = LabelKind::Target;
    }
    if (made.label.kind == LabelKind::Target && !mayHave(made.label, whole)) made.label = {};
    if (several && made.label.nyu40 != 0) made.name = std::string(nyu40Name(made.label.nyu40));
    return made;
}

}  // namespace

MaterialMeshes regroupMaterialMeshes(RawScene& raw, const LabelTable& labels,
                                     std::vector<ObjectDraft>& drafts, bool apply) {
    MaterialMeshSearch search(raw, drafts);
    search.run();
    MaterialMeshes found;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (search.isTakenApart(i)) found.names.push_back(drafts[i].name);
    }
    for (const std::size_t i : search.doubtful()) found.doubtful.push_back(drafts[i].name);
    found.objects = search.wholes().size();
    if (found.names.empty() || !apply) return found;
    const std::vector<bool> mixed = search.holdChairsAndOthers(labels);
    std::vector<std::vector<ObjectDraft>> made(drafts.size());  // by the draft with their name
    for (const FoundObject& whole : search.wholes()) {
        std::size_t owner = 0;
        ObjectDraft draft = draftOf(whole, drafts, search, raw, owner);
        if (mixed[owner]) draft.label = labels.find(isUpright(whole) ? "chair" : "table");
        if (draft.label.kind == LabelKind::None) ++found.unnamed;
        made[owner].push_back(std::move(draft));
    }
    std::set<std::string> used;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (!search.isTakenApart(i)) used.insert(drafts[i].name);
    }
    std::map<std::string, int> numbers;
    std::vector<ObjectDraft> result;
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        if (!search.isTakenApart(i)) {
            result.push_back(std::move(drafts[i]));
            continue;
        }
        for (const std::size_t part : drafts[i].parts) raw.parts[part] = MeshPart{};
        for (ObjectDraft& draft : made[i]) {
            const std::string base = draft.name + "_";
            do draft.name = base + std::to_string(++numbers[base]);
            while (used.contains(draft.name));
            result.push_back(std::move(draft));
        }
    }
    drafts = std::move(result);
    return found;
}

}  // namespace dollytrack
