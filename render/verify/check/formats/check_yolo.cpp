#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/filled_mask.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <tuple>

namespace dollytrack::verify {
namespace {

/// Shares of the image are written with six decimals.
constexpr double kShareTolerance = 1e-6;

/// A line: class, then alternating shares of the image's width and height.
struct Line {
    int number = 0;
    std::vector<double> shares;
};

Result<std::vector<Line>> readLines(const std::filesystem::path& path) {
    Result<std::string> text = readText(path);
    if (!text) return tl::unexpected(text.error());
    std::vector<Line> lines;
    std::istringstream rows(*text);
    rows.imbue(std::locale::classic());
    for (std::string row; std::getline(rows, row);) {
        std::istringstream fields(row);
        fields.imbue(std::locale::classic());
        Line line;
        if (!(fields >> line.number)) {
            return fail(ErrorCode::BadInput, fmt::format("line {} has no class", lines.size() + 1));
        }
        for (double share = 0.0; fields >> share;) line.shares.push_back(share);
        if (!fields.eof()) {
            return fail(ErrorCode::BadInput,
                        fmt::format("line {} has a word that is not a number", lines.size() + 1));
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

/// The expected content of a visible target's line.
struct Expected {
    int object_id = 0;
    int number = 0;
    std::array<double, 4> box = {};  // x, y, width, height, px
};

std::vector<Expected> expectedLines(const StoredDataset& dataset, FrameImages& images) {
    std::vector<Expected> expected;
    for (const auto& [id, shown] : images.seen()) {
        const StoredObject* object = dataset.object(id);
        if (!object || object->role != "target") continue;
        const DatasetClass* of = dataset.boxClass(*object);
        if (of == nullptr) continue;
        expected.push_back({id, dataset.classes().indexOf(*of), shown.box()});
    }
    return expected;
}

/// Checks the class names, one per line in order, after the line `after` if given.
void checkNames(const StoredDataset& dataset, const char* file, std::string_view after,
                Findings& findings) {
    const Result<std::string> text = readText(dataset.folder / file);
    if (!text) {
        findings.add({file, {}, {}, text.error().message, "the classes' names"});
        return;
    }
    const std::vector<std::string_view> lines = splitLines(*text);
    std::size_t at = 0;
    if (!after.empty()) {
        const auto found = std::ranges::find(lines, after);
        at = static_cast<std::size_t>(std::min(found - lines.begin() + 1, std::ssize(lines)));
    }
    const ClassTable& classes = dataset.classes();
    for (const DatasetClass& one : classes.classes()) {
        const std::string before = after.empty() ? "" : fmt::format("  {}: ", classes.indexOf(one));
        const std::string found = at < lines.size() ? std::string(lines[at]) : "no line";
        ++at;
        // YAML may have quoted names, as in JSON.
        const std::string expected = before + one.name;
        const bool quoted = !after.empty() && found == before + nlohmann::json(one.name).dump();
        if (found == expected || quoted) continue;
        findings.add({fmt::format("{}:{}", file, at), {}, {}, found, expected});
        return;
    }
}

/// Frames of an image list, resolved as Ultralytics' reader does: "./" is the list's folder, and
/// labels are found by replacing `images` by `labels`.
std::set<int> framesOfList(const StoredDataset& dataset, const std::string& list,
                           Findings& findings) {
    constexpr std::string_view kStart = "./images/";
    std::set<int> frames;
    const Result<std::string> text = readText(dataset.folder / list);
    if (!text) {
        findings.add({list, {}, {}, text.error().message, "a list of images"});
        return frames;
    }
    int number = 0;
    for (const std::string_view line : splitLines(*text)) {
        ++number;
        if (line.empty()) continue;
        const std::string name(line.substr(std::min(kStart.size(), line.size())));
        const int frame = std::atoi(name.c_str());
        const std::string expected = fmt::format("{:06}.png", frame);
        const auto hashOf = [&](const std::string& file) {
            const auto at = dataset.sha256s.find(file);
            return at == dataset.sha256s.end() ? std::string() : at->second;
        };
        const std::string hash = hashOf("images/" + expected);
        const bool there = line.starts_with(kStart) && name == expected && !hash.empty() &&
                           hash == hashOf("rgb/" + expected) &&
                           dataset.sha256s.contains(fmt::format("labels/{:06}.txt", frame));
        if (!there || !frames.insert(frame).second) {
            findings.add({fmt::format("{}:{}", list, number),
                          {},
                          {},
                          std::string(line),
                          "images of the dataset that have labels, each once"});
        }
    }
    if (frames.empty()) findings.add({list, {}, {}, "no images", "at least one"});
    return frames;
}

/// Checks the paths in data.yaml and that no frame is both trained on and held back.
void checkSplit(const StoredDataset& dataset, Findings& findings) {
    const Result<std::string> text = readText(dataset.folder / "data.yaml");
    if (!text) return;  // already reported
    const auto lines = splitLines(*text);
    for (const std::string_view line : {"train: train.txt", "val: val.txt"}) {
        if (std::ranges::find(lines, line) != lines.end()) continue;
        findings.add({"data.yaml", {}, {}, "no such line", std::string(line)});
    }
    const std::set<int> train = framesOfList(dataset, "train.txt", findings);
    const std::set<int> val = framesOfList(dataset, "val.txt", findings);
    if (dataset.frames.size() < 2) return;
    for (const int frame : val) {
        if (!train.contains(frame)) continue;
        findings.add({"val.txt", frame, {}, "an image that is also a training image", "another"});
    }
}

class YoloFrameCheck {
  public:
    YoloFrameCheck(const StoredDataset& dataset, FrameImages& images, Findings& findings)
        : dataset_(dataset),
          images_(images),
          frame_(images.frame()),
          findings_(findings),
          ids_(images.image16("instance")) {}

    void run() {
        if (!ids_) return;
        const std::vector<Expected> expected = expectedLines(dataset_, images_);
        const auto boxes = linesOf("labels", expected.size());
        const auto outlines = linesOf("labels_seg", expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (boxes.size() == expected.size()) compareBox(boxes[i], expected[i]);
            if (outlines.size() == expected.size()) compareOutline(outlines[i], expected[i]);
        }
    }

  private:
    [[nodiscard]] std::string file(const char* folder) const {
        return fmt::format("{}/{:06}.txt", folder, frame_);
    }
    void add(const char* folder, const Expected& of, std::string found, std::string expected) {
        findings_.add({file(folder), frame_,
                       std::array{static_cast<int>(of.box[0]), static_cast<int>(of.box[1])},
                       fmt::format("object {}: {}", of.object_id, found), std::move(expected)});
    }

    /// Reads the lines; adds a finding if their number differs from that of visible targets.
    std::vector<Line> linesOf(const char* folder, std::size_t count) {
        Result<std::vector<Line>> lines = readLines(dataset_.folder / file(folder));
        if (!lines) {
            findings_.add({file(folder), frame_, {}, lines.error().message, "labels"});
            return {};
        }
        if (lines->size() != count) {
            findings_.add({file(folder),
                           frame_,
                           {},
                           fmt::format("{} lines", lines->size()),
                           fmt::format("{}, one per visible target", count)});
        }
        return std::move(*lines);
    }

    void compareBox(const Line& line, const Expected& of) {
        if (line.number != of.number) {
            add("labels", of, fmt::format("class {}", line.number), fmt::format("{}", of.number));
        }
        if (line.shares.size() != 4) {
            return add("labels", of, fmt::format("{} numbers", line.shares.size()), "4");
        }
        const double width = ids_->width;
        const double height = ids_->height;
        const std::array<double, 4> shares = {(of.box[0] + 0.5 * of.box[2]) / width,
                                              (of.box[1] + 0.5 * of.box[3]) / height,
                                              of.box[2] / width, of.box[3] / height};
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(line.shares[i] - shares[i]) <= kShareTolerance) continue;
            return add("labels", of, fmt::format("{:.6f}", line.shares[i]),
                       fmt::format("{:.6f}", shares[i]));
        }
    }

    /// The outline must surround a whole visible part of the object, a largest one, with its holes.
    void compareOutline(const Line& line, const Expected& of) {
        const char* folder = "labels_seg";
        if (line.number != of.number) {
            add(folder, of, fmt::format("class {}", line.number), fmt::format("{}", of.number));
        }
        if (line.shares.size() < 6 || line.shares.size() % 2 != 0) {
            return add(folder, of, fmt::format("{} numbers", line.shares.size()),
                       "pairs, three or more");
        }
        std::vector<double> corners;
        for (std::size_t i = 0; i < line.shares.size(); ++i) {
            const double size = i % 2 == 0 ? ids_->width : ids_->height;
            const double place = line.shares[i] * size;
            if (std::abs(place - std::round(place)) > kShareTolerance * size) {
                return add(folder, of, fmt::format("a corner at {:.3f} px", place),
                           "one of a pixel");
            }
            corners.push_back(std::round(place));
        }
        std::vector<std::uint8_t> outlined(ids_->values.size());
        fillPolygon(corners, ids_->width, ids_->height, outlined);
        const std::string wrong =
            partProblem(outlined, shownBy(*ids_, of.object_id), ids_->width, ids_->height);
        if (!wrong.empty()) add(folder, of, wrong, "an outline of its largest visible part");
    }

    const StoredDataset& dataset_;
    FrameImages& images_;
    int frame_;
    Findings& findings_;
    const Image16* ids_;
};

}  // namespace

CheckWork beginYolo(const Subject& subject, Findings& findings) {
    checkNames(subject.dataset, "classes.txt", "", findings);
    checkNames(subject.dataset, "data.yaml", "names:", findings);
    checkSplit(subject.dataset, findings);
    CheckWork work;
    work.frame = [&dataset = subject.dataset](FrameImages& images, Findings& found) {
        YoloFrameCheck(dataset, images, found).run();
    };
    return work;
}

}  // namespace dollytrack::verify
