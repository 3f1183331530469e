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

/// A model or world with its links, frames, joints and models.
struct Scope;

/// An element with a pose, to which other poses can be relative.
struct Frame {
    explicit Frame(const pugi::xml_node& xml) : node(xml) {}

    [[nodiscard]] bool is(std::string_view kind) const { return kind == node.name(); }

    pugi::xml_node node;              // <link>, <frame>, <joint>, <model>, <include>
    std::unique_ptr<Scope> model;     // for models and for includes that were found
    std::optional<std::size_t> link;  // for links: index into SdfReader::links_
    /// One of the equal models of a <population>, whose element names and places only the first.
    struct Copy {
        std::string name;
        Eigen::Vector3d position;  // in the world, without rotation
    };
    std::optional<Copy> copy;
    enum class State { New, Busy, Known } state = State::New;
    Eigen::Affine3d scope_from_frame = Eigen::Affine3d::Identity();
};

struct Scope {
    pugi::xml_node node;         // <model> or <world>
    std::filesystem::path path;  // of its file
    const XmlFile* xml = nullptr;
    std::string name;  // clean text; empty for the world
    const Scope* parent = nullptr;
    int depth = 0;
    std::vector<Frame> frames;
    std::map<std::string, std::size_t, std::less<>> by_name;  // indices into `frames`
};

/// A frame within its scope. `frame` is null for the scope itself ("arm::__model__").
struct Step {
    Scope* scope;
    Frame* frame;
};

/// A BadInput error at an element of a scope's file, with its line.
[[nodiscard]] tl::unexpected<Error> wrongAt(std::string message, const Scope& scope,
                                            const pugi::xml_node& element);

/// The <pose> in an element, without its `relative_to`. `of` names the element in errors. Error:
/// BadInput.
[[nodiscard]] Result<Eigen::Affine3d> poseIn(const pugi::xml_node& node, const std::string& of,
                                             const Scope& scope);

/// Resolves a name such as "gripper::finger": the frames from outer to inner, of which the last is
/// the named one; empty if there is no such frame. Model names end at the first "::"; only the last
/// name may contain one, as links of included models did before SDF 1.7.
[[nodiscard]] std::vector<Step> locate(Scope& scope, std::string_view name);

/// The pose of a named frame in `scope`. The identity for an empty name and "world". `element`
/// contains the name, for errors. Error: BadInput.
[[nodiscard]] Result<Eigen::Affine3d> poseOfName(Scope& scope, const std::string& name,
                                                 const pugi::xml_node& element, int depth = 0);

/// The pose of a frame in its scope, computed once per frame. Error: BadInput, also for poses that
/// are relative to each other in a cycle.
[[nodiscard]] Result<Eigen::Affine3d> poseOf(Scope& scope, Frame& frame, int depth = 0);

}  // namespace dollytrack::gazebo
