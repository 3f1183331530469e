// Integrates the inertial measurements over short spans and compares with the poses.
#include "engine/camera/imu_track.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/number_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr const char* kImuFile = "imu.csv";
using Samples = std::vector<ImuSample>;

/// Tolerance of a span's integral: a fixed part for the file's digits, and a part for the unknown
/// curve between samples, estimated from their curvature.
struct Tolerance {
    double turn_rad = 2e-5;
    double velocity_mps = 5e-5;
};

/// The integral from one frame to the next.
struct Span {
    Eigen::Quaterniond turned =
        Eigen::Quaterniond::Identity();  // rotation from the first camera to the last
    // Integral of world acceleration, weighted from 0 to 1 and from 1 to 0, m/s.
    Eigen::Vector3d rising = Eigen::Vector3d::Zero();
    Eigen::Vector3d falling = Eigen::Vector3d::Zero();
    Tolerance tolerance;
    bool covered = false;
};

ImuSample mix(const ImuSample& a, const ImuSample& b, double time_s) {
    const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
    return {time_s, a.rate_rps + t * (b.rate_rps - a.rate_rps),
            a.specific_force_mps2 + t * (b.specific_force_mps2 - a.specific_force_mps2)};
}

/// Samples from `begin` to `end`, interpolated at both ends; extrapolated by at most one interval
/// after the last. Empty if there is a gap.
Samples between(const Samples& all, double begin, double end, double interval) {
    const auto at = [&](double time) {
        return std::lower_bound(all.begin(), all.end(), time,
                                [](const ImuSample& s, double t) { return s.time_s < t; });
    };
    // Times are whole nanoseconds in the file.
    constexpr double kStamp = 1e-9;
    const auto first = at(begin - kStamp);
    auto last = at(end - kStamp);
    if (!(begin < end) || first == all.end() || all.size() < 2) return {};
    Samples samples;
    const bool starts_there = first->time_s - begin <= kStamp;
    if (!starts_there && first == all.begin()) return {};
    if (!starts_there) samples.push_back(mix(*(first - 1), *first, begin));
    samples.insert(samples.end(), first, last);
    if (last != all.end() && last->time_s - end <= kStamp) {
        samples.push_back(*last);
    } else if (last != all.end() && last->time_s - (last - 1)->time_s < 1.5 * interval) {
        samples.push_back(mix(*(last - 1), *last, end));
    } else if (samples.size() >= 2 && end - samples.back().time_s < 1.01 * interval) {
        samples.push_back(mix(samples[samples.size() - 2], samples.back(), end));
    }
    if (samples.size() < 2 || samples.back().time_s < end - 2.0 * kStamp) return {};
    for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].time_s - samples[i - 1].time_s > 1.5 * interval) return {};
    }
    return samples;
}

Span integrate(const Samples& samples, const Eigen::Quaterniond& begin) {
    Span span;
    span.covered = samples.size() >= 2;
    if (!span.covered) return span;
    const double start = samples.front().time_s;
    const double length = samples.back().time_s - start;
    Eigen::Quaterniond rotation = begin;
    const auto acceleration = [&](const ImuSample& sample) -> Eigen::Vector3d {
        return rotation * sample.specific_force_mps2 - kGravity_mps2 * Eigen::Vector3d::UnitZ();
    };
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        const ImuSample& a = samples[i];
        const ImuSample& b = samples[i + 1];
        const double step = b.time_s - a.time_s;
        const Eigen::Vector3d at_a = acceleration(a);
        const Eigen::Vector3d angle = 0.5 * step * (a.rate_rps + b.rate_rps);
        if (angle.norm() > 0.0) {
            rotation = rotation * Eigen::AngleAxisd(angle.norm(), angle.normalized());
        }
        const Eigen::Vector3d at_b = acceleration(b);
        const double wa = (a.time_s - start) / length;
        const double wb = (b.time_s - start) / length;
        span.rising += 0.5 * step * (wa * at_a + wb * at_b);
        span.falling += 0.5 * step * ((1.0 - wa) * at_a + (1.0 - wb) * at_b);
        if (i == 0) continue;
        const ImuSample& before = samples[i - 1];
        const Eigen::Vector3d bend = b.rate_rps - 2.0 * a.rate_rps + before.rate_rps;
        const Eigen::Vector3d bend_of_force =
            b.specific_force_mps2 - 2.0 * a.specific_force_mps2 + before.specific_force_mps2;
        span.tolerance.turn_rad += step * bend.norm() / 8.0;
        span.tolerance.velocity_mps += step * bend_of_force.norm() / 8.0;
    }
    span.turned = begin.conjugate() * rotation;
    span.tolerance.velocity_mps += kGravity_mps2 * span.tolerance.turn_rad * length;
    return span;
}

/// A trajectory without motion has no rows, only the header.
bool hasNoRows(std::string_view text) {
    const auto lines = splitLines(text);
    return std::all_of(lines.begin(), lines.end(),
                       [](std::string_view line) { return line.empty() || line.front() == '#'; });
}

Result<Samples> readSamples(const std::filesystem::path& path) {
    const Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    if (text->starts_with('#') && hasNoRows(*text)) return Samples{};
    const auto lines = readNumberLines(path, *text, 7, "time, angular rate, specific force");
    if (!lines) return tl::unexpected(lines.error());
    Samples samples;
    for (const NumberLine& line : *lines) {
        const auto& v = line.values;
        samples.push_back({v[0] * 1e-9, {v[1], v[2], v[3]}, {v[4], v[5], v[6]}});
        if (samples.size() > 1 && !(samples.back().time_s > samples[samples.size() - 2].time_s)) {
            return fail(ErrorCode::BadInput, "The time is not after the one before it.",
                        placeOf(path, line.line));
        }
    }
    return samples;
}

/// Whether the path continues from the previous frame; unknown if frames.csv does not tell.
std::vector<std::optional<bool>> motionsGoOn(const StoredDataset& dataset) {
    std::vector<std::optional<bool>> goes_on(dataset.frames.size());
    const auto rows = NumberTable::read(dataset.folder / "frames.csv");
    if (!rows || !rows->has("path") || rows->rows() != dataset.frames.size()) return goes_on;
    for (std::size_t i = 1; i < goes_on.size(); ++i) {
        goes_on[i] = rows->number(i, "path") == rows->number(i - 1, "path");
    }
    return goes_on;
}

class ImuCheck {
  public:
    ImuCheck(const StoredDataset& dataset, Samples samples, double interval_s, Findings& findings)
        : dataset_(dataset),
          samples_(std::move(samples)),
          interval_(interval_s),
          findings_(findings) {}

    void run() {
        const auto goes_on = motionsGoOn(dataset_);
        Span before;
        for (std::size_t i = 1; i < dataset_.frames.size(); ++i) {
            const StoredFrame& a = dataset_.frames[i - 1];
            const StoredFrame& b = dataset_.frames[i];
            const Span span =
                integrate(between(samples_, a.time_s, b.time_s, interval_), a.pose.rotation);
            const bool expected = goes_on[i] ? *goes_on[i] : measuredBetween(a.time_s, b.time_s);
            if (expected && !span.covered) {
                add(i, fmt::format("measurements missing before {:.6f} s", b.time_s),
                    fmt::format("one every {:g} s since {:.6f} s", interval_, a.time_s));
            }
            if (span.covered) compareTurn(i, span);
            if (span.covered && before.covered) compareVelocity(i - 1, before, span);
            before = span;
        }
    }

  private:
    void add(std::size_t frame, std::string found, std::string expected) {
        findings_.add(
            {kImuFile, static_cast<int>(frame), {}, std::move(found), std::move(expected)});
    }

    [[nodiscard]] bool measuredBetween(double begin, double end) const {
        const auto first =
            std::upper_bound(samples_.begin(), samples_.end(), begin + 1e-9,
                             [](double time, const ImuSample& s) { return time < s.time_s; });
        return first != samples_.end() && first->time_s < end - 1e-9;
    }

    void compareTurn(std::size_t i, const Span& span) {
        const Eigen::Quaterniond expected =
            dataset_.frames[i - 1].pose.rotation.conjugate() * dataset_.frames[i].pose.rotation;
        const double off = expected.angularDistance(span.turned);
        if (off <= span.tolerance.turn_rad) return;
        add(i, fmt::format("angular rates that deviate by {:.3g} rad from the pose", off),
            fmt::format("at most {:.2g} rad", span.tolerance.turn_rad));
    }

    /// Over two spans the unknown velocity at the first frame cancels out.
    void compareVelocity(std::size_t middle, const Span& first, const Span& second) {
        const auto& frames = dataset_.frames;
        const auto mean_velocity = [&](std::size_t i) -> Eigen::Vector3d {
            return (frames[i].pose.position - frames[i - 1].pose.position) /
                   (frames[i].time_s - frames[i - 1].time_s);
        };
        const Eigen::Vector3d expected = mean_velocity(middle + 1) - mean_velocity(middle);
        const Eigen::Vector3d found = first.rising + second.falling;
        const double allowed = first.tolerance.velocity_mps + second.tolerance.velocity_mps;
        const double off = (found - expected).norm();
        if (off <= allowed) return;
        add(middle,
            fmt::format("specific forces that deviate by {:.3g} m/s from the poses' velocity", off),
            fmt::format("at most {:.2g} m/s", allowed));
    }

    const StoredDataset& dataset_;
    const Samples samples_;
    double interval_;
    Findings& findings_;
};

}  // namespace

CheckWork beginImu(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    double rate_hz = 0.0;
    try {
        rate_hz = dataset.card.at("parameters").at("imu").at("imu_rate_hz").get<double>();
    } catch (const nlohmann::json::exception& error) {
        findings.add({"dataset.json", {}, {}, plainReason(error), "parameters.imu.imu_rate_hz"});
        return {};
    }
    if (dataset.frames.size() < 2 || !(rate_hz > 0.0)) return {};
    Result<Samples> samples = readSamples(dataset.folder / kImuFile);
    if (!samples) {
        findings.add({kImuFile, {}, {}, describe(samples.error()), "EuRoC's columns"});
        return {};
    }
    ImuCheck(dataset, std::move(*samples), 1.0 / rate_hz, findings).run();
    return {};
}

}  // namespace dollytrack::verify
