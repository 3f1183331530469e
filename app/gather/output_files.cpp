#include "app/gather/output_files.h"

#include "app/gather/output_folder.h"
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

Result<bool> OutputFiles::linkPicture(const OpenedSource& source, std::size_t frame,
                                      const GuardedFolder& to) const {
    // Both paths are resolved from the root without following symbolic links.
    const Result<GuardedFolder> root = GuardedFolder::open("/");
    if (!root) return tl::unexpected(root.error());
    std::error_code error;
    const fs::path from = fs::canonical(source.source.folder, error) / frameFileOf(kPicture, frame);
    const fs::path link = fs::canonical(to.path(), error) / pictureNameOf(source, frame);
    if (error) return false;
    const auto found = root->find(from.relative_path().string());
    if (!found || !S_ISREG(found->st_mode)) return false;
    if (Status whole = prove(source.file(kPicture, frame)); !whole) {
        return tl::unexpected(whole.error());
    }
    const Status linked = root->link(from.relative_path().string(), link.relative_path().string());
    if (!linked) return tl::unexpected(linked.error());
    return true;
}

Status OutputFiles::copyPicture(const OpenedSource& source, std::size_t frame,
                                const GuardedFolder& to, const JobContext& job) const {
    const SourceFile file = source.file(kPicture, frame);
    const std::string name = pictureNameOf(source, frame);
    if (settings_.resume && sha256Within(to, name, job) == file.sha256) return {};
    if (settings_.hard_links) {
        const Result<bool> linked = linkPicture(source, frame, to);
        if (!linked) return tl::unexpected(linked.error());
        if (*linked) return {};
    }
    return copyProven(file, to, name);
}

Status OutputFiles::copyPictures(const OpenedSource& source, std::size_t begin, std::size_t end,
                                 const std::string& folder, const JobContext& job) {
    const Result<GuardedFolder> to = folder_.makeWithin(folder);
    if (!to) return tl::unexpected(to.error());
    std::vector<Status> copied(end - begin);
    parallelFor(end - begin, [&](std::size_t i) {
        if (!job.cancelled()) copied[i] = copyPicture(source, begin + i, *to, job);
    });
    Status status = firstError(copied);
    for (std::size_t frame = begin; status && frame < end; ++frame) {
        status =
            list(folder + "/" + pictureNameOf(source, frame), source.file(kPicture, frame).sha256);
    }
    return status;
}

Result<std::string> OutputFiles::finish() {
    return sums_.finish();
}

}  // namespace dollytrack::gather
