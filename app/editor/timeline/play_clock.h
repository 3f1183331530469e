#pragma once

namespace dollytrack::editor {

/// Counts the frames that are due during playback.
class PlayClock {
  public:
    [[nodiscard]] bool runs() const { return runs_; }
    void start() {
        runs_ = true;
        gathered_ = 0.0;
    }
    void stop() { runs_ = false; }

    /// Adds a possibly fractional number of frames and returns how many whole frames are due; the
    /// rest carries over.
    int advance(double pictures) {
        if (!runs_) return 0;
        gathered_ += pictures;
        const int due = static_cast<int>(gathered_);
        gathered_ -= due;
        return due;
    }

    /// Frames until the next one is due: above 0, at most 1.
    [[nodiscard]] double untilNext() const { return 1.0 - gathered_; }

  private:
    bool runs_ = false;
    double gathered_ = 0.0;
};

}  // namespace dollytrack::editor
