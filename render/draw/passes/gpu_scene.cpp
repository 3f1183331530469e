#include "render/draw/passes/gpu_scene.h"

#include "render/draw/passes/coarse_mesh.h"
#include "render/gl/context.h"
#include "render/light/sun_rays.h"
#include "render/materials/surface_kind.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <map>
#include <tuple>
#include <unordered_map>

namespace dollytrack::render {
namespace {

/// Vertex layout that surface.vert expects.
struct Vertex {
    Eigen::Vector3f position;
    std::array<std::int16_t, 4> normal;
    Eigen::Vector2f uv;
    std::array<std::uint8_t, 4> base_color;
    std::array<std::uint8_t, 4> traits;
    std::uint32_t object_id;
};
static_assert(sizeof(Vertex) == 40);

constexpr int kMaxTextureSize = 2048;
constexpr int kAnisotropy = 8;  // on a graphics card; on the CPU it makes drawing 1.5 times as slow

/// Whether a triangle is degenerate: its corners lie on one line within the rounding of their
/// coordinates. Rays miss it, and its rasterised depth is arbitrary. Modelling programs leave such
/// triangles where one long edge meets two short ones.
bool isDegenerate(const Scene& scene, const Triangle& triangle) {
    constexpr double kRounding =
        2.5e-7;  // of the largest coordinate: two steps of single precision
    const auto corner = [&](std::size_t k) {
        return Eigen::Vector3d(scene.positions[triangle[k]].cast<double>());
    };
    const Eigen::Vector3d ab = corner(1) - corner(0);
    const Eigen::Vector3d ac = corner(2) - corner(0);
    const double longest = std::max({ab.norm(), ac.norm(), (ac - ab).norm()});
    const double farthest = corner(0).cwiseAbs().maxCoeff() + longest;
    return ab.cross(ac).norm() <= kRounding * farthest * longest;
}

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

void setNormal(Vertex& vertex, const Eigen::Vector3f& normal) {
    for (int c = 0; c < 3; ++c) {
        vertex.normal[c] =
            static_cast<std::int16_t>(std::lround(std::clamp(normal[c], -1.0F, 1.0F) * 32767.0F));
    }
}

/// See surface.vert.
std::uint8_t structureTrait(const Object& object, bool shows_outside) {
    if (shows_outside) return object.structure ? 191 : 64;
    return object.structure ? 255 : 0;
}

Vertex makeVertex(const Scene& scene, const Object& object, bool shows_outside,
                  const Material& material, std::uint32_t index) {
    Vertex vertex{};
    vertex.position = scene.positions[index];
    setNormal(vertex, scene.normals[index]);
    vertex.uv = index < scene.uvs.size() ? scene.uvs[index] : Eigen::Vector2f::Zero();
    // Emitting surfaces carry the hue of their emission as colour; its strength is a trait.
    const Eigen::Vector3f emission_rgb = drawnEmission(material);
    const float emission = emission_rgb.maxCoeff();
    const Eigen::Vector3f color =
        emission > 0.0F ? Eigen::Vector3f(emission_rgb / emission) : material.base_color;
    for (int c = 0; c < 3; ++c) vertex.base_color[c] = toByte(std::sqrt(std::max(color[c], 0.0F)));
    vertex.base_color[3] = toByte(material.opacity);
    vertex.traits = {toByte(material.roughness), toByte(plainMetallic(scene, material)),
                     toByte(emission / 8.0F), structureTrait(object, shows_outside)};
    vertex.object_id = static_cast<std::uint32_t>(object.id);
    return vertex;
}

/// Halves both sides by averaging.
Texture halved(const Texture& texture) {
    Texture half;
    half.width = std::max(texture.width / 2, 1);
    half.height = std::max(texture.height / 2, 1);
    half.rgba.resize(4UL * half.width * half.height);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                int sum = 0;
                for (int k = 0; k < 4; ++k) {
                    const int from_x = std::min(2 * x + (k & 1), texture.width - 1);
                    const int from_y = std::min(2 * y + (k >> 1), texture.height - 1);
                    sum += texture.rgba[4UL * (static_cast<std::size_t>(from_y) * texture.width +
                                               from_x) +
                                        c];
                }
                half.rgba[4UL * (static_cast<std::size_t>(y) * half.width + x) + c] =
                    static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return half;
}

gl::Texture uploadTexture(const Texture& source) {
    Texture smaller;
    const Texture* texture = &source;
    while (std::max(texture->width, texture->height) > kMaxTextureSize) {
        smaller = halved(*texture);
        texture = &smaller;
    }
    gl::Texture name = gl::createTexture(GL_TEXTURE_2D);
    const int levels = 1 + static_cast<int>(std::log2(std::max(texture->width, texture->height)));
    glTextureStorage2D(name.get(), levels, GL_RGBA8, texture->width, texture->height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(name.get(), 0, 0, 0, texture->width, texture->height, GL_RGBA,
                        GL_UNSIGNED_BYTE, texture->rgba.data());
    glGenerateTextureMipmap(name.get());
    glTextureParameteri(name.get(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(name.get(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(name.get(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(name.get(), GL_TEXTURE_WRAP_T, GL_REPEAT);
    return name;
}

void describeLayout(GpuScene& scene) {
    scene.layout = gl::createVertexArray();
    scene.positions_layout = gl::createVertexArray();
    for (const unsigned array : {scene.layout.get(), scene.positions_layout.get()}) {
        glVertexArrayVertexBuffer(array, 0, scene.vertices.get(), 0, sizeof(Vertex));
        glVertexArrayElementBuffer(array, scene.indices.get());
        glEnableVertexArrayAttrib(array, 0);
        glVertexArrayAttribFormat(array, 0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
        glVertexArrayAttribBinding(array, 0, 0);
    }
    const unsigned array = scene.layout.get();
    glVertexArrayAttribFormat(array, 1, 3, GL_SHORT, GL_TRUE, offsetof(Vertex, normal));
    glVertexArrayAttribFormat(array, 2, 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, uv));
    glVertexArrayAttribFormat(array, 3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, base_color));
    glVertexArrayAttribFormat(array, 4, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, traits));
    glVertexArrayAttribIFormat(array, 5, 1, GL_UNSIGNED_INT, offsetof(Vertex, object_id));
    for (unsigned attribute = 1; attribute <= 5; ++attribute) {
        glEnableVertexArrayAttrib(array, attribute);
        glVertexArrayAttribBinding(array, attribute, 0);
    }
}

/// Sorts the triangles into batches (surface kind, texture, maps) and, within these, by object.
class SceneSorter {
  public:
    SceneSorter(const Scene& scene, Detail detail) : scene_(scene), outside_(showsOutside(scene)) {
        const std::vector<Surface> kinds = surfaceKinds(scene);
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            if (detail == Detail::Plain) {
                const bool glass = kinds[i] == Surface::Glass;
                keys_.push_back({glass ? Surface::Glass : Surface::Opaque, -1, -1});
                continue;
            }
            const Material& material = scene.materials[i];
            const bool mapped =
                hasMap(scene, material.normal_map) || hasMap(scene, material.roughness_map) ||
                hasMap(scene, material.metallic_map) || hasMap(scene, material.emission_map);
            keys_.push_back({kinds[i], isTextured(scene, material) ? material.texture : -1,
                             mapped && kinds[i] != Surface::Glass ? static_cast<int>(i) : -1});
        }
    }

    void sort() {
        for (const Object& object : scene_.objects) {
            first_vertices.push_back(static_cast<std::uint32_t>(vertices.size()));
            addObject(object);
        }
        first_vertices.push_back(static_cast<std::uint32_t>(vertices.size()));
    }

    struct Key {
        Surface surface;
        int texture;  // index in the scene's textures, -1: none
        int mapped;   // index of the material if it has maps of its own, else -1
        auto operator<=>(const Key&) const = default;
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> first_vertices;
    std::map<Key, std::vector<std::pair<int, std::vector<std::uint32_t>>>> indices;

  private:
    void addObject(const Object& object) {
        // A vertex used by two materials is duplicated, because each vertex carries its material.
        std::unordered_map<std::uint64_t, std::uint32_t> known;
        known.reserve(object.vertex_count);
        for (std::uint32_t t = object.first_triangle;
             t < object.first_triangle + object.triangle_count; ++t) {
            if (isDegenerate(scene_, scene_.triangles[t])) continue;
            const std::uint32_t material = scene_.triangle_material[t];
            auto& groups = indices[keys_[material]];
            if (groups.empty() || groups.back().first != object.id)
                groups.push_back({object.id, {}});
            for (const std::uint32_t corner : scene_.triangles[t]) {
                const std::uint64_t key = std::uint64_t{material} << 32U | corner;
                const auto [place, added] =
                    known.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
                if (added) {
                    vertices.push_back(makeVertex(scene_, object, outside_[object.id - 1],
                                                  scene_.materials[material], corner));
                }
                groups.back().second.push_back(place->second);
            }
        }
    }

    const Scene& scene_;
    std::vector<bool> outside_;  // by id - 1
    std::vector<Key> keys_;      // by material
};

Eigen::AlignedBox3f boundsOf(const std::uint32_t* corners, std::uint32_t count,
                             const std::vector<Vertex>& vertices, std::uint32_t first_vertex) {
    Eigen::AlignedBox3f bounds;
    for (std::uint32_t i = 0; i < count; ++i) {
        bounds.extend(vertices[corners[i] - first_vertex].position);
    }
    return bounds;
}

/// Whether two triangles are coplanar within 1 mm and 0.8 degrees.
bool inOnePlane(const std::uint32_t* a, const std::uint32_t* b,
                const std::vector<Vertex>& vertices) {
    const auto corner = [&](const std::uint32_t* of, int i) { return vertices[of[i]].position; };
    const auto normalOf = [&](const std::uint32_t* of) {
        return Eigen::Vector3f(
            (corner(of, 1) - corner(of, 0)).cross(corner(of, 2) - corner(of, 0)).normalized());
    };
    const Eigen::Vector3f normal = normalOf(a);
    if (std::abs(normal.dot(normalOf(b))) < 0.9999F) return false;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(normal.dot(corner(b, i) - corner(a, 0))) > 0.001F) return false;
    }
    return true;
}

void findGlass(const std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
               GpuScene& scene) {
    for (std::size_t i = 0; i < scene.batches.size(); ++i) {
        if (scene.batches[i].surface != Surface::Glass) continue;
        for (const Piece& piece : scene.batches[i].pieces) {
            bool first = true;
            for (std::uint32_t k = 0; k + 2 < piece.index_count; k += 3) {
                const std::uint32_t* corners = &indices[piece.first_index + k];
                if (first || !inOnePlane(corners - 3, corners, vertices)) {
                    scene.glass.push_back({i, piece.object_id, piece.first_index + k, 0, {}});
                }
                first = false;
                scene.glass.back().index_count += 3;
                scene.glass_corners.insert(scene.glass_corners.end(), corners, corners + 3);
            }
        }
    }
    const std::uint32_t* corners = scene.glass_corners.data();
    for (GlassSheet& sheet : scene.glass) {
        sheet.bounds = boundsOf(corners, sheet.index_count, vertices, 0);
        corners += sheet.index_count;
    }
}

/// Appends the simplified triangles of each piece to the index buffer.
void addCoarse(const SceneSorter& sorter, Detail detail, std::vector<std::uint32_t>& indices,
               std::vector<Batch>& batches) {
    for (Batch& batch : batches) {
        for (Piece& piece : batch.pieces) {
            piece.coarse_first = piece.first_index;
            piece.coarse_count = piece.index_count;
            if (detail != Detail::FullAndCoarse || batch.surface == Surface::Glass) continue;
            const std::uint32_t* first = &sorter.first_vertices[piece.object_id - 1];
            std::vector<std::uint32_t> corners(
                indices.begin() + piece.first_index,
                indices.begin() + piece.first_index + piece.index_count);
            for (std::uint32_t& corner : corners) corner -= first[0];
            corners = coarseMesh(corners, sorter.vertices[first[0]].position, first[1] - first[0],
                                 sizeof(Vertex));
            if (corners.size() == piece.index_count) continue;
            for (std::uint32_t& corner : corners) corner += first[0];
            piece.coarse_first = static_cast<std::uint32_t>(indices.size());
            piece.coarse_count = static_cast<std::uint32_t>(corners.size());
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
    }
}

/// Adds the batches of triangles by surface and material, and uploads their textures.
/// @param indices  corners of the pieces are appended to it
void addBatches(const Scene& scene, const SceneSorter& sorter, std::vector<std::uint32_t>& indices,
                GpuScene& result) {
    std::map<int, unsigned> names;
    const auto nameOf = [&](int texture) -> unsigned {
        if (!hasMap(scene, texture)) return 0;
        unsigned& name = names[texture];
        if (name == 0) {
            result.textures.push_back(uploadTexture(scene.textures[texture]));
            name = result.textures.back().get();
        }
        return name;
    };
    for (const auto& [key, groups] : sorter.indices) {
        Batch batch;
        batch.surface = key.surface;
        batch.texture = nameOf(key.texture);
        if (key.mapped >= 0) {
            const Material& material = scene.materials[key.mapped];
            batch.maps = BatchMaps{nameOf(material.normal_map),   nameOf(material.roughness_map),
                                   nameOf(material.metallic_map), nameOf(material.emission_map),
                                   material.normal_scale,         material.emission};
        }
        for (const auto& [object_id, corners] : groups) {
            batch.pieces.push_back({object_id, static_cast<std::uint32_t>(indices.size()),
                                    static_cast<std::uint32_t>(corners.size()), 0, 0});
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
        result.has_maps = result.has_maps || batch.maps.has_value();
        result.batches.push_back(std::move(batch));
    }
}

/// Adds each object in one piece, for silhouettes: the index buffer holds its triangles a second
/// time.
void addWholeObjects(const Scene& scene, const SceneSorter& sorter,
                     std::vector<std::uint32_t>& indices, GpuScene& result) {
    result.whole_objects.resize(scene.objects.size());
    result.bounds.resize(scene.objects.size());
    std::vector<std::vector<std::uint32_t>> whole(scene.objects.size());
    for (const Batch& batch : result.batches) {
        for (const Piece& piece : batch.pieces) {
            auto& corners = whole[piece.object_id - 1];
            const auto first = indices.begin() + piece.first_index;
            corners.insert(corners.end(), first, first + piece.index_count);
        }
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        result.whole_objects[i] = {static_cast<int>(i) + 1,
                                   static_cast<std::uint32_t>(indices.size()),
                                   static_cast<std::uint32_t>(whole[i].size()), 0, 0};
        indices.insert(indices.end(), whole[i].begin(), whole[i].end());
        for (const std::uint32_t corner : whole[i]) {
            result.bounds[i].extend(sorter.vertices[corner].position);
        }
    }
}

/// Uploads vertices and indices. OpenGL rejects empty buffers; a scene without triangles draws
/// nothing with one element each.
void uploadBuffers(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices,
                   GpuScene& result) {
    result.vertices = gl::createBuffer();
    result.indices = gl::createBuffer();
    if (vertices.empty()) vertices.resize(1);
    if (indices.empty()) indices.resize(1);
    glNamedBufferStorage(result.vertices.get(),
                         static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                         GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferStorage(result.indices.get(),
                         static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                         indices.data(), 0);
}

}  // namespace

void setAnisotropy(const GpuScene& scene, int samples) {
    if (!GLEW_EXT_texture_filter_anisotropic) return;
    if (samples == 0) samples = gl::drawsByProcessor() ? 1 : kAnisotropy;
    GLint most = 1;
    glGetIntegerv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    for (const gl::Texture& texture : scene.textures) {
        glTextureParameterf(texture.get(), GL_TEXTURE_MAX_ANISOTROPY_EXT,
                            static_cast<float>(std::min(samples, most)));
    }
}

Result<GpuScene> uploadScene(const Scene& scene, Detail detail) {
    if (scene.objects.size() > 65535) {
        return fail(ErrorCode::BadInput,
                    "the scene has " + std::to_string(scene.objects.size()) +
                        " objects, more than the 65535 that 16-bit labels can distinguish; merge "
                        "some of them",
                    scene.source.string());
    }
    SceneSorter sorter(scene, detail);
    sorter.sort();

    GpuScene result;
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * scene.triangles.size() * 2);
    addBatches(scene, sorter, indices, result);
    findGlass(sorter.vertices, indices, result);
    addCoarse(sorter, detail, indices, result.batches);
    addWholeObjects(scene, sorter, indices, result);
    result.whole_windows = wholeWindows(scene);
    for (const Object& object : scene.objects) result.windows.push_back(sendsDaylight(object));
    uploadBuffers(sorter.vertices, indices, result);
    result.first_vertices = std::move(sorter.first_vertices);
    describeLayout(result);
    if (Status status = gl::checkErrors("loading the scene"); !status) {
        return tl::unexpected(status.error());
    }
    return result;
}

RestingObject copyOf(const GpuScene& scene, int object_id) {
    const auto index = static_cast<std::size_t>(object_id) - 1;
    const std::uint32_t first = scene.first_vertices[index];
    const std::uint32_t count = scene.first_vertices[index + 1] - first;
    RestingObject object{object_id, std::vector<std::uint8_t>(count * sizeof(Vertex)),
                         scene.bounds[index]};
    if (count > 0) {
        glGetNamedBufferSubData(scene.vertices.get(), static_cast<GLintptr>(first * sizeof(Vertex)),
                                static_cast<GLsizeiptr>(object.vertices.size()),
                                object.vertices.data());
    }
    return object;
}

void place(GpuScene& scene, const RestingObject& object, const Eigen::Isometry3d& motion) {
    const auto index = static_cast<std::size_t>(object.object_id) - 1;
    std::vector<Vertex> vertices(object.vertices.size() / sizeof(Vertex));
    if (vertices.empty()) return;
    std::memcpy(static_cast<void*>(vertices.data()), object.vertices.data(),
                object.vertices.size());
    Eigen::AlignedBox3f bounds;
    for (Vertex& vertex : vertices) {
        vertex.position = (motion * vertex.position.cast<double>()).cast<float>();
        const Eigen::Vector3d normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
        setNormal(vertex, (motion.linear() * normal / 32767.0).cast<float>());
        bounds.extend(vertex.position);
    }
    scene.bounds[index] = bounds;
    const std::uint32_t* corners = scene.glass_corners.data();
    for (GlassSheet& sheet : scene.glass) {
        if (sheet.object_id == object.object_id) {
            sheet.bounds =
                boundsOf(corners, sheet.index_count, vertices, scene.first_vertices[index]);
        }
        corners += sheet.index_count;
    }
    glNamedBufferSubData(scene.vertices.get(),
                         static_cast<GLintptr>(scene.first_vertices[index] * sizeof(Vertex)),
                         static_cast<GLsizeiptr>(object.vertices.size()), vertices.data());
}

}  // namespace dollytrack::render
