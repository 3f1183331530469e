#pragma once

#include <cstdint>

namespace dollytrack::render {

/// Random numbers that depend only on seed, frame, pixel and index, so that neither threads nor a
/// resumed export change them. Uses the finaliser of SplitMix64 (Steele, Lea and Flood, 2014) on
/// each in turn. `place` is the index of a number within its pixel.
class PixelRandom {
  public:
    PixelRandom(std::uint32_t seed, int frame, std::uint64_t pixel)
        : key_(mixed(mixed(mixed(seed) + static_cast<std::uint32_t>(frame)) + pixel)) {}

    /// Uniform in (0, 1).
    [[nodiscard]] double uniform(std::uint32_t place) const {
        return (static_cast<double>(mixed(key_ + place) >> 11U) + 0.5) * 0x1p-53;
    }
    /// Mean 0, standard deviation 1 (Box-Muller); uses two indices.
    [[nodiscard]] double normal(std::uint32_t place) const;

    /// Poisson distributed with this mean: exact below 64, else a rounded normal distribution,
    /// where the skewness is below 1/8. Uses two indices.
    [[nodiscard]] double poisson(double mean, std::uint32_t place) const;

  private:
    static std::uint64_t mixed(std::uint64_t x) {
        x += 0x9E3779B97F4A7C15ULL;
        x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
        return x ^ (x >> 31U);
    }
    std::uint64_t key_;
};

}  // namespace dollytrack::render
