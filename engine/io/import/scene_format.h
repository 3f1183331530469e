#pragma once

#include "engine/core/result.h"
#include "engine/io/import/raw_scene.h"
#include "engine/io/import/scene_import.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// One kind of scene file: how it is told, and its reader.
struct SceneFormat {
    std::string_view name;                     // with its article: "a glTF file"
    std::vector<std::string_view> extensions;  // lower case, with the dot
    /// Whether a file that has the extension and begins with these bytes is of this kind.
    bool (*begins_like)(std::string_view head);
    /// Everything the file holds, in its own axes and unit. Files are opened through
    /// io::ConfinedFolder, or by io::openNamedFile() where a person named them.
    Result<RawScene> (*read)(const std::filesystem::path& path, const ImportOptions& options,
                             const JobContext& job);
    /// Files and folders that the reader may open besides those beneath the scene's own folder;
    /// where scenes are read apart, nothing else of the machine can be opened.
    std::vector<std::filesystem::path> (*more_inputs)(const std::filesystem::path& path,
                                                      const ImportOptions& options) = nullptr;
    /// Files of quite another kind have the extension, too: patterns pick only what begins like it.
    bool shares_extension = false;
    /// How much longer reading takes than models of as many bytes do: clouds become surfaces.
    double work = 1.0;
    /// Its specification fixes the unit and the upward axis, so that neither is doubted.
    bool frame_is_specified = false;
};

/// Every kind that can be read. Where several share an extension the first that fits counts.
const std::vector<SceneFormat>& sceneFormats();

/// The extensions of all formats, each once, in order: what file dialogs and patterns pick.
std::vector<std::string> sceneExtensions();

/// Whether a pattern of files should pick this one: by its extension, and by its first bytes where
/// the extension is not the format's alone.
bool isSceneFile(const std::filesystem::path& path);

/// Loads what reading this file may take and what few others do. To be called where the process is
/// about to give up opening files.
void loadLibrariesFor(const std::filesystem::path& path, const ImportOptions& options);

/// A text without the blanks and the byte-order mark that it begins with.
std::string_view fromFirstLetter(std::string_view head);

/// The first character of a text behind blanks and a byte-order mark; 0 where there is none.
char firstLetter(std::string_view head);

/// ".GLTF" of "room.GLTF" as ".gltf".
std::string lowerExtension(const std::filesystem::path& path);

}  // namespace dollytrack
