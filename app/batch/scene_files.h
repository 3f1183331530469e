#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A scene or project file of a batch.
struct SceneFile {
    std::filesystem::path path;  // relative to the jobs file's folder, or absolute as given
    std::string name;            // name used for job folders; see nameScenes()
};

/// Whether a text contains wildcards (*, ? or [).
[[nodiscard]] bool isPattern(const std::string& text);

/// The scenes and projects that match a pattern, in natural order: `*`, `?` and `[...]` match
/// within a name, `**` matches any number of folders. Text without wildcards is a single file of
/// any type. A Habitat dataset config is replaced by the scenes it lists. Names that begin with a
/// dot are skipped by wildcards. Each file occurs once. Error: BadInput if nothing is found, a
/// folder cannot be read, or a dataset config cannot be used.
[[nodiscard]] Result<std::vector<SceneFile>> filesMatching(const std::string& pattern,
                                                           const std::filesystem::path& base);

/// Whether a path matches a pattern, both relative to the same folder; does not access the disk.
[[nodiscard]] bool matches(const std::filesystem::path& path, const std::string& pattern);

/// Gives each scene a short unique name of letters, digits, '-' and '_': that of its file, or of
/// its folder if the file has a generic name such as "scene" or "model". Equal names are
/// distinguished by the file extension or by as many parent folders as needed. A scene's name does
/// not depend on scenes of other names, so a batch that grows finds its finished jobs again.
void nameScenes(std::vector<SceneFile>& scenes);

/// Makes a text usable in a folder name: other ASCII characters become '_'.
[[nodiscard]] std::string asName(std::string_view text);

}  // namespace dollytrack::batch
