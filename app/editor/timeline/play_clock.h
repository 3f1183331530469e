#pragma once

namespace dollytrack::editor {

/// Counts the pictures that are due while something plays.
class PlayClock {
  public:
    [[nodiscard]] bool runs() const { return runs_; }
    void start() {
        runs_ = true;
        gathered_ = 0.0;
    }
    void stop() { runs_ = false; }

    /// How many whole pictures are due after `pictures` more, a fraction mostly; what is left of
    /// one counts next time.
    int advance(double pictures) {
        if (!runs_) return 0;
        gathered_ += pictures;
        const int due = static_cast<int>(gathered_);
        gathered_ -= due;
        return due;
    }

  private:
    bool runs_ = false;
    double gathered_ = 0.0;
};

}  // namespace dollytrack::editor
