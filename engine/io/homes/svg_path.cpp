#include "engine/io/homes/svg_path.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

namespace dollytrack::homes {
namespace {

using Eigen::Vector2d;

constexpr int kSteps = 16;  // line segments per curve
constexpr std::size_t kMostPoints = 20'000;

class PathReader {
  public:
    explicit PathReader(std::string_view path) : rest_(path) {}

    std::vector<std::vector<Vector2d>> read() {
        char command = 0;
        while (points_ < kMostPoints) {
            skip();
            if (rest_.empty()) break;
            if (std::isalpha(static_cast<unsigned char>(rest_.front()))) {
                command = rest_.front();
                rest_.remove_prefix(1);
            } else if (command == 0 || command == 'Z' || command == 'z') {
                break;
            }
            if (!apply(command)) break;
            if (command == 'M') command = 'L';  // further coordinate pairs are lines
            if (command == 'm') command = 'l';
        }
        finish();
        return std::move(outlines_);
    }

  private:
    void skip() {
        while (!rest_.empty() &&
               (std::isspace(static_cast<unsigned char>(rest_.front())) || rest_.front() == ',')) {
            rest_.remove_prefix(1);
        }
    }

    std::optional<double> number() {
        skip();
        if (!rest_.empty() && rest_.front() == '+') rest_.remove_prefix(1);
        double value = 0.0;
        const auto [end, status] =
            std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (status != std::errc{} || !std::isfinite(value) || std::abs(value) > 1e3) {
            return std::nullopt;
        }
        rest_.remove_prefix(end - rest_.data());
        return value;
    }

    std::optional<bool> flag() {
        skip();
        if (rest_.empty() || (rest_.front() != '0' && rest_.front() != '1')) return std::nullopt;
        const bool value = rest_.front() == '1';
        rest_.remove_prefix(1);
        return value;
    }

    std::optional<Vector2d> point(bool relative) {
        const auto x = number();
        const auto y = x ? number() : std::nullopt;
        if (!y) return std::nullopt;
        return Vector2d(*x, *y) + (relative ? at_ : Vector2d::Zero());
    }

    void to(const Vector2d& p) {
        outline_.push_back(p);
        at_ = p;
        ++points_;
    }

    void finish() {
        if (outline_.size() >= 3) outlines_.push_back(std::move(outline_));
        outline_.clear();
    }

    void cubic(const Vector2d& a, const Vector2d& b, const Vector2d& end) {
        const Vector2d start = at_;
        for (int i = 1; i <= kSteps; ++i) {
            const double t = static_cast<double>(i) / kSteps;
            const double s = 1.0 - t;
            to(s * s * s * start + 3 * s * s * t * a + 3 * s * t * t * b + t * t * t * end);
        }
        handle_ = b;
    }

    void quadratic(const Vector2d& a, const Vector2d& end) {
        const Vector2d start = at_;
        for (int i = 1; i <= kSteps; ++i) {
            const double t = static_cast<double>(i) / kSteps;
            const double s = 1.0 - t;
            to(s * s * start + 2 * s * t * a + t * t * end);
        }
        handle_ = a;
    }

    /// Adds an elliptical arc; converts it from end points to centre parameters (SVG 1.1, appendix
    /// F.6.5).
    void arc(double rx, double ry, double turn, bool large, bool sweep, const Vector2d& end) {
        rx = std::abs(rx);
        ry = std::abs(ry);
        if (rx == 0.0 || ry == 0.0 || end == at_) {
            to(end);
            return;
        }
        const Eigen::Rotation2Dd rotation(turn);
        const Vector2d half = rotation.inverse() * (0.5 * (at_ - end));
        const double off = half.x() * half.x() / (rx * rx) + half.y() * half.y() / (ry * ry);
        if (off > 1.0) {
            rx *= std::sqrt(off);
            ry *= std::sqrt(off);
        }
        const double a = rx * rx * half.y() * half.y() + ry * ry * half.x() * half.x();
        if (!(a > 0.0) ||
            !std::isfinite(rx * rx * ry * ry)) {  // too small or too large to be drawn
            to(end);
            return;
        }
        const double root = std::sqrt(std::max(0.0, (rx * rx * ry * ry - a) / a));
        const double sign = large == sweep ? -1.0 : 1.0;
        const Vector2d middle = sign * root * Vector2d(rx * half.y() / ry, -ry * half.x() / rx);
        const Vector2d centre = rotation * middle + 0.5 * (at_ + end);
        const auto angle = [&](const Vector2d& p) {
            return std::atan2((p.y() - middle.y()) / ry, (p.x() - middle.x()) / rx);
        };
        const double from = angle(half);
        double extent = angle(-half) - from;
        if (sweep && extent < 0.0) extent += 2.0 * std::numbers::pi;
        if (!sweep && extent > 0.0) extent -= 2.0 * std::numbers::pi;
        for (int i = 1; i < 2 * kSteps; ++i) {
            const double t = from + extent * i / (2 * kSteps);
            to(centre + rotation * Vector2d(rx * std::cos(t), ry * std::sin(t)));
        }
        to(end);
    }

    bool applyArc(bool relative) {
        const auto rx = number();
        const auto ry = rx ? number() : std::nullopt;
        const auto turn = ry ? number() : std::nullopt;
        const auto large = turn ? flag() : std::nullopt;
        const auto sweep = large ? flag() : std::nullopt;
        const auto end = sweep ? point(relative) : std::nullopt;
        if (!end) return false;
        arc(*rx, *ry, *turn * std::numbers::pi / 180.0, *large, *sweep, *end);
        return true;
    }

    bool applyCurve(char kind, bool relative) {
        const bool smooth = (kind == 'S' && curve_ == 'C') || (kind == 'T' && curve_ == 'Q');
        const Vector2d mirrored = smooth ? Vector2d(2.0 * at_ - handle_) : at_;
        // Number of points in the path: C has two control points, S and Q one, T none.
        const bool whole = kind == 'C' || kind == 'Q';
        std::vector<Vector2d> written;
        const std::size_t count = kind == 'C' ? 3 : kind == 'T' ? 1 : 2;
        while (written.size() < count) {
            const auto p = point(relative);
            if (!p) return false;
            written.push_back(*p);
        }
        const Vector2d a = whole ? written.front() : mirrored;
        const Vector2d b = written[count == 1 ? 0 : count - 2];
        const Vector2d end = written.back();
        if (kind == 'C' || kind == 'S') {
            cubic(a, b, end);
            curve_ = 'C';
        } else {
            quadratic(a, end);
            curve_ = 'Q';
        }
        return true;
    }

    bool apply(char command) {
        const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
        const bool relative = command != kind;
        if (kind == 'C' || kind == 'S' || kind == 'Q' || kind == 'T') {
            return applyCurve(kind, relative);
        }
        curve_ = 0;
        if (kind == 'A') return applyArc(relative);
        if (kind == 'Z') {
            finish();
            at_ = begin_;
            return true;
        }
        if (kind == 'H' || kind == 'V') {
            const auto value = number();
            if (!value) return false;
            const int axis = kind == 'H' ? 0 : 1;
            Vector2d p = at_;
            p[axis] = *value + (relative ? at_[axis] : 0.0);
            to(p);
            return true;
        }
        if (kind != 'M' && kind != 'L') return false;
        const auto p = point(relative);
        if (!p) return false;
        if (kind == 'M') {
            finish();
            begin_ = *p;
        }
        to(*p);
        return true;
    }

    std::string_view rest_;
    std::vector<std::vector<Vector2d>> outlines_;
    std::vector<Vector2d> outline_;
    Vector2d at_ = Vector2d::Zero();
    Vector2d begin_ = Vector2d::Zero();
    Vector2d handle_ = Vector2d::Zero();  // last control point of the previous curve
    char curve_ = 0;
    std::size_t points_ = 0;
};

}  // namespace

std::vector<std::vector<Vector2d>> outlinesOfPath(std::string_view path) {
    return PathReader(path).read();
}

}  // namespace dollytrack::homes
