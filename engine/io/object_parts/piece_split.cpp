#include "engine/io/object_parts/piece_split.h"

#include "engine/core/disjoint_sets.h"
#include "engine/io/object_parts/draft_pieces.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cmath>

namespace dollytrack {
namespace {

constexpr float kFarApart = 0.5F;         // m: smallest gap between separate objects
constexpr std::ptrdiff_t kFewOthers = 5;  // largest number of other objects beside a whole room

std::vector<ObjectDraft> split(RawScene& raw, const LabelTable& labels, const ObjectDraft& draft,
                               std::size_t least) {
    std::vector<DraftPiece> found = findDraftPieces(raw, draft, least);
    if (found.empty()) return {draft};
    std::vector<ObjectDraft> pieces;
    for (DraftPiece& one : found) {
        ObjectDraft piece;
        piece.loose = true;
        std::size_t most = 0;
        for (MeshPart& mesh : one.meshes) {
            if (mesh.triangles.size() > most) {
                most = mesh.triangles.size();
                piece.name = raw.materials[mesh.material].name;
            }
            piece.parts.push_back(raw.parts.size());
            raw.parts.push_back(std::move(mesh));
        }
        piece.label = labels.find(piece.name);
        // "mat" is a material here, not a door mat.
        if (piece.label.pattern == "mat") piece.label = {};
        if (piece.label.kind == LabelKind::None && isMaterialNumber(piece.name)) piece.name.clear();
        pieces.push_back(std::move(piece));
    }
    for (const std::size_t part : draft.parts) raw.parts[part] = MeshPart{};
    return pieces;
}

/// Whether a draft may have a gap of half a metre along an axis. A fast test: such a gap leaves a
/// cell of a quarter of a metre without triangles.
bool mayHaveGap(const RawScene& raw, const ObjectDraft& draft, const Eigen::AlignedBox3f& bounds,
                int axis) {
    constexpr float kCell = 0.48F * kFarApart;
    constexpr float kMostCells = 4096.0F;
    const float low = bounds.min()[axis];
    const float size = bounds.sizes()[axis];
    if (!(size > kFarApart)) return false;
    if (!(size < kMostCells * kCell)) return true;
    const auto cellOf = [&](float x) { return static_cast<std::size_t>((x - low) / kCell); };
    std::vector<int> change(cellOf(bounds.max()[axis]) + 2, 0);  // change of the triangle count
    for (const std::size_t index : draft.parts) {
        const MeshPart& part = raw.parts[index];
        for (const Triangle& t : part.triangles) {
            const float a = part.positions[t[0]][axis];
            const float b = part.positions[t[1]][axis];
            const float c = part.positions[t[2]][axis];
            ++change[cellOf(std::min({a, b, c}))];
            --change[cellOf(std::max({a, b, c})) + 1];
        }
    }
    int here = 0;
    for (std::size_t i = 0; i + 1 < change.size(); ++i) {
        here += change[i];
        if (here == 0) return true;
    }
    return false;
}

/// Whether a draft has a gap of half a metre along an axis.
bool hasGap(const RawScene& raw, const ObjectDraft& draft) {
    const Eigen::AlignedBox3f bounds = boundsOf(raw, draft);
    for (int axis = 0; axis < 3; ++axis) {
        if (!mayHaveGap(raw, draft, bounds, axis)) continue;
        std::vector<std::pair<float, float>> spans;
        for (const std::size_t index : draft.parts) {
            const MeshPart& part = raw.parts[index];
            for (const Triangle& t : part.triangles) {
                const float a = part.positions[t[0]][axis];
                const float b = part.positions[t[1]][axis];
                const float c = part.positions[t[2]][axis];
                spans.emplace_back(std::min({a, b, c}), std::max({a, b, c}));
            }
        }
        std::sort(spans.begin(), spans.end());
        float reached = spans.empty() ? 0.0F : spans.front().second;
        for (const auto& [low, high] : spans) {
            if (low - reached > kFarApart) return true;
            reached = std::max(reached, high);
        }
    }
    return false;
}

/// Clusters pieces whose boxes are near each other.
std::vector<ObjectDraft> clusterPieces(const RawScene& raw, std::vector<ObjectDraft> pieces) {
    DisjointSets near(pieces.size());
    std::vector<Eigen::AlignedBox3f> boxes;
    for (const ObjectDraft& piece : pieces) boxes.push_back(boundsOf(raw, piece));
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (std::size_t j = i + 1; j < pieces.size(); ++j) {
            if (boxes[i].exteriorDistance(boxes[j]) > kFarApart) continue;
            near.join(i, j);
        }
    }
    std::vector<ObjectDraft> clusters;
    std::vector<std::size_t> cluster_of(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (near.find(i) == i) {
            cluster_of[i] = clusters.size();
            clusters.push_back(std::move(pieces[i]));
        } else {
            auto& parts = clusters[cluster_of[near.find(i)]].parts;
            parts.insert(parts.end(), pieces[i].parts.begin(), pieces[i].parts.end());
        }
    }
    return clusters;
}

}  // namespace

std::size_t splitScattered(RawScene& raw, const LabelTable& labels,
                           std::vector<ObjectDraft>& drafts) {
    std::vector<ObjectDraft> result;
    std::size_t count = 0;
    std::vector<char> scattered(drafts.size());
    parallelFor(drafts.size(), [&](std::size_t i) {
        const ObjectDraft& draft = drafts[i];
        const bool large = boundsOf(raw, draft).sizes().maxCoeff() > 2.0F * kFarApart;
        scattered[i] =
            !draft.loose && draft.label.kind != LabelKind::Structure && large && hasGap(raw, draft);
    });
    for (std::size_t k = 0; k < drafts.size(); ++k) {
        ObjectDraft& draft = drafts[k];
        if (!scattered[k]) {
            result.push_back(std::move(draft));
            continue;
        }
        std::vector<ObjectDraft> clusters = clusterPieces(raw, split(raw, labels, draft, 2));
        if (clusters.size() > 1) ++count;
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            clusters[i].name = draft.name;
            if (clusters.size() > 1) clusters[i].name.append("_").append(std::to_string(i + 1));
            clusters[i].label = draft.label;
            clusters[i].loose = false;
            result.push_back(std::move(clusters[i]));
        }
    }
    drafts = std::move(result);
    return count;
}

void dropNamesOfJoinedScenes(const RawScene& raw, std::vector<ObjectDraft>& drafts) {
    std::vector<Eigen::AlignedBox3f> boxes;
    Eigen::AlignedBox3f all;
    for (const ObjectDraft& draft : drafts) all.extend(boxes.emplace_back(boundsOf(raw, draft)));
    for (std::size_t i = 0; i < drafts.size(); ++i) {
        const Eigen::Vector3f share = boxes[i].sizes().cwiseQuotient(all.sizes().cwiseMax(1e-6F));
        if (drafts[i].label.kind != LabelKind::Target || share.minCoeff() < 0.85F) continue;
        std::ptrdiff_t inside = 0;
        for (std::size_t k = 0; k < boxes.size() && inside <= kFewOthers; ++k) {
            if (k != i && boxes[i].contains(boxes[k].center())) ++inside;
        }
        if (inside <= kFewOthers) continue;
        drafts[i].name.clear();
        drafts[i].label = {};
    }
}

std::size_t splitMergedScenes(RawScene& raw, const LabelTable& labels,
                              std::vector<ObjectDraft>& drafts) {
    Eigen::AlignedBox3f all;
    for (const ObjectDraft& draft : drafts) all.extend(boundsOf(raw, draft));
    std::vector<ObjectDraft> result;
    std::size_t count = 0;
    const auto targets = std::count_if(drafts.begin(), drafts.end(), [](const ObjectDraft& draft) {
        return draft.label.kind != LabelKind::Structure;
    });
    for (ObjectDraft& draft : drafts) {
        const Eigen::Vector3f share =
            boundsOf(raw, draft).sizes().cwiseQuotient(all.sizes().cwiseMax(1e-6F));
        const Eigen::Vector3f size = boundsOf(raw, draft).sizes();
        const bool spans = share.x() > 0.6F && share.y() > 0.6F && size.z() > 1.0F &&
                           size.head<2>().minCoeff() > 1.5F;
        if (!spans || targets > kFewOthers || draft.label.kind == LabelKind::Target) {
            result.push_back(std::move(draft));
            continue;
        }
        std::vector<ObjectDraft> pieces = split(raw, labels, draft, 3);
        count += pieces.size() > 1;
        for (ObjectDraft& piece : pieces) result.push_back(std::move(piece));
    }
    drafts = std::move(result);
    return count;
}

}  // namespace dollytrack
