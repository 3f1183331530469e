#include "app/gather/output/output_files.h"

#include "app/gather/output/output_folder.h"
#include "engine/jobs/parallel.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace dollytrack::gather {
namespace {

namespace fs = std::filesystem;

Status firstError(const std::vector<Status>& all) {
    for (const Status& one : all) {
        if (!one) return one;
    }
    return {};
}

Result<std::string> writeHashed(const GuardedFolder& folder, const std::string& name,
                                std::string_view text) {
    Result<HashingFileWriter> file = HashingFileWriter::create(folder, name);
    if (!file) return tl::unexpected(file.error());
    if (Status written = file->write(text); !written) return tl::unexpected(written.error());
    return file->finish();
}

}  // namespace

std::string pictureNameOf(const OpenedSource& source, std::size_t frame) {
    return source.frameName(frame) + ".png";
}

Result<OutputFiles> OutputFiles::begin(const GuardedFolder& folder, Settings settings) {
    Result<HashingFileWriter> sums = HashingFileWriter::create(folder, kSumsFile);
    if (!sums) return tl::unexpected(sums.error());
    return OutputFiles(folder, settings, std::move(*sums));
}

Status OutputFiles::list(const std::string& name, std::string_view sha256) {
    return sums_.write(fmt::format("{}  {}\n", sha256, name));
}

Status OutputFiles::write(const std::string& name, std::string_view text) {
    const Result<std::string> sha256 = writeHashed(folder_, name, text);
    return sha256 ? list(name, *sha256) : tl::unexpected(sha256.error());
}

Status OutputFiles::write(const std::string& folder,
                          const std::vector<std::pair<std::string, std::string>>& texts) {
    const Result<GuardedFolder> within = folder_.makeWithin(folder);
    if (!within) return tl::unexpected(within.error());
    std::vector<Status> written(texts.size());
    std::vector<std::string> sha256s(texts.size());
    parallelFor(texts.size(), [&](std::size_t i) {
        const Result<std::string> hash = writeHashed(*within, texts[i].first, texts[i].second);
        if (hash) {
            sha256s[i] = *hash;
        } else {
            written[i] = tl::unexpected(hash.error());
        }
    });
    Status status = firstError(written);
    for (std::size_t i = 0; status && i < texts.size(); ++i) {
        status = list(folder + "/" + texts[i].first, sha256s[i]);
    }
    return status;
}

Result<bool> OutputFiles::linkFile(const OpenedSource& source, const FileCopy& file,
                                   const GuardedFolder& to) const {
    // Both paths are resolved from the root without following symbolic links.
    const Result<GuardedFolder> root = GuardedFolder::open("/");
    if (!root) return tl::unexpected(root.error());
    std::error_code error;
    const fs::path from = fs::canonical(source.source.folder, error) / file.from;
    const fs::path link = fs::canonical(to.path(), error) / file.name;
    if (error) return false;
    const auto found = root->find(from.relative_path().string());
    if (!found || !S_ISREG(found->st_mode)) return false;
    if (Status whole = prove(source.file(file.from)); !whole) return tl::unexpected(whole.error());
    const Status linked = root->link(from.relative_path().string(), link.relative_path().string());
    if (!linked) return tl::unexpected(linked.error());
    return true;
}

Status OutputFiles::copyFile(const OpenedSource& source, const FileCopy& file,
                             const GuardedFolder& to, const JobContext& job) const {
    const SourceFile from = source.file(file.from);
    if (settings_.resume && sha256Within(to, file.name, job) == from.sha256) return {};
    if (settings_.hard_links) {
        const Result<bool> linked = linkFile(source, file, to);
        if (!linked) return tl::unexpected(linked.error());
        if (*linked) return {};
    }
    return copyProven(from, to, file.name);
}

Status OutputFiles::copyFiles(const OpenedSource& source, const std::vector<FileCopy>& files,
                              const std::string& folder, const JobContext& job) {
    for (const FileCopy& file : files) {
        const Result<SourceFile> listed = listedFile(source.dataset, file.from);
        if (!listed) return tl::unexpected(listed.error());
    }
    const Result<GuardedFolder> to = folder_.makeWithin(folder);
    if (!to) return tl::unexpected(to.error());
    std::vector<Status> copied(files.size());
    parallelFor(files.size(), [&](std::size_t i) {
        if (!job.cancelled()) copied[i] = copyFile(source, files[i], *to, job);
    });
    Status status = firstError(copied);
    for (const FileCopy& file : files) {
        if (status) status = list(folder + "/" + file.name, source.file(file.from).sha256);
    }
    return status;
}

Status OutputFiles::copyFrames(const OpenedSource& source, const std::string& from,
                               std::size_t begin, std::size_t end,
                               const std::function<std::size_t(std::size_t)>& count,
                               const std::string& folder, const JobContext& job) {
    std::vector<FileCopy> files;
    for (std::size_t frame = begin; frame < end; ++frame) {
        const std::vector<std::string> names = source.filesOf(from, frame);
        if (names.size() != count(frame)) {
            return fail(ErrorCode::BadInput,
                        fmt::format("dataset.json lists {} files of frame {} in {}, not {}; export "
                                    "the dataset again.",
                                    names.size(), frame, from, count(frame)),
                        source.source.folder.string());
        }
        for (const std::string& name : names) files.push_back({from + "/" + name, name});
    }
    return copyFiles(source, files, folder, job);
}

Status OutputFiles::copyPictures(const OpenedSource& source, std::size_t begin, std::size_t end,
                                 const std::string& folder, const JobContext& job) {
    std::vector<FileCopy> pictures;
    for (std::size_t frame = begin; frame < end; ++frame) {
        pictures.push_back(
            {frameFileOf(source.dataset, kPicture, frame), pictureNameOf(source, frame)});
    }
    return copyFiles(source, pictures, folder, job);
}

Result<std::string> OutputFiles::finish() {
    return sums_.finish();
}

}  // namespace dollytrack::gather
