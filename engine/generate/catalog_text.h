#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::generate {

/// A model of a furniture library as its catalogue describes it; cm, front towards +y of the plan.
struct CatalogPiece {
    std::string id;           // "Scopia#bed1"
    std::string name;         // English: "Bed"
    std::string category;     // "Bedroom"
    std::string model;        // a name in the library's files
    std::size_t archive = 0;  // of FurnitureCatalog::files(), the one that holds it
    std::string creator;
    std::string license;  // of the library
    std::string library;  // "Scopia catalog"
    double width = 0.0;
    double depth = 0.0;
    double height = 0.0;
    double elevation = 0.0;  // where such a thing hangs
    bool opening = false;    // a door or a window
    std::string cut_out;     // of an opening: SVG path in its unit square; empty: all of it
    std::optional<Eigen::Matrix3d> model_rotation;
};

struct CatalogText {
    std::string name;
    std::string license;
    std::vector<CatalogPiece> pieces;
};

/// What a catalogue's text lists (Java properties, ISO 8859-1); pieces without a model or a size
/// are left out.
CatalogText parseCatalog(std::string_view text);

}  // namespace dollytrack::generate
