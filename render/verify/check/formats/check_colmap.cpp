// Checks COLMAP's text model except its poses: lens, names and initial points.
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/sensor_files.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace dollytrack::verify {
namespace {

constexpr const char* kCameras = "sparse/0/cameras.txt";
constexpr const char* kImages = "sparse/0/images.txt";
constexpr const char* kPoints = "sparse/0/points3D.txt";

constexpr double kColmapLens_px = 1e-6;  // the file has nine digits
constexpr double kOnSurface_m = 1e-4;    // error of single precision in the largest rooms

/// m, and share of depth: a point may lie this far in front of the surrounding pixels' surface.
constexpr double kBefore_m = 0.01;
constexpr double kBeforeShare = 0.01;

struct Point {
    Eigen::Vector3d place;
    int line = 0;
};

/// A frame's view of the points.
struct DepthComparison {
    std::size_t compared = 0;
    std::size_t before = 0;  // points in front of the surface that the frame shows
    std::string example;
};

/// Words of the non-empty, non-comment lines, with line numbers.
std::vector<std::pair<int, std::vector<std::string_view>>> wordLines(std::string_view text) {
    std::vector<std::pair<int, std::vector<std::string_view>>> lines;
    int number = 0;
    for (const std::string_view line : splitLines(text)) {
        ++number;
        auto words = splitWords(line);
        if (words.empty() || words.front().starts_with('#')) continue;
        lines.emplace_back(number, std::move(words));
    }
    return lines;
}

std::string textOf(const StoredDataset& dataset, const char* file, Findings& findings) {
    Result<std::string> text = readText(dataset.folder / file);
    if (text) return std::move(*text);
    findings.add({file, {}, {}, text.error().message, "COLMAP's text"});
    return {};
}

void checkCameras(const StoredDataset& dataset, Findings& findings) {
    const auto wrong = [&](std::string found, std::string expected) {
        findings.add({kCameras, {}, {}, std::move(found), std::move(expected)});
    };
    const std::string text = textOf(dataset, kCameras, findings);
    const auto lines = wordLines(text);
    if (lines.size() != 1) return wrong(fmt::format("{} cameras", lines.size()), "1");
    const auto& words = lines.front().second;
    const Intrinsics& lens = dataset.lens;
    const StoredDistortion bent = distortionOfPictures(dataset);
    std::vector<double> expected = {
        double(lens.width), double(lens.height), lens.fx, lens.fy, lens.cx, lens.cy};
    std::string_view model = "PINHOLE";
    if (!bent.none()) {
        model = "FULL_OPENCV";
        expected.insert(expected.end(), {bent.k1, bent.k2, bent.p1, bent.p2, bent.k3, 0, 0, 0});
    }
    if (words.size() != expected.size() + 2 || words[0] != "1" || words[1] != model) {
        return wrong("another camera", fmt::format("1 {} and {} numbers", model, expected.size()));
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto found = parseNumber(words[i + 2], kCameras, lines.front().first);
        if (!found) return wrong(found.error().message, "a number");
        if (std::abs(*found - expected[i]) <= kColmapLens_px) continue;
        wrong(fmt::format("{:.9g}", *found), fmt::format("{:.9g}", expected[i]));
    }
}

/// Each image is named after its frame, in the image folder.
void checkNames(const StoredDataset& dataset, Findings& findings) {
    const std::string text = textOf(dataset, kImages, findings);
    int frame = 0;
    // Lines of 2D points are empty.
    for (const auto& [number, words] : wordLines(text)) {
        const auto wrong = [&, line = number](std::string found, std::string expected) {
            findings.add({fmt::format("{}:{}", kImages, line),
                          frame,
                          {},
                          std::move(found),
                          std::move(expected)});
        };
        if (words.size() != 10) return wrong(fmt::format("{} words", words.size()), "10");
        const std::string name(words[9]);
        if (words[8] != "1") wrong("camera " + std::string(words[8]), "1");
        bool there = name.starts_with(fmt::format("{:06}.", frame));
        if (there) {
            there = false;
            for (const ImageKind& kind : imageKinds()) {
                there = there || dataset.sha256s.contains(std::string(kind.modality) + "/" + name);
            }
        }
        if (!there) wrong("the image " + name, fmt::format("that of frame {}", frame));
        ++frame;
    }
}

std::vector<Point> readPoints(const StoredDataset& dataset, Findings& findings) {
    std::vector<Point> points;
    const std::string text = textOf(dataset, kPoints, findings);
    for (const auto& [number, words] : wordLines(text)) {
        const auto wrong = [&, line = number](std::string found, std::string expected) {
            findings.add({fmt::format("{}:{}", kPoints, line),
                          {},
                          {},
                          std::move(found),
                          std::move(expected)});
        };
        if (words.size() != 8) {
            wrong(fmt::format("{} words", words.size()), "8, without a track");
            return {};
        }
        std::array<double, 8> values = {};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto value = parseNumber(words[i], kPoints, number);
            if (!value) {
                wrong(std::string(words[i]), "a number");
                return {};
            }
            values[i] = *value;
        }
        if (values[0] != static_cast<double>(points.size() + 1)) {
            wrong(fmt::format("point {}", values[0]), fmt::format("{}", points.size() + 1));
        }
        for (std::size_t i = 4; i < 7; ++i) {
            if (values[i] >= 0.0 && values[i] <= 255.0 && values[i] == std::floor(values[i])) {
                continue;
            }
            wrong(fmt::format("colour {}", values[i]), "0 to 255");
        }
        points.push_back({{values[1], values[2], values[3]}, number});
    }
    return points;
}

/// Image position and depth of a point in a frame.
struct Seen {
    Eigen::Vector2d at;
    double depth_m = 0.0;
};

std::optional<Seen> seenBy(const StoredDataset& dataset, const StoredFrame& frame,
                           const Eigen::Vector3d& place, double margin_px) {
    const Eigen::Vector3d in_camera = frame.pose.toCamera(place);
    if (!(in_camera.z() >= dataset.near_m - 1e-6)) return std::nullopt;
    const Eigen::Vector2d at = dataset.lens.project(in_camera);
    const bool inside = at.x() >= margin_px && at.y() >= margin_px &&
                        at.x() < dataset.lens.width - margin_px &&
                        at.y() < dataset.lens.height - margin_px;
    if (!inside) return std::nullopt;
    return Seen{at, in_camera.z()};
}

bool isInAnyFrame(const StoredDataset& dataset, const Eigen::Vector3d& place) {
    constexpr double kSlack_px = 0.01;
    for (const StoredFrame& frame : dataset.frames) {
        if (seenBy(dataset, frame, place, -kSlack_px)) return true;
    }
    return false;
}

/// Whether the point belongs to a moving object, which the model shows unmoved.
bool isOfMoving(const StoredDataset& dataset, const StoredFrame& frame,
                const Eigen::Vector3d& place) {
    for (const MovedObject& moved : frame.moving) {
        const StoredObject* object = dataset.object(moved.object_id);
        if (object && object->box.contains(place, 1e-3)) return true;
    }
    return false;
}

DepthComparison compareWithDepth(const StoredDataset& dataset, const std::vector<Point>& points,
                                 FrameImages& images) {
    DepthComparison comparison;
    const FrameImages::Depth* depth = images.depth();
    if (!depth) return comparison;
    for (const Point& point : points) {
        const auto seen = seenBy(dataset, images.stored(), point.place, 1.0);
        if (!seen || isOfMoving(dataset, images.stored(), point.place)) continue;
        const int x = static_cast<int>(seen->at.x());
        const int y = static_cast<int>(seen->at.y());
        double nearest = std::numeric_limits<double>::infinity();
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (!depth->metres.holds(x + dx, y + dy)) continue;
                const double metres = depth->metres.at(x + dx, y + dy);
                if (metres > 0.0) nearest = std::min(nearest, metres);
            }
        }
        ++comparison.compared;
        if (seen->depth_m >= nearest - kBefore_m - kBeforeShare * nearest) continue;
        if (comparison.before++ > 0) continue;
        comparison.example =
            fmt::format("{}:{} at {:.3f} m, where {} shows {:.3f} m", kPoints, point.line,
                        seen->depth_m, imageFile(depth->modality, images.frame()), nearest);
    }
    return comparison;
}

/// With the scene each point must lie on it. Without, objects thinner than a pixel may stand in
/// front of the pixels' surface, but only few points may.
void reportPoints(const std::vector<DepthComparison>& comparisons, Findings& findings) {
    for (std::size_t frame = 0; frame < comparisons.size(); ++frame) {
        const DepthComparison& one = comparisons[frame];
        if (one.before <= 5 + one.compared / 50) continue;
        findings.add({kPoints,
                      static_cast<int>(frame),
                      {},
                      fmt::format("{} of {} points are in front of the visible surfaces ({})",
                                  one.before, one.compared, one.example),
                      "points of surfaces"});
    }
}

}  // namespace

CheckWork beginColmap(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    checkCameras(dataset, findings);
    checkNames(dataset, findings);
    const auto points = std::make_shared<std::vector<Point>>(readPoints(dataset, findings));
    const auto comparisons = std::make_shared<std::vector<DepthComparison>>(dataset.frames.size());
    CheckWork work;
    if (!subject.rays) {
        work.frame = [&dataset, points, comparisons](FrameImages& images, Findings& /*findings*/) {
            (*comparisons)[images.frame()] = compareWithDepth(dataset, *points, images);
        };
    }
    work.finish = [&subject, points, comparisons](Findings& found, const JobContext&) {
        reportPoints(*comparisons, found);
        for (const Point& point : *points) {
            const auto wrong = [&](std::string what, std::string expected) {
                found.add({fmt::format("{}:{}", kPoints, point.line),
                           {},
                           {},
                           std::move(what),
                           std::move(expected)});
            };
            if (!isInAnyFrame(subject.dataset, point.place)) {
                wrong("a point that no image contains", "one in view");
            }
            if (!subject.rays) continue;
            const double off = subject.rays->closest(point.place).distance;
            if (off <= kOnSurface_m) continue;
            wrong(fmt::format("a point {:.4g} m from the nearest surface", off), "one on it");
        }
    };
    return work;
}

}  // namespace dollytrack::verify
