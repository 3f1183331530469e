#include "render/pathtrace/denoiser.h"

#include "engine/jobs/parallel.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace dollytrack::render {
namespace {

using Image = std::vector<Eigen::Vector3f>;

/// How one layer is filtered. Distances between pixels are in units of these tolerances.
struct Filter {
    int radius_px;      // of the window
    int stride_px;      // distance of the windows' centres
    int guide_px;       // radius of the rough filter whose result is compared
    float normals;      // tolerated difference of normals
    float off_plane;    // tolerated distance from the other's plane, in distances from the camera
    float noise_count;  // tolerated difference of light, in standard deviations
};

// The strides divide kDenoisedRows / 4, and the radii, with 3 px for the variance and those of the
// neighbouring windows, do not exceed kDenoisedRows.
constexpr Filter kDirect = {7, 2, 2, 0.5F, 0.02F, 1.5F};
constexpr Filter kIndirect = {10, 3, 3, 0.5F, 0.02F, 2.0F};
constexpr Filter kGlossy = {5, 2, 1, 0.3F, 0.01F, 1.0F};

constexpr int kVarianceRadius = 3;
constexpr int kOutlierRadius = 2;
constexpr float kOutlierFactor = 4.0F;
constexpr float kRelative = 0.03F;  // tolerated difference of light, relative
constexpr float kLeastWeight = 1e-4F;
constexpr float kRidge = 1e-3F;          // regularization of the slopes
constexpr float kPositionScale = 0.05F;  // scale of positions, in distances from the camera

/// The surface at a pixel.
struct Visible {
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    float distance = 0.0F;
    bool hit = false;  // in most samples
};

/// One layer: the mean of each set of samples.
using Halves = std::array<Image, 2>;

constexpr int kTerms = 7;  // constant, position, normal
using Terms = Eigen::Matrix<float, kTerms, 1>;
using Coefficients = Eigen::Matrix<float, kTerms, 3>;

Terms termsOf(const Visible& pixel, const Visible& center) {
    Terms terms;
    terms[0] = 1.0F;
    terms.segment<3>(1) =
        (pixel.position - center.position) / (kPositionScale * std::max(center.distance, 1e-3F));
    terms.segment<3>(4) = 2.0F * (pixel.normal - center.normal);
    return terms;
}

class LayerFilter {
  public:
    LayerFilter(const LayeredImage& image, const std::vector<Visible>& visible,
                const std::vector<char>& counts, const Filter& filter, const Halves& halves)
        : width_(image.width),
          height_(image.height),
          visible_(visible),
          counts_(counts),
          filter_(filter),
          columns_((image.width + filter.stride_px - 1) / filter.stride_px),
          rows_((image.height + filter.stride_px - 1) / filter.stride_px),
          layer_(visible.size()) {
        const Halves clamped = {withoutOutliers(halves[0]), withoutOutliers(halves[1])};
        for (std::size_t i = 0; i < layer_.size(); ++i) {
            layer_[i] = 0.5F * (clamped[0][i] + clamped[1][i]);
        }
        findVariance(clamped);
        findGuide();
    }

    /// Whether a pixel's standard deviation is more than a hundredth of its value.
    [[nodiscard]] bool isNoisy(std::size_t i) const {
        return variance_[i] > 1e-4F * layer_[i].squaredNorm() / 3.0F;
    }
    [[nodiscard]] bool anyNoise() const {
        for (std::size_t i = 0; i < layer_.size(); ++i) {
            if (isNoisy(i)) return true;
        }
        return false;
    }

    [[nodiscard]] Image result() const {
        std::vector<Coefficients> fits(static_cast<std::size_t>(columns_) * rows_);
        parallelFor(static_cast<std::size_t>(rows_), [&](std::size_t row) {
            for (int column = 0; column < columns_; ++column) {
                const int y = centerOf(static_cast<int>(row), height_);
                fits[row * columns_ + column] = fitAround(centerOf(column, width_), y);
            }
        });
        Image image(layer_.size());
        parallelFor(static_cast<std::size_t>(height_), [&](std::size_t y) {
            for (int x = 0; x < width_; ++x) {
                image[y * width_ + x] = combined(fits, x, static_cast<int>(y));
            }
        });
        return image;
    }

  private:
    [[nodiscard]] std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * width_ + x;
    }
    [[nodiscard]] int centerOf(int window, int size) const {
        return std::min(window * filter_.stride_px + filter_.stride_px / 2, size - 1);
    }

    /// Calls visit(x, y) for the pixels of a window.
    template <class Visit>
    void around(int x, int y, int radius, Visit&& visit) const {
        const int right = std::min(x + radius, width_ - 1);
        const int bottom = std::min(y + radius, height_ - 1);
        for (int v = std::max(y - radius, 0); v <= bottom; ++v) {
            for (int u = std::max(x - radius, 0); u <= right; ++u) visit(u, v);
        }
    }

    /// Squared difference of two pixels' surfaces.
    [[nodiscard]] float difference(std::size_t i, std::size_t j) const {
        const Visible& a = visible_[i];
        const Visible& b = visible_[j];
        if (a.hit != b.hit) return 1e9F;
        const Eigen::Vector3f apart = b.position - a.position;
        const float off = std::max(std::abs(a.normal.dot(apart)), std::abs(b.normal.dot(apart))) /
                          (filter_.off_plane * std::max(a.distance, 1e-3F));
        return (a.normal - b.normal).squaredNorm() / (filter_.normals * filter_.normals) +
               off * off;
    }

    /// Weight of pixel j in a window around pixel i.
    [[nodiscard]] float weight(std::size_t i, std::size_t j) const {
        if (counts_[j] == 0) return 0.0F;
        const float surfaces = difference(i, j);
        if (surfaces > 30.0F) return 0.0F;
        const float allowed =
            filter_.noise_count * filter_.noise_count * (guide_variance_[i] + guide_variance_[j]) +
            kRelative * kRelative * (guide_[i].squaredNorm() / 3.0F + 1e-6F);
        const float light = (guide_[i] - guide_[j]).squaredNorm() / 3.0F / allowed;
        return std::exp(-0.5F * (surfaces + light));
    }

    /// Dims pixels that are several times as bright as nearly all pixels of the same surface around
    /// them: single paths that met a small bright light by chance, whose light would become a spot.
    [[nodiscard]] Image withoutOutliers(const Image& set) const {
        Image result = set;
        parallelFor(static_cast<std::size_t>(height_), [&](std::size_t y) {
            std::vector<float> near;
            for (int x = 0; x < width_; ++x) {
                const std::size_t i = at(x, static_cast<int>(y));
                near.clear();
                around(x, static_cast<int>(y), kOutlierRadius, [&](int u, int v) {
                    const std::size_t j = at(u, v);
                    if (counts_[j] != 0 && difference(i, j) < 4.0F) near.push_back(set[j].mean());
                });
                if (near.size() < 6) continue;
                const auto bright =
                    near.begin() + static_cast<std::ptrdiff_t>(near.size() * 8 / 10);
                std::nth_element(near.begin(), bright, near.end());
                const float most = kOutlierFactor * *bright;
                if (set[i].mean() > most) result[i] *= most / set[i].mean();
            }
        });
        return result;
    }

    /// The variance of each pixel's mean, itself averaged over neighbours of the same surface.
    void findVariance(const Halves& halves) {
        std::vector<float> raw(layer_.size());
        for (std::size_t i = 0; i < raw.size(); ++i) {
            raw[i] = (0.5F * (halves[0][i] - halves[1][i])).squaredNorm() / 3.0F;
        }
        variance_.resize(raw.size());
        parallelFor(static_cast<std::size_t>(height_), [&](std::size_t y) {
            for (int x = 0; x < width_; ++x) {
                const std::size_t i = at(x, static_cast<int>(y));
                float sum = 1e-3F * raw[i];
                float weights = 1e-3F;
                around(x, static_cast<int>(y), kVarianceRadius, [&](int u, int v) {
                    const std::size_t j = at(u, v);
                    if (counts_[j] == 0) return;
                    const float w = std::exp(-0.5F * difference(i, j));
                    sum += w * raw[j];
                    weights += w;
                });
                variance_[i] = sum / weights;
            }
        });
    }

    /// A roughly filtered layer and its variance.
    void findGuide() {
        guide_.resize(layer_.size());
        guide_variance_.resize(layer_.size());
        parallelFor(static_cast<std::size_t>(height_), [&](std::size_t y) {
            for (int x = 0; x < width_; ++x) {
                const std::size_t i = at(x, static_cast<int>(y));
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                float weights = 0.0F;
                float variance = 0.0F;
                around(x, static_cast<int>(y), filter_.guide_px, [&](int u, int v) {
                    const std::size_t j = at(u, v);
                    if (counts_[j] == 0) return;
                    const float w = std::exp(-0.5F * difference(i, j));
                    sum += w * layer_[j];
                    weights += w;
                    variance += w * w * variance_[j];
                });
                const bool any = weights > kLeastWeight;
                guide_[i] = any ? Eigen::Vector3f(sum / weights) : layer_[i];
                guide_variance_[i] = any ? variance / (weights * weights) : variance_[i];
            }
        });
    }

    /// Weighted least squares in one window; 0 if no pixel counts.
    [[nodiscard]] Coefficients fitAround(int x, int y) const {
        const std::size_t center = at(x, y);
        Eigen::Matrix<float, kTerms, kTerms> a = Eigen::Matrix<float, kTerms, kTerms>::Zero();
        Coefficients b = Coefficients::Zero();
        around(x, y, filter_.radius_px, [&](int u, int v) {
            const std::size_t j = at(u, v);
            const float w = weight(center, j);
            if (!(w >= kLeastWeight)) return;
            const Terms terms = termsOf(visible_[j], visible_[center]);
            const Terms weighted = w * terms;
            a.noalias() += weighted * terms.transpose();
            b.noalias() += weighted * layer_[j].transpose();
        });
        const float weights = a(0, 0);
        if (!(weights > 0.0F)) return Coefficients::Zero();
        a(0, 0) += 1e-6F * weights;
        for (int k = 1; k < kTerms; ++k) a(k, k) += kRidge * weights;
        const Coefficients solved = a.ldlt().solve(b);
        if (solved.allFinite()) return solved;
        Coefficients mean = Coefficients::Zero();
        mean.row(0) = b.row(0) / weights;
        return mean;
    }

    /// The results of the windows around a pixel, by weight and nearness.
    [[nodiscard]] Eigen::Vector3f combined(const std::vector<Coefficients>& fits, int x,
                                           int y) const {
        const std::size_t i = at(x, y);
        if (counts_[i] == 0) return layer_[i];
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        float weights = 0.0F;
        const int column = x / filter_.stride_px;
        const int row = y / filter_.stride_px;
        for (int v = std::max(row - 1, 0); v <= std::min(row + 1, rows_ - 1); ++v) {
            for (int u = std::max(column - 1, 0); u <= std::min(column + 1, columns_ - 1); ++u) {
                const int cx = centerOf(u, width_);
                const int cy = centerOf(v, height_);
                const std::size_t center = at(cx, cy);
                if (counts_[center] == 0) continue;
                const auto apart = static_cast<float>((cx - x) * (cx - x) + (cy - y) * (cy - y));
                const auto stride = static_cast<float>(filter_.stride_px);
                const float w = weight(center, i) * std::exp(-0.5F * apart / (stride * stride));
                if (w < 1e-6F) continue;
                const Coefficients& fit = fits[static_cast<std::size_t>(v) * columns_ + u];
                sum += w * (fit.transpose() * termsOf(visible_[i], visible_[center]));
                weights += w;
            }
        }
        if (weights < 1e-5F) return guide_[i];
        return (sum / weights).cwiseMax(0.0F);
    }

    int width_;
    int height_;
    const std::vector<Visible>& visible_;
    const std::vector<char>& counts_;  // by pixel: it has light of this layer
    Filter filter_;
    int columns_;  // of windows
    int rows_;
    Image layer_;
    std::vector<float> variance_;
    Image guide_;
    std::vector<float> guide_variance_;
};

std::vector<Visible> visibleSurfaces(const LayeredImage& image) {
    std::vector<Visible> visible(image.sets[0].size());
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const LayeredLight total = image.total(i);
        if (!(total.hits > 0.0F)) continue;
        visible[i].normal = total.normal / total.hits;
        visible[i].position = total.position / total.hits;
        visible[i].distance = total.distance / total.hits;
        visible[i].hit = 2.0F * total.hits > static_cast<float>(image.samples);
    }
    return visible;
}

/// The mean of a layer over each set of samples.
Halves meansOf(const LayeredImage& image, Eigen::Vector3f LayeredLight::*layer, float scale) {
    Halves means;
    const float factor = 2.0F * scale / static_cast<float>(std::max(image.samples, 1));
    for (std::size_t k = 0; k < 2; ++k) {
        for (const LayeredLight& light : image.sets[k]) means[k].push_back(factor * light.*layer);
    }
    return means;
}

}  // namespace

PictureLayers denoised(const LayeredImage& image, float scale) {
    PictureLayers layers;
    layers.reflectance = meanOf(image, &LayeredLight::reflectance, 1.0F);
    const std::vector<Visible> visible = visibleSurfaces(image);
    std::vector<char> lit(visible.size());
    for (std::size_t i = 0; i < lit.size(); ++i) {
        lit[i] = layers.reflectance[i].mean() > 4.0F * kBlack ? 1 : 0;
    }
    const auto diffuse = [&](Eigen::Vector3f LayeredLight::*layer, const Filter& filter) {
        Halves halves = meansOf(image, layer, scale);
        for (Image& half : halves) half = illumination(half, layers.reflectance);
        return LayerFilter(image, visible, lit, filter, halves).result();
    };
    layers.direct = diffuse(&LayeredLight::direct, kDirect);
    layers.indirect = diffuse(&LayeredLight::indirect, kIndirect);
    const Halves glossy = meansOf(image, &LayeredLight::glossy, scale);
    const std::vector<char> all(visible.size(), 1);
    layers.residual = LayerFilter(image, visible, all, kGlossy, glossy).result();
    // Light seen through glass is noisy, because some of the paths are reflected.
    const Image shown = meanOf(image, &LayeredLight::shown, scale);
    const LayerFilter filter(image, visible, all, kGlossy,
                             meansOf(image, &LayeredLight::shown, scale));
    const Image smooth = filter.anyNoise() ? filter.result() : shown;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        layers.residual[i] += filter.isNoisy(i) ? smooth[i] : shown[i];
    }
    return layers;
}

}  // namespace dollytrack::render
