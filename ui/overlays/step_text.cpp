#include "ui/overlays/steps_overlay.h"

#include <fmt/format.h>

namespace dollytrack::ui {

std::string nameOf(const Scene& scene, const Plan& plan, int position_point) {
    const std::size_t p = position_point;
    if (position_point < 0 || p >= plan.position_points.size()) return "nothing";
    const std::size_t o = plan.position_points[p].observation_point;
    const std::vector<int>& objects = plan.observation_points[o].objects;
    if (objects.empty()) {
        const PositionPoint& point = plan.position_points[p];
        if (point.surface_view) return "a surface view";
        return point.room_view ? "a room view" : "a constraint view";
    }
    const std::string& first = scene.object(objects.front()).name;
    return objects.size() == 1 ? first : fmt::format("{} and {} more", first, objects.size() - 1);
}

namespace {

std::string obstacle(const Scene& scene, const RefusedEdge& edge) {
    if (edge.object_id > 0) return "would collide with " + scene.object(edge.object_id).name;
    if (edge.reason == Verdict::NoGo) return "would enter a no-go box";
    if (edge.reason == Verdict::HeightBand) return "would leave the height band";
    return "would leave free space";
}

}  // namespace

std::string describe(const Scene& scene, const Plan& plan, const AlgorithmStep& step) {
    using Kind = AlgorithmStep::Kind;
    const std::string a = nameOf(scene, plan, step.a);
    const std::string b = nameOf(scene, plan, step.b);
    const std::size_t index = step.index;
    switch (step.kind) {
        case Kind::Sample:
            return fmt::format("Sample: the view of {}.", a);
        case Kind::Near:
            return fmt::format(
                "Near: {}, {:.2f} m away, cost {:.2f} = {:.2f} distance + {:.2f} size + {:.2f} "
                "turn.",
                b, step.distance_m, step.cost(), step.distance_cost, step.size_cost,
                step.turn_cost);
        case Kind::Skip:
            return fmt::format("Skip: {} and {} are already joined, or their edge collides.", a, b);
        case Kind::Edge:
            return fmt::format("Edge: straight from {} to {}?", a, b);
        case Kind::Accepted:
            return fmt::format("CollisionFree: yes, {} and {} are joined, {:.2f} m.", a, b,
                               plan.roadmap.edges[index].length_m);
        case Kind::Refused:
            return fmt::format("CollisionFree: no, between {} and {} the camera {}.", a, b,
                               obstacle(scene, plan.roadmap.refused[index]));
        case Kind::Leave:
            return step.index == 0 ? fmt::format("Done with {}: it has all the edges it needs.", a)
                                   : fmt::format("Done with {}: {} {} colliding.", a, step.index,
                                                 step.index == 1 ? "edge was" : "edges were");
        case Kind::Link:
            return fmt::format("Link: RRT* grows from {} towards {}.", a, b);
        case Kind::LinkSample:
            return fmt::format("Link: sample {} joins the tree, {:.2f} m from {}.", step.index + 1,
                               (step.point - step.from).norm(),
                               step.parent < 0 ? a : fmt::format("sample {}", step.parent + 1));
        case Kind::LinkFound:
            return fmt::format("Link: found from {} to {}, {:.2f} m with {} corners.", a, b,
                               plan.roadmap.edges[index].length_m,
                               plan.roadmap.edges[index].via.size());
        case Kind::LinkFailed:
            return fmt::format("Link: none found from {} to {} with {} samples.", a, b, step.index);
        case Kind::Prune:
            return fmt::format("Prune: the edge between {} and {} closes a cycle and is removed.",
                               a, b);
        case Kind::Visit:
            return step.b < 0 ? fmt::format("Path {}: starts at {}.", step.index + 1, a)
                              : fmt::format("Path {}: from {} to {}.", step.index + 1, b, a);
    }
    return {};
}

}  // namespace dollytrack::ui
