#include "engine/io/gazebo/standard_models.h"

#include "engine/core/name_pattern.h"
#include "engine/io/gazebo/fuel_uri.h"

namespace dollytrack::gazebo {
namespace {

constexpr std::string_view kSun = "<sdf version='1.6'><light name='sun' type='directional'/></sdf>";
constexpr std::string_view kGroundPlane =
    "<sdf version='1.6'><model name='ground_plane'><static>true</static><link name='link'>"
    "<visual name='visual'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>"
    "</geometry></visual></link></model></sdf>";

}  // namespace

std::string_view standardModel(const std::string& uri) {
    std::string name = uri;
    while (name.ends_with('/')) name.pop_back();
    if (const auto fuel = fuelUriOf(name)) {
        const std::string model = inSmallLetters(fuel->model);
        if (!fuel->file.empty()) return {};
        return model == "sun" ? kSun : model == "ground plane" ? kGroundPlane : std::string_view();
    }
    if (name == "model://sun") return kSun;
    if (name == "model://ground_plane") return kGroundPlane;
    return {};
}

}  // namespace dollytrack::gazebo
