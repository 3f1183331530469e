#include "engine/io/gltf/document.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/gltf/meshopt_view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace dollytrack::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

/// Extensions that this folder reads or that do not change shapes. Files that require others are
/// refused, because they would be rendered wrongly.
constexpr std::array kKnown = {
    std::string_view("KHR_draco_mesh_compression"),
    std::string_view("EXT_meshopt_compression"),
    std::string_view("KHR_mesh_quantization"),
    std::string_view("EXT_mesh_gpu_instancing"),
    std::string_view("KHR_texture_transform"),
    std::string_view("KHR_texture_basisu"),
    std::string_view("KHR_texture_ktx"),
    std::string_view("EXT_texture_webp"),
    std::string_view("EXT_texture_avif"),
    std::string_view("MSFT_texture_dds"),
    std::string_view("KHR_animation_pointer"),
    std::string_view("KHR_xmp_json_ld"),
    std::string_view("MSFT_lod"),
    std::string_view("EXT_mesh_features"),
    std::string_view("EXT_structural_metadata"),
};
constexpr std::array kOfAppearance = {
    std::string_view("KHR_materials_"), std::string_view("KHR_lights_"),
    std::string_view("EXT_lights_"), std::string_view("ADOBE_materials_")};

bool isKnown(const std::string& extension) {
    return std::ranges::find(kKnown, extension) != kKnown.end() ||
           std::ranges::any_of(kOfAppearance, [&](std::string_view beginning) {
               return extension.starts_with(beginning);
           });
}

std::uint32_t wordAt(std::string_view bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof(word));
    return word;
}

/// The JSON and BIN chunks of a .glb; further chunks are ignored.
struct Chunks {
    std::string_view json;
    std::string_view binary;
};

Chunks findChunks(std::string_view file) {
    constexpr std::size_t kHeader = 12;
    constexpr std::size_t kChunkHeader = 8;
    constexpr std::uint32_t kJson = 0x4E4F534A;
    constexpr std::uint32_t kBinary = 0x004E4942;
    if (file.size() < kHeader) throw damaged("its header is truncated");
    if (wordAt(file, 4) != 2) {
        throw Fault(
            fmt::format("it is binary glTF of version {}; export it as glTF 2.0", wordAt(file, 4)));
    }
    Chunks chunks;
    std::size_t at = kHeader;
    while (file.size() - at >= kChunkHeader) {
        const std::size_t length = wordAt(file, at);
        const std::uint32_t kind = wordAt(file, at + 4);
        at += kChunkHeader;
        if (length > file.size() - at) {
            throw damaged(
                fmt::format("a chunk should have {} bytes, but has {}", length, file.size() - at));
        }
        if (kind == kJson && chunks.json.empty()) chunks.json = file.substr(at, length);
        if (kind == kBinary && !chunks.binary.data()) chunks.binary = file.substr(at, length);
        at += std::min((length + 3) / 4 * 4, file.size() - at);  // chunks begin at multiples of 4
    }
    if (chunks.json.empty()) throw damaged("it has no JSON");
    return chunks;
}

Json parseJson(std::string_view text) {
    Result<Json> json = parseBoundedJson(text, {});
    // Some exporters write names in a local encoding instead of UTF-8.
    if (!json) {
        const std::string clean = cleanText(text);
        if (clean != text) json = parseBoundedJson(clean, {});
    }
    if (!json) throw damaged("its JSON " + describe(json.error()));
    if (!json->is_object()) throw damaged("its JSON is not an object");
    return std::move(*json);
}

void checkVersion(const Json& json) {
    const std::string version = textOr(objectAt(json, "asset"), "version");
    if (version.starts_with("2.")) return;
    throw Fault(version.empty() ? std::string("it is not marked as glTF 2.0 (asset.version); if it "
                                              "is a glTF file, export it again")
                                : "it is glTF " + cleanText(version) + "; export it as glTF 2.0");
}

void checkExtensions(const Json& json) {
    std::vector<std::string> unknown;
    for (const Json& name : listAt(json, "extensionsRequired")) {
        if (!name.is_string())
            throw damaged("extensionsRequired contains an entry that is not a name");
        const std::string extension = cleanText(name.get<std::string>());
        if (!isKnown(extension)) unknown.push_back(extension);
    }
    if (unknown.empty()) return;
    constexpr std::size_t kMostNamed = 5;
    if (unknown.size() > kMostNamed) {
        unknown.resize(kMostNamed);
        unknown.emplace_back("others");
    }
    throw Fault(
        fmt::format("it requires glTF extensions that cannot be read: {}; export it "
                    "without them",
                    fmt::join(unknown, ", ")));
}

Bytes asBytes(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

int sixBits(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;  // '-': the URL-safe alphabet
    if (c == '/' || c == '_') return 63;
    return -1;
}

}  // namespace

std::optional<std::string> decodeDataUri(std::string_view uri) {
    if (!uri.starts_with("data:")) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
        throw damaged("a data URI is not base64");
    }
    std::string_view text = uri.substr(comma + 1);
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int six = sixBits(c);
        if (six < 0) throw damaged("a data URI is not base64");
        bits = (bits << 6U) | static_cast<std::uint32_t>(six);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>((bits >> static_cast<unsigned>(count)) & 0xFFU);
    }
    return bytes;
}

Document::Document(std::string file, ReadBeside read_beside)
    : file_(std::move(file)), read_beside_(std::move(read_beside)) {
    std::string_view text = file_;
    if (file_.starts_with("glTF")) {
        const Chunks chunks = findChunks(file_);
        text = chunks.json;
        binary_ = chunks.binary;
    }
    json_ = parseJson(text);
    checkVersion(json_);
    checkExtensions(json_);
}

const Json& Document::entry(const char* list, std::size_t index) const {
    const auto& entries = listAt(json_, list);
    if (index >= entries.size() || !entries[index].is_object()) {
        throw damaged(fmt::format("{}[{}] is missing", list, index));
    }
    return entries[index];
}

std::size_t Document::size(const char* list) const {
    return listAt(json_, list).size();
}

Bytes Document::buffer(std::size_t index) const {
    const Json& description = entry("buffers", index);
    const std::size_t claimed = requireCount(description, "byteLength");
    std::string_view bytes = binary_;
    if (description.contains("uri")) {
        auto found = buffers_.find(index);
        if (found == buffers_.end()) {
            const std::string uri = textOr(description, "uri");
            std::optional<std::string> inside = decodeDataUri(uri);
            if (!inside) {
                Result<std::string> beside = read_beside_(uri);
                if (!beside) {
                    throw Fault(
                        fmt::format("the file's buffer \"{}\" is missing; put it beside the file",
                                    cleanText(uri)));
                }
                inside = std::move(*beside);
            }
            found = buffers_.emplace(index, std::move(*inside)).first;
        }
        bytes = found->second;
    } else if (index != 0 || !binary_.data()) {
        throw damaged(fmt::format("buffers[{}] has no data", index));
    }
    if (claimed > bytes.size()) {
        throw damaged(fmt::format("buffers[{}] should have {} bytes, but has {}", index, claimed,
                                  bytes.size()));
    }
    return asBytes(bytes.substr(0, claimed));
}

Bytes Document::slice(const Json& place) const {
    const Bytes all = buffer(requireCount(place, "buffer"));
    const std::size_t offset = countOr(place, "byteOffset", 0);
    const std::size_t length = requireCount(place, "byteLength");
    if (offset > all.size() || length > all.size() - offset) {
        throw damaged("a buffer view reaches beyond its buffer");
    }
    return all.subspan(offset, length);
}

Bytes Document::view(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    const Json& description = entry("bufferViews", index);
    const Json& packed = extensionOf(description, "EXT_meshopt_compression");
    if (!packed.is_object()) return slice(description);
    auto found = unpacked_.find(index);
    if (found == unpacked_.end()) {
        found = unpacked_.emplace(index, unpackMeshopt(slice(packed), packed)).first;
    }
    return found->second;
}

}  // namespace dollytrack::gltf
