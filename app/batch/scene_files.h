#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace dollytrack::batch {

/// A scene or project of a batch.
struct SceneFile {
    std::filesystem::path path;  // from the jobs file's folder on, or absolute as it was given
    std::string name;            // as folders are called after it; see nameScenes()
};

/// Whether a text has wildcards at all.
[[nodiscard]] bool isPattern(const std::string& text);

/// The scenes and projects that a pattern names, in natural order: `*` and `?` within a name, `**`
/// for any number of folders. A text without wildcards is one file, of whatever kind. A dataset
/// config of Habitat stands for each of its scenes. Names that begin with a dot are not looked at.
/// Each file is named once. Error: BadInput where nothing is found, a folder cannot be read, or a
/// dataset config cannot be used.
[[nodiscard]] Result<std::vector<SceneFile>> filesMatching(const std::string& pattern,
                                                           const std::filesystem::path& base);

/// Whether a pattern without a look at the disk covers a path given in the same way.
[[nodiscard]] bool matches(const std::filesystem::path& path, const std::string& pattern);

/// Gives each a short name of its own made of letters, digits, '-' and '_': that of its file, or of
/// its folder where the file is called scene, model or the like. Where others have the same one,
/// the ending or as many folders as it takes are added. What a scene is called does not depend on
/// scenes of other names, so that a batch which grows finds its finished jobs again.
void nameScenes(std::vector<SceneFile>& scenes);

/// A text as part of a folder's name.
[[nodiscard]] std::string asName(std::string_view text);

}  // namespace dollytrack::batch
