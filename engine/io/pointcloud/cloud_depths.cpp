#include "engine/io/pointcloud/cloud_depths.h"

#include "engine/jobs/parallel.h"
#include "engine/math/quantile.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dollytrack {
namespace {

constexpr double kNearest = 0.05;       // m; smallest depth of a depth image
constexpr std::size_t kFewest = 1'000;  // smallest number of points of a depth image
constexpr std::size_t kPerValue = 100;  // mean number of points per value if depth is quantized
constexpr double kSteps = 1.5;          // largest deviation of neighbours from the plane, in steps
constexpr int kReach = 7;               // neighbourhood in cells, to each side
constexpr std::size_t kLeastNeighbours = 12;
constexpr std::size_t kMostCells = 64'000'000;

/// A point in normalized image coordinates, with its inverse depth in 1/m.
struct Pixel {
    double u = 0.0;
    double v = 0.0;
    double inverse = 0.0;
};

std::vector<Pixel> pixelsOf(const PointCloud& cloud, const Eigen::Vector3d& eye) {
    std::vector<Pixel> pixels(cloud.points.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Eigen::Vector3d p = cloud.points[i] - eye;
        if (p.z() < kNearest) return {};
        pixels[i] = {p.x() / p.z(), p.y() / p.z(), 1.0 / p.z()};
    }
    return pixels;
}

/// The quantization step of the inverse depths: the median gap of adjacent values; 0 if there are
/// too many different values.
double stepOf(const std::vector<Pixel>& pixels) {
    std::vector<double> values;
    values.reserve(pixels.size());
    for (const Pixel& pixel : pixels) values.push_back(pixel.inverse);
    std::sort(values.begin(), values.end());
    std::vector<double> gaps;
    std::size_t different = 1;
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double gap = values[i] - values[i - 1];
        if (gap < 1e-6) continue;  // the same value, rounded differently
        ++different;
        gaps.push_back(gap);
    }
    if (gaps.empty() || different * kPerValue > pixels.size()) return 0.0;
    return upperMedian(std::move(gaps));
}

/// A grid over the image with about one pixel per cell, for neighbour queries.
class Picture {
  public:
    explicit Picture(const std::vector<Pixel>& pixels) : pixels_(pixels) {
        Eigen::AlignedBox2d box;
        for (const Pixel& pixel : pixels) box.extend(Eigen::Vector2d(pixel.u, pixel.v));
        low_ = box.min();
        const Eigen::Vector2d size = box.sizes().array() + 1e-9;
        pitch_ = std::sqrt(size.prod() / static_cast<double>(pixels.size()));
        pitch_ = std::max(pitch_, std::sqrt(size.prod() / static_cast<double>(kMostCells)));
        pitch_ = std::max(pitch_, size.maxCoeff() / 30'000.0);
        columns_ = static_cast<int>(size.x() / pitch_) + 1;
        rows_ = static_cast<int>(size.y() / pitch_) + 1;
        const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
        first_.assign(cells + 1, 0);
        for (const Pixel& pixel : pixels) ++first_[cellOf(pixel) + 1];
        for (std::size_t i = 0; i < cells; ++i) first_[i + 1] += first_[i];
        order_.resize(pixels.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t i = 0; i < pixels.size(); ++i) order_[next[cellOf(pixels[i])]++] = i;
    }

    [[nodiscard]] double pitch() const { return pitch_; }

    template <class Visit>
    void forNear(const Pixel& pixel, Visit&& visit) const {
        const int column = columnOf(pixel);
        const int row = rowOf(pixel);
        for (int y = std::max(0, row - kReach); y <= std::min(rows_ - 1, row + kReach); ++y) {
            const std::size_t line =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_);
            const auto from = line + static_cast<std::size_t>(std::max(0, column - kReach));
            const auto to =
                line + static_cast<std::size_t>(std::min(columns_ - 1, column + kReach));
            for (std::uint32_t i = first_[from]; i < first_[to + 1]; ++i) visit(order_[i]);
        }
    }

  private:
    [[nodiscard]] int columnOf(const Pixel& pixel) const {
        return std::clamp(static_cast<int>((pixel.u - low_.x()) / pitch_), 0, columns_ - 1);
    }
    [[nodiscard]] int rowOf(const Pixel& pixel) const {
        return std::clamp(static_cast<int>((pixel.v - low_.y()) / pitch_), 0, rows_ - 1);
    }
    [[nodiscard]] std::size_t cellOf(const Pixel& pixel) const {
        return static_cast<std::size_t>(rowOf(pixel)) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(columnOf(pixel));
    }

    const std::vector<Pixel>& pixels_;
    Eigen::Vector2d low_;
    double pitch_ = 1.0;
    int columns_ = 1;
    int rows_ = 1;
    std::vector<std::uint32_t> first_;  // index into order_ by cell
    std::vector<std::uint32_t> order_;
};

/// Inverse depth at a pixel of the plane through its neighbours; its own if there are too few.
double smoothed(const std::vector<Pixel>& pixels, const Picture& picture, std::size_t i,
                double step) {
    const Pixel& at = pixels[i];
    Eigen::Vector3d plane(at.inverse, 0.0, 0.0);  // value, and slopes per cell
    // The first plane faces the camera; on slanted surfaces later rounds include more neighbours.
    for (int round = 0; round < 3; ++round) {
        Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
        Eigen::Vector3d sums = Eigen::Vector3d::Zero();
        std::size_t count = 0;
        picture.forNear(at, [&](std::uint32_t j) {
            const Eigen::Vector3d row(1.0, (pixels[j].u - at.u) / picture.pitch(),
                                      (pixels[j].v - at.v) / picture.pitch());
            if (std::abs(row.dot(plane) - pixels[j].inverse) > kSteps * step) return;
            products += row * row.transpose();
            sums += pixels[j].inverse * row;
            ++count;
        });
        if (count < kLeastNeighbours) return at.inverse;
        const Eigen::LDLT<Eigen::Matrix3d> solver(products);
        const Eigen::Vector3d next = solver.solve(sums);
        if (!next.allFinite() || solver.vectorD().minCoeff() < 1.0) return at.inverse;
        plane = next;
    }
    return std::clamp(plane[0], at.inverse - kSteps * step, at.inverse + kSteps * step);
}

}  // namespace

double smoothDepths(PointCloud& cloud_m, const JobContext& job) {
    if (cloud_m.points.size() < kFewest) return 0.0;
    const Eigen::Vector3d eye = cloud_m.viewpoint.value_or(Eigen::Vector3d::Zero());
    const std::vector<Pixel> pixels = pixelsOf(cloud_m, eye);
    const double step = pixels.empty() ? 0.0 : stepOf(pixels);
    if (step == 0.0) return 0.0;
    const Picture picture(pixels);
    parallelFor(pixels.size(), [&](std::size_t i) {
        if (job.cancelled()) return;
        const double inverse = std::max(1e-3, smoothed(pixels, picture, i, step));
        cloud_m.points[i] = eye + Eigen::Vector3d(pixels[i].u, pixels[i].v, 1.0) / inverse;
    });
    return step;
}

}  // namespace dollytrack
