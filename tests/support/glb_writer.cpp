#include "tests/support/glb_writer.h"

#include <cstring>
#include <utility>

namespace dollytrack::test {
namespace {

std::string word(std::size_t value) {
    const auto small = static_cast<std::uint32_t>(value);
    std::string bytes(sizeof(small), '\0');
    std::memcpy(bytes.data(), &small, sizeof(small));
    return bytes;
}

std::string base64(const std::string& bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            three = three << 8U;
            if (i + k < bytes.size()) three |= static_cast<std::uint8_t>(bytes[i + k]);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k > bytes.size() ? '=' : kDigits[(three >> (18 - 6 * k)) & 63U];
        }
    }
    return text;
}

}  // namespace

GlbWriter::GlbWriter()
    : json({{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", nlohmann::json::array()}}}}}) {
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews"}) {
        json[list] = nlohmann::json::array();
    }
}

std::size_t GlbWriter::addView(std::string_view bytes, std::size_t stride) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    nlohmann::json view = {
        {"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    buffer_ += bytes;
    json["bufferViews"].push_back(std::move(view));
    return json["bufferViews"].size() - 1;
}

std::size_t GlbWriter::addAccessor(std::size_t view, int component_type, const char* type,
                                   std::size_t count, bool normalized) {
    nlohmann::json accessor = {
        {"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}};
    if (normalized) accessor["normalized"] = true;
    json["accessors"].push_back(std::move(accessor));
    return json["accessors"].size() - 1;
}

nlohmann::json& GlbWriter::addMesh(const char* node_name, nlohmann::json primitive) {
    json["meshes"].push_back({{"primitives", {std::move(primitive)}}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back({{"name", node_name}, {"mesh", json["meshes"].size() - 1}});
    return json["nodes"].back();
}

nlohmann::json GlbWriter::finished() const {
    nlohmann::json whole = json;
    if (!buffer_.empty() && !whole.contains("buffers")) {
        whole["buffers"] = {{{"byteLength", buffer_.size()}}};
    }
    return whole;
}

std::string GlbWriter::glb() const {
    std::string text = finished().dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string bytes = buffer_;
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return "glTF" + word(2) + word(28 + text.size() + bytes.size()) + word(text.size()) + "JSON" +
           text + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
}

std::string GlbWriter::gltf() const {
    nlohmann::json whole = finished();
    whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(buffer_);
    return whole.dump();
}

}  // namespace dollytrack::test
