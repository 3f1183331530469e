#pragma once

#include "app/gather/files/hashing_file_writer.h"
#include "app/gather/sources/opened_source.h"
#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/jobs/job.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dollytrack::gather {

/// A file of a dataset that is copied.
struct FileCopy {
    std::string from;  // relative to the dataset's folder
    std::string name;  // of the copy
};

/// Writes the files of a gathered dataset and lists each with its hash in SHA256SUMS.
class OutputFiles {
  public:
    struct Settings {
        bool resume = false;      // files of an earlier run that are whole stay
        bool hard_links = false;  // make hard links instead of copies if possible
    };

    [[nodiscard]] static Result<OutputFiles> begin(const GuardedFolder& folder, Settings settings);

    [[nodiscard]] const GuardedFolder& folder() const { return folder_; }

    /// Adds a file that is written to the list.
    [[nodiscard]] Status list(const std::string& name, std::string_view sha256);
    [[nodiscard]] Status write(const std::string& name, std::string_view text);
    /// Several files of one folder, in parallel.
    [[nodiscard]] Status write(const std::string& folder,
                               const std::vector<std::pair<std::string, std::string>>& texts);
    /// Files of a dataset into one folder, in parallel.
    [[nodiscard]] Status copyFiles(const OpenedSource& source, const std::vector<FileCopy>& files,
                                   const std::string& folder, const JobContext& job);
    /// The files of frames `begin` to `end` (not included) that a dataset has in a folder. Each
    /// frame must have `count` of them, else BadInput.
    [[nodiscard]] Status copyFrames(const OpenedSource& source, const std::string& from,
                                    std::size_t begin, std::size_t end,
                                    const std::function<std::size_t(std::size_t frame)>& count,
                                    const std::string& folder, const JobContext& job);
    /// The images of frames `begin` to `end` (not included).
    [[nodiscard]] Status copyPictures(const OpenedSource& source, std::size_t begin,
                                      std::size_t end, const std::string& folder,
                                      const JobContext& job);

    /// Ends the list; returns its own hash.
    [[nodiscard]] Result<std::string> finish();

  private:
    OutputFiles(const GuardedFolder& folder, Settings settings, HashingFileWriter sums)
        : folder_(folder), settings_(settings), sums_(std::move(sums)) {}
    /// Makes a hard link to the file; false if it is a symbolic link and must be copied.
    [[nodiscard]] Result<bool> linkFile(const OpenedSource& source, const FileCopy& file,
                                        const GuardedFolder& to) const;
    [[nodiscard]] Status copyFile(const OpenedSource& source, const FileCopy& file,
                                  const GuardedFolder& to, const JobContext& job) const;

    GuardedFolder folder_;
    Settings settings_;
    HashingFileWriter sums_;
};

/// The name of a frame's image in layouts of single files.
[[nodiscard]] std::string pictureNameOf(const OpenedSource& source, std::size_t frame);

}  // namespace dollytrack::gather
