#pragma once

#include "engine/core/result.h"
#include "engine/io/gazebo/link_xml.h"

#include <Eigen/Geometry>
#include <pugixml.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gazebo {

/// A model or world with the links, frames, joints and models in it.
struct Scope;

/// Anything that has a pose and that other poses may be relative to.
struct Frame {
    explicit Frame(const pugi::xml_node& xml) : node(xml) {}

    [[nodiscard]] bool is(std::string_view kind) const { return kind == node.name(); }

    pugi::xml_node node;              // <link>, <frame>, <joint>, <model>, <include>
    std::unique_ptr<Scope> model;     // of models, and of includes that were found
    std::optional<std::size_t> link;  // of links: index into SdfReader::links_
    enum class State { New, Busy, Known } state = State::New;
    Eigen::Affine3d scope_from_frame = Eigen::Affine3d::Identity();
};

struct Scope {
    pugi::xml_node node;         // <model> or <world>
    std::filesystem::path path;  // of the file that it is written in
    const XmlFile* xml = nullptr;
    std::string name;  // clean text; empty: the world
    const Scope* parent = nullptr;
    int depth = 0;
    std::vector<Frame> frames;
    std::map<std::string, std::size_t, std::less<>> by_name;  // indices into `frames`
};

/// A frame and the scope that it lies in; null: the scope itself, as "arm::__model__" names it.
struct Step {
    Scope* scope;
    Frame* frame;
};

/// A failure at an element of a scope's file, with its line.
[[nodiscard]] tl::unexpected<Error> wrongAt(std::string message, const Scope& scope,
                                            const pugi::xml_node& element);

/// What a <pose> says, aside from what it is relative to. Error: BadInput; `of` names the element.
[[nodiscard]] Result<Eigen::Affine3d> poseIn(const pugi::xml_node& node, const std::string& of,
                                             const Scope& scope);

/// The frames that a name as "gripper::finger" goes through, the last of which it means; none where
/// there is no such frame. The names of models end at the first "::"; only the last name may hold
/// one, as links of included models did before SDF 1.7.
[[nodiscard]] std::vector<Step> locate(Scope& scope, std::string_view name);

/// The pose of the frame that a name means, in the scope that names it in `element`. Error:
/// BadInput.
[[nodiscard]] Result<Eigen::Affine3d> poseOfName(Scope& scope, const std::string& name,
                                                 const pugi::xml_node& element, int depth = 0);

/// The pose of a frame in its scope. Each is computed once. Error: BadInput.
[[nodiscard]] Result<Eigen::Affine3d> poseOf(Scope& scope, Frame& frame, int depth = 0);

}  // namespace dollytrack::gazebo
