// Checks KITTI's labels: 2D and 3D boxes of objects.
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "engine/scene/labels.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dollytrack::verify {
namespace {

constexpr double kKittiObjectsTolerance = 2e-6;  // the file has six digits
constexpr std::size_t kNumbers = 14;

/// A row without its type.
using Label = std::array<double, kNumbers>;
constexpr std::array<const char*, kNumbers> kNames = {
    "truncated", "occluded", "alpha",  "left", "top", "right", "bottom",
    "height",    "width",    "length", "x",    "y",   "z",     "rotation_y"};
enum Field : std::size_t { Truncated, Occluded, Alpha, Left, Height = 7, X = 10, Turned = 13 };

/// Class name without spaces, which separate fields.
std::string typeOf(const DatasetClass& of) {
    std::string name = of.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

double angleBetween(double a, double b) {
    return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

class KittiObjectsFrameCheck {
  public:
    KittiObjectsFrameCheck(const StoredDataset& dataset, FrameImages& images, Findings& findings)
        : dataset_(dataset),
          images_(images),
          findings_(findings),
          file_(fmt::format("label_2/{:06}.txt", images.frame())) {}

    void run() {
        const Image16* ids = images_.image16("instance");
        if (!ids) return;
        const Result<std::string> text = readText(dataset_.folder / file_);
        if (!text) return add(0, text.error().message, "labels");
        std::vector<std::vector<std::string_view>> rows;
        for (const std::string_view line : splitLines(*text)) {
            if (!line.empty()) rows.push_back(splitWords(line));
        }
        // Objects that are not targets may or may not be labelled.
        std::vector<const StoredObject*> things, targets;
        const auto& seen = images_.seen();
        for (const auto& [id, pixels] : seen) {
            const StoredObject* object = dataset_.object(id);
            if (!object || object->role == "structure") continue;
            if (dataset_.boxClass(*object) == nullptr) continue;
            things.push_back(object);
            if (object->role == "target") targets.push_back(object);
        }
        const auto& expected = rows.size() == things.size() ? things : targets;
        if (rows.size() != expected.size()) {
            add(0, fmt::format("{} lines", rows.size()),
                fmt::format("{}, one per visible object", expected.size()));
        }
        for (std::size_t i = 0; i < std::min(rows.size(), expected.size()); ++i) {
            compare(i + 1, rows[i], *expected[i], seen.at(expected[i]->id));
        }
    }

  private:
    void add(std::size_t line, std::string found, std::string expected) {
        findings_.add({line > 0 ? fmt::format("{}:{}", file_, line) : file_,
                       images_.frame(),
                       {},
                       std::move(found),
                       std::move(expected)});
    }

    void compare(std::size_t line, const std::vector<std::string_view>& words,
                 const StoredObject& object, const ObjectPixels& seen) {
        if (words.size() != kNumbers + 1) {
            return add(line, fmt::format("{} words", words.size()), "a type and 14 numbers");
        }
        if (const std::string type = typeOf(*dataset_.boxClass(object)); words[0] != type) {
            add(line, fmt::format("type {}", words[0]), type);
        }
        Label found{};
        for (std::size_t i = 0; i < kNumbers; ++i) {
            const auto number = parseNumber(words[i + 1], file_, static_cast<int>(line));
            if (!number) return add(line, number.error().message, kNames[i]);
            found[i] = *number;
        }
        const Label expected = labelOf(object, seen, found);
        for (std::size_t i = 0; i < kNumbers; ++i) {
            const bool angle = i == Alpha || i == Turned;
            const double off =
                angle ? angleBetween(found[i], expected[i]) : std::abs(found[i] - expected[i]);
            if (off <= kKittiObjectsTolerance) continue;
            return add(line, fmt::format("{} {:.6f}", kNames[i], found[i]),
                       fmt::format("{:.6f}, as object {} is", expected[i], object.id));
        }
    }

    /// The expected label. Truncation and occlusion need amodal masks; here they are only clamped
    /// to their ranges.
    [[nodiscard]] Label labelOf(const StoredObject& object, const ObjectPixels& seen,
                                const Label& found) const {
        Label label{};
        label[Truncated] = std::clamp(found[Truncated], 0.0, 1.0);
        label[Occluded] = std::clamp(std::round(found[Occluded]), 0.0, 2.0);
        const std::array<int, 4> bounds = {seen.x0, seen.y0, seen.x1, seen.y1};
        std::copy(bounds.begin(), bounds.end(), label.begin() + Left);
        const Eigen::Isometry3d box = cameraFromBox(object, images_.stored());
        const Eigen::Vector3d size = 2.0 * object.box.half_size;
        const Eigen::Vector3d bottom = box * Eigen::Vector3d(0, 0, -object.box.half_size.z());
        const Eigen::Vector3d along = box.linear().col(0);
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            label[Height + static_cast<std::size_t>(axis)] = size[2 - axis];
            label[X + static_cast<std::size_t>(axis)] = bottom[axis];
        }
        label[Turned] = std::atan2(-along.z(), along.x());
        label[Alpha] = label[Turned] - std::atan2(bottom.x(), bottom.z());
        return label;
    }

    const StoredDataset& dataset_;
    FrameImages& images_;
    Findings& findings_;
    std::string file_;
};

}  // namespace

CheckWork beginKittiObjects(const Subject& subject, Findings& /*findings*/) {
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& findings) {
        KittiObjectsFrameCheck(dataset, images, findings).run();
    };
    return work;
}

}  // namespace dollytrack::verify
