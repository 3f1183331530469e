#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dollytrack::io {

/// How long a reading may take: a damaged file shall be given up soon, and a large sound one on a
/// slow machine be waited for.
class ReadingClock {
  public:
    using Seconds = std::chrono::duration<double>;

    static constexpr Seconds kLeast{10.0};
    static constexpr Seconds kMost{900.0};
    static constexpr Seconds kForMebibyte{2.0};

    /// `work` is that of the scene's format.
    explicit ReadingClock(double work = 1.0) : work_(work) {}

    void opened(std::uint64_t bytes) { bytes_ += static_cast<double>(bytes); }
    [[nodiscard]] Seconds allowed() const {
        return std::min(kMost, work_ * (kLeast + kForMebibyte * (bytes_ / 1048576.0)));
    }
    /// For so long in all others had the processors: a busy machine is no fault of the file.
    void waited(Seconds sum) { waited_ = std::max(waited_, sum); }
    [[nodiscard]] Seconds left() const { return allowed() + waited_ - (Clock::now() - begin_); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
    double work_;
    double bytes_ = 0.0;
    Seconds waited_{0.0};
};

}  // namespace dollytrack::io
