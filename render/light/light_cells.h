#pragma once

#include "engine/geometry/ray_caster.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack::render {

/// The cells of a light volume, x fastest: where they are, which are in the air of the rooms, which
/// are open to each other, and the blurs of values over neighbours that follow from that. None of
/// it depends on the number of threads.
class LightCells {
  public:
    /// Over a box, m, in cells of the wanted size or what makes at most about so many of them.
    LightCells(Eigen::AlignedBox3d box, double wanted_m, int most);

    [[nodiscard]] std::size_t count() const;
    [[nodiscard]] const Eigen::Vector3d& low() const { return low_; }  // corner, m
    [[nodiscard]] double size_m() const { return size_m_; }
    [[nodiscard]] const std::array<int, 3>& along() const { return along_; }  // cells by axis
    [[nodiscard]] Eigen::Vector3d center(std::size_t i) const;
    /// The cell that a point is in, or the nearest one.
    [[nodiscard]] std::size_t cellAt(const Eigen::Vector3d& point) const;

    /// All are until they leave it. Different cells may leave on different threads.
    [[nodiscard]] bool inAir(std::size_t i) const { return in_air_[i] != 0; }
    void leaveAir(std::size_t i) { in_air_[i] = 0; }

    /// Finds between which neighbours nothing stands; before the two below.
    void link(const RayCaster& rays);
    /// Which cells an open way leads to, by cell.
    [[nodiscard]] std::vector<char> reachedFrom(const std::vector<std::size_t>& starts) const;
    /// Blurs what cells of the air have over those of it that are open to them, by about a normal
    /// distribution of this standard deviation, m: the chance of the rays goes, and light does not
    /// cross what stands between cells.
    void blur(std::vector<Eigen::Vector3f>& values, double deviation_m) const;

    /// Gives cells outside the air the light of the air next to them, layer by layer.
    void closeHoles(std::vector<Eigen::Vector3f>& values) const;

  private:
    /// From a cell to the next one along an axis.
    [[nodiscard]] std::size_t step(unsigned axis) const;
    /// Calls visit(j) for the cells next to i that nothing stands before.
    template <class Visit>
    void visitOpen(std::size_t i, Visit&& visit) const;
    /// Calls add(j, steps) for the 27 cells around i, itself included.
    template <class Add>
    void visitAround(std::size_t i, Add&& add) const;

    Eigen::Vector3d low_ = Eigen::Vector3d::Zero();
    double size_m_ = 0.0;
    std::array<int, 3> along_ = {0, 0, 0};
    std::vector<char> in_air_;        // by cell
    std::vector<std::uint8_t> open_;  // by cell, a bit an axis: to the next cell along it
};

}  // namespace dollytrack::render
