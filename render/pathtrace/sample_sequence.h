#pragma once

#include <array>
#include <cstdint>

namespace dollytrack::render {

/// Random numbers of one path. They depend only on seed, pixel, sample and dimension, so order of
/// work and number of threads do not matter. Each pair of dimensions is a two-dimensional Sobol
/// sequence over a pixel's samples with hash-based Owen scrambling (Burley, Practical Hash-based
/// Owen Scrambling, JCGT 9(4), 2020).
class SampleSequence {
  public:
    SampleSequence(std::uint32_t seed, std::uint32_t pixel, std::uint32_t sample);

    /// Returns one or two numbers in [0, 1) and advances by as many dimensions.
    [[nodiscard]] double next();
    [[nodiscard]] std::array<double, 2> nextPair();

    /// Continues at the given dimension, so that paths with different branches stay aligned.
    void jumpTo(std::uint32_t dimension) { dimension_ = dimension; }

  private:
    std::uint32_t pixel_seed_ = 0;
    std::uint32_t sample_ = 0;
    std::uint32_t dimension_ = 0;
};

}  // namespace dollytrack::render
