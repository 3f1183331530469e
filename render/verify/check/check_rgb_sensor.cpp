// Checks the description of sensor images, and that they show their frames.
#include "render/verify/check/check_list.h"
#include "render/verify/read/sensor_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int kCells = 24;           // of the reduced image, across and down
constexpr double kFlat = 4.0;        // of 255: an image with less deviation has nothing to compare
constexpr double kLeastAlike = 0.5;  // least correlation with its own frame, despite noise and blur
constexpr double kMoreAlike = 0.05;  // another frame's correlation must not be larger by this

/// A reduced image: brightness sum and pixel count of each cell.
struct Small {
    std::array<double, kCells* kCells> sum = {};
    std::array<double, kCells* kCells> count = {};

    void add(double x_share, double y_share, const std::uint8_t* color) {
        const auto cell = [](double share) {
            return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1);
        };
        const auto at = static_cast<std::size_t>(cell(y_share) * kCells + cell(x_share));
        sum[at] += (color[0] + color[1] + color[2]) / 3.0;
        count[at] += 1.0;
    }
};

/// Correlation over cells present in both, and the smaller standard deviation.
struct Likeness {
    double correlation = 0.0;
    double deviation = 0.0;
};

Likeness likeness(const Small& a, const Small& b) {
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (std::size_t i = 0; i < a.sum.size(); ++i) {
        if (a.count[i] == 0.0 || b.count[i] == 0.0) continue;
        const double u = a.sum[i] / a.count[i], v = b.sum[i] / b.count[i];
        n += 1, sa += u, sb += v, saa += u * u, sbb += v * v, sab += u * v;
    }
    if (n < 0.25 * kCells * kCells) return {};
    const double va = saa / n - sa * sa / n / n, vb = sbb / n - sb * sb / n / n;
    const double deviation = std::sqrt(std::max(0.0, std::min(va, vb)));
    if (deviation < 1e-6) return {0.0, deviation};
    return {(sab / n - sa * sb / n / n) / std::sqrt(va * vb), deviation};
}

Small smallOf(const Image8& picture) {
    Small small;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            small.add((x + 0.5) / picture.width, (y + 0.5) / picture.height, picture.pixel(x, y));
        }
    }
    return small;
}

/// Undistorts and reduces the sensor image.
Small straightened(const Image8& picture, const Intrinsics& lens, const StoredDistortion& lines) {
    Small small;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const Eigen::Vector2d at = lines.inSensor(lens, x + 0.5, y + 0.5);
            const int from_x = static_cast<int>(std::floor(at.x()));
            const int from_y = static_cast<int>(std::floor(at.y()));
            if (!picture.holds(from_x, from_y)) continue;
            small.add((x + 0.5) / picture.width, (y + 0.5) / picture.height,
                      picture.pixel(from_x, from_y));
        }
    }
    return small;
}

/// The row exposure is the shutter time, but with a rolling shutter at least readout / looks.
void checkRowExposure(const OrderedJson& exposure, int height, Findings& findings) {
    const auto number = [&](const char* key) {
        return exposure.is_object() && exposure.contains(key) && exposure[key].is_number()
                   ? exposure[key].get<double>()
                   : -1.0;
    };
    const double shutter_s = number("shutter_s"), readout_s = number("readout_s");
    const double found = number("row_exposure_s");
    const bool rolls = readout_s > 0.0 && height > 1;
    const double expected = rolls ? std::max(shutter_s, readout_s / number("looks")) : shutter_s;
    if (std::abs(found - expected) <= 1e-12) return;
    findings.add({"dataset.json",
                  {},
                  {},
                  fmt::format("conventions.rgb_sensor exposure row_exposure_s is {:g}", found),
                  fmt::format("{:g} s, by shutter_s, readout_s and looks", expected)});
}

/// Each parameter is stored twice, as requested and in the description of the files.
void checkParameters(const StoredDataset& dataset, Findings& findings) {
    const OrderedJson convention = dataset.convention("rgb_sensor");
    const auto add = [&](const std::string& what, const std::string& found, std::string expected) {
        findings.add({"dataset.json", {}, {}, what + " is " + found, std::move(expected)});
    };
    if (!distortionOf(dataset)) {
        add("conventions.rgb_sensor.distortion", "missing", "k1 k2 p1 p2 k3");
        return;
    }
    checkRowExposure(convention.value("exposure", OrderedJson::object()), dataset.lens.height,
                     findings);
    const OrderedJson& parameters = dataset.card.at("parameters");
    if (!parameters.contains("sensor")) return;  // exports without a command line
    const OrderedJson& asked = parameters["sensor"];
    const std::array<std::pair<const char*, std::vector<const char*>>, 5> groups = {{
        {"distortion", {"k1", "k2", "p1", "p2", "k3"}},
        {"exposure", {"shutter_s", "readout_s", "looks"}},
        {"lens", {"aperture_mm", "focus_m", "vignetting"}},
        {"noise", {"white_e", "read_noise_e", "sensor_seed"}},
        {"", {"jpeg_quality"}},
    }};
    for (const auto& [group, keys] : groups) {
        const OrderedJson said =
            *group == '\0' ? convention : convention.value(group, OrderedJson::object());
        for (const char* const key : keys) {
            const OrderedJson found = said.value(key, OrderedJson());
            const OrderedJson expected = asked.value(key, OrderedJson());
            if (found == expected) continue;
            add(fmt::format("conventions.rgb_sensor {} {}", group, key), found.dump(),
                expected.dump() + ", as in parameters.sensor");
        }
    }
}

}  // namespace

CheckWork beginRgbSensor(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    checkParameters(dataset, findings);
    const auto lines = distortionOf(dataset);
    if (!lines || !dataset.has("rgb")) return {};
    CheckWork work;
    work.frame = [&dataset, lines = *lines](FrameImages& images, Findings& found) {
        const Image8* picture = images.image8("rgb_sensor");
        const Image8* clean = images.image8("rgb");
        if (!picture || !clean) return;
        const Small shown = straightened(*picture, dataset.lens, lines);
        const Small own = smallOf(*clean);
        const auto tell = [&](std::string what, std::string expected) {
            found.add({storedFile(dataset, *imageKind("rgb_sensor"), images.frame()),
                       images.frame(),
                       {},
                       std::move(what),
                       std::move(expected)});
        };
        const Likeness of_own = likeness(own, own);
        const Likeness with_own = likeness(shown, own);
        if (of_own.deviation < kFlat) return;
        if (with_own.correlation < kLeastAlike) {
            return tell(
                fmt::format("its correlation with the clean image is {:.2f}", with_own.correlation),
                fmt::format("{} and more", kLeastAlike));
        }
        const int count = static_cast<int>(dataset.frames.size());
        for (const int other : {images.frame() - 1, images.frame() + 1}) {
            if (other < 0 || other >= count) continue;
            const Image8* beside = images.other(other).image8("rgb");
            if (!beside) continue;
            const double alike = likeness(shown, smallOf(*beside)).correlation;
            if (alike <= with_own.correlation + kMoreAlike) continue;
            return tell(fmt::format("its correlation with frame {} ({:.2f}) is higher than with "
                                    "its own frame ({:.2f})",
                                    other, alike, with_own.correlation),
                        "an image of this frame");
        }
    };
    return work;
}

}  // namespace dollytrack::verify
