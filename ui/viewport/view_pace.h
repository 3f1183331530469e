#pragma once

#include <chrono>

namespace dollytrack::ui {

/// In how many pixels a view is drawn so that it follows the mouse: fewer while it moves and a
/// whole picture takes too long, all once it rests.
class ViewPace {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Without a new view for so long it rests. Views that come more seldom are no movement.
    static constexpr std::chrono::milliseconds kRest{150};
    static constexpr double kFluent_ms = 50.0;  // whole pictures that take no longer stay whole

    /// Of the pane's pixels, a side, in one of the picture's. `same`: as the view before, of which
    /// at most what lies over it is new.
    [[nodiscard]] int shrinkFor(bool same, Time now) const;

    /// What was drawn: a whole picture (shrink 1) of the scene tells how long these take.
    void drew(int shrink, bool same, bool scene, double milliseconds, Time now);
    /// Other things to draw take other times.
    void forget() { *this = {}; }

    /// From then on it rests.
    [[nodiscard]] Time restsAt() const { return moved_ + kRest; }

  private:
    double whole_ms_ = 0.0;
    int shrink_ = 1;
    Time moved_;  // when a new view was last drawn
};

}  // namespace dollytrack::ui
