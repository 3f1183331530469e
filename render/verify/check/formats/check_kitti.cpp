// Checks KITTI's projections, times and flow; poses are checked elsewhere.
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/motion_check.h"
#include "render/verify/compare/stereo_pair.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr const char* kCalibration = "calib.txt";
constexpr const char* kTimes = "times.txt";
constexpr double kKittiTolerance = 1e-6;  // the file has nine digits
constexpr double kStepsPerPixel = 64.0;
constexpr double kMiddle = 32768.0;

/// A projection's twelve numbers, row by row. KITTI puts pixel centres at integer coordinates.
std::array<double, 12> projection(const Intrinsics& lens, double right_m) {
    return {lens.fx, 0, lens.cx - 0.5, -lens.fx * right_m, 0, lens.fy, lens.cy - 0.5, 0, 0, 0,
            1,       0};
}

void compareProjection(const StoredDataset& dataset, int camera, int line,
                       const std::vector<std::string_view>& words, std::optional<double> baseline,
                       Findings& findings) {
    const auto wrong = [&](std::string found, std::string expected) {
        findings.add({fmt::format("{}:{}", kCalibration, line),
                      {},
                      {},
                      std::move(found),
                      std::move(expected)});
    };
    const std::string name = fmt::format("P{}:", camera);
    if (words.size() != 13 || words.front() != name) {
        return wrong(fmt::format("{} and {} words", words.front(), words.size() - 1),
                     name + " and 12 numbers");
    }
    const bool right = camera % 2 == 1;
    const auto expected = projection(dataset.lens, right ? baseline.value_or(0.0) : 0.0);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto found = parseNumber(words[i + 1], kCalibration, line);
        if (!found) return wrong(found.error().message, "a number");
        // Without a baseline elsewhere in the dataset, only the sign can be checked.
        if (i == 3 && right && !baseline && *found < 0.0) continue;
        if (std::abs(*found - expected[i]) <= kKittiTolerance) continue;
        return wrong(
            fmt::format("{} has {:.9g} in row {}, column {}", name, *found, i / 4 + 1, i % 4 + 1),
            fmt::format("{:.9g}", expected[i]));
    }
}

void checkCalibration(const StoredDataset& dataset, Findings& findings) {
    const Result<std::string> text = readText(dataset.folder / kCalibration);
    if (!text) {
        findings.add({kCalibration, {}, {}, text.error().message, "projections"});
        return;
    }
    const std::optional<double> baseline = baselineOf(dataset);
    int line = 0;
    for (const std::string_view row : splitLines(*text)) {
        const auto words = splitWords(row);
        if (words.empty()) continue;
        if (line < 4) compareProjection(dataset, line, line + 1, words, baseline, findings);
        ++line;
    }
    if (line == 4) return;
    findings.add({kCalibration, {}, {}, fmt::format("{} projections", line), "4"});
}

void checkTimes(const StoredDataset& dataset, Findings& findings) {
    const Result<std::string> text = readText(dataset.folder / kTimes);
    if (!text) return findings.add({kTimes, {}, {}, text.error().message, "times"});
    const auto lines = readNumberLines(kTimes, *text, 1, "a time");
    if (!lines) return findings.add({kTimes, {}, {}, describe(lines.error()), "times"});
    if (lines->size() != dataset.frames.size()) {
        return findings.add({kTimes,
                             {},
                             {},
                             fmt::format("{} times", lines->size()),
                             fmt::format("{}", dataset.frames.size())});
    }
    for (std::size_t i = 0; i < lines->size(); ++i) {
        const double found = (*lines)[i].values.front();
        const double expected = dataset.frames[i].time_s;
        if (std::abs(found - expected) <= kKittiTolerance) continue;
        findings.add({fmt::format("{}:{}", kTimes, (*lines)[i].line),
                      static_cast<int>(i),
                      {},
                      fmt::format("{:.7f} s", found),
                      fmt::format("{:.7f} s", expected)});
    }
}

/// The third channel marks known flow.
ImageF motionsFrom(const Image16& image) {
    ImageF motions{image.width, image.height, 2, {}};
    motions.values.reserve(2 * image.values.size() / 3);
    for (std::size_t i = 0; i < image.values.size(); i += 3) {
        for (std::size_t c = 0; c < 2; ++c) {
            const double motion = (image.values[i + c] - kMiddle) / kStepsPerPixel;
            motions.values.push_back(image.values[i + 2] == 1 ? static_cast<float>(motion)
                                                              : 2.0F * kUnknownMotion);
        }
    }
    return motions;
}

void compareMotions(const StoredDataset& dataset, FrameImages& images, Findings& findings) {
    const int frame = images.frame();
    if (frame + 1 >= static_cast<int>(dataset.frames.size())) return;
    const std::string file = fmt::format("kitti_flow/{:06}.png", frame);
    const Result<Image16> flow = readImage16(dataset.folder / file, 3);
    const FrameImages::Depth* depth = images.depth();
    if (!isUsable(flow, dataset, file, frame, findings) || !depth) return;
    const StoredFrame& next = dataset.frames[frame + 1];
    const OtherView to{next.pose, next};
    const double half_step = 0.5 * std::sqrt(2.0) / kStepsPerPixel;
    checkMotions(motionsFrom(*flow), *depth, reprojectAll(dataset, images, *depth, to),
                 {file, frame, half_step, (65535.0 - kMiddle) / kStepsPerPixel - 0.1}, findings);
}

}  // namespace

CheckWork beginKitti(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    checkCalibration(dataset, findings);
    checkTimes(dataset, findings);
    CheckWork work;
    work.frame = [&dataset](FrameImages& images, Findings& found) {
        compareMotions(dataset, images, found);
    };
    return work;
}

}  // namespace dollytrack::verify
