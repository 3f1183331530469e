#pragma once

#include <array>
#include <cstdint>

namespace dollytrack::render {

/// The random numbers of one path: a function of seed, pixel, sample and dimension alone, so that
/// neither the order of work nor the number of threads matters. Each pair of dimensions is a
/// two-dimensional Sobol sequence over the samples of a pixel, shuffled and scrambled by hashes
/// (Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020).
class SampleSequence {
  public:
    SampleSequence(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample);

    /// The next one or two dimensions; each in [0, 1).
    [[nodiscard]] double next();
    [[nodiscard]] std::array<double, 2> nextPair();

    /// Goes on at the given dimension. Paths that took different turns stay in step that way.
    void jumpTo(std::uint32_t dimension) { dimension_ = dimension; }

  private:
    std::uint32_t pixel_seed_ = 0;
    std::uint32_t sample_ = 0;
    std::uint32_t dimension_ = 0;
};

}  // namespace dollytrack::render
