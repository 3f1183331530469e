#pragma once

#include <assimp/IOStream.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace dollytrack {

/// What was repaired in the text files of a model, and what was missing.
struct ModelTextRepairs {
    std::size_t mended_faces = 0;             // see mendObjLines()
    std::set<std::string> missing_materials;  // names of .mtl files that could not be opened

    /// assimp looks for one file in several folders; it is missing when it is in none.
    void noteMaterial(const std::filesystem::path& file, bool opened) {
        const std::string name = file.filename().string();
        if (opened) {
            opened_.insert(name);
            missing_materials.erase(name);
        } else if (!opened_.contains(name)) {
            missing_materials.insert(name);
        }
    }

  private:
    std::set<std::string> opened_;
};

/// Whether a text has numbers without a digit before the point, ".5" or "-.5".
[[nodiscard]] bool hasBarePoints(const std::vector<std::uint8_t>& text);

/// The same text with a zero before each such point.
[[nodiscard]] std::vector<std::uint8_t> withLeadingZeros(const std::vector<std::uint8_t>& text);

/// Mends lines of an OBJ text that assimp reads wrongly: it skips those that begin with blanks, and
/// one face that names texture coordinates which are not there costs the whole mesh its own or, as
/// number 0, the file. Such faces lose theirs and are added to `mended_faces`. Returns whether
/// anything was changed.
bool mendObjLines(std::vector<std::uint8_t>& text, std::size_t& mended_faces);

/// Removes blanks between <color> and its first number; assimp rejects the file otherwise. Returns
/// whether there were any.
bool removeBlanksBeforeColors(std::vector<std::uint8_t>& text);

/// The stream of an OBJ or Collada file as assimp can read it, by the file's extension: assimp
/// takes ".5" for no number and drops the corner. Takes the stream over and returns it from its
/// beginning, or one of the mended text where something has to be mended. Adds the faces that lost
/// their texture coordinates to `mended_faces`.
[[nodiscard]] Assimp::IOStream* mendText(Assimp::IOStream* stream, const std::string& extension,
                                         std::size_t& mended_faces);

}  // namespace dollytrack
