#pragma once

#include "engine/io/sandbox/reachable_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::gazebo {

/// Whether a name is an address on the web: http:// or https://.
[[nodiscard]] bool isWebAddress(std::string_view uri);

/// A model of Gazebo Fuel, the collection of models at fuel.gazebosim.org, and a file in it.
struct FuelUri {
    std::string server;   // "fuel.gazebosim.org"
    std::string owner;    // "OpenRobotics"
    std::string model;    // "Office Chair"
    std::string version;  // digits; empty: the newest
    std::string file;     // within the model; empty: the model
};

/// The parts of https://SERVER/1.0/OWNER/models/MODEL[/VERSION[/files/FILE]]; nothing for other
/// addresses.
[[nodiscard]] std::optional<FuelUri> fuelUriOf(const std::string& uri);

/// The folder of a model that was downloaded: MODEL below one of the folders, or
/// SERVER/OWNER/models/MODEL/VERSION as `gz fuel download` keeps it in ~/.gz/fuel, in small letters
/// or not.
[[nodiscard]] std::optional<std::filesystem::path> findFuelModel(const io::ReachableFiles& files,
                                                                 const FuelUri& uri);

}  // namespace dollytrack::gazebo
