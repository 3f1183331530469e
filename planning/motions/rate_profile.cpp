#include "planning/motions/rate_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dollytrack::planning {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Pieces that take less than this at full speed (s) count as standing still.
constexpr double kNothing = 1e-9;
// Changes of direction take at most this share of the limits of acceleration; sqrt(1 - 0.8^2) is
// left for speeding up and braking.
constexpr double kAcross = 0.8;
constexpr double kAlong = 0.6;

/// The pieces by the time that each takes at the limits of speed and turning. A rate is a share of
/// those limits: at rate 1 a piece takes exactly that time.
class RateProfile {
  public:
    RateProfile(std::vector<TimedPiece>& pieces, const MotionLimits& limits, double interval_s)
        : pieces_(pieces), limits_(limits), interval_s_(interval_s) {
        // The rate grows by this in a second at most.
        gain_ = kAlong * std::min(limits.acceleration_mps2 / limits.speed_mps,
                                  limits.turn_acceleration_rps2 / limits.turn_rps);
        for (const TimedPiece& piece : pieces) {
            least_.push_back(std::max(piece.move.norm() / limits.speed_mps,
                                      piece.turn.norm() / limits.turn_rps));
            caps_.push_back(capOf(piece, least_.back()));
        }
        rates_.assign(pieces.size() + 1, kInfinity);
    }

    void run() {
        limitNodes();
        for (std::size_t i = pieces_.size(); i-- > 0;) ramp(i, i + 1, i);
        for (std::size_t i = 0; i < pieces_.size(); ++i) ramp(i, i, i + 1);
        for (std::size_t i = 0; i < pieces_.size(); ++i) setTime(i);
    }

  private:
    static double capOf(const TimedPiece& piece, double least) {
        const double given = piece.given_s > 0.0 ? least / piece.given_s : 1.0;
        return piece.slowdown * (piece.retime ? std::min(1.0, given) : given);
    }

    /// Rates at the joints that touch a piece to be retimed.
    void limitNodes() {
        const std::size_t last = pieces_.size();
        for (std::size_t n = 0; n <= last; ++n) {
            const bool before = n > 0 && pieces_[n - 1].retime;
            const bool after = n < last && pieces_[n].retime;
            if (!before && !after) continue;
            if (n == 0 || n == last) {
                rates_[n] = 0.0;
                continue;
            }
            rates_[n] = std::min({capAt(n - 1), capAt(n), cornerLimit(n - 1, n)});
        }
    }

    [[nodiscard]] double capAt(std::size_t piece) const {
        if (least_[piece] > kNothing) return caps_[piece];
        return pieces_[piece].given_s > kNothing ? 0.0 : kInfinity;  // it stands, or takes no time
    }

    /// Largest rate at which the velocities of two pieces differ no more than the limits allow.
    [[nodiscard]] double cornerLimit(std::size_t a, std::size_t b) const {
        if (least_[a] <= kNothing || least_[b] <= kNothing) return 1.0;
        const double middle = 0.5 * (least_[a] + least_[b]);
        const auto limitOf = [&](const Eigen::Vector3d& change, double acceleration) {
            const double jump = std::max(change.norm(), 1e-12);
            return std::min(acceleration * interval_s_ / jump,
                            std::sqrt(acceleration * middle / jump));
        };
        const TimedPiece& first = pieces_[a];
        const TimedPiece& second = pieces_[b];
        return std::min(limitOf(second.move / least_[b] - first.move / least_[a],
                                kAcross * limits_.acceleration_mps2),
                        limitOf(second.turn / least_[b] - first.turn / least_[a],
                                kAcross * limits_.turn_acceleration_rps2));
    }

    /// Limits the rate at one end of a piece by that at the other.
    void ramp(std::size_t piece, std::size_t from, std::size_t node) {
        const double known = rates_[from];
        if (known == kInfinity) return;
        if (least_[piece] <= kNothing) {
            if (pieces_[piece].given_s <= kNothing) rates_[node] = std::min(rates_[node], known);
            return;
        }
        const double reach = std::sqrt(known * known + 2.0 * gain_ * least_[piece]);
        if (pieces_[piece].retime || caps_[piece] > reach) {
            const double cap = std::min(rates_[node], caps_[piece]);
            rates_[node] = std::min(cap, reach);
        }
    }

    void setTime(std::size_t i) {
        TimedPiece& piece = pieces_[i];
        const double start = rates_[i];
        const double end = rates_[i + 1];
        piece.changed = piece.retime || (start < kInfinity && end < kInfinity);
        piece.start_rate = piece.end_rate = 1.0;
        piece.time_s = piece.given_s;
        if (!piece.changed) return;
        piece.start_rate = std::min(start, caps_[i]);
        piece.end_rate = std::min(end, caps_[i]);
        const double sum = piece.start_rate + piece.end_rate;
        if (least_[i] <= kNothing) {
            piece.start_rate = piece.end_rate = 1.0;
        } else if (sum > 0.0) {
            piece.time_s = std::max(piece.given_s, 2.0 * least_[i] / sum);
        } else {
            piece.time_s = std::max(piece.given_s, 2.0 * std::sqrt(least_[i] / gain_));
        }
    }

    std::vector<TimedPiece>& pieces_;
    MotionLimits limits_;
    double interval_s_;
    double gain_ = 1.0;
    std::vector<double> least_;  // by piece: time at the limits, s
    std::vector<double> caps_;   // by piece: largest rate
    std::vector<double> rates_;  // by joint; infinity: as given
};

}  // namespace

double TimedPiece::shareAt(double time_share) const {
    const double t = time_share;
    const double sum = start_rate + end_rate;
    if (sum <= 0.0) return t < 0.5 ? 2.0 * t * t : 1.0 - 2.0 * (1.0 - t) * (1.0 - t);
    return (2.0 * start_rate * t + (end_rate - start_rate) * t * t) / sum;
}

void setTimes(std::vector<TimedPiece>& pieces, const MotionLimits& limits, double interval_s) {
    RateProfile(pieces, limits, interval_s).run();
}

}  // namespace dollytrack::planning
