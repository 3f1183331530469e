// Compares base colours, roughness and metalness with the materials of the surfaces shown.
#include "engine/scene/srgb.h"
#include "render/materials/surface_kind.h"
#include "render/verify/check/check_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace dollytrack::verify {
namespace {

constexpr int kAlbedoTolerance = 3;  // of 255; rendering also stores colours in 8 bits

/// Range of colours that a surface may have, by channel, over its texture's texels.
struct ColorRange {
    std::array<int, 3> least = {255, 255, 255};
    std::array<int, 3> most = {0, 0, 0};

    [[nodiscard]] bool holds(const std::uint8_t* color) const {
        for (std::size_t c = 0; c < 3; ++c) {
            if (color[c] < least[c] - kAlbedoTolerance || color[c] > most[c] + kAlbedoTolerance)
                return false;
        }
        return true;
    }
};

ColorRange rangeOf(const Material& material, const std::vector<Texture>& textures) {
    std::array<int, 3> darkest = {255, 255, 255};
    std::array<int, 3> brightest = {255, 255, 255};
    const Texture* texture = material.texture < 0 ? nullptr : &textures[material.texture];
    if (texture && !texture->rgba.empty()) {
        brightest = {0, 0, 0};
        for (std::size_t i = 0; i + 3 < texture->rgba.size(); i += 4) {
            for (std::size_t c = 0; c < 3; ++c) {
                darkest[c] = std::min<int>(darkest[c], texture->rgba[i + c]);
                brightest[c] = std::max<int>(brightest[c], texture->rgba[i + c]);
            }
        }
    }
    // A uniformly emitting surface has the hue of its emission, unless that is faint.
    const float emission = material.emission_map < 0 ? material.emission.maxCoeff() : 0.0F;
    const Eigen::Vector3f surface_color = emission >= render::kFaintestEmission
                                              ? Eigen::Vector3f(material.emission / emission)
                                              : material.base_color;
    ColorRange range;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto color = [&](int texel) {
            const float linear = linearFromSrgb(static_cast<float>(texel) / 255.0F);
            return encodedSrgb(double{surface_color[static_cast<Eigen::Index>(c)] * linear});
        };
        range.least[c] = color(darkest[c]);
        range.most[c] = color(brightest[c]);
    }
    return range;
}

/// Colour ranges of each object's materials, by id.
using Colors = std::map<int, std::vector<ColorRange>>;

Colors colorsOf(const Scene& scene) {
    std::vector<ColorRange> ranges;
    for (const Material& material : scene.materials) {
        ranges.push_back(rangeOf(material, scene.textures));
    }
    Colors colors;
    for (const Object& object : scene.objects) {
        const auto first = scene.triangle_material.begin() + object.first_triangle;
        const std::set<std::uint32_t> used(first, first + object.triangle_count);
        for (const std::uint32_t material : used) colors[object.id].push_back(ranges[material]);
    }
    return colors;
}

/// Whether the pixel has a colour of the object shown by it or by a neighbour. At borders the
/// images may be rasterised differently.
bool mayHave(const Colors& colors, const Image16& ids, int x, int y, const std::uint8_t* color) {
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (!ids.holds(x + dx, y + dy)) continue;
            const int id = ids.at(x + dx, y + dy);
            if (id == 0 && std::all_of(color, color + 3, [](int c) { return c == 0; })) return true;
            const auto of = colors.find(id);
            if (of == colors.end()) continue;
            if (std::any_of(of->second.begin(), of->second.end(),
                            [&](const ColorRange& range) { return range.holds(color); })) {
                return true;
            }
        }
    }
    return false;
}

/// Range of a material's roughness or metalness in an image; a map can only lower it.
struct ValueRange {
    int least = 0;
    int most = 0;
};

/// Ranges of each object's materials, by id.
using Values = std::map<int, std::vector<ValueRange>>;

Values valuesOf(const Scene& scene, float Material::*value, int Material::*map) {
    Values values;
    for (const Object& object : scene.objects) {
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            const Material& material =
                scene.materials[scene.triangle_material[object.first_triangle + t]];
            const float most = std::clamp(material.*value, 0.0F, 1.0F);
            const int highest = static_cast<int>(std::lround(255.0F * most));
            const bool plain = material.*map < 0;
            const ValueRange range{plain ? highest - 1 : 0, highest + 1};
            std::vector<ValueRange>& known = values[object.id];
            const bool there = std::ranges::any_of(known, [&](const ValueRange& one) {
                return one.least == range.least && one.most == range.most;
            });
            if (!there) known.push_back(range);
        }
    }
    return values;
}

/// Whether the value belongs to the object shown by the pixel or by a neighbour; see mayHave().
bool mayHave(const Values& values, const Image16& ids, int x, int y, int found) {
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            if (!ids.holds(x + dx, y + dy)) continue;
            const auto of = values.find(ids.at(x + dx, y + dy));
            if (of == values.end() && found == 0) return true;
            if (of == values.end()) continue;
            if (std::ranges::any_of(of->second, [&](const ValueRange& range) {
                    return found >= range.least && found <= range.most;
                })) {
                return true;
            }
        }
    }
    return false;
}

/// Checks an image of roughness or metalness.
void checkValues(FrameImages& images, const char* modality, const Values& values,
                 Findings& findings) {
    const Image8* image = images.image8(modality);
    const Image16* ids = images.image16("instance");
    if (!image || !ids) return;
    WrongPixels wrong;
    for (int y = 0; y < ids->height; ++y) {
        for (int x = 0; x < ids->width; ++x) {
            if (mayHave(values, *ids, x, y, image->at(x, y))) continue;
            wrong.add(x, y, [&] {
                return WrongPixels::Text{
                    fmt::format("{}", image->at(x, y)),
                    fmt::format("a value of object {}'s materials", ids->at(x, y))};
            });
        }
    }
    wrong.report(imageFile(modality, images.frame()), images.frame(), findings);
}

}  // namespace

CheckWork beginMaterials(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    const auto of = [&](float Material::*value, int Material::*map) {
        return std::make_shared<const Values>(valuesOf(*subject.scene, value, map));
    };
    work.frame = [roughness = of(&Material::roughness, &Material::roughness_map),
                  metallic = of(&Material::metallic, &Material::metallic_map)](FrameImages& images,
                                                                               Findings& findings) {
        checkValues(images, "roughness", *roughness, findings);
        checkValues(images, "metallic", *metallic, findings);
    };
    return work;
}

CheckWork beginAlbedo(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [colors = std::make_shared<const Colors>(colorsOf(*subject.scene))](
                     FrameImages& images, Findings& findings) {
        const Image8* albedo = images.image8("albedo");
        const Image16* ids = images.image16("instance");
        if (!albedo || !ids) return;
        WrongPixels wrong;
        for (int y = 0; y < ids->height; ++y) {
            for (int x = 0; x < ids->width; ++x) {
                const std::uint8_t* color = albedo->pixel(x, y);
                if (mayHave(*colors, *ids, x, y, color)) continue;
                wrong.add(x, y, [&] {
                    return WrongPixels::Text{
                        fmt::format("({}, {}, {})", color[0], color[1], color[2]),
                        fmt::format("a colour of object {}'s materials", ids->at(x, y))};
                });
            }
        }
        wrong.report(imageFile("albedo", images.frame()), images.frame(), findings);
    };
    return work;
}

}  // namespace dollytrack::verify
