#include "render/gpu_scene.h"

#include "render/gl/context.h"
#include "render/surface_kind.h"

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

/// As surface.vert reads it.
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

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

void setNormal(Vertex& vertex, const Eigen::Vector3f& normal) {
    for (int c = 0; c < 3; ++c) {
        vertex.normal[c] =
            static_cast<std::int16_t>(std::lround(std::clamp(normal[c], -1.0F, 1.0F) * 32767.0F));
    }
}

Vertex makeVertex(const Scene& scene, const Object& object, const Material& material,
                  std::uint32_t index) {
    Vertex vertex{};
    vertex.position = scene.positions[index];
    setNormal(vertex, scene.normals[index]);
    vertex.uv = index < scene.uvs.size() ? scene.uvs[index] : Eigen::Vector2f::Zero();
    // A thing that shines shows the colour it shines in; its strength is apart.
    const float emission = material.emission.maxCoeff();
    const Eigen::Vector3f color =
        emission > 0.0F ? Eigen::Vector3f(material.emission / emission) : material.base_color;
    for (int c = 0; c < 3; ++c) vertex.base_color[c] = toByte(std::sqrt(std::max(color[c], 0.0F)));
    vertex.base_color[3] = toByte(material.opacity);
    vertex.traits = {
        toByte(material.roughness), toByte(material.metallic),
        emission > 0.0F ? toByte(std::max(emission / 8.0F, 1.0F / 255.0F)) : std::uint8_t{0},
        object.structure ? std::uint8_t{255} : std::uint8_t{0}};
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

/// Sorts the triangles by how they are drawn, then by object.
class SceneSorter {
  public:
    explicit SceneSorter(const Scene& scene) : scene_(scene) {
        const std::vector<Surface> kinds = surfaceKinds(scene);
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            const Material& material = scene.materials[i];
            keys_.emplace_back(kinds[i], isTextured(scene, material) ? material.texture : -1);
        }
    }

    void sort() {
        for (const Object& object : scene_.objects) {
            first_vertices.push_back(static_cast<std::uint32_t>(vertices.size()));
            addObject(object);
        }
        first_vertices.push_back(static_cast<std::uint32_t>(vertices.size()));
    }

    using Key = std::pair<Surface, int>;  // with the texture's index
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> first_vertices;
    std::map<Key, std::vector<std::pair<int, std::vector<std::uint32_t>>>> indices;

  private:
    void addObject(const Object& object) {
        // A corner used under two materials becomes two vertices, as each carries its material.
        std::unordered_map<std::uint64_t, std::uint32_t> known;
        known.reserve(object.vertex_count);
        for (std::uint32_t t = object.first_triangle;
             t < object.first_triangle + object.triangle_count; ++t) {
            const std::uint32_t material = scene_.triangle_material[t];
            auto& groups = indices[keys_[material]];
            if (groups.empty() || groups.back().first != object.id)
                groups.push_back({object.id, {}});
            for (const std::uint32_t corner : scene_.triangles[t]) {
                const std::uint64_t key = std::uint64_t{material} << 32U | corner;
                const auto [place, added] =
                    known.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
                if (added) {
                    vertices.push_back(
                        makeVertex(scene_, object, scene_.materials[material], corner));
                }
                groups.back().second.push_back(place->second);
            }
        }
    }

    const Scene& scene_;
    std::vector<Key> keys_;  // by material
};

}  // namespace

Result<GpuScene> uploadScene(const Scene& scene) {
    if (scene.objects.size() > 65535) {
        return fail(ErrorCode::BadInput,
                    "the scene has " + std::to_string(scene.objects.size()) +
                        " objects, more than the 65535 that 16-bit labels can tell apart; join "
                        "some of them",
                    scene.source.string());
    }
    SceneSorter sorter(scene);
    sorter.sort();

    GpuScene result;
    std::vector<std::uint32_t> indices;
    indices.reserve(3 * scene.triangles.size() * 2);
    std::map<int, unsigned> names;
    for (const auto& [key, groups] : sorter.indices) {
        Batch batch;
        batch.surface = key.first;
        if (key.second >= 0) {
            auto& name = names[key.second];
            if (name == 0) {
                result.textures.push_back(uploadTexture(scene.textures[key.second]));
                name = result.textures.back().get();
            }
            batch.texture = name;
        }
        for (const auto& [object_id, corners] : groups) {
            batch.pieces.push_back({object_id, static_cast<std::uint32_t>(indices.size()),
                                    static_cast<std::uint32_t>(corners.size())});
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
        result.batches.push_back(std::move(batch));
    }
    // Objects in one piece for silhouettes: another run through the index buffer, grouped by id.
    result.whole_objects.resize(scene.objects.size());
    result.bounds.resize(scene.objects.size());
    std::vector<std::vector<std::uint32_t>> whole(scene.objects.size());
    for (const Batch& batch : result.batches) {
        for (const Piece& piece : batch.pieces) {
            auto& corners = whole[static_cast<std::size_t>(piece.object_id) - 1];
            const auto first = indices.begin() + piece.first_index;
            corners.insert(corners.end(), first, first + piece.index_count);
        }
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        result.whole_objects[i] = {static_cast<int>(i) + 1,
                                   static_cast<std::uint32_t>(indices.size()),
                                   static_cast<std::uint32_t>(whole[i].size())};
        indices.insert(indices.end(), whole[i].begin(), whole[i].end());
        for (const std::uint32_t corner : whole[i]) {
            result.bounds[i].extend(sorter.vertices[corner].position);
        }
    }

    result.vertices = gl::createBuffer();
    result.indices = gl::createBuffer();
    // Empty buffers are an error to OpenGL; a scene without triangles draws nothing all the same.
    if (sorter.vertices.empty()) sorter.vertices.resize(1);
    if (indices.empty()) indices.resize(1);
    glNamedBufferStorage(result.vertices.get(),
                         static_cast<GLsizeiptr>(sorter.vertices.size() * sizeof(Vertex)),
                         sorter.vertices.data(), GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferStorage(result.indices.get(),
                         static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                         indices.data(), 0);
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
    glNamedBufferSubData(scene.vertices.get(),
                         static_cast<GLintptr>(scene.first_vertices[index] * sizeof(Vertex)),
                         static_cast<GLsizeiptr>(object.vertices.size()), vertices.data());
}

}  // namespace dollytrack::render
