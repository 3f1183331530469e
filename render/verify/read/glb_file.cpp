#include "render/verify/read/glb_file.h"

#include "engine/io/files/bounded_json.h"
#include "render/verify/read/json_file.h"

#include "engine/io/files/text_file.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace dollytrack::verify {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr int kFloat = 5126;

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (int i = 3; i >= 0; --i) {
        word = (word << 8) | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
    }
    return word;
}

}  // namespace

Result<GlbFile> GlbFile::read(const std::filesystem::path& path) {
    const Result<std::string> bytes = readText(path);
    if (!bytes) return tl::unexpected(bytes.error());
    GlbFile file;
    try {
        if (!bytes->starts_with("glTF") || wordAt(*bytes, 4) != 2 ||
            wordAt(*bytes, 8) != bytes->size()) {
            return fail(ErrorCode::BadInput, "not a complete glTF 2.0 file");
        }
        for (std::size_t at = 12; at < bytes->size();) {
            const std::size_t length = wordAt(*bytes, at);
            const std::uint32_t kind = wordAt(*bytes, at + 4);
            if (length > bytes->size() - at - 8) throw std::out_of_range("a chunk is truncated");
            if (kind == kJsonChunk) {
                file.json_ = parseJson(std::string_view(*bytes).substr(at + 8, length)).value();
            }
            if (kind == kBinaryChunk) file.binary_ = bytes->substr(at + 8, length);
            at += 8 + length;
        }
        return file;
    } catch (const std::exception& error) {
        return fail(ErrorCode::BadInput, plainReason(error));
    }
}

std::vector<float> GlbFile::floats(std::size_t accessor, std::size_t components) const {
    const auto& numbers = json_.at("accessors").at(accessor);
    const auto& view = json_.at("bufferViews").at(numbers.at("bufferView").get<std::size_t>());
    const std::size_t count = numbers.at("count").get<std::size_t>();
    const std::size_t begin =
        view.value("byteOffset", std::size_t{0}) + numbers.value("byteOffset", std::size_t{0});
    if (numbers.at("componentType") != kFloat || view.contains("byteStride")) {
        throw std::runtime_error("keys that are not plain floats");
    }
    if (begin > binary_.size() || count > (binary_.size() - begin) / (components * sizeof(float))) {
        throw std::runtime_error("an accessor reaches beyond the file");
    }
    std::vector<float> values(count * components);
    std::memcpy(values.data(), binary_.data() + begin, values.size() * sizeof(float));
    return values;
}

NodeKeys GlbFile::readKeys(int node) const {
    const auto& animation = json_.at("animations").at(0);
    NodeKeys keys;
    for (const auto& channel : animation.at("channels")) {
        const auto& target = channel.at("target");
        if (target.at("node") != node) continue;
        const auto& sampler = animation.at("samplers").at(channel.at("sampler").get<std::size_t>());
        keys.times_s = floats(sampler.at("input").get<std::size_t>(), 1);
        const auto output = sampler.at("output").get<std::size_t>();
        if (target.at("path") == "translation") {
            const std::vector<float> values = floats(output, 3);
            for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
                keys.translations.emplace_back(values[i], values[i + 1], values[i + 2]);
            }
        } else if (target.at("path") == "rotation") {
            const std::vector<float> values = floats(output, 4);
            for (std::size_t i = 0; i + 3 < values.size(); i += 4) {
                keys.rotations.emplace_back(values[i], values[i + 1], values[i + 2], values[i + 3]);
            }
        }
    }
    if (keys.times_s.empty() || keys.translations.size() != keys.times_s.size() ||
        keys.rotations.size() != keys.times_s.size()) {
        throw std::runtime_error("different numbers of time, translation and rotation keys");
    }
    return keys;
}

Result<NodeKeys> GlbFile::keys(int node) const {
    try {
        return readKeys(node);
    } catch (const std::exception& error) {
        return fail(ErrorCode::BadInput, plainReason(error));
    }
}

}  // namespace dollytrack::verify
