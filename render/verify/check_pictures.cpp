// Pictures show what the labels of their frame say. One is wrong where something else explains it
// better: the labels mirrored or moved, or those of another frame; or where its own explain nothing
// of it and the things that they name have other colours in the rest of the dataset.
#include "engine/jobs/parallel.h"
#include "render/verify/check_list.h"
#include "render/verify/object_colours.h"
#include "render/verify/picture_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

namespace dollytrack::verify {
namespace {

constexpr double kWellExplained = 0.8;     // rank: no other frame need be asked
constexpr double kExplainsNothing = 0.65;  // what is below may be a picture of something else
constexpr double kLeastStructure = 0.01;   // of a picture, to be one of something
constexpr double kMoreLikeOthers = 0.1;    // share of frames whose labels fit the colours better
constexpr double kManyAlike = 0.25;        // of the frames: no longer a few faint ones
constexpr std::size_t kLikeliest = 6;      // frames whose labels are tried, beside the neighbours
constexpr int kNeighbours = 2;
constexpr std::size_t kMostTried = 500;  // pictures; a dataset with more is wrong in any case

/// What is known of a frame once its images were read.
struct Seen {
    SmallFrame small;
    bool judged = false;  // it has outlines enough
    bool blank = false;
    double structure = 0.0;
    OwnFit fit = {};
};

class Pictures {
  public:
    explicit Pictures(const StoredDataset& dataset)
        : dataset_(dataset), seen_(dataset.frames.size()) {}

    void look(FrameImages& images) {
        const Image8* picture = images.image8("rgb");
        const Image16* ids = images.image16("instance");
        if (!picture || !ids) return;
        auto seen = std::make_unique<Seen>(Seen{SmallFrame(*picture, *ids)});
        const Outlines outlines = outlinesOf(*ids, false);
        seen->judged = outlines.count() >= kFewestPlaces;
        if (seen->judged) {
            const ChangeMap change(*picture);
            seen->blank = change.blank();
            seen->structure = change.structure();
            seen->fit = judgeByOwn(change, outlines);
        }
        seen_[static_cast<std::size_t>(images.frame())] = std::move(seen);
    }

    void judge(Findings& findings) {
        std::vector<std::string> wrong(seen_.size());
        std::vector<std::size_t> doubtful;
        std::size_t judged = 0, unexplained = 0;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (!seen_[i]) continue;
            colours_.add(seen_[i]->small);
            if (!seen_[i]->judged) continue;
            ++judged;
            unexplained += isUnexplained(*seen_[i]) ? 1 : 0;
            if (seen_[i]->blank) {
                wrong[i] = "all of it has one colour";
            } else if (!seen_[i]->fit.elsewhere.empty()) {
                wrong[i] = textOf(seen_[i]->fit);
            } else if (seen_[i]->fit.own.rank < kWellExplained) {
                doubtful.push_back(i);
            }
        }
        // Two and more of all frames, so that one faint frame of three is no majority.
        const bool many = unexplained >= 2 && static_cast<double>(unexplained) >=
                                                  kManyAlike * static_cast<double>(judged);
        doubtful.resize(std::min(doubtful.size(), kMostTried));
        parallelFor(doubtful.size(),
                    [&](std::size_t i) { wrong[doubtful[i]] = ask(doubtful[i], many); });
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            if (wrong[i].empty()) continue;
            const int frame = static_cast<int>(i);
            findings.add({imageFile("rgb", frame),
                          frame,
                          {},
                          wrong[i],
                          "edges where the objects of this frame meet"});
        }
    }

  private:
    static bool isUnexplained(const Seen& seen) {
        return !seen.blank && seen.fit.best < kExplainsNothing && seen.structure >= kLeastStructure;
    }

    /// Frames by how well their labels fit the colours of a picture, the best first.
    struct Ranked {
        std::vector<std::size_t> others;
        double better = 0.0;  // share of them that fit better than its own; 0 where none is known
    };
    [[nodiscard]] Ranked rankedFor(std::size_t frame) const {
        const SmallFrame& picture = seen_[frame]->small;
        const double own = colours_.distance(picture, picture);
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (i == frame || !seen_[i]) continue;
            const double distance = colours_.distance(picture, seen_[i]->small);
            if (distance >= 0.0) order.emplace_back(distance, i);
        }
        std::sort(order.begin(), order.end());
        Ranked ranked;
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

    /// What is wrong with a picture that its own labels explain badly; empty where nothing is.
    [[nodiscard]] std::string ask(std::size_t frame, bool many_unexplained) const {
        const Seen& seen = *seen_[frame];
        const Ranked ranked = rankedFor(frame);
        std::vector<std::size_t> tried;
        for (int aside = -kNeighbours; aside <= kNeighbours; ++aside) {
            const int other = static_cast<int>(frame) + aside;
            if (aside != 0 && other >= 0 && other < static_cast<int>(seen_.size())) {
                tried.push_back(static_cast<std::size_t>(other));
            }
        }
        for (std::size_t i = 0; i < std::min(kLikeliest, ranked.others.size()); ++i) {
            tried.push_back(ranked.others[i]);
        }
        if (std::string found = explainedByOther(frame, tried); !found.empty()) return found;
        if (!isUnexplained(seen)) return {};
        return many_unexplained || ranked.better >= kMoreLikeOthers ? textOf(seen.fit.own)
                                                                    : std::string();
    }

    [[nodiscard]] std::string explainedByOther(std::size_t frame,
                                               const std::vector<std::size_t>& others) const {
        FrameImages images(dataset_, static_cast<int>(frame));
        const Image8* picture = images.image8("rgb");
        if (!picture) return {};
        const ChangeMap change(*picture);
        const Fit& own = seen_[frame]->fit.own;
        Fit best = own;
        std::optional<std::size_t> best_frame;
        for (const std::size_t other : others) {
            FrameImages other_images(dataset_, static_cast<int>(other));
            const Image16* ids = other_images.image16("instance");
            if (!ids) continue;
            const Fit fit = change.fit(outlinesOf(*ids, false));
            if (fit.rank <= best.rank || !explainsBetter(fit, own)) continue;
            best = fit;
            best_frame = other;
        }
        if (!best_frame) return {};
        return fmt::format(
            "where objects meet in the frame's instance image colours change more than in {:.0f} % "
            "of the picture; with that of frame {} in {:.0f} %",
            100.0 * own.rank, *best_frame, 100.0 * best.rank);
    }

    const StoredDataset& dataset_;
    std::vector<std::unique_ptr<Seen>> seen_;  // by frame; null: its images cannot be read
    ObjectColours colours_;
};

}  // namespace

CheckWork beginPictures(const Subject& subject, Findings& /*findings*/) {
    const auto pictures = std::make_shared<Pictures>(subject.dataset);
    return {[pictures](FrameImages& images, Findings&) { pictures->look(images); },
            [pictures](Findings& findings) { pictures->judge(findings); }};
}

}  // namespace dollytrack::verify
