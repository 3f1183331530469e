#include "engine/document/regroup.h"

#include "engine/geometry/object_measure.h"
#include "engine/geometry/piece_finder.h"
#include "engine/scene/labels.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace dollytrack {
namespace {

/// Builds new vertex and triangle arrays with the objects one after the other.
class Layout {
  public:
    explicit Layout(Scene& scene) : from_(scene) {
        positions_.reserve(scene.positions.size());
        normals_.reserve(scene.normals.size());
        uvs_.reserve(scene.uvs.size());
        triangles_.reserve(scene.triangles.size());
        materials_.reserve(scene.triangle_material.size());
    }

    void begin(Object object) {
        object.id = static_cast<int>(objects_.size()) + 1;
        object.first_vertex = static_cast<std::uint32_t>(positions_.size());
        object.first_triangle = static_cast<std::uint32_t>(triangles_.size());
        objects_.push_back(std::move(object));
    }

    /// Adds all vertices and triangles of another object to the current object.
    void addWhole(const Object& source) {
        const auto shift = static_cast<std::uint32_t>(positions_.size());
        for (std::uint32_t i = 0; i < source.vertex_count; ++i) addVertex(source.first_vertex + i);
        for (std::uint32_t i = 0; i < source.triangle_count; ++i) {
            Triangle triangle = from_.triangles[source.first_triangle + i];
            for (std::uint32_t& index : triangle) index = index - source.first_vertex + shift;
            addTriangle(triangle, source.first_triangle + i);
        }
    }

    /// Adds some triangles of another object to the current object, with their vertices.
    void addTriangles(const Object& source, const TriangleList& list) {
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> moved(source.vertex_count, kNone);
        for (const std::uint32_t t : list) {
            Triangle triangle = from_.triangles[t];
            for (std::uint32_t& index : triangle) {
                std::uint32_t& place = moved[index - source.first_vertex];
                if (place == kNone) {
                    place = static_cast<std::uint32_t>(positions_.size());
                    addVertex(index);
                }
                index = place;
            }
            addTriangle(triangle, t);
        }
    }

    void measureLast() { measured_.push_back(objects_.size() - 1); }

    /// Moves the new arrays into the scene.
    void finish() {
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            Object& object = objects_[i];
            const bool last = i + 1 == objects_.size();
            const auto vertices_end =
                last ? static_cast<std::uint32_t>(positions_.size()) : objects_[i + 1].first_vertex;
            const auto triangles_end = last ? static_cast<std::uint32_t>(triangles_.size())
                                            : objects_[i + 1].first_triangle;
            object.vertex_count = vertices_end - object.first_vertex;
            object.triangle_count = triangles_end - object.first_triangle;
        }
        from_.positions = std::move(positions_);
        from_.normals = std::move(normals_);
        from_.uvs = std::move(uvs_);
        from_.triangles = std::move(triangles_);
        from_.triangle_material = std::move(materials_);
        from_.objects = std::move(objects_);
        for (const std::size_t i : measured_) measureObject(from_, from_.objects[i]);
    }

  private:
    void addVertex(std::uint32_t index) {
        positions_.push_back(from_.positions[index]);
        normals_.push_back(from_.normals[index]);
        uvs_.push_back(from_.uvs[index]);
    }
    void addTriangle(const Triangle& triangle, std::uint32_t source) {
        triangles_.push_back(triangle);
        materials_.push_back(from_.triangle_material[source]);
    }

    Scene& from_;
    std::vector<Eigen::Vector3f> positions_;
    std::vector<Eigen::Vector3f> normals_;
    std::vector<Eigen::Vector2f> uvs_;
    std::vector<Triangle> triangles_;
    std::vector<std::uint32_t> materials_;
    std::vector<Object> objects_;
    std::vector<std::size_t> measured_;
};

std::vector<Eigen::AlignedBox3f> boxesOf(const Scene& scene,
                                         const std::vector<TriangleList>& pieces) {
    std::vector<Eigen::AlignedBox3f> boxes(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const std::uint32_t t : pieces[i]) {
            for (const std::uint32_t v : scene.triangles[t]) boxes[i].extend(scene.positions[v]);
        }
    }
    return boxes;
}

/// Index of the nearest box; if the piece is inside several, of the smallest of them.
std::size_t nearestBox(const Eigen::AlignedBox3f& piece,
                       const std::vector<Eigen::AlignedBox3f>& boxes,
                       const std::vector<std::size_t>& among) {
    std::pair best(std::numeric_limits<float>::max(), std::numeric_limits<float>::max());
    std::size_t nearest = among.front();
    for (const std::size_t i : among) {
        const std::pair one(static_cast<float>(piece.exteriorDistance(boxes[i])),
                            boxes[i].diagonal().norm());
        if (one < best) {
            best = one;
            nearest = i;
        }
    }
    return nearest;
}

/// Indices of the boxes, by decreasing longest side.
std::vector<std::size_t> bySize(const std::vector<Eigen::AlignedBox3f>& boxes) {
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return boxes[a].sizes().maxCoeff() > boxes[b].sizes().maxCoeff();
    });
    return order;
}

std::vector<double> sizesOf(const std::vector<Eigen::AlignedBox3f>& boxes,
                            const std::vector<std::size_t>& order) {
    std::vector<double> sizes;
    for (const std::size_t i : order) {
        sizes.push_back(static_cast<double>(boxes[i].sizes().maxCoeff()));
    }
    return sizes;
}

/// Whether an object is of the building itself. Doors and windows are not.
bool isBuilding(const Object& object) {
    return object.structure && (object.nyu40 == kNyuWall || object.nyu40 == kNyuFloor ||
                                object.nyu40 == kNyuCeiling || object.nyu40 == kNyuOtherStructure);
}

/// Whether a box is as large as furniture and no panel, moulding or trim.
bool isLikeFurniture(const OrientedBox& box) {
    constexpr double kLargest_m = 3.5;  // diagonal
    constexpr double kThinnest_m = 0.1;
    return 2.0 * box.half_size.norm() <= kLargest_m &&
           2.0 * box.half_size.minCoeff() >= kThinnest_m;
}

}  // namespace

std::vector<TriangleList> findPieces(const Scene& scene, const Object& object) {
    PieceFinder finder(object.vertex_count);
    std::vector<std::uint32_t> places;
    places.reserve(object.vertex_count);
    for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
        places.push_back(finder.add(scene.positions[object.first_vertex + i]));
    }
    const auto placeOf = [&](std::uint32_t vertex) { return places[vertex - object.first_vertex]; };
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const Triangle& t = scene.triangles[object.first_triangle + i];
        finder.join(placeOf(t[0]), placeOf(t[1]));
        finder.join(placeOf(t[0]), placeOf(t[2]));
    }
    std::vector<int> piece_of(object.vertex_count, -1);
    std::vector<TriangleList> pieces;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const std::uint32_t triangle = object.first_triangle + i;
        int& piece = piece_of[finder.find(placeOf(scene.triangles[triangle][0]))];
        if (piece < 0) {
            piece = static_cast<int>(pieces.size());
            pieces.emplace_back();
        }
        pieces[piece].push_back(triangle);
    }
    return pieces;
}

std::vector<TriangleList> findPieces(const Scene& scene, const Object& object,
                                     const SplitLimits& limits) {
    std::vector<TriangleList> pieces = findPieces(scene, object);
    const std::vector<Eigen::AlignedBox3f> boxes = boxesOf(scene, pieces);
    std::vector<std::size_t> kept = bySize(boxes);
    // At least one piece is kept, so that the others can be joined to it.
    kept.resize(std::max<std::size_t>(1, keptPieces(sizesOf(boxes, kept), limits)));
    if (kept.size() == pieces.size()) return pieces;
    std::sort(kept.begin(), kept.end());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (std::binary_search(kept.begin(), kept.end(), i)) continue;
        TriangleList& whole = pieces[nearestBox(boxes[i], boxes, kept)];
        whole.insert(whole.end(), pieces[i].begin(), pieces[i].end());
    }
    std::vector<TriangleList> wholes;
    for (const std::size_t i : kept) {
        std::sort(pieces[i].begin(), pieces[i].end());
        wholes.push_back(std::move(pieces[i]));
    }
    return wholes;
}

std::vector<double> pieceSizes(const Scene& scene, const Object& object) {
    const std::vector<Eigen::AlignedBox3f> boxes = boxesOf(scene, findPieces(scene, object));
    return sizesOf(boxes, bySize(boxes));
}

std::size_t keptPieces(const std::vector<double>& sizes_m, const SplitLimits& limits) {
    const auto first_small = std::find_if(
        sizes_m.begin(), sizes_m.end(), [&](double size_m) { return size_m < limits.min_size_m; });
    const std::size_t large = first_small - sizes_m.begin();
    return limits.max_pieces == 0 ? large
                                  : std::min(large, static_cast<std::size_t>(limits.max_pieces));
}

void mergeObjects(Scene& scene, const std::vector<int>& ids, const std::string& name, int nyu40) {
    Object merged = scene.object(ids.front());
    double largest = -1.0;
    bool structure = true;
    for (const int id : ids) {
        const Object& part = scene.object(id);
        structure &= part.structure;
        if (part.box.volume() <= largest) continue;
        largest = part.box.volume();
        merged.nyu40 = part.nyu40;
    }
    merged.name = name;
    if (nyu40 != 0) merged.nyu40 = nyu40;
    merged.role = Role::Target;
    merged.structure = structure;
    merged.front_source = FrontSource::RoomCentre;
    Layout layout(scene);
    for (const Object& object : scene.objects) {
        if (object.id == ids.front()) {
            layout.begin(merged);
            for (const int id : ids) layout.addWhole(scene.object(id));
            layout.measureLast();
        } else if (!std::binary_search(ids.begin(), ids.end(), object.id)) {
            layout.begin(object);
            layout.addWhole(object);
        }
    }
    layout.finish();
}

void splitObject(Scene& scene, int id, const std::vector<TriangleList>& pieces,
                 const std::vector<std::string>& names) {
    const bool may_hold_furniture = isBuilding(scene.object(id));
    Layout layout(scene);
    for (const Object& object : scene.objects) {
        if (object.id != id) {
            layout.begin(object);
            layout.addWhole(object);
            continue;
        }
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            Object piece = object;
            piece.name = names[i];
            layout.begin(std::move(piece));
            layout.addTriangles(object, pieces[i]);
            layout.measureLast();
        }
    }
    layout.finish();
    if (!may_hold_furniture) return;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Object& piece = scene.objects[static_cast<std::size_t>(id) - 1 + i];
        if (!isLikeFurniture(piece.box)) continue;
        piece.structure = false;
        piece.role = Role::Target;
        piece.nyu40 = kNyuUnknown;
    }
}

std::vector<std::string> pieceNames(const Scene& scene, const std::string& name,
                                    std::size_t count) {
    std::set<std::string> used;
    for (const Object& object : scene.objects) used.insert(object.name);
    std::vector<std::string> names;
    for (int number = 1; names.size() < count; ++number) {
        std::string next = name + "_" + std::to_string(number);
        if (!used.contains(next)) names.push_back(std::move(next));
    }
    return names;
}

}  // namespace dollytrack
