#include "engine/io/files/bounded_json.h"
#include "engine/plan/capture.h"
#include "render/verify/check/check_list.h"
#include "render/verify/read/object_pixels.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>

namespace dollytrack::verify {
namespace {

/// An object's best frame in dataset.json.
struct Best {
    int object_id = 0;
    bool captured = false;
    double visible_fraction = 0.0;
    double box_share = 0.0;
    double mask_share = 0.0;
};

/// All best frames in dataset.json.
struct Captures {
    std::vector<std::vector<Best>> of_frame;
    std::set<int> shown_nowhere;  // object ids
};

/// Least number of pixels that counts in an image of this area; the rule is for 640 x 480.
double leastPixels(double area_px) {
    return CaptureRules{}.min_visible_px * area_px / (640.0 * 480.0);
}

Captures readCaptures(const StoredDataset& dataset, Findings& findings) {
    Captures captures;
    auto& by_frame = captures.of_frame;
    by_frame.resize(dataset.frames.size());
    std::set<int> listed;
    const auto add = [&](std::string found, std::string expected) {
        findings.add(
            {"dataset.json", {}, {}, "metrics.counted: " + std::move(found), std::move(expected)});
    };
    const auto& counted = dataset.card.at("metrics").at("counted");
    int captured = 0;
    int rows = 0;
    for (const auto& one : counted.at("per_object")) {
        const Best best{one.at("object_id").get<int>(), one.at("captured").get<bool>(),
                        one.at("visible_fraction").get<double>(), one.at("box_share").get<double>(),
                        one.at("mask_share").get<double>()};
        const int frame = one.at("best_frame").get<int>();
        ++rows;
        if (!listed.insert(best.object_id).second) {
            add(fmt::format("object {} twice", best.object_id), "each target once");
        }
        captured += best.captured ? 1 : 0;
        if (dataset.unusable_frames.contains(frame)) {
            add(fmt::format("best_frame {} of object {}", frame, best.object_id),
                "a frame whose image is usable");
        }
        if (frame >= static_cast<int>(by_frame.size())) {
            add(fmt::format("best_frame {}", frame), fmt::format("below {}", by_frame.size()));
        } else if (frame >= 0) {
            by_frame[frame].push_back(best);
        } else if (best.captured) {
            add(fmt::format("object {} captured in no frame", best.object_id), "a best_frame");
        } else {
            captures.shown_nowhere.insert(best.object_id);
        }
    }
    for (const StoredObject& object : dataset.objects) {
        if ((object.role == "target") != listed.contains(object.id)) {
            add(fmt::format("object {} is{} there", object.id,
                            listed.contains(object.id) ? "" : " not"),
                "all targets, and no others");
        }
    }
    if (counted.at("captured").get<int>() != captured) {
        add(fmt::format("captured {}", counted.at("captured").get<int>()),
            fmt::format("{}, according to the objects", captured));
    }
    if (counted.at("objects").get<int>() != rows) {
        add(fmt::format("objects {}", counted.at("objects").get<int>()), fmt::format("{}", rows));
    }
    return captures;
}

void compare(const Best& best, const ObjectPixels& shown, const Image16& ids, int frame,
             Findings& findings) {
    const double area = static_cast<double>(ids.width) * ids.height;
    const auto box = shown.box();
    const auto share = [&](const char* what, double found, double expected) {
        if (std::abs(found - expected) <= 1e-9) return;
        findings.add({"dataset.json",
                      frame,
                      {},
                      fmt::format("{} {:.6g} of object {}", what, found, best.object_id),
                      fmt::format("{:.6g}", expected)});
    };
    share("mask_share", best.mask_share, shown.count / area);
    share("box_share", best.box_share, shown.count > 0 ? box[2] * box[3] / area : 0.0);
    const CaptureRules rules;
    const bool captured =
        best.visible_fraction >= rules.min_visible_fraction && shown.count >= leastPixels(area);
    if (captured != best.captured) {
        findings.add({"dataset.json",
                      frame,
                      {},
                      fmt::format("object {} captured: {}", best.object_id, best.captured),
                      fmt::format("{}, by its visible part and its pixels", captured)});
    }
}

}  // namespace

CheckWork beginCaptures(const Subject& subject, Findings& findings) {
    auto captures = std::make_shared<Captures>();
    try {
        *captures = readCaptures(subject.dataset, findings);
    } catch (const nlohmann::json::exception& error) {
        findings.add({"dataset.json", {}, {}, plainReason(error), "metrics.counted"});
        return {};
    }
    CheckWork work;
    work.frame = [captures, &dataset = subject.dataset](FrameImages& images, Findings& found) {
        const auto& best = captures->of_frame[images.frame()];
        const Image16* ids = images.image16("instance");
        if (!ids || dataset.unusable_frames.contains(images.frame())) return;
        const double least_px = leastPixels(static_cast<double>(ids->width) * ids->height);
        for (const auto& [id, shown] : images.seen()) {
            if (shown.count < least_px || !captures->shown_nowhere.contains(id)) continue;
            found.add({"dataset.json", images.frame(), std::array{shown.x0, shown.y0},
                       fmt::format("object {} has no best_frame", id),
                       fmt::format("one: {} px show it here", shown.count)});
        }
        const auto& seen = images.seen();
        for (const Best& one : best) {
            const auto at = seen.find(one.object_id);
            compare(one, at == seen.end() ? ObjectPixels{} : at->second, *ids, images.frame(),
                    found);
        }
    };
    return work;
}

}  // namespace dollytrack::verify
