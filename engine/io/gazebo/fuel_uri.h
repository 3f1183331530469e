#pragma once

#include "engine/io/files/reachable_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dollytrack::gazebo {

/// Whether a name is a web address: http:// or https://.
[[nodiscard]] bool isWebAddress(std::string_view uri);

/// The address of a model, or of a file in it, on Gazebo Fuel, the model collection at
/// fuel.gazebosim.org.
struct FuelUri {
    std::string server;   // "fuel.gazebosim.org"
    std::string owner;    // "OpenRobotics"
    std::string model;    // "Office Chair"
    std::string version;  // digits; empty: the newest
    std::string file;     // path within the model; empty: the model itself
};

/// Parses https://SERVER/1.0/OWNER/models/MODEL[/VERSION[/files/FILE]]; nullopt for other
/// addresses.
[[nodiscard]] std::optional<FuelUri> fuelUriOf(const std::string& uri);

/// The folder of a downloaded model: MODEL in one of the folders, or
/// SERVER/OWNER/models/MODEL/VERSION as stored by `gz fuel download` in ~/.gz/fuel. Case does not
/// count.
[[nodiscard]] std::optional<std::filesystem::path> findFuelModel(const ReachableFiles& files,
                                                                 const FuelUri& uri);

}  // namespace dollytrack::gazebo
