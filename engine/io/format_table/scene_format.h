#pragma once

#include "engine/core/result.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/io/settings/import_options.h"
#include "engine/jobs/job.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack {

/// A scene file format: how it is recognized, and its reader.
struct SceneFormat {
    std::string_view name;                     // with its article: "a glTF file"
    std::vector<std::string_view> extensions;  // lower case, with the dot
    /// Whether a file with the extension that begins with `head` has this format.
    bool (*begins_like)(std::string_view head);
    /// Reads the file, in its own axes and unit. Files must be opened through ConfinedFolder,
    /// or with openNamedFile() if the user named them.
    Result<RawScene> (*read)(const std::filesystem::path& path, const ImportOptions& options,
                             const JobContext& job);
    /// Files and folders that the reader may open in addition to those below the scene's folder. In
    /// the sandbox nothing else can be opened.
    std::vector<std::filesystem::path> (*more_inputs)(const std::filesystem::path& path,
                                                      const ImportOptions& options) = nullptr;
    /// Whether files that are no scenes also have the extension; patterns then check begins_like.
    bool shares_extension = false;
    /// Reading time relative to that of a model of the same size; larger for point clouds.
    double work = 1.0;
    /// Whether the specification defines unit and up axis, which are then not questioned.
    bool frame_is_specified = false;
    /// The up axis of most files, if the specification defines none; by default unknown.
    UpAxis usual_up = {};
};

/// All supported formats. Of several with the same extension, the first that recognizes the content
/// of the file is used.
const std::vector<SceneFormat>& sceneFormats();

/// The extensions of all formats, each once, for file dialogs and patterns.
std::vector<std::string> sceneExtensions();

/// Whether a file pattern should match this file: by its extension, and by its first bytes if files
/// that are no scenes also have the extension.
bool isSceneFile(const std::filesystem::path& path);

/// Loads the libraries that are needed only for files of this kind. Must be called before the
/// process gives up its right to open files.
void loadLibrariesFor(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace dollytrack
