#pragma once

#include "engine/geometry/ray_caster.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dollytrack::render {

/// The cells of an irradiance grid, x fastest: their positions, which are in the rooms' free space,
/// which neighbours see each other, and edge-aware blurs. Results do not depend on the number of
/// threads.
class IrradianceGrid {
  public:
    /// Covers a box (m) with cells of the wanted size, or larger ones if there would be more than
    /// about `most`.
    IrradianceGrid(Eigen::AlignedBox3d box, double wanted_m, int most);

    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] const Eigen::Vector3d& low() const { return low_; }  // corner, m
    [[nodiscard]] double size_m() const { return size_m_; }
    /// Number of cells by axis.
    [[nodiscard]] const std::array<int, 3>& along() const { return along_; }
    [[nodiscard]] Eigen::Vector3d center(std::size_t i) const;
    /// The cell that contains a point, or the nearest one.
    [[nodiscard]] std::size_t cellAt(const Eigen::Vector3d& point) const;

    /// Whether a cell is in free space; true until exclude(). Different cells may be changed on
    /// different threads.
    [[nodiscard]] bool inAir(std::size_t i) const { return in_air_[i] != 0; }
    void exclude(std::size_t i) { in_air_[i] = 0; }

    /// Finds which neighbouring cells see each other. Call it before the three functions below.
    void link(const RayCaster& rays);
    /// The index of the cell straight below, if no surface lies between the two.
    [[nodiscard]] std::optional<std::size_t> below(std::size_t i) const;
    /// By cell: whether it is connected to one of `starts` through neighbours that see each other.
    [[nodiscard]] std::vector<char> reachedFrom(const std::vector<std::size_t>& starts) const;
    /// Blurs the values of free cells over connected free cells, by about a Gaussian of this
    /// standard deviation, m. This removes sampling noise without leaking light through walls.
    void blur(std::vector<Eigen::Vector3f>& values, double deviation_m) const;

    /// Extrapolates values into cells outside free space, up to three layers deep.
    void closeHoles(std::vector<Eigen::Vector3f>& values) const;

  private:
    /// Index offset between neighbours along an axis.
    [[nodiscard]] std::size_t step(unsigned axis) const;
    /// Calls visit(j) for each neighbour j of i that sees i.
    template <class Visit>
    void visitOpen(std::size_t i, Visit&& visit) const;
    /// Calls add(j, steps) for the up to 27 cells around i, itself included; `steps` is the
    /// Manhattan distance.
    template <class Add>
    void visitAround(std::size_t i, Add&& add) const;

    Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
    double size_m_ = 0.0;
    std::array<int, 3> along_ = {0, 0, 0};
    std::vector<char> in_air_;        // by cell: it is in free space
    std::vector<std::uint8_t> open_;  // by cell, one bit per axis: the next cell is visible
};

}  // namespace dollytrack::render
