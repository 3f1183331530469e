#pragma once

#include "engine/core/fields.h"
#include "engine/core/result.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::planning {

/// One setting of a camera move. The command line's options, the window's form and the help are
/// made from it.
struct MoveSetting {
    enum class Kind { Number, Point, Object };
    std::string_view name;  // "radius"
    Kind kind = Kind::Number;
    // The text says what it is, and what is chosen if it is not given; limits are for numbers.
    FieldInfo info;
    double usual = 0.0;  // Number: first value of a widget, and the example in the help
};

struct MoveKind {
    std::string_view name;  // "orbit"
    std::string_view text;
    std::vector<MoveSetting> settings;
};

/// All kinds of camera moves.
[[nodiscard]] std::span<const MoveKind> moveKinds();
[[nodiscard]] const MoveKind* findMoveKind(std::string_view name);

/// Texts of settings, by name.
using MoveOptions = std::map<std::string, std::string>;

/// A camera move made from a template, for example "orbit:target=sofa,radius=1.5". Settings that
/// are not given are chosen to fit the scene.
struct MoveRequest {
    std::string kind;
    MoveOptions options;
    std::optional<int> object_id = {};  // subject of the move if `options` name none
    bool operator==(const MoveRequest&) const = default;
};

/// Parses a camera move such as "orbit:target=sofa,radius=1.5". Errors: Usage if the kind of move
/// or a setting is unknown; the message suggests the most similar known name.
Result<MoveRequest> parseMove(const std::string& text);

/// The request as parseMove() reads it, without the object's id.
[[nodiscard]] std::string moveText(const MoveRequest& request);

/// The numbers and points of a request, by setting.
struct MoveValues {
    std::map<std::string, double, std::less<>> numbers;
    std::map<std::string, Eigen::Vector3d, std::less<>> points;

    [[nodiscard]] bool has(std::string_view name) const { return numbers.contains(name); }
    [[nodiscard]] double number(std::string_view name, double otherwise) const;
    [[nodiscard]] std::optional<Eigen::Vector3d> point(std::string_view name) const;
};

/// Reads and checks the settings of a request. Errors: Usage for a value that cannot be read or is
/// out of range; `where` is the setting's name.
Result<MoveValues> readMove(const MoveRequest& request);

/// Read the text of an option. Empty if it is not a number, or not a point "x;y;z".
[[nodiscard]] std::optional<double> readNumber(std::string_view text);
[[nodiscard]] std::optional<Eigen::Vector3d> readPoint(std::string_view text);

/// The text of an option for a value, rounded to a thousandth.
[[nodiscard]] std::string optionText(double value);
[[nodiscard]] std::string optionText(const Eigen::Vector3d& point);

/// The name of a setting as a label: "From height".
[[nodiscard]] std::string settingLabel(std::string_view name);

/// Kinds of moves and their settings, a line each.
[[nodiscard]] std::string moveHelp();

}  // namespace dollytrack::planning
