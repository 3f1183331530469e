#include "render/formats/scenes/glb_builder.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Constants of glTF.
constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;
constexpr int kVertices = 34962;
constexpr int kIndices = 34963;
constexpr int kNoTarget = 0;

void append32(std::string& out, std::uint64_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    out.append(reinterpret_cast<const char*>(&narrow), sizeof(narrow));
}

void pad(std::string& text, char with) {
    text.resize((text.size() + 3) / 4 * 4, with);
}

}  // namespace

int GlbBuilder::addView(const void* data, std::size_t bytes, int target) {
    pad(binary_, '\0');
    Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}};
    if (target != kNoTarget) view["target"] = target;
    views_.push_back(std::move(view));
    binary_.append(static_cast<const char*>(data), bytes);
    return static_cast<int>(views_.size()) - 1;
}

int GlbBuilder::addFloats(const float* values, std::size_t count, int components, const char* type,
                          int target) {
    const std::size_t width = components;
    Json low = Json::array(), high = Json::array();
    for (std::size_t c = 0; c < width; ++c) {
        float least = std::numeric_limits<float>::infinity(), most = -least;
        for (std::size_t i = 0; i < count; ++i) {
            least = std::min(least, values[i * width + c]);
            most = std::max(most, values[i * width + c]);
        }
        low.push_back(static_cast<double>(least));
        high.push_back(static_cast<double>(most));
    }
    const int view = addView(values, count * width * sizeof(float), target);
    accessors_.push_back({{"bufferView", view},
                          {"componentType", kFloat},
                          {"count", count},
                          {"type", type},
                          {"min", std::move(low)},
                          {"max", std::move(high)}});
    return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuilder::addVertices(const std::vector<Eigen::Vector2f>& values) {
    return addFloats(values.data()->data(), values.size(), 2, "VEC2", kVertices);
}

int GlbBuilder::addVertices(const std::vector<Eigen::Vector3f>& values) {
    return addFloats(values.data()->data(), values.size(), 3, "VEC3", kVertices);
}

int GlbBuilder::addKeys(const std::vector<float>& values) {
    return addFloats(values.data(), values.size(), 1, "SCALAR", kNoTarget);
}

int GlbBuilder::addKeys(const std::vector<Eigen::Vector3f>& values) {
    return addFloats(values.data()->data(), values.size(), 3, "VEC3", kNoTarget);
}

int GlbBuilder::addKeys(const std::vector<Eigen::Vector4f>& values) {
    return addFloats(values.data()->data(), values.size(), 4, "VEC4", kNoTarget);
}

int GlbBuilder::addIndices(const std::vector<std::uint32_t>& values) {
    const int view = addView(values.data(), values.size() * sizeof(std::uint32_t), kIndices);
    accessors_.push_back({{"bufferView", view},
                          {"componentType", kUnsignedInt},
                          {"count", values.size()},
                          {"type", "SCALAR"}});
    return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuilder::addImage(const std::string& name, const char* mime_type,
                         std::span<const std::uint8_t> bytes) {
    const int view = addView(bytes.data(), bytes.size(), kNoTarget);
    images_.push_back({{"name", name}, {"mimeType", mime_type}, {"bufferView", view}});
    return static_cast<int>(images_.size()) - 1;
}

Result<std::string> GlbBuilder::pack(Json root) const {
    std::string binary = binary_;
    pad(binary, '\0');
    if (!images_.empty()) root["images"] = images_;
    root["accessors"] = accessors_;
    root["bufferViews"] = views_;
    root["buffers"] = Json::array({{{"byteLength", binary.size()}}});
    // Object names may contain invalid UTF-8, which must not end the export.
    std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    pad(json, ' ');
    const std::uint64_t length = 12 + 8 + json.size() + 8 + binary.size();
    if (length > std::numeric_limits<std::uint32_t>::max()) {
        return fail(
            ErrorCode::Failed,
            "the scene is larger than the 4 GB limit of a .glb file; leave out the format 'gltf'",
            "--formats");
    }
    std::string file = "glTF";
    file.reserve(length);
    append32(file, 2);
    append32(file, length);
    append32(file, json.size());
    file += "JSON" + json;
    append32(file, binary.size());
    file.append("BIN\0", 4);
    file += binary;
    return file;
}

}  // namespace dollytrack::render
