#pragma once

#include <assimp/IOStream.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// Repairs of a model's text files, and the material files that could not be found.
struct ModelTextRepairs {
    std::size_t mended_faces = 0;            // of the OBJ file; see mendText()
    std::set<std::string> sought_materials;  // names of the .mtl files that assimp asked for
    std::set<std::string> opened_materials;  // those of them that were opened
    std::string refusal;                     // why assimp must not read the file; empty: it may

    /// Notes that assimp asked for a .mtl file. It asks for one name in several folders.
    void noteMaterial(const std::filesystem::path& file, bool opened);

    /// The names that were opened in no folder.
    [[nodiscard]] std::set<std::string> missingMaterials() const;
};

/// Whether a text has numbers without a digit before the point, ".5" or "-.5".
[[nodiscard]] bool hasBarePoints(const std::vector<std::uint8_t>& text);

/// The same text with a zero before each such point.
[[nodiscard]] std::vector<std::uint8_t> withLeadingZeros(const std::vector<std::uint8_t>& text);

/// Mends two kinds of lines in an OBJ text that assimp reads wrongly. It skips lines that begin
/// with blanks: the blanks are removed. One face that names missing texture coordinates costs the
/// whole mesh its coordinates, or with number 0 the whole file: the texture coordinates of such
/// faces are removed, and the number of these faces is added to `mended_faces`. Returns whether
/// anything was changed.
bool mendObjLines(std::vector<std::uint8_t>& text, std::size_t& mended_faces);

/// Turns lines of an MTL text into comments if the format has no such statement, or if a word
/// stands where the format has a number. assimp reads every line that begins with "a", such as
/// "ao 1", as an anisotropy, and rejects the file if it is none. Returns whether any line was
/// changed.
bool dropUnknownMaterialLines(std::vector<std::uint8_t>& text);

/// Removes blanks between <color> and its first number; assimp rejects the file otherwise. Returns
/// whether there were any.
bool removeBlanksBeforeColors(std::vector<std::uint8_t>& text);

/// Corrects the counts of the arrays in a Collada text, which LeoCAD writes as numbers of vertices,
/// and lowers those of accessors that reach beyond their arrays. assimp trusts both, and would read
/// beyond the memory of the array. Returns whether any count was wrong.
bool mendArrayCounts(std::vector<std::uint8_t>& text);

/// The line of the first index list (<p> of a Collada file's <triangles>, <polylist> and so on)
/// that contains anything but whole numbers, counted from 1; 0 if there is none or the text is not
/// XML. assimp 5.2 reads such a list without end. Comments and other markup within a list count as
/// such, too.
[[nodiscard]] std::size_t lineOfBadIndices(std::string_view collada);

/// Mends an OBJ, MTL or Collada file before assimp reads it; `extension` says which of them it is.
/// assimp does not read ".5" as a number and drops the vertex. Takes ownership of the stream and
/// returns it rewound, or returns a stream of the mended text. If the file is OBJ, sets
/// `repairs.mended_faces` to the number of faces that lost their texture coordinates. Returns null
/// and sets `repairs.refusal` for a file that assimp must not read.
[[nodiscard]] Assimp::IOStream* mendText(Assimp::IOStream* stream, const std::string& extension,
                                         ModelTextRepairs& repairs);

}  // namespace dollytrack
