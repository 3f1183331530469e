#include "engine/io/homes/standard_colors.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace dollytrack::homes {
namespace {

struct NamedColor {
    std::string_view word;
    float r, g, b;  // linear
};

/// Words that contain other words come first.
constexpr std::array<NamedColor, 32> kColors = {{
    {"yellow_green", 0.33F, 0.47F, 0.05F}, {"bluegrey", 0.18F, 0.23F, 0.30F},
    {"bluteal", 0.03F, 0.24F, 0.28F},      {"sky_blue", 0.25F, 0.50F, 0.80F},
    {"dkdkgr", 0.05F, 0.05F, 0.05F},       {"dkgr", 0.12F, 0.12F, 0.12F},
    {"dkblue", 0.02F, 0.03F, 0.18F},       {"dkred", 0.20F, 0.01F, 0.01F},
    {"ltgr", 0.55F, 0.55F, 0.55F},         {"ltbrown", 0.38F, 0.22F, 0.11F},
    {"lighttan", 0.60F, 0.45F, 0.30F},     {"redwood", 0.28F, 0.10F, 0.05F},
    {"sand_stone", 0.55F, 0.42F, 0.28F},   {"blonde", 0.60F, 0.42F, 0.22F},
    {"lavend", 0.45F, 0.35F, 0.60F},       {"brown", 0.17F, 0.08F, 0.03F},
    {"yellow", 0.75F, 0.60F, 0.08F},       {"orange", 0.75F, 0.28F, 0.03F},
    {"silver", 0.55F, 0.56F, 0.58F},       {"white", 0.82F, 0.82F, 0.80F},
    {"black", 0.02F, 0.02F, 0.02F},        {"flesh", 0.70F, 0.42F, 0.30F},
    {"teeth", 0.80F, 0.76F, 0.66F},        {"amber", 0.45F, 0.20F, 0.04F},
    {"flame", 0.80F, 0.30F, 0.05F},        {"bone", 0.68F, 0.62F, 0.50F},
    {"ruby", 0.40F, 0.01F, 0.05F},         {"iris", 0.10F, 0.08F, 0.35F},
    {"ship", 0.30F, 0.32F, 0.35F},         {"grey", 0.25F, 0.25F, 0.25F},
    {"tan", 0.50F, 0.35F, 0.20F},          {"red", 0.55F, 0.03F, 0.03F},
}};

}  // namespace

void giveStandardColors(RawScene& model) {
    // assimp's default for a material without a description.
    const Eigen::Vector3f undescribed(0.6F, 0.6F, 0.6F);
    for (Material& material : model.materials) {
        const bool plain = material.texture < 0 && material.opacity >= 1.0F;
        if (!plain) continue;
        const Eigen::Vector3f& color = material.base_color;
        const bool grey =
            (color - undescribed).cwiseAbs().maxCoeff() < 0.01F ||
            (color - Eigen::Vector3f::Constant(0.3185F)).cwiseAbs().maxCoeff() < 0.01F;
        if (!grey) continue;
        const auto named = std::find_if(kColors.begin(), kColors.end(), [&](const auto& known) {
            return material.name.find(known.word) != std::string::npos;
        });
        if (named != kColors.end()) material.base_color = {named->r, named->g, named->b};
    }
}

}  // namespace dollytrack::homes
