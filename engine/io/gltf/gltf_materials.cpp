#include "engine/io/gltf/gltf_materials.h"

#include "engine/core/clean_text.h"
#include "engine/core/text_lists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace dollytrack::gltf {
namespace {

/// Extensions that name an image in addition to or instead of a texture's `source`.
constexpr const char* kWebp = "EXT_texture_webp";
constexpr std::array kUndecoded = {"KHR_texture_basisu", "KHR_texture_ktx", "EXT_texture_avif",
                                   "MSFT_texture_dds"};

/// Largest base colour that counts as black beside a texture, linear.
constexpr float kBlackFactor = 0.004F;
constexpr float kClearestGlass = 0.05F;        // opacity, so that glass stays visible
constexpr double kMostEmissiveStrength = 8.0;  // brighter emission is clamped by the renderer

/// Whether an image is KTX, Basis, AVIF or DDS, which cannot be decoded; by first bytes or
/// extension.
bool isUndecoded(std::string_view bytes, std::string_view uri) {
    if (bytes.starts_with("\xABKTX ") || bytes.starts_with("DDS ")) return true;
    if (bytes.size() >= 12 && bytes.substr(4, 8) == "ftypavif") return true;
    return std::ranges::any_of(std::array{".ktx", ".ktx2", ".basis", ".avif", ".dds"},
                               [&](std::string_view end) { return uri.ends_with(end); });
}

/// Collects the images of all materials, each once.
class TextureList {
  public:
    TextureList(const Document& document, RawScene& raw) : document_(document), raw_(raw) {}

    /// The index of the request for the image of a texture; -1: it has none that can be decoded.
    int request(std::size_t texture, bool opaque) {
        const std::optional<std::size_t> image = imageOf(document_.entry("textures", texture));
        if (!image) return -1;
        auto found = indices_.find(*image);
        if (found == indices_.end()) found = indices_.emplace(*image, add(*image)).first;
        if (found->second < 0) return -1;
        TextureRequest& request = raw_.textures[found->second];
        request.opaque = request.opaque && opaque;
        return found->second;
    }

    void noteOtherCoordinates() { ++elsewhere_; }
    void noteBlackFactor() { ++blackened_; }

    void report() const {
        if (!undecoded_.empty()) {
            raw_.warnings.push_back(
                counted(undecoded_.size(), "texture is", "textures are") +
                " KTX2, Basis, DDS or AVIF, which cannot be read, and shown as a flat colour; "
                "export them as PNG, JPEG or WebP");
        }
        if (blackened_ > 0) {
            raw_.warnings.push_back(
                counted(blackened_, "material multiplies its", "materials multiply their") +
                " texture by black, which some exporters write by mistake; the "
                "texture is shown as it is");
        }
        if (elsewhere_ > 0) {
            raw_.notes.push_back(
                counted(elsewhere_, "texture map was", "texture maps were") +
                " left out, with texture coordinates that differ from those of the base colour");
        }
    }

  private:
    std::optional<std::size_t> imageOf(const Json& texture) {
        if (const auto webp = findCount(extensionOf(texture, kWebp), "source")) return webp;
        if (const auto plain = findCount(texture, "source")) return plain;
        for (const char* extension : kUndecoded) {
            if (const auto image = findCount(extensionOf(texture, extension), "source")) {
                undecoded_.insert(*image);
            }
        }
        return std::nullopt;
    }

    int add(std::size_t index) {
        const Json& image = document_.entry("images", index);
        const std::string uri = textOr(image, "uri");
        TextureRequest request;
        std::string_view head;
        std::optional<std::string> inside;
        if (const auto view = findCount(image, "bufferView")) {
            const Bytes bytes = document_.view(*view);
            request.embedded.assign(bytes.begin(), bytes.end());
        } else if ((inside = decodeDataUri(uri))) {
            request.embedded.assign(inside->begin(), inside->end());
        } else if (uri.empty()) {
            throw damaged("images[" + std::to_string(index) + "] has no data");
        } else {
            request.name = uri;
        }
        if (request.name.empty()) {
            request.name = textOr(image, "name");
            if (request.name.empty()) request.name = "*" + std::to_string(embedded_);
            ++embedded_;
            head = {reinterpret_cast<const char*>(request.embedded.data()),
                    request.embedded.size()};
        }
        if (isUndecoded(head, inside ? std::string_view() : uri)) {
            undecoded_.insert(index);
            return -1;
        }
        const auto next = static_cast<int>(raw_.textures.size());
        if (request.embedded.empty()) {  // images with the same file are one texture
            const auto [same, is_new] = files_.try_emplace(request.name, next);
            if (!is_new) return same->second;
        }
        raw_.textures.push_back(std::move(request));
        return next;
    }

    const Document& document_;
    RawScene& raw_;
    std::map<std::size_t, int> indices_;  // indices of requests by image
    std::map<std::string, int> files_;    // indices of requests by file
    std::set<std::size_t> undecoded_;     // images that cannot be decoded
    std::size_t embedded_ = 0;
    std::size_t elsewhere_ = 0;
    std::size_t blackened_ = 0;
};

PictureCoordinates coordinatesOf(const Json& info) {
    const Json& extension = extensionOf(info, "KHR_texture_transform");
    PictureCoordinates coordinates;
    std::size_t set = countOr(info, "texCoord", 0);
    set = countOr(extension, "texCoord", set);
    coordinates.set = static_cast<int>(std::min<std::size_t>(set, 255));
    if (!extension.is_object()) return coordinates;
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();
    Eigen::Vector2d scale = Eigen::Vector2d::Ones();
    readNumbers(extension, "offset", offset);
    readNumbers(extension, "scale", scale);
    // Counter-clockwise as seen in the image, whose v points down.
    const double turn = -numberOr(extension, "rotation", 0.0);
    coordinates.transform = Eigen::Translation2d(offset) * Eigen::Rotation2Dd(turn) *
                            Eigen::Scaling(scale.x(), scale.y());
    return coordinates;
}

float share(double value) {
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

Eigen::Vector3f colorOf(const Eigen::Vector3d& value) {
    return {share(value.x()), share(value.y()), share(value.z())};
}

/// Reads one material; all its maps share the coordinates of the first image it has.
class MaterialReader {
  public:
    MaterialReader(const Json& source, TextureList& textures)
        : source_(source), textures_(textures) {}

    std::pair<Material, PictureCoordinates> read() {
        const std::string alpha_mode = textOr(source_, "alphaMode");
        const bool opaque = alpha_mode.empty() || alpha_mode == "OPAQUE";
        Material material;
        material.name = cleanText(textOr(source_, "name"));
        const Json& metallic = objectAt(source_, "pbrMetallicRoughness");
        const Json& specular = extensionOf(source_, "KHR_materials_pbrSpecularGlossiness");
        Eigen::Vector4d color = Eigen::Vector4d::Ones();
        if (metallic.is_object() || !specular.is_object()) {
            readNumbers(metallic, "baseColorFactor", color);
            material.texture = mapOf(objectAt(metallic, "baseColorTexture"), opaque);
            material.metallic = share(numberOr(metallic, "metallicFactor", 1.0));
            material.roughness = share(numberOr(metallic, "roughnessFactor", 1.0));
        } else {
            readNumbers(specular, "diffuseFactor", color);
            material.texture = mapOf(objectAt(specular, "diffuseTexture"), opaque);
            material.metallic = 0.0F;
            material.roughness = share(1.0 - numberOr(specular, "glossinessFactor", 1.0));
        }
        material.base_color = colorOf(color.head<3>());
        if (material.texture >= 0 && material.base_color.maxCoeff() < kBlackFactor) {
            material.base_color.setOnes();
            textures_.noteBlackFactor();
        }
        // Some exporters write an opacity of 0 for opaque materials.
        material.opacity = opaque || !(color.w() > 0.0) ? 1.0F : share(color.w());
        const Json& transmission = extensionOf(source_, "KHR_materials_transmission");
        // A transmission texture may leave most of the surface opaque.
        if (!objectAt(transmission, "transmissionTexture").is_object()) {
            material.opacity *= std::max(
                kClearestGlass, share(1.0 - numberOr(transmission, "transmissionFactor", 0.0)));
        }

        Eigen::Vector3d emission = Eigen::Vector3d::Zero();
        readNumbers(source_, "emissiveFactor", emission);
        const Json& strength = extensionOf(source_, "KHR_materials_emissive_strength");
        material.emission = colorOf(emission) * static_cast<float>(std::clamp(
                                                    numberOr(strength, "emissiveStrength", 1.0),
                                                    0.0, kMostEmissiveStrength));
        material.emission_map = mapOf(objectAt(source_, "emissiveTexture"), true);
        const Json& normal = objectAt(source_, "normalTexture");
        material.normal_map = mapOf(normal, true);
        material.normal_scale =
            static_cast<float>(std::clamp(numberOr(normal, "scale", 1.0), 0.0, 10.0));
        material.roughness_map = mapOf(objectAt(metallic, "metallicRoughnessTexture"), true);
        material.metallic_map = material.roughness_map;
        if (extensionOf(source_, "KHR_materials_unlit").is_object()) {
            material.metallic = 0.0F;
            material.roughness = 1.0F;
            material.roughness_map = material.metallic_map = -1;
        }
        return {std::move(material), coordinates_.value_or(PictureCoordinates())};
    }

  private:
    int mapOf(const Json& info, bool opaque) {
        const std::optional<std::size_t> texture = findCount(info, "index");
        if (!texture) return -1;
        const PictureCoordinates coordinates = coordinatesOf(info);
        if (coordinates_ && !(coordinates == *coordinates_)) {
            textures_.noteOtherCoordinates();
            return -1;
        }
        const int request = textures_.request(*texture, opaque);
        if (request >= 0) coordinates_ = coordinates;
        return request;
    }

    const Json& source_;
    TextureList& textures_;
    std::optional<PictureCoordinates> coordinates_;
};

}  // namespace

std::vector<PictureCoordinates> readMaterials(const Document& document, RawScene& raw) {
    TextureList textures(document, raw);
    std::vector<PictureCoordinates> coordinates;
    const auto add = [&](const Json& source) {
        auto [material, where] = MaterialReader(source, textures).read();
        raw.materials.push_back(std::move(material));
        coordinates.push_back(where);
    };
    for (std::size_t i = 0; i < document.size("materials"); ++i)
        add(document.entry("materials", i));
    add(Json::object());
    textures.report();
    return coordinates;
}

}  // namespace dollytrack::gltf
