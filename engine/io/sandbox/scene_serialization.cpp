#include "engine/io/sandbox/scene_serialization.h"

#include "engine/core/clean_text.h"
#include "engine/io/sandbox/binary_archive.h"
#include "engine/io/sandbox/scene_check.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace dollytrack {
namespace {

constexpr std::uint64_t kSceneMagic = 0x31454E454353'5444ULL;  // "DTSCENE1"
constexpr std::size_t kLongestMessage = 2000;

struct Header {
    std::uint64_t magic = kSceneMagic;
    std::uint32_t version = kSerializationVersion;
    std::uint32_t is_error = 0;
    std::uint64_t size = 0;  // including this header
    std::uint64_t sum = 0;   // of all bytes after the header
};

// Structured bindings name all members, so that a new member that is missing here is a compile
// error. The same function reads and writes.

template <class Archive, class T>
void nodeMembers(Archive& archive, T& node) {
    auto& [name, parent, children] = node;
    archive.text(name);
    archive.number(parent);
    archive.number(children);
}

template <class Archive, class T>
void partMembers(Archive& archive, T& part) {
    // The reader measures bounds and areas again.
    auto& [name, node, material, positions, normals, uvs, triangles, bounds, facing_area, area] =
        part;
    (void)bounds, (void)facing_area, (void)area;
    archive.text(name);
    archive.number(node);
    archive.number(material);
    archive.array(positions);
    archive.array(normals);
    archive.array(uvs);
    archive.array(triangles);
}

template <class Archive, class T>
void objectMembers(Archive& archive, T& object) {
    auto& [name, category, nyu40, structure, parts, front] = object;
    archive.text(name);
    archive.text(category);
    archive.number(nyu40);
    archive.number(structure);
    archive.array(parts);
    archive.maybe(front, [](Archive& to, auto& vector) {
        for (int axis = 0; axis < 3; ++axis) to.number(vector[axis]);
    });
}

template <class Archive, class T>
void materialMembers(Archive& archive, T& material) {
    auto& [name, base_color, opacity, emission, metallic, roughness, texture, normal_map,
           normal_scale, roughness_map, metallic_map, emission_map] = material;
    archive.text(name);
    for (int i = 0; i < 3; ++i) archive.number(base_color[i]);
    archive.number(opacity);
    for (int i = 0; i < 3; ++i) archive.number(emission[i]);
    archive.number(metallic);
    archive.number(roughness);
    archive.number(texture);
    archive.number(normal_map);
    archive.number(normal_scale);
    archive.number(roughness_map);
    archive.number(metallic_map);
    archive.number(emission_map);
}

template <class Archive, class T>
void requestMembers(Archive& archive, T& request) {
    // The image itself is among the textures; only the importer needs its location.
    auto& [name, embedded, embedded_width, embedded_height, opaque, folder, only_there] = request;
    (void)embedded, (void)embedded_width, (void)embedded_height, (void)folder, (void)only_there;
    archive.text(name);
    archive.number(opaque);
}

template <class Archive, class T>
void textureMembers(Archive& archive, T& texture) {
    auto& [name, width, height, rgba] = texture;
    archive.text(name);
    archive.number(width);
    archive.number(height);
    archive.array(rgba);
}

template <class Archive, class T>
void repairMembers(Archive& archive, T& repairs) {
    auto& [bad_numbers, too_far, bad_indices, no_area, approximate, polygons, lines, made_normals,
           mirrored] = repairs;
    for (auto* count : {&bad_numbers, &too_far, &bad_indices, &no_area, &approximate, &polygons,
                        &lines, &made_normals, &mirrored}) {
        archive.number(*count);
    }
}

template <class Archive, class T>
void sceneMembers(Archive& archive, T& scene) {
    auto& [raw, set] = scene;
    auto& [nodes, parts, objects, materials, requests, repairs, unit_m, up_axis, up_is_certain,
           file_from_parts, notes, warnings] = raw;
    auto& [textures, missing, broken, found] = set;
    const auto text = [](Archive& to, auto& line) { to.text(line); };
    archive.list(nodes, 16, [](Archive& to, auto& node) { nodeMembers(to, node); });
    archive.list(parts, 48, [](Archive& to, auto& part) { partMembers(to, part); });
    archive.list(objects, 30, [](Archive& to, auto& object) { objectMembers(to, object); });
    archive.list(materials, 68, [](Archive& to, auto& one) { materialMembers(to, one); });
    archive.list(requests, 9, [](Archive& to, auto& request) { requestMembers(to, request); });
    repairMembers(archive, repairs);
    archive.maybe(unit_m, [](Archive& to, auto& unit) { to.number(unit); });
    auto& [axis_letter, axis_negative] = up_axis;
    archive.number(axis_letter);
    archive.number(axis_negative);
    archive.number(up_is_certain);
    for (Eigen::Index i = 0; i < 12; ++i) archive.number(file_from_parts(i / 4, i % 4));
    archive.list(notes, 8, text);
    archive.list(warnings, 8, text);
    archive.list(textures, 24, [](Archive& to, auto& texture) { textureMembers(to, texture); });
    archive.list(missing, 8, text);
    archive.list(broken, 8, text);
    archive.number(found);
}

template <class Archive, class T>
void errorMembers(Archive& archive, T& error) {
    auto& [code, message, where] = error;
    archive.number(code);
    archive.text(message);
    archive.text(where);
}

void writeBody(BinaryWriter& writer, const Result<DecodedScene>& outcome) {
    if (outcome) {
        sceneMembers(writer, *outcome);
    } else {
        errorMembers(writer, outcome.error());
    }
}

Error damage(std::string reason) {
    return {ErrorCode::BadInput, std::move(reason), {}};
}

std::string shortened(const std::string& text) {
    return cleanText(std::string_view(text).substr(0, kLongestMessage));
}

/// Limits an error to codes that the importer may report, and cleans its text.
Error cleanError(const Error& read) {
    const bool known = read.code == ErrorCode::BadInput || read.code == ErrorCode::Usage;
    return {known ? read.code : ErrorCode::BadInput, shortened(read.message),
            shortened(read.where)};
}

}  // namespace

std::size_t serializedSize(const Result<DecodedScene>& outcome) {
    BinaryWriter counter;
    writeBody(counter, outcome);
    return sizeof(Header) + counter.size();
}

void serializeScene(const Result<DecodedScene>& outcome, std::span<std::uint8_t> out) {
    BinaryWriter writer(out.data() + sizeof(Header));
    writeBody(writer, outcome);
    Header header;
    header.is_error = !outcome;
    header.size = out.size();
    std::memcpy(out.data(), &header, sizeof(header));
    updateChecksum(out);
}

void updateChecksum(std::span<std::uint8_t> bytes) {
    Header header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    header.sum = checksumOf(bytes.subspan(sizeof(header)));
    std::memcpy(bytes.data(), &header, sizeof(header));
}

Result<DecodedScene> deserializeScene(std::span<const std::uint8_t> bytes, bool& damaged) {
    damaged = true;
    Header header;
    if (bytes.size() < sizeof(header)) return tl::unexpected(damage("it is too short"));
    std::memcpy(&header, bytes.data(), sizeof(header));
    if (header.magic != kSceneMagic)
        return tl::unexpected(damage("it does not start with the expected bytes"));
    if (header.version != kSerializationVersion)
        return tl::unexpected(damage("it has another version"));
    if (header.is_error > 1) return tl::unexpected(damage("its kind is unknown"));
    if (header.size != bytes.size()) return tl::unexpected(damage("its length is wrong"));
    const auto body = bytes.subspan(sizeof(header));
    if (header.sum != checksumOf(body)) return tl::unexpected(damage("its checksum is wrong"));
    BinaryReader reader(body);
    if (header.is_error == 1) {
        Error error;
        errorMembers(reader, error);
        if (!reader.finished()) return tl::unexpected(damage("its error is incomplete"));
        damaged = false;
        return tl::unexpected(cleanError(error));
    }
    DecodedScene scene;
    sceneMembers(reader, scene);
    if (!reader.finished()) return tl::unexpected(damage("its counts do not match its length"));
    if (Status sound = checkScene(scene); !sound) return tl::unexpected(sound.error());
    damaged = false;
    return scene;
}

}  // namespace dollytrack
