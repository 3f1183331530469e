#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::generate {

/// A model of a furniture library, as its catalogue describes it. Lengths are in cm; the front
/// faces +y of the plan.
struct CatalogPiece {
    std::string id;           // "Scopia#bed1"
    std::string name;         // English: "Bed"
    std::string category;     // "Bedroom"
    std::string model;        // file name within the library
    std::size_t archive = 0;  // index of its library in FurnitureCatalog::files()
    std::string creator;
    std::string license;  // of the library
    std::string library;  // "Scopia catalog"
    double width = 0.0;
    double depth = 0.0;
    double height = 0.0;
    double elevation = 0.0;  // usual height above the floor
    bool opening = false;    // a door or a window
    std::string cut_out;     // hole of an opening: SVG path in the unit square; empty: all of it
    std::optional<Eigen::Matrix3d> model_rotation;
};

struct CatalogText {
    std::string name;
    std::string license;
    std::vector<CatalogPiece> pieces;
};

/// Parses a catalogue (Java properties, ISO 8859-1). Pieces without a model or a size are left out.
CatalogText parseCatalog(std::string_view text);

}  // namespace dollytrack::generate
