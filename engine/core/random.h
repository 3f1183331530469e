#pragma once

#include <cstdint>

namespace dollytrack {

/// Seeded random numbers with the same sequence on every platform and standard library
/// (PCG-XSH-RR 64/32, O'Neill 2014). Each stage and each item takes a stream of its own, so that
/// results do not depend on the order of work.
class Random {
  public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0);

    std::uint32_t next();
    /// Uniform in [0, 1).
    double uniform();
    double uniform(double low, double high);
    /// Uniform in 0 .. count-1; count > 0.
    std::uint32_t below(std::uint32_t count);
    /// Normal distribution with mean 0 and deviation 1 (Box-Muller).
    double normal();

  private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_ = 1;
};

}  // namespace dollytrack
