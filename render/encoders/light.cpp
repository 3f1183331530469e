#include "render/encoders/encoders.h"
#include "render/encoders/exr.h"
#include "render/encoders/pack.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

/// The layers of a pixel as files hold them. The residual is what `light` is more than the product
/// of the rounded layers, so that the files add up.
struct StoredLight {
    Eigen::Vector3f light, reflectance, illumination, residual;
};

StoredLight storedLight(const PictureLayers& layers, std::size_t i) {
    StoredLight stored;
    stored.light = roundedToHalf(layers.light(i));
    stored.reflectance = roundedToHalf(layers.reflectance[i]);
    stored.illumination = roundedToHalf(layers.direct[i] + layers.indirect[i]);
    stored.residual =
        roundedToHalf(stored.light - stored.reflectance.cwiseProduct(stored.illumination));
    return stored;
}

/// Encodes valueOf(pixel number) of all pixels.
template <class ValueOf>
FrameFiles encodeLight(const FrameRecord& frame, const char* folder, ValueOf&& valueOf) {
    std::vector<Eigen::Vector3f> image(frame.layers.size());
    for (std::size_t i = 0; i < image.size(); ++i) image[i] = valueOf(i);
    return oneFile(frameFile(folder, frame.index, ".exr"),
                   encodeExr(frame.width, frame.height, image));
}

Json lightConvention(const char* folder, const char* meaning) {
    return {{"folder", folder},
            {"type", "float16 x 3, channels R, G and B"},
            {"encoding", "linear, sRGB primaries, exposed as rgb"},
            {"meaning", meaning}};
}

}  // namespace

FrameFiles encodeHdr(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "hdr",
                       [&](std::size_t i) { return storedLight(frame.layers, i).light; });
}

FrameFiles encodeDiffuseReflectance(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "diffuse_reflectance",
                       [&](std::size_t i) { return frame.layers.reflectance[i]; });
}

FrameFiles encodeDiffuseIllumination(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "diffuse_illumination",
                       [&](std::size_t i) { return storedLight(frame.layers, i).illumination; });
}

FrameFiles encodeDirectIllumination(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "direct_illumination",
                       [&](std::size_t i) { return frame.layers.direct[i]; });
}

FrameFiles encodeIndirectIllumination(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "indirect_illumination",
                       [&](std::size_t i) { return frame.layers.indirect[i]; });
}

FrameFiles encodeResidual(const FrameContext& /*context*/, const FrameRecord& frame) {
    return encodeLight(frame, "residual",
                       [&](std::size_t i) { return storedLight(frame.layers, i).residual; });
}

Json hdrConvention(const DatasetContents& /*contents*/) {
    Json convention = lightConvention(
        "hdr",
        "light before the tone curve: diffuse_reflectance * diffuse_illumination + residual");
    convention["tone_curve"] =
        "rgb = srgb(min(x, 0.55) + 0.45 * y / (y + 0.45)) with y = max(x - 0.55, 0)";
    return convention;
}

Json diffuseReflectanceConvention(const DatasetContents& /*contents*/) {
    return lightConvention("diffuse_reflectance",
                           "base colour * (1 - metalness) of the visible surface, mean over the "
                           "pixel; behind glass, that of the surface there");
}

Json diffuseIlluminationConvention(const DatasetContents& /*contents*/) {
    return lightConvention("diffuse_illumination",
                           "diffusely reflected light divided by diffuse_reflectance; a guess, or "
                           "0, where that is 0");
}

Json directIlluminationConvention(const DatasetContents& /*contents*/) {
    return lightConvention("direct_illumination",
                           "part of diffuse_illumination directly from lamps, sun, sky and "
                           "emitting surfaces");
}

Json indirectIlluminationConvention(const DatasetContents& /*contents*/) {
    return lightConvention("indirect_illumination",
                           "part of diffuse_illumination from other surfaces");
}

Json residualConvention(const DatasetContents& /*contents*/) {
    return lightConvention("residual",
                           "all other light: reflections, visible emission and the backdrop; "
                           "rounding makes it slightly negative where there is none");
}

}  // namespace dollytrack::render
