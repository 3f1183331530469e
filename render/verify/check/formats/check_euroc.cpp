// Checks EuRoC's layout: times, poses, lenses and images.
#include "render/verify/check/check_list.h"

#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::verify {
namespace {

constexpr double kPose = 1e-6;          // m, and quaternion components
constexpr double kEurocLens_px = 1e-6;  // numbers have nine digits

std::vector<std::string_view> splitAt(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = text.find(separator);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

class EurocCheck {
  public:
    EurocCheck(const StoredDataset& dataset, Findings& findings)
        : dataset_(dataset), findings_(findings) {}

    void run() {
        checkCamera("cam0", "rgb", 0.0);
        if (dataset_.has("rgb_right")) {
            checkCamera("cam1", "rgb_right",
                        dataset_.convention("rgb_right").value("baseline_m", 0.0));
        }
        checkPoses();
        checkImu();
    }

  private:
    void add(std::string file, std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({std::move(file), frame, {}, std::move(found), std::move(expected)});
    }

    /// The fields of all non-comment lines; adds a finding if there is not one line per frame.
    std::vector<std::vector<std::string>> rowsOf(const std::string& file) {
        std::vector<std::vector<std::string>> rows;
        const Result<std::string> text = readText(dataset_.folder / file);
        if (!text) {
            add(file, {}, text.error().message, "a table");
            return {};
        }
        for (const std::string_view line : splitLines(*text)) {
            if (line.empty() || line.starts_with('#')) continue;
            std::vector<std::string>& row = rows.emplace_back();
            for (const std::string_view field : splitAt(line, ',')) row.emplace_back(field);
        }
        if (rows.size() == dataset_.frames.size()) return rows;
        add(file, {}, fmt::format("{} rows", rows.size()),
            fmt::format("{}, one a frame", dataset_.frames.size()));
        return {};
    }

    [[nodiscard]] std::string stampOf(std::size_t frame) const {
        const double nanoseconds = std::round(dataset_.frames[frame].time_s * 1e9);
        return std::to_string(static_cast<std::int64_t>(nanoseconds));
    }

    [[nodiscard]] std::string hashOf(const std::string& name) const {
        const auto at = dataset_.sha256s.find(name);
        return at == dataset_.sha256s.end() ? std::string() : at->second;
    }

    void checkCamera(const std::string& camera, const char* modality, double right_m) {
        const std::string file = "mav0/" + camera + "/data.csv";
        const auto rows = rowsOf(file);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto frame = static_cast<int>(i);
            const std::string stamp = fmt::format("{:0>19}", stampOf(i));
            if (rows[i].size() != 2 || rows[i][0] != stamp || rows[i][1] != stamp + ".png") {
                add(file, frame, rows[i].front(), stamp + "," + stamp + ".png");
                continue;
            }
            const std::string picture = "mav0/" + camera + "/data/" + rows[i][1];
            const std::string same = imageFile(modality, frame);
            if (hashOf(picture).empty() || hashOf(picture) != hashOf(same)) {
                add(picture, frame, "another image", same);
            }
        }
        const Intrinsics& lens = dataset_.lens;
        const std::string sensor = "mav0/" + camera + "/sensor.yaml";
        checkNumbers(sensor, "intrinsics", {lens.fx, lens.fy, lens.cx - 0.5, lens.cy - 0.5});
        checkNumbers(sensor, "resolution",
                     {static_cast<double>(lens.width), static_cast<double>(lens.height)});
        checkNumbers(sensor, "data", {1, 0, 0, right_m, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    }

    /// Compares the list of numbers after a key in a YAML file.
    void checkNumbers(const std::string& file, const std::string& key,
                      const std::vector<double>& expected) {
        const Result<std::string> text = readText(dataset_.folder / file);
        if (!text) return add(file, {}, text.error().message, "a sensor");
        const std::size_t at = text->find(key + ": [");
        const std::size_t end = text->find(']', at == std::string::npos ? 0 : at);
        if (at == std::string::npos || end == std::string::npos) {
            return add(file, {}, "no " + key, "a list of numbers");
        }
        const std::size_t begin = at + key.size() + 3;
        const auto fields = splitAt(std::string_view(*text).substr(begin, end - begin), ',');
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const auto words =
                i < fields.size() ? splitWords(fields[i]) : std::vector<std::string_view>{};
            const auto number = parseNumber(words.size() == 1 ? words[0] : "none", file, 1);
            if (number && std::abs(*number - expected[i]) <= kEurocLens_px) continue;
            return add(file, {}, fmt::format("{}, number {}", key, i + 1),
                       fmt::format("{:.9g}", expected[i]));
        }
    }

    void checkPoses() {
        const std::string file = "mav0/state_groundtruth_estimate0/data.csv";
        const auto rows = rowsOf(file);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto frame = static_cast<int>(i);
            if (rows[i].size() != 17 || rows[i][0] != stampOf(i)) {
                add(file, frame, fmt::format("{} fields at {}", rows[i].size(), rows[i].front()),
                    "17 at " + stampOf(i));
                continue;
            }
            std::vector<double> values;
            for (std::size_t k = 1; k < rows[i].size(); ++k) {
                values.push_back(parseNumber(rows[i][k], file, frame + 2).value_or(NAN));
            }
            const Pose& pose = dataset_.frames[i].pose;
            const Eigen::Vector3d position(values[0], values[1], values[2]);
            const Eigen::Quaterniond rotation(values[3], values[4], values[5], values[6]);
            const double turned = (rotation.coeffs() - pose.rotation.coeffs()).norm();
            const double turned_back = (rotation.coeffs() + pose.rotation.coeffs()).norm();
            if (!((position - pose.position).norm() <= kPose) ||
                !(std::min(turned, turned_back) <= kPose)) {
                add(file, frame, "another pose",
                    "that of dataset.json, as x, y, z, qw, qx, qy, qz");
            }
        }
    }

    /// Compares with imu.csv, which another check verifies.
    void checkImu() {
        const std::string file = "mav0/imu0/data.csv";
        if (!dataset_.sha256s.contains("imu.csv") || hashOf(file) == hashOf("imu.csv")) return;
        add(file, {}, "other measurements", "those of imu.csv");
    }

    const StoredDataset& dataset_;
    Findings& findings_;
};

}  // namespace

CheckWork beginEuroc(const Subject& subject, Findings& findings) {
    EurocCheck(subject.dataset, findings).run();
    return {};
}

}  // namespace dollytrack::verify
