#include "planning/explanations/capture_ledger.h"

#include "planning/explanations/candidate_tally.h"

#include <fmt/format.h>

#include <algorithm>

namespace dollytrack::planning {
namespace {

bool has(const std::vector<int>& ids, int id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// The last planning stage that a position point has reached.
enum class Reached { Found, KeyFrame, Path, Frame };

Reached reached(const Plan& plan, int point) {
    if (!has(plan.key_frames, point)) return Reached::Found;
    const bool on_path = std::any_of(
        plan.smooth_paths.begin(), plan.smooth_paths.end(), [&](const SmoothPath& path) {
            return std::any_of(path.keys.begin(), path.keys.end(), [&](const SmoothPath::Key& key) {
                return key.position_point == point;
            });
        });
    if (!on_path) return Reached::KeyFrame;
    const auto& frames = plan.trajectory.frames;
    return std::any_of(frames.begin(), frames.end(),
                       [&](const TrajectoryFrame& f) { return f.position_point == point; })
               ? Reached::Frame
               : Reached::Path;
}

/// Distance between a key frame and the rounded path, m.
double movedBySmoothing(const Plan& plan, int point) {
    double moved = 0.0;
    for (const SmoothPath& path : plan.smooth_paths) {
        for (const SmoothPath::Key& key : path.keys) {
            if (key.position_point != point) continue;
            const auto& p = plan.position_points[point];
            moved = std::max(moved, (key.position - p.pose.position).norm());
        }
    }
    return moved;
}

class RowMaker {
  public:
    RowMaker(const Scene& scene, const Plan& plan, const ObjectCapture& capture,
             const ExclusionReasons& reasons)
        : scene_(scene), plan_(plan), capture_(capture), reasons_(reasons) {}

    LedgerRow make() {
        row_.object_id = capture_.object_id;
        row_.captured = capture_.captured;
        row_.well_captured = capture_.well_captured;
        takeFrame(capture_.best_well.frame >= 0 ? capture_.best_well : capture_.best);
        if (!row_.well_captured && !lostOnTheWay() && (reasons_.given_motion || !lostByHand()))
            lostInSearch();
        return std::move(row_);
    }

  private:
    void takeFrame(const ObjectView& view) {
        // A fully occluded object is not shown by the frame.
        if (view.frame < 0 || view.visible_fraction <= 0.0) return;
        const auto& frame = plan_.trajectory.frames[view.frame];
        row_.frame = view.frame;
        row_.time_s = frame.time_s;
        row_.key_frame = frame.position_point >= 0;
        row_.visible_fraction = view.visible_fraction;
        row_.box_share = view.box_share;
        row_.mask_share = view.mask_share;
        row_.distance_m = (center() - frame.pose.position).norm();
    }

    /// Whether some position point captures the object (or captures it well) although no frame
    /// does: the view was lost after the search.
    bool lostOnTheWay() {
        int furthest = -1;
        Reached how_far = Reached::Found;
        for (std::size_t p = 0; p < plan_.position_points.size(); ++p) {
            const PositionPoint& point = plan_.position_points[p];
            if (!has(row_.captured ? point.well_captured : point.captured, row_.object_id)) {
                continue;
            }
            const Reached now = reached(plan_, static_cast<int>(p));
            if (furthest >= 0 && now <= how_far) continue;
            furthest = static_cast<int>(p);
            how_far = now;
        }
        if (furthest < 0) return false;
        if (reasons_.given_motion) {
            lose(Loss::NotInMotion,
                 fmt::format("No frame of the given camera motion captures it{}; the search found "
                             "a view that does.",
                             row_.captured ? " well" : ""));
            return true;
        }
        switch (how_far) {
            case Reached::Found:
                // Key frames of objects are chosen to keep every capture; only a budget drops some.
                lose(Loss::OverBudget,
                     fmt::format("Its key frame was dropped {}.", reasons_.key_frames));
                break;
            case Reached::KeyFrame:
                lostBeforePath(furthest);
                break;
            case Reached::Path:
                lose(Loss::DroppedByScore,
                     "The frame that showed it was removed because its image score was low.");
                break;
            case Reached::Frame:
                lostAtKeyFrame(furthest);
                break;
        }
        return true;
    }

    void lostBeforePath(int point) {
        const int part = plan_.position_points[point].component;
        const bool visited =
            std::any_of(plan_.smooth_paths.begin(), plan_.smooth_paths.end(),
                        [&](const SmoothPath& path) { return path.component == part; });
        if (visited) {
            lose(Loss::DroppedByPath,
                 fmt::format("Its key frame was left out of the path {}.", reasons_.path));
        } else {
            lose(Loss::OtherComponent,
                 fmt::format("Its key frame is in room {}, which no path visits.", part + 1));
        }
    }

    void lostAtKeyFrame(int point) {
        constexpr double kMoved_m = 1e-6;
        const double moved = movedBySmoothing(plan_, point);
        lose(Loss::LostInSmoothing,
             moved > kMoved_m
                 ? fmt::format("The rounded path passes its key frame at {:.2f} m, where {}.",
                               moved, justBelow())
                 : fmt::format("The path passes its key frame, but counted pixel by pixel {}.",
                               justBelow()));
    }

    [[nodiscard]] std::string justBelow() const {
        return row_.captured
                   ? fmt::format("its box takes {:.1f} % of the image", 100.0 * row_.box_share)
                   : fmt::format("{:.0f} % of it is visible", 100.0 * row_.visible_fraction);
    }

    bool lostByHand() {
        for (std::size_t o = 0; o < plan_.observation_points.size(); ++o) {
            if (!has(plan_.observation_points[o].objects, row_.object_id)) continue;
            if (plan_.searches[o].removed && tallyOf(plan_, row_.object_id).legal() > 0) {
                lose(Loss::ByHand, "Its position point was removed manually.");
                return true;
            }
        }
        const bool pinned = std::any_of(
            plan_.position_points.begin(), plan_.position_points.end(), [&](const auto& point) {
                const std::size_t o = point.observation_point;
                return point.pin >= 0 && has(plan_.observation_points[o].objects, row_.object_id);
            });
        if (!pinned || row_.captured) return false;
        lose(Loss::ByHand, "Its pinned position point does not capture it.");
        return true;
    }

    void lostInSearch() {
        if (row_.captured) {
            lose(Loss::TooSmall, whyNotLarger());
            return;
        }
        const CandidateTally tally = tallyOf(plan_, row_.object_id);
        lose(tally.loss(), tally.reason(scene_));
        if (tally.loss() == Loss::Occluded) row_.occluder = tally.occluder();
    }

    /// For an object captured but never large: the verdicts on candidates closer to it.
    [[nodiscard]] std::string whyNotLarger() const {
        double largest = row_.box_share;
        for (const std::vector<ObjectView>& frame : plan_.frame_views) {
            for (const ObjectView& view : frame) {
                if (view.object_id == row_.object_id && isCaptured(view)) {
                    largest = std::max(largest, view.box_share);
                }
            }
        }
        const std::string text = fmt::format(
            "Its box takes at most {:.1f} % of the image where it is captured; {:.0f} % are needed",
            100.0 * largest, 100.0 * CaptureRules{}.min_box_share);
        CandidateTally nearer;
        for (std::size_t o = 0; o < plan_.observation_points.size(); ++o) {
            const ObservationPoint& point = plan_.observation_points[o];
            if (point.objects != std::vector{row_.object_id}) continue;
            for (const Candidate& candidate : plan_.searches[o].candidates) {
                if ((candidate.position - center()).norm() < row_.distance_m) nearer.add(candidate);
            }
        }
        const std::string why = nearer.refusals(scene_, 3);
        return why.empty() ? text + "." : text + "; closer candidates are " + why + ".";
    }

    void lose(Loss loss, std::string reason) {
        row_.loss = loss;
        row_.reason = std::move(reason);
    }

    [[nodiscard]] const Eigen::Vector3d& center() const {
        return scene_.object(row_.object_id).box.center;
    }

    const Scene& scene_;
    const Plan& plan_;
    const ObjectCapture& capture_;
    const ExclusionReasons& reasons_;
    LedgerRow row_;
};

}  // namespace

std::vector<LedgerRow> captureLedger(const Scene& scene, const Plan& plan,
                                     const ExclusionReasons& reasons) {
    std::vector<LedgerRow> ledger;
    for (const ObjectCapture& capture : plan.captures) {
        ledger.push_back(RowMaker(scene, plan, capture, reasons).make());
    }
    return ledger;
}

}  // namespace dollytrack::planning
