#pragma once

#include <cstdint>

namespace dollytrack::render {

/// Random numbers that are a function of seed, frame, pixel and place in the row alone, so that
/// neither threads nor a continued export change them: the finaliser of SplitMix64 (Steele, Lea and
/// Flood, 2014), applied to each in turn.
class PixelRandom {
  public:
    PixelRandom(std::uint32_t seed, int frame, std::uint64_t pixel)
        : key_(mixed(mixed(mixed(seed) + static_cast<std::uint32_t>(frame)) + pixel)) {}

    /// Uniform in (0, 1).
    [[nodiscard]] double uniform(std::uint32_t place) const {
        return (static_cast<double>(mixed(key_ + place) >> 11U) + 0.5) * 0x1p-53;
    }
    /// Mean 0, deviation 1 (Box-Muller); takes two places.
    [[nodiscard]] double normal(std::uint32_t place) const;

    /// How many of something come when `mean` are expected: exact below 64, above it the rounded
    /// normal distribution, whose skewness is below an eighth there. Takes two places.
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
