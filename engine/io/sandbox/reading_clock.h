#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace dollytrack {

/// Time limit of a reading. A damaged file is given up early, while a large intact file has time
/// even on a slow machine. Starting the importer has a limit of its own, which ends when the first
/// file is opened.
class ReadingClock {
  public:
    using Seconds = std::chrono::duration<double>;

    static constexpr Seconds kStart{10.0};
    static constexpr Seconds kLeast{2.0};
    static constexpr Seconds kFirstMebibyte{10.0};
    static constexpr Seconds kFurtherMebibyte{2.0};
    static constexpr Seconds kMost{900.0};

    /// `work` multiplies the time; each scene format has its own.
    explicit ReadingClock(double work = 1.0) : work_(work) {}

    void opened(std::uint64_t bytes) {
        if (!reads_) {
            reads_ = true;
            begin_ = Clock::now();
            waited_before_ = waited_;
        }
        mebibytes_ += static_cast<double>(bytes) / 1048576.0;
    }
    /// Whether a file was opened. Time before that is not the file's fault.
    [[nodiscard]] bool reads() const { return reads_; }
    [[nodiscard]] Seconds allowed() const {
        if (!reads_) return kStart;
        const double first = std::min(mebibytes_, 1.0);
        return std::min(kMost, work_ * (kLeast + first * kFirstMebibyte +
                                        (mebibytes_ - first) * kFurtherMebibyte));
    }
    /// Sets the total time for which other programs kept the processors busy; the limit is extended
    /// by it.
    void waited(Seconds sum) { waited_ = std::max(waited_, sum); }
    [[nodiscard]] Seconds left() const {
        return allowed() + waited_ - waited_before_ - (Clock::now() - begin_);
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
    double work_;
    double mebibytes_ = 0.0;
    bool reads_ = false;
    Seconds waited_{0.0};
    Seconds waited_before_{0.0};
};

}  // namespace dollytrack
