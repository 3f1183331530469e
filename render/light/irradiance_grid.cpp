#include "render/light/irradiance_grid.h"

#include "engine/jobs/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace dollytrack::render {

IrradianceGrid::IrradianceGrid(Eigen::AlignedBox3d box, double wanted_m, int most) {
    if (box.isEmpty()) box.extend(Eigen::Vector3d::Zero());
    const Eigen::Vector3d size = box.sizes().cwiseMax(0.1).cwiseMin(200.0);
    size_m_ = std::max(wanted_m, std::cbrt(size.prod() / most));
    for (int axis = 0; axis < 3; ++axis) {
        along_[axis] = static_cast<int>(std::ceil(size[axis] / size_m_)) + 1;
        low_[axis] = box.center()[axis] - 0.5 * along_[axis] * size_m_;
    }
    in_air_.assign(count(), 1);
}

std::size_t IrradianceGrid::count() const {
    return step(3);
}

std::size_t IrradianceGrid::step(unsigned axis) const {
    std::size_t cells = 1;
    for (unsigned k = 0; k < axis; ++k) cells *= static_cast<std::size_t>(along_[k]);
    return cells;
}

Eigen::Vector3d IrradianceGrid::center(std::size_t i) const {
    const std::size_t row = step(1);
    const std::size_t layer = step(2);
    const Eigen::Vector3d at(static_cast<double>(i % row), static_cast<double>(i % layer / row),
                             static_cast<double>(i / layer));
    return low_ + (at.array() + 0.5).matrix() * size_m_;
}

std::size_t IrradianceGrid::cellAt(const Eigen::Vector3d& point) const {
    std::size_t cell = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const double place = (point[axis] - low_[axis]) / size_m_;
        const int at = std::clamp(static_cast<int>(std::floor(place)), 0, along_[axis] - 1);
        cell += static_cast<std::size_t>(at) * step(axis);
    }
    return cell;
}

void IrradianceGrid::link(const RayCaster& rays) {
    open_.assign(count(), 0);
    parallelRanges(open_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            for (unsigned axis = 0; axis < 3; ++axis) {
                const std::size_t length = along_[axis];
                if (i / step(axis) % length + 1 == length) continue;
                if (rays.sees(center(i), center(i + step(axis)))) open_[i] |= 1U << axis;
            }
        }
    });
}

template <class Visit>
void IrradianceGrid::visitOpen(std::size_t i, Visit&& visit) const {
    for (unsigned axis = 0; axis < 3; ++axis) {
        const std::size_t away = step(axis);
        if ((open_[i] >> axis & 1U) != 0) visit(i + away);
        if (i >= away && (open_[i - away] >> axis & 1U) != 0) visit(i - away);
    }
}

template <class Add>
void IrradianceGrid::visitAround(std::size_t i, Add&& add) const {
    const auto [width, height, layers] = along_;
    const int x = static_cast<int>(i % step(1));
    const int y = static_cast<int>(i % step(2) / step(1));
    const int z = static_cast<int>(i / step(2));
    for (int k = std::max(z - 1, 0); k <= std::min(z + 1, layers - 1); ++k) {
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j) {
            const std::size_t row =
                static_cast<std::size_t>(k) * step(2) + static_cast<std::size_t>(j) * step(1);
            for (int h = std::max(x - 1, 0); h <= std::min(x + 1, width - 1); ++h) {
                const int steps = std::abs(h - x) + std::abs(j - y) + std::abs(k - z);
                add(row + static_cast<std::size_t>(h), steps);
            }
        }
    }
}

std::optional<std::size_t> IrradianceGrid::below(std::size_t i) const {
    constexpr unsigned kUp = 2;
    const std::size_t layer = step(kUp);
    if (i < layer || (open_[i - layer] >> kUp & 1U) == 0) return std::nullopt;
    return i - layer;
}

std::vector<char> IrradianceGrid::reachedFrom(const std::vector<std::size_t>& starts) const {
    std::vector<char> reached(count(), 0);
    std::vector<std::size_t> next;
    const auto reach = [&](std::size_t i) {
        if (std::exchange(reached[i], 1) == 0) next.push_back(i);
    };
    for (const std::size_t start : starts) reach(start);
    while (!next.empty()) {
        const std::size_t i = next.back();
        next.pop_back();
        visitOpen(i, reach);
    }
    return reached;
}

void IrradianceGrid::blur(std::vector<Eigen::Vector3f>& values, double deviation_m) const {
    // The mean over a cell and its six neighbours has a variance of 2/7 cells^2 per axis.
    const double wanted = 3.5 * std::pow(deviation_m / size_m_, 2.0);
    std::vector<Eigen::Vector3f> before;
    for (long pass = 0; pass < std::lround(wanted); ++pass) {
        before = values;
        parallelRanges(values.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (!inAir(i)) continue;
                float cells = 1.0F;
                visitOpen(i, [&](std::size_t j) {
                    if (!inAir(j)) return;
                    values[i] += before[j];
                    ++cells;
                });
                values[i] /= cells;
            }
        });
    }
}

void IrradianceGrid::closeHoles(std::vector<Eigen::Vector3f>& values) const {
    std::vector<char> known = in_air_;
    for (int layer = 0; layer < 3; ++layer) {
        const std::vector<char> before = known;
        std::vector<Eigen::Vector3f> next = values;
        parallelRanges(values.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (before[i] != 0) continue;
                Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                float weights = 0.0F;
                visitAround(i, [&](std::size_t j, int steps) {
                    if (before[j] == 0) return;
                    const float weight = 1.0F / static_cast<float>(1 + steps * steps);
                    sum += weight * values[j];
                    weights += weight;
                });
                if (weights == 0.0F) continue;
                next[i] = sum / weights;
                known[i] = 1;
            }
        });
        values = std::move(next);
    }
}

}  // namespace dollytrack::render
