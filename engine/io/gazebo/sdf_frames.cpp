#include "engine/io/gazebo/sdf_frames.h"

#include "engine/core/clean_text.h"

#include <cmath>
#include <utility>

namespace dollytrack::gazebo {
namespace {

constexpr int kDeepestFrames = 200;

std::optional<Eigen::Affine3d> writtenPose(const pugi::xml_node& node) {
    const pugi::xml_node pose = node.child("pose");
    const auto numbers = numbersOf(pose.child_value());
    if (!numbers) return std::nullopt;
    if (numbers->empty()) return Eigen::Affine3d::Identity();
    const std::vector<double>& n = *numbers;
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    if (std::string_view(pose.attribute("rotation_format").value()) == "quat_xyzw") {
        if (n.size() != 7) return std::nullopt;
        const Eigen::Quaterniond rotation(n[6], n[3], n[4], n[5]);
        if (!(rotation.norm() > 1e-9)) return std::nullopt;
        result = Eigen::Translation3d(n[0], n[1], n[2]) * rotation.normalized();
        return result;
    }
    if (n.size() != 6) return std::nullopt;
    Eigen::Vector3d angles(n[3], n[4], n[5]);
    if (pose.attribute("degrees").as_bool()) angles *= M_PI / 180.0;
    result = Eigen::Translation3d(n[0], n[1], n[2]) * rotationFromRollPitchYaw(angles);
    return result;
}

}  // namespace

tl::unexpected<Error> wrongAt(std::string message, const Scope& scope,
                              const pugi::xml_node& element) {
    return fail(ErrorCode::BadInput, std::move(message), scope.xml->placeOf(scope.path, element));
}

Result<Eigen::Affine3d> poseIn(const pugi::xml_node& node, const std::string& of,
                               const Scope& scope) {
    const auto pose = writtenPose(node);
    if (pose) return *pose;
    return wrongAt("the <pose> of " + of + " is not six numbers; correct it", scope,
                   node.child("pose"));
}

std::vector<Step> locate(Scope& scope, std::string_view name) {
    std::vector<Step> steps;
    Scope* around = &scope;
    while (true) {
        if (name == "__model__") {
            steps.push_back({around, nullptr});
            return steps;
        }
        if (const auto last = around->by_name.find(name); last != around->by_name.end()) {
            steps.push_back({around, &around->frames[last->second]});
            return steps;
        }
        const auto colons = name.find("::");
        if (colons == name.npos) return {};
        const auto at = around->by_name.find(name.substr(0, colons));
        if (at == around->by_name.end()) return {};
        Frame& frame = around->frames[at->second];
        if (!frame.model) return {};
        steps.push_back({around, &frame});
        around = frame.model.get();
        name.remove_prefix(colons + 2);
    }
}

Result<Eigen::Affine3d> poseOfName(Scope& scope, const std::string& name,
                                   const pugi::xml_node& element, int depth) {
    Eigen::Affine3d pose = Eigen::Affine3d::Identity();
    if (name.empty() || name == "world") return pose;
    const auto steps = locate(scope, name);
    if (steps.empty()) {
        return wrongAt("a <pose> is relative to '" + cleanText(name) +
                           "', which does not exist; correct the name",
                       scope, element);
    }
    for (const auto& [around, frame] : steps) {
        if (frame == nullptr) break;
        const auto step = poseOf(*around, *frame, depth + 1);
        if (!step) return step;
        pose = pose * *step;
    }
    return pose;
}

Result<Eigen::Affine3d> poseOf(Scope& scope, Frame& frame, int depth) {
    if (frame.state == Frame::State::Known) return frame.scope_from_frame;
    if (frame.state == Frame::State::Busy || depth > kDeepestFrames) {
        return wrongAt("the pose of '" + cleanText(frame.node.attribute("name").value()) +
                           "' is relative to itself, or has a chain of more than 200 relative "
                           "poses; correct relative_to",
                       scope, frame.node);
    }
    frame.state = Frame::State::Busy;
    if (frame.copy) {
        frame.scope_from_frame = Eigen::Translation3d(frame.copy->position);
        frame.state = Frame::State::Known;
        return frame.scope_from_frame;
    }
    // An <include> without a pose uses that of the model.
    const bool keeps = frame.is("include") && frame.model && !frame.node.child("pose");
    const pugi::xml_node node = keeps ? frame.model->node : frame.node;
    const auto own = poseIn(node, "'" + cleanText(node.attribute("name").value()) + "'",
                            keeps ? *frame.model : scope);
    if (!own) return own;
    std::string from = node.child("pose").attribute("relative_to").value();
    if (from.empty() && frame.is("frame")) from = node.attribute("attached_to").value();
    if (from.empty() && frame.is("joint")) from = textOf(node.child("child"));
    const auto base = poseOfName(scope, from, frame.node, depth);
    if (!base) return base;
    frame.scope_from_frame = *base * *own;
    if (frame.model) {
        // With a placement_frame, the pose is that of this frame of the model.
        std::string placed = textOf(frame.node.child("placement_frame"));
        if (placed.empty()) {
            placed = frame.model->node.attribute("placement_frame").value();
        }
        const auto within = poseOfName(*frame.model, placed, frame.model->node, depth);
        if (!within) return within;
        frame.scope_from_frame = frame.scope_from_frame * within->inverse(Eigen::Isometry);
    }
    frame.state = Frame::State::Known;
    return frame.scope_from_frame;
}

}  // namespace dollytrack::gazebo
