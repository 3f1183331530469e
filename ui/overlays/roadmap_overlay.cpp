#include "ui/overlays/roadmap_overlay.h"

#include "engine/core/disjoint_sets.h"
#include "ui/overlays/edge_shape.h"
#include "ui/overlays/palette.h"
#include "ui/overlays/pick_tag.h"

#include <algorithm>

namespace dollytrack::ui {
namespace {

using Mark = render::OverlayMark;
using Shape = LegendEntry::Shape;

/// The connected component of each position point by straight moves alone, before linking; numbered
/// from the largest.
struct Parts {
    std::vector<int> of_point;
    int count = 0;

    explicit Parts(const Plan& plan) : of_point(plan.position_points.size(), -1) {
        DisjointSets<int> connected(of_point.size());
        for (const RoadmapEdge& edge : plan.roadmap.edges) {
            if (!edge.is_link) connected.join(edge.a, edge.b);
        }
        std::vector<std::pair<int, int>> sizes;  // negative size, root
        for (const int key : plan.key_frames) {
            const int top = connected.find(key);
            const auto known = std::find_if(sizes.begin(), sizes.end(),
                                            [&](const auto& one) { return one.second == top; });
            if (known == sizes.end()) {
                sizes.emplace_back(-1, top);
            } else {
                --known->first;
            }
        }
        std::sort(sizes.begin(), sizes.end());
        count = static_cast<int>(sizes.size());
        for (int part = 0; part < count; ++part) {
            for (const int key : plan.key_frames) {
                if (connected.find(key) == sizes[part].second) {
                    of_point[key] = part;
                }
            }
        }
    }
};

class RoadmapBuilder {
  public:
    RoadmapBuilder(const Plan& plan, const RoadmapOverlayOptions& options)
        : plan_(plan), options_(options), parts_(plan) {}

    PlanLayer build() {
        layer_.legend.title = "Roadmap";
        if (options_.refused) addRefused();
        if (options_.samples) addSamples();
        addEdges();
        if (options_.path) addPath();
        addSelected();
        return std::move(layer_);
    }

  private:
    void addRefused() {
        const auto& refused = plan_.roadmap.refused;
        for (std::size_t i = 0; i < refused.size(); ++i) {
            const std::int32_t tag = toTag(Picked::RefusedEdge, static_cast<int>(i));
            // Opaque red up to the collision, then faint along the rest of the refused move.
            addLine(at(refused[i].a), refused[i].collision, withOpacity(kRefusedColor, 0.8F), 1.4,
                    0.0, tag);
            addLine(refused[i].collision, at(refused[i].b), withOpacity(kRefusedColor, 0.35F), 1.0,
                    4.0, tag);
        }
        for (std::size_t i = 0; i < refused.size(); ++i) {
            layer_.overlay.marks.push_back({refused[i].collision,
                                            Mark::Shape::Cross,
                                            kRefusedColor,
                                            6.5,
                                            {0, 0, 0},
                                            toTag(Picked::RefusedEdge, static_cast<int>(i))});
        }
        layer_.legend.entries.push_back({"Colliding edge, with the point of collision", Shape::Line,
                                         kRefusedColor, static_cast<int>(refused.size())});
    }

    void addSamples() {
        const auto& samples = plan_.roadmap.samples;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            layer_.overlay.marks.push_back({samples[i],
                                            Mark::Shape::Dot,
                                            withOpacity(kSampleColor, 0.85F),
                                            3.5,
                                            {0, 0, 0},
                                            toTag(Picked::Sample, static_cast<int>(i))});
        }
        if (!samples.empty()) {
            layer_.legend.entries.push_back(
                {"RRT* sample", Shape::SmallDot, kSampleColor, static_cast<int>(samples.size())});
        }
    }

    void addEdges() {
        int dropped = 0;
        int links = 0;
        std::vector<int> by_color;
        const auto& edges = plan_.roadmap.edges;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const RoadmapEdge& edge = edges[i];
            const std::int32_t tag = toTag(Picked::Edge, static_cast<int>(i));
            if (!edge.in_tree) {
                ++dropped;
                if (options_.dropped) {
                    addEdge(edge, withOpacity(kDroppedColor, 0.9F), 1.3, 5.0, tag);
                }
            } else if (edge.is_link) {
                ++links;
                if (options_.links) addEdge(edge, kLinkColor, 4.0, 0.0, tag);
            } else {
                const int color = colorIndex(edge);
                by_color.resize(std::max(by_color.size(), static_cast<std::size_t>(color) + 1));
                ++by_color[color];
                if (options_.accepted) addEdge(edge, partColor(color), 3.4, 0.0, tag);
            }
        }
        auto& entries = layer_.legend.entries;
        if (options_.accepted) {
            const char* name =
                options_.color == EdgeColor::Part ? "Accepted, part " : "Accepted, room ";
            for (std::size_t i = 0; i < by_color.size(); ++i) {
                if (by_color[i] == 0) continue;
                entries.push_back({name + std::to_string(i + 1), Shape::Line,
                                   partColor(static_cast<int>(i)), by_color[i]});
            }
        }
        if (options_.links && links > 0) {
            entries.push_back({"Link by RRT*", Shape::Line, kLinkColor, links});
        }
        if (options_.dropped) {
            entries.push_back(
                {"Dropped: closes a cycle", Shape::DashedLine, kDroppedColor, dropped});
        }
    }

    void addPath() {
        int vertices = 0;
        for (const CameraPath& path : plan_.paths) {
            for (std::size_t i = 0; i < path.vertices.size(); ++i) {
                ++vertices;
                if (i == 0) continue;
                addLine(path.vertices[i - 1].position, path.vertices[i].position, kPathColor, 1.7,
                        0.0, render::kNoTag);
            }
        }
        layer_.legend.entries.push_back({"Path", Shape::Line, kPathColor, vertices});
    }

    void addSelected() {
        const auto& roadmap = plan_.roadmap;
        const int e = options_.selected_edge;
        if (e >= 0 && e < static_cast<int>(roadmap.edges.size())) {
            addEdge(roadmap.edges[e], kSelectedColor, 4.0, 0.0, toTag(Picked::Edge, e));
        }
        const int r = options_.selected_refused;
        if (r >= 0 && r < static_cast<int>(roadmap.refused.size())) {
            const RefusedEdge& edge = roadmap.refused[r];
            const std::int32_t tag = toTag(Picked::RefusedEdge, r);
            addLine(at(edge.a), at(edge.b), kSelectedColor, 3.0, 0.0, tag);
            layer_.overlay.marks.push_back(
                {edge.collision, Mark::Shape::Ring, kSelectedColor, 20.0, {0, 0, 0}, tag});
        }
    }

    [[nodiscard]] int colorIndex(const RoadmapEdge& edge) const {
        const std::size_t a = edge.a;
        return std::max(0, options_.color == EdgeColor::Room ? plan_.position_points[a].component
                                                             : parts_.of_point[a]);
    }

    void addEdge(const RoadmapEdge& edge, const Eigen::Vector4f& rgba, double width_px,
                 double dash_px, std::int32_t tag) {
        ui::addEdge(layer_.overlay, plan_, edge, rgba, width_px, dash_px, tag);
    }

    void addLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector4f& rgba,
                 double width_px, double dash_px, std::int32_t tag) {
        layer_.overlay.lines.push_back({a, b, rgba, width_px, dash_px, tag});
    }

    [[nodiscard]] const Eigen::Vector3d& at(int position_point) const {
        return plan_.position_points[position_point].pose.position;
    }

    const Plan& plan_;
    const RoadmapOverlayOptions& options_;
    Parts parts_;
    PlanLayer layer_;
};

}  // namespace

PlanLayer roadmapLayer(const Plan& plan, const RoadmapOverlayOptions& options) {
    return RoadmapBuilder(plan, options).build();
}

}  // namespace dollytrack::ui
