#include "render/verify/compare/label_alignment_check.h"

#include "engine/jobs/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dollytrack::verify {
namespace {

constexpr double kWellExplained = 0.8;     // rank above which no other frame is tried
constexpr double kExplainsNothing = 0.65;  // rank below which the image may belong to another
                                           // scene
constexpr double kLeastStructure = 0.02;   // least structure of an image with content
constexpr double kMostStructure = 0.7;     // more is noise of few samples per pixel, which hides
                                           // edges
constexpr double kMoreLikeOthers = 0.1;    // share of frames whose labels fit the colours better
constexpr double kManyAlike = 0.25;        // share of frames above which unexplained images are
                                           // no exception
constexpr double kClearContrast = 16.0;    // of 255, between the mean colours of two objects
constexpr std::size_t kLikeliest = 6;      // frames whose labels are tried, besides the neighbours
constexpr int kNeighbours = 2;
constexpr std::size_t kMostTried = 500;  // images, those with the worst fit

}  // namespace

LabelAlignmentCheck::LabelAlignmentCheck(std::size_t frames, bool objects_only)
    : measurements_(frames), objects_only_(objects_only) {}

void LabelAlignmentCheck::addFrame(std::size_t frame, const Image8& picture, const Image16& ids) {
    auto measurement =
        std::make_unique<FrameMeasurement>(FrameMeasurement{SmallFrame(picture, ids)});
    const Outlines outlines = outlinesOf(ids, objects_only_);
    measurement->has_outlines = outlines.count() >= kFewestPlaces;
    if (measurement->has_outlines) {
        const GradientMap gradients(picture);
        measurement->blank = gradients.blank();
        measurement->structure = gradients.structure();
        measurement->fit = alignmentOf(gradients, outlines);
    }
    measurements_[frame] = std::move(measurement);
}

void LabelAlignmentCheck::report(const Files& files, Findings& findings) {
    std::vector<std::string> wrong(measurements_.size());
    std::vector<std::size_t> doubtful;
    std::size_t compared = 0, unexplained = 0;
    for (std::size_t i = 0; i < measurements_.size(); ++i) {
        if (!measurements_[i]) continue;
        colours_.add(measurements_[i]->small);
        if (!measurements_[i]->has_outlines) continue;
        ++compared;
        unexplained += isUnexplained(*measurements_[i]) ? 1 : 0;
        if (measurements_[i]->blank) {
            wrong[i] = kBlank;
        } else if (!measurements_[i]->fit.elsewhere.empty()) {
            wrong[i] = textOf(measurements_[i]->fit);
        } else if (measurements_[i]->fit.own.rank < kWellExplained) {
            doubtful.push_back(i);
        }
    }
    // At least two, so that one low-contrast frame of three is no majority.
    const bool many = unexplained >= 2 && static_cast<double>(unexplained) >=
                                              kManyAlike * static_cast<double>(compared);
    std::ranges::stable_sort(doubtful, {},
                             [&](std::size_t i) { return measurements_[i]->fit.own.rank; });
    doubtful.resize(std::min(doubtful.size(), kMostTried));
    parallelFor(doubtful.size(),
                [&](std::size_t i) { wrong[doubtful[i]] = problemOf(doubtful[i], many, files); });
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        if (wrong[i].empty()) continue;
        const int frame = static_cast<int>(i);
        findings.add({files.picture_name(frame),
                      frame,
                      {},
                      wrong[i],
                      "edges at the object borders of this frame"});
    }
}

bool LabelAlignmentCheck::isUnexplained(const FrameMeasurement& measurement) {
    return !measurement.blank && measurement.fit.best < kExplainsNothing &&
           measurement.structure >= kLeastStructure && measurement.structure <= kMostStructure;
}

LabelAlignmentCheck::RankedFrames LabelAlignmentCheck::rankedFor(std::size_t frame) const {
    const SmallFrame& picture = measurements_[frame]->small;
    const double own = colours_.distance(picture, picture);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < measurements_.size(); ++i) {
        if (i == frame || !measurements_[i]) continue;
        const double distance = colours_.distance(picture, measurements_[i]->small);
        if (distance >= 0.0) order.emplace_back(distance, i);
    }
    std::sort(order.begin(), order.end());
    RankedFrames ranked;
    std::size_t better = 0;
    for (const auto& [distance, i] : order) {
        ranked.others.push_back(i);
        better += own >= 0.0 && distance < own ? 1 : 0;
    }
    if (!order.empty()) {
        ranked.better = static_cast<double>(better) / static_cast<double>(order.size());
    }
    return ranked;
}

/// Problem of an image that its own labels explain badly; empty if none.
std::string LabelAlignmentCheck::problemOf(std::size_t frame, bool many_unexplained,
                                           const Files& files) const {
    const FrameMeasurement& measurement = *measurements_[frame];
    const RankedFrames ranked = rankedFor(frame);
    std::vector<std::size_t> tried;
    for (int aside = -kNeighbours; aside <= kNeighbours; ++aside) {
        const int other = static_cast<int>(frame) + aside;
        if (aside != 0 && other >= 0 && other < static_cast<int>(measurements_.size())) {
            tried.push_back(static_cast<std::size_t>(other));
        }
    }
    for (std::size_t i = 0; i < std::min(kLikeliest, ranked.others.size()); ++i) {
        tried.push_back(ranked.others[i]);
    }
    if (std::string found = explainedByOther(frame, tried, files); !found.empty()) return found;
    if (!isUnexplained(measurement)) return {};
    // If many images are wrong, the colours of other frames prove nothing.
    const bool wrong =
        many_unexplained || (ranked.better >= kMoreLikeOthers && lacksExpectedEdges(frame, files));
    return wrong ? textOf(measurement.fit.own) : std::string();
}

bool LabelAlignmentCheck::lacksExpectedEdges(std::size_t frame, const Files& files) const {
    const Image8 picture = files.picture(static_cast<int>(frame));
    const Image16 ids = files.ids(static_cast<int>(frame));
    if (picture.values.empty() || ids.width != picture.width || ids.height != picture.height) {
        return false;
    }
    const auto colours = colours_.meansElsewhere(measurements_[frame]->small);
    const Outlines outlines = outlinesOf(ids, [&](int a, int b) {
        if (objects_only_ && (a == 0 || b == 0)) return false;
        const auto one = colours.find(static_cast<std::uint16_t>(a));
        const auto other = colours.find(static_cast<std::uint16_t>(b));
        if (one == colours.end() || other == colours.end()) return false;
        double most = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            most = std::max(most, std::abs(one->second[c] - other->second[c]));
        }
        return most >= kClearContrast;
    });
    return outlines.count() >= kFewestPlaces / 2 &&
           GradientMap(picture).fit(outlines).rank < kExplainsNothing;
}

std::string LabelAlignmentCheck::explainedByOther(std::size_t frame,
                                                  const std::vector<std::size_t>& others,
                                                  const Files& files) const {
    const Image8 picture = files.picture(static_cast<int>(frame));
    if (picture.values.empty()) return {};
    const GradientMap gradients(picture);
    const Fit& own = measurements_[frame]->fit.own;
    Fit best = own;
    std::optional<std::size_t> best_frame;
    for (const std::size_t other : others) {
        const Image16 ids = files.ids(static_cast<int>(other));
        if (ids.width != picture.width || ids.height != picture.height) continue;
        const Fit fit = gradients.fit(outlinesOf(ids, objects_only_));
        if (fit.rank <= best.rank || !explainsBetter(fit, own)) continue;
        best = fit;
        best_frame = other;
    }
    if (!best_frame) return {};
    return fmt::format(
        "at object borders of its instance image, colours change more than in {:.0f} % of the "
        "image; with the instance image of frame {}, in {:.0f} %",
        100.0 * own.rank, *best_frame, 100.0 * best.rank);
}

}  // namespace dollytrack::verify
