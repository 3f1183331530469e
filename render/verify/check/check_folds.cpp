// Checks the lists for cross-validation.
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/number_lines.h"
#include "engine/io/files/text_file.h"
#include "render/verify/check/check_list.h"
#include "render/verify/compare/coco_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <set>

namespace dollytrack::verify {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Limits within which frames beside a held-back frame are left out.
struct Guard {
    double seconds = 0.0, metres = 0.0, turned_rad = 0.0;
};

class FoldCheck {
  public:
    FoldCheck(const StoredDataset& dataset, Findings& findings)
        : dataset_(dataset), findings_(findings) {}

    void run(const OrderedJson& convention) {
        const int count = convention.at("count").get<int>();
        const bool by_room = convention.at("split_by").get<std::string>() == "room";
        Guard guard;
        if (!by_room) {
            const OrderedJson& left_out = convention.at("left_out");
            guard = {left_out.at("closer_s").get<double>(), left_out.at("closer_m").get<double>(),
                     left_out.at("turned_less_deg").get<double>() * std::numbers::pi / 180.0};
        }
        std::vector<int> held_back(dataset_.frames.size());
        for (int fold = 0; fold < count; ++fold) {
            const std::string name = fmt::format("folds/fold_{}_", fold);
            const std::vector<int> train = listed(name + "train.txt");
            const std::vector<int> val = listed(name + "val.txt");
            for (const int frame : val) ++held_back[frame];
            compareParts(name + "train.txt", train, val, by_room ? nullptr : &guard);
            if (!dataset_.has("coco")) continue;
            compareCoco(name + "train.json", train);
            compareCoco(name + "val.json", val);
        }
        for (std::size_t i = 0; i < held_back.size(); ++i) {
            if (held_back[i] == 1) continue;
            add("folds", static_cast<int>(i), fmt::format("validated {} times", held_back[i]),
                "in one fold");
        }
    }

  private:
    void add(std::string file, std::optional<int> frame, std::string found, std::string expected) {
        findings_.add({std::move(file), frame, {}, std::move(found), std::move(expected)});
    }

    /// Frames in an image list, increasing.
    std::vector<int> listed(const std::string& file) {
        const Result<std::string> text = readText(dataset_.folder / file);
        if (!text) {
            add(file, {}, text.error().message, "a list of images");
            return {};
        }
        std::set<int> frames;
        int number = 0;
        for (const std::string_view line : splitLines(*text)) {
            ++number;
            if (line.empty()) continue;
            const std::optional<int> frame = frameOf(line);
            if (!frame || !frames.insert(*frame).second) {
                add(fmt::format("{}:{}", file, number), {}, std::string(line),
                    "images of the dataset, each once");
            }
        }
        return {frames.begin(), frames.end()};
    }

    [[nodiscard]] std::optional<int> frameOf(std::string_view picture) const {
        if (!dataset_.sha256s.contains(std::string(picture))) return std::nullopt;
        // Images are named by frame number.
        const std::string_view name = picture.substr(picture.find_last_of('/') + 1);
        int frame = 0;
        const auto read = std::from_chars(name.data(), name.data() + name.size(), frame);
        const bool fits = read.ec == std::errc{} && *read.ptr == '.' && frame >= 0 &&
                          frame < static_cast<int>(dataset_.frames.size());
        return fits ? std::optional(frame) : std::nullopt;
    }

    /// Every frame must be held back, be near a held-back frame, or be trained on. `guard` is null
    /// if whole rooms are held back, which leaves no frame out.
    void compareParts(const std::string& file, const std::vector<int>& train,
                      const std::vector<int>& val, const Guard* guard) {
        const std::set<int> trained(train.begin(), train.end());
        const std::set<int> held_back(val.begin(), val.end());
        for (int frame = 0; frame < static_cast<int>(dataset_.frames.size()); ++frame) {
            const bool is_trained = trained.contains(frame);
            if (held_back.contains(frame)) {
                if (is_trained)
                    add(file, frame, "used for training and validation", "one of the two");
                continue;
            }
            if (!guard) {
                if (!is_trained) add(file, frame, "in neither list", "in one of the two");
                continue;
            }
            switch (nearest(frame, val, *guard)) {
                case Nearness::Neighbour:
                    if (is_trained) {
                        add(file, frame, "almost the same as a validation frame",
                            "in neither list");
                    }
                    break;
                case Nearness::Apart:
                    if (!is_trained) {
                        add(file, frame, "in neither list",
                            "in the training list, because no validation frame is near");
                    }
                    break;
                case Nearness::Unknown:
                    break;
            }
        }
    }

    enum class Nearness { Neighbour, Apart, Unknown };

    /// Time counts only within one path, which dataset.json does not record: frames that are near
    /// only in time cannot be judged.
    [[nodiscard]] Nearness nearest(int frame, const std::vector<int>& others,
                                   const Guard& guard) const {
        constexpr double kSlack = 1e-9;
        const StoredFrame& a = dataset_.frames[frame];
        Nearness found = Nearness::Apart;
        for (const int other : others) {
            const StoredFrame& b = dataset_.frames[other];
            const double metres = (a.pose.position - b.pose.position).norm();
            const double seconds = std::abs(a.time_s - b.time_s);
            if (metres > guard.metres + kSlack && seconds > guard.seconds + kSlack) continue;
            const double turned = a.pose.rotation.angularDistance(b.pose.rotation);
            if (metres < guard.metres - kSlack && turned < guard.turned_rad - kSlack) {
                return Nearness::Neighbour;
            }
            const bool maybe = metres < guard.metres + kSlack && turned < guard.turned_rad + kSlack;
            if (maybe || seconds < guard.seconds + kSlack) found = Nearness::Unknown;
        }
        return found;
    }

    /// Compares with annotations.json, ignoring annotation ids.
    void compareCoco(const std::string& file, const std::vector<int>& frames) {
        const auto part = readCoco(dataset_, file, frames, findings_);
        if (!part || !whole()) return;
        for (const int frame : frames) {
            const auto& found = (*part)[frame];
            const auto& expected = (*whole())[frame];
            const bool same =
                std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                           [](const CocoAnnotation& a, const CocoAnnotation& b) {
                               return a.object_id == b.object_id && a.area == b.area &&
                                      a.box == b.box && a.segmentation == b.segmentation;
                           });
            if (!same) add(file, frame, "other annotations", "those of annotations.json");
        }
    }

    const CocoByFrame* whole() {
        if (!whole_read_) {
            whole_read_ = true;
            std::vector<int> all;
            while (all.size() < dataset_.frames.size()) all.push_back(static_cast<int>(all.size()));
            Findings of_another_check;
            whole_ = readCoco(dataset_, "annotations.json", all, of_another_check);
        }
        return whole_ ? &*whole_ : nullptr;
    }

    const StoredDataset& dataset_;
    Findings& findings_;
    std::optional<CocoByFrame> whole_;
    bool whole_read_ = false;
};

}  // namespace

CheckWork beginFolds(const Subject& subject, Findings& findings) {
    try {
        FoldCheck(subject.dataset, findings).run(subject.dataset.card.at("folds"));
    } catch (const OrderedJson::exception& error) {
        findings.add({"dataset.json", {}, {}, plainReason(error), "folds"});
    }
    return {};
}

}  // namespace dollytrack::verify
