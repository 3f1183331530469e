#include "render/light/tone_curve.h"

#include "engine/scene/srgb.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::render {
namespace {

constexpr float kKnee = 0.55F;  // light below this is unchanged

float smoothStep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

}  // namespace

Eigen::Vector3f toneCurve(const Eigen::Vector3f& linear) {
    return linear.unaryExpr([](float c) {
        const float high = std::max(c - kKnee, 0.0F);
        return std::min(c, kKnee) + (1.0F - kKnee) * high / (high + (1.0F - kKnee));
    });
}

Eigen::Vector3f inverseToneCurve(const Eigen::Vector3f& shown) {
    return shown.unaryExpr([](float c) {
        if (c <= kKnee) return c;
        const float share = std::min((c - kKnee) / (1.0F - kKnee), 0.999F);
        return kKnee + (1.0F - kKnee) * share / (1.0F - share);
    });
}

std::uint8_t encodedByte(float linear) {
    const float c = std::clamp(linear, 0.0F, 1.0F);
    const float encoded = c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255.0F * encoded));
}

Eigen::Vector3f decoded(const Eigen::Vector3f& srgb) {
    return srgb.unaryExpr([](float c) { return linearFromSrgb(c); });
}

Eigen::Vector3f skyBackdrop(float rise, float grey) {
    const Eigen::Vector3f horizon(0.90F, 0.93F, 0.96F);
    const Eigen::Vector3f zenith(0.62F, 0.77F, 0.95F);
    const Eigen::Vector3f ground(0.64F, 0.63F, 0.61F);
    const float up = std::clamp(1.5F * rise, 0.0F, 1.0F);
    const float down = smoothStep(0.0F, 0.12F, -rise);
    const Eigen::Vector3f color =
        (horizon + up * (zenith - horizon)) * (1.0F - down) + ground * down;
    const float luma = color.dot(Eigen::Vector3f(0.2126F, 0.7152F, 0.0722F));
    return color + grey * (Eigen::Vector3f::Constant(luma) - color);
}

}  // namespace dollytrack::render
