#pragma once

#include <Eigen/Core>

namespace dollytrack::ui {

/// Colours of the overlays, sRGB with alpha.
inline const Eigen::Vector4f kLargeTargetColor(0.98F, 0.80F, 0.10F, 1.0F);
inline const Eigen::Vector4f kSmallTargetColor(0.90F, 0.12F, 0.12F, 1.0F);
inline const Eigen::Vector4f kKeyFrameColor(0.10F, 0.78F, 0.93F, 1.0F);
inline const Eigen::Vector4f kSpareColor(0.55F, 0.62F, 0.70F, 1.0F);
inline const Eigen::Vector4f kSelectedColor(1.0F, 0.25F, 0.80F, 1.0F);
inline const Eigen::Vector4f kRefusedColor(0.88F, 0.10F, 0.10F, 1.0F);
inline const Eigen::Vector4f kAcceptedColor(0.20F, 0.72F, 0.30F, 1.0F);
inline const Eigen::Vector4f kLinkColor(0.98F, 0.52F, 0.08F, 1.0F);
inline const Eigen::Vector4f kSampleColor(0.60F, 0.35F, 0.85F, 1.0F);
inline const Eigen::Vector4f kDroppedColor(0.45F, 0.45F, 0.48F, 1.0F);
inline const Eigen::Vector4f kPathColor(1.0F, 1.0F, 1.0F, 1.0F);

inline const Eigen::Vector4f kWarningColor(1.0F, 0.60F, 0.0F, 1.0F);
inline const Eigen::Vector4f kGapColor(0.93F, 0.25F, 0.55F, 1.0F);
inline const Eigen::Vector4f kUnusableColor(0.50F, 0.45F, 1.0F, 1.0F);
inline const Eigen::Vector4f kKeptPlanColor(0.80F, 0.72F, 0.95F, 0.85F);

/// The colour with its alpha set to `opacity`.
[[nodiscard]] Eigen::Vector4f withOpacity(const Eigen::Vector4f& rgba, float opacity);

/// Clearly distinct colours for the parts of a whole; they repeat after ten.
[[nodiscard]] Eigen::Vector4f partColor(int part);

/// A colour scale over 0..1 (clamped): dark violet, blue, teal, green, yellow. Lightness rises
/// monotonically, so the scale stays readable without colour vision.
[[nodiscard]] Eigen::Vector4f scaleColor(double share);

}  // namespace dollytrack::ui
