#include "ui/overlays/steps_overlay.h"

#include "ui/overlays/edge_shape.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <algorithm>

namespace dollytrack::ui {
namespace {

using Kind = AlgorithmStep::Kind;
using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

/// Replays the steps and collects the resulting elements.
class Replay {
  public:
    explicit Replay(const Plan& plan)
        : plan_(plan),
          sampled_(plan.position_points.size(), false),
          pruned_(plan.roadmap.edges.size(), false) {}

    void take(const AlgorithmStep& step) {
        switch (step.kind) {
            case Kind::Sample:
                sampled_[step.a] = true;
                break;
            case Kind::Accepted:
            case Kind::LinkFound:
                edges_.push_back(step.index);
                break;
            case Kind::Refused:
                refused_.push_back(step.index);
                break;
            case Kind::LinkSample:
                current_link_.push_back(&step);
                samples_.push_back(&step);
                break;
            case Kind::Prune:
                pruned_[step.index] = true;
                break;
            case Kind::Visit:
                visits_.push_back(&step);
                break;
            default:
                break;
        }
        const bool in_link = step.kind == Kind::LinkSample || step.kind == Kind::LinkFound ||
                             step.kind == Kind::LinkFailed;
        if (!in_link) current_link_.clear();
    }

    PlanLayer draw(const AlgorithmStep* last) {
        layer_.legend.title = "Steps";
        drawRefused();
        drawSamples();
        drawEdges();
        drawVisits();
        drawKeyFrames();
        if (last != nullptr) drawLast(*last);
        return std::move(layer_);
    }

  private:
    void drawRefused() {
        for (const int index : refused_) {
            const RefusedEdge& edge = plan_.roadmap.refused[index];
            const std::int32_t tag = toTag(Picked::RefusedEdge, index);
            line(at(edge.a), edge.collision, withOpacity(kRefusedColor, 0.5F), 1.2, 0.0, tag);
            line(edge.collision, at(edge.b), withOpacity(kRefusedColor, 0.25F), 1.0, 4.0, tag);
            mark(edge.collision, Mark::Shape::Cross, withOpacity(kRefusedColor, 0.8F), 6.0, tag);
        }
        entry("Refused", Shape::Line, kRefusedColor, refused_.size());
    }

    void drawSamples() {
        for (const AlgorithmStep* step : samples_) {
            mark(step->point.cast<double>(), Mark::Shape::Dot, withOpacity(kSampleColor, 0.7F), 3.5,
                 toTag(Picked::Sample, step->index));
        }
        // Only the tree of the current link search is drawn; earlier searches leave only their
        // samples.
        for (const AlgorithmStep* step : current_link_) {
            line(step->from.cast<double>(), step->point.cast<double>(),
                 withOpacity(kSampleColor, 0.9F), 1.3, 0.0, toTag(Picked::Sample, step->index));
        }
        if (!samples_.empty()) entry("RRT* sample", Shape::SmallDot, kSampleColor, samples_.size());
    }

    void drawEdges() {
        std::size_t kept = 0;
        std::size_t links = 0;
        std::size_t dropped = 0;
        for (const int index : edges_) {
            const RoadmapEdge& edge = plan_.roadmap.edges[index];
            const std::int32_t tag = toTag(Picked::Edge, index);
            if (pruned_[index]) {
                ++dropped;
                addEdge(layer_.overlay, plan_, edge, kDroppedColor, 1.3, 5.0, tag);
            } else if (edge.is_link) {
                ++links;
                addEdge(layer_.overlay, plan_, edge, kLinkColor, 3.0, 0.0, tag);
            } else {
                ++kept;
                addEdge(layer_.overlay, plan_, edge, kAcceptedColor, 2.2, 0.0, tag);
            }
        }
        entry("Accepted", Shape::Line, kAcceptedColor, kept);
        if (links > 0) entry("Link by RRT*", Shape::Line, kLinkColor, links);
        if (dropped > 0) entry("Dropped", Shape::DashedLine, kDroppedColor, dropped);
    }

    /// The visiting order as straight lines; the actual path follows the edges.
    void drawVisits() {
        for (const AlgorithmStep* step : visits_) {
            if (step->b >= 0) line(at(step->b), at(step->a), kPathColor, 2.6, 0.0, render::kNoTag);
        }
        if (!visits_.empty()) entry("Visited in turn", Shape::Line, kPathColor, visits_.size());
    }

    void drawKeyFrames() {
        std::size_t sampled = 0;
        for (const int key : plan_.key_frames) {
            const bool done = sampled_[key];
            sampled += done;
            mark(at(key), Mark::Shape::Cross, done ? kKeyFrameColor : kSpareColor, 8.0,
                 toTag(Picked::PositionPoint, key));
        }
        entry("Key frame, sampled", Shape::Cross, kKeyFrameColor, sampled);
        entry("Key frame, waiting", Shape::Cross, kSpareColor, plan_.key_frames.size() - sampled);
    }

    void drawLast(const AlgorithmStep& step) {
        if (step.a >= 0) ring(step.a);
        switch (step.kind) {
            case Kind::Near:
            case Kind::Skip:
            case Kind::Link:
                ring(step.b);
                line(at(step.a), at(step.b), kSelectedColor, 1.8, 6.0, render::kNoTag);
                break;
            case Kind::Edge:
                ring(step.b);
                line(at(step.a), at(step.b), kSelectedColor, 2.6, 0.0, render::kNoTag);
                break;
            case Kind::Accepted:
            case Kind::LinkFound:
                addEdge(layer_.overlay, plan_, plan_.roadmap.edges[step.index], kAcceptedColor, 4.5,
                        0.0, toTag(Picked::Edge, step.index));
                break;
            case Kind::Refused: {
                const RefusedEdge& edge = plan_.roadmap.refused[step.index];
                line(at(edge.a), at(edge.b), kRefusedColor, 3.0, 0.0, render::kNoTag);
                mark(edge.collision, Mark::Shape::Cross, kRefusedColor, 15.0,
                     toTag(Picked::RefusedEdge, step.index));
                break;
            }
            case Kind::LinkSample:
                line(step.from.cast<double>(), step.point.cast<double>(), kSelectedColor, 2.6, 0.0,
                     render::kNoTag);
                mark(step.point.cast<double>(), Mark::Shape::Ring, kSelectedColor, 13.0,
                     toTag(Picked::Sample, step.index));
                break;
            case Kind::Prune:
                addEdge(layer_.overlay, plan_, plan_.roadmap.edges[step.index], kSelectedColor, 3.0,
                        6.0, toTag(Picked::Edge, step.index));
                break;
            default:
                break;
        }
        entry("This step", Shape::Ring, kSelectedColor, 1);
    }

    void ring(int position_point) {
        mark(at(position_point), Mark::Shape::Ring, kSelectedColor, 19.0,
             toTag(Picked::PositionPoint, position_point));
    }
    void line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector4f& rgba,
              double width_px, double dash_px, std::int32_t tag) {
        layer_.overlay.lines.push_back({a, b, rgba, width_px, dash_px, tag});
    }
    void mark(const Eigen::Vector3d& where, Mark::Shape shape, const Eigen::Vector4f& rgba,
              double size_px, std::int32_t tag) {
        layer_.overlay.marks.push_back({where, shape, rgba, size_px, {0, 0, 0}, tag});
    }
    void entry(const char* name, Shape shape, const Eigen::Vector4f& rgba, std::size_t count) {
        layer_.legend.entries.push_back({name, shape, rgba, static_cast<int>(count)});
    }
    [[nodiscard]] const Eigen::Vector3d& at(int position_point) const {
        return plan_.position_points[position_point].pose.position;
    }

    const Plan& plan_;
    std::vector<bool> sampled_;
    std::vector<bool> pruned_;
    std::vector<int> edges_;
    std::vector<int> refused_;
    std::vector<const AlgorithmStep*> samples_;
    std::vector<const AlgorithmStep*> current_link_;
    std::vector<const AlgorithmStep*> visits_;
    PlanLayer layer_;
};

}  // namespace

PlanLayer stepsLayer(const Plan& plan, std::size_t count) {
    const std::vector<AlgorithmStep>& steps = plan.roadmap.steps.steps;
    count = std::min(count, steps.size());
    Replay replay(plan);
    for (std::size_t i = 0; i < count; ++i) replay.take(steps[i]);
    return replay.draw(count > 0 ? &steps[count - 1] : nullptr);
}

}  // namespace dollytrack::ui
