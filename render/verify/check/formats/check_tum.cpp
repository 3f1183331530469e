// Checks TUM's depth and image lists; poses are checked elsewhere.
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/motion_check.h"

#include <fmt/format.h>

#include <cmath>

namespace dollytrack::verify {
namespace {

constexpr double kStepsPerMetre = 5000.0;
constexpr double kTime_s = 1e-6;

/// An image list: each line has, for each folder, a time and an image.
struct PictureList {
    const char* file;
    std::vector<const char*> folders;
};

class ListCheck {
  public:
    ListCheck(const StoredDataset& dataset, const PictureList& list, Findings& findings)
        : dataset_(dataset), list_(list), findings_(findings) {}

    void run() {
        const Result<std::string> text = readText(dataset_.folder / list_.file);
        if (!text) return findings_.add({list_.file, {}, {}, text.error().message, "a list"});
        int number = 0;
        std::size_t frame = 0;
        for (const std::string_view line : splitLines(*text)) {
            ++number;
            const auto words = splitWords(line);
            if (words.empty() || words.front().starts_with('#')) continue;
            if (frame < dataset_.frames.size()) compare(number, static_cast<int>(frame), words);
            ++frame;
        }
        if (frame == dataset_.frames.size()) return;
        findings_.add({list_.file,
                       {},
                       {},
                       fmt::format("{} lines", frame),
                       fmt::format("{}, one a frame", dataset_.frames.size())});
    }

  private:
    void compare(int line, int frame, const std::vector<std::string_view>& words) {
        const auto wrong = [&](std::string found, std::string expected) {
            findings_.add({fmt::format("{}:{}", list_.file, line),
                           frame,
                           {},
                           std::move(found),
                           std::move(expected)});
        };
        if (words.size() != 2 * list_.folders.size()) {
            return wrong(fmt::format("{} words", words.size()),
                         fmt::format("{}", 2 * list_.folders.size()));
        }
        const double time_s = dataset_.frames[frame].time_s;
        for (std::size_t i = 0; i < list_.folders.size(); ++i) {
            const auto said = parseNumber(words[2 * i], list_.file, line);
            if (!said || !(std::abs(*said - time_s) <= kTime_s)) {
                wrong("time " + std::string(words[2 * i]), fmt::format("{:.6f} s", time_s));
            }
            const std::string picture = fmt::format("{}/{:06}.png", list_.folders[i], frame);
            const std::string name(words[2 * i + 1]);
            if (name != picture) wrong(name, picture);
            if (!dataset_.sha256s.contains(name)) wrong(name, "an image of the dataset");
        }
    }

    const StoredDataset& dataset_;
    const PictureList& list_;
    Findings& findings_;
};

void compareDepth(const StoredDataset& dataset, FrameImages& images, Findings& findings) {
    const int frame = images.frame();
    const std::string file = fmt::format("depth_tum/{:06}.png", frame);
    const Result<Image16> found = readImage16(dataset.folder / file, 1);
    if (!isUsable(found, dataset, file, frame, findings)) return;
    const FrameImages::Depth* depth = images.depth();
    if (!depth) return;
    WrongPixels wrong;
    for (int y = 0; y < found->height; ++y) {
        for (int x = 0; x < found->width; ++x) {
            const double metres = depth->metres.at(x, y);
            const int steps = found->at(x, y);
            const double expected = kStepsPerMetre * metres;
            const double allowed = 0.5 + kStepsPerMetre * depth->rounding_m + 1e-6 * expected;
            // Depth beyond the range is stored as 0.
            if (expected > 65535.5 - allowed && steps == 0) continue;
            if (metres > 0.0 ? std::abs(steps - expected) <= allowed : steps == 0) continue;
            wrong.add(x, y, [&] {
                return WrongPixels::Text{
                    fmt::format("{:.4f} m (5000 units per metre)", steps / kStepsPerMetre),
                    fmt::format("{:.4f} m, as in {}", metres, imageFile(depth->modality, frame))};
            });
        }
    }
    wrong.report(file, frame, findings);
}

}  // namespace

CheckWork beginTum(const Subject& subject, Findings& findings) {
    const StoredDataset& dataset = subject.dataset;
    ListCheck(dataset, {"depth.txt", {"depth_tum"}}, findings).run();
    if (dataset.has("rgb")) {
        ListCheck(dataset, {"rgb.txt", {"rgb"}}, findings).run();
        ListCheck(dataset, {"associations.txt", {"rgb", "depth_tum"}}, findings).run();
    }
    CheckWork work;
    work.frame = [&dataset](FrameImages& images, Findings& found) {
        compareDepth(dataset, images, found);
    };
    return work;
}

}  // namespace dollytrack::verify
