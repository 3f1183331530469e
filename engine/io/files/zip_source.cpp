#include "engine/core/clean_text.h"
#include "engine/io/files/file_source.h"
#include "engine/io/files/input_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <map>
#include <mutex>

namespace dollytrack {
namespace {

constexpr zip_int64_t kMostEntries = 100'000;
constexpr std::uint64_t kMostEntryBytes = std::uint64_t{512} << 20;
constexpr std::uint64_t kMostArchiveBytes = std::uint64_t{4} << 30;

struct CloseArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
    void operator()(zip_file_t* file) const { zip_fclose(file); }
};

class ZipSource : public Archive {
  public:
    ZipSource(std::vector<std::uint8_t> bytes, std::string where)
        : bytes_(std::move(bytes)), where_(std::move(where)) {}

    /// Opens the archive and checks its list of entries.
    Status open() {
        zip_error_t error;
        zip_error_init(&error);
        zip_source_t* source = zip_source_buffer_create(bytes_.data(), bytes_.size(), 0, &error);
        if (source) {
            archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
            if (!archive_) zip_source_free(source);
        }
        zip_error_fini(&error);
        if (!archive_) return refuse("it is not a complete zip archive; save or download it again");
        const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
        if (count > kMostEntries) return refuse("it contains more than 100,000 files");
        std::uint64_t total = 0;
        for (zip_int64_t i = 0; i < count; ++i) {
            if (Status ok = takeEntry(static_cast<zip_uint64_t>(i), total); !ok) return ok;
        }
        return {};
    }

    [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> read(
        const std::string& name) const override {
        const std::optional<std::string> safe = safeRelativeName(name);
        const auto found = safe ? entries_.find(*safe) : entries_.end();
        if (found == entries_.end()) return std::optional<std::vector<std::uint8_t>>{};
        const std::lock_guard lock(mutex_);
        const std::unique_ptr<zip_file_t, CloseEntry> file(
            zip_fopen_index(archive_.get(), found->second.index, 0));
        if (!file) return damaged(*safe);
        // Read in pieces, so that memory depends on the actual size, not on the declared one.
        std::vector<std::uint8_t> bytes;
        constexpr std::size_t kPiece = std::size_t{1} << 20;
        while (true) {
            const std::size_t before = bytes.size();
            bytes.resize(before + kPiece);
            const zip_int64_t got = zip_fread(file.get(), bytes.data() + before, kPiece);
            if (got < 0) return damaged(*safe);
            bytes.resize(before + static_cast<std::size_t>(got));
            if (got == 0) break;
            if (bytes.size() > found->second.size) return damaged(*safe);
        }
        if (bytes.size() != found->second.size) return damaged(*safe);
        return std::optional(std::move(bytes));
    }

    [[nodiscard]] std::vector<std::string> names() const override {
        std::vector<std::string> names;
        for (const auto& [name, entry] : entries_) names.push_back(name);
        return names;
    }

  private:
    struct Entry {
        zip_uint64_t index = 0;
        std::uint64_t size = 0;
    };

    [[nodiscard]] tl::unexpected<Error> refuse(const std::string& why) const {
        return fail(ErrorCode::BadInput, "the archive cannot be used: " + why, where_);
    }
    [[nodiscard]] tl::unexpected<Error> damaged(const std::string& name) const {
        return refuse(fmt::format("\"{}\" in it is damaged", cleanText(name)));
    }

    Status takeEntry(zip_uint64_t index, std::uint64_t& total) {
        zip_stat_t stat;
        zip_stat_init(&stat);
        constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE;
        if (zip_stat_index(archive_.get(), index, 0, &stat) != 0 ||
            (stat.valid & kNeeded) != kNeeded) {
            return refuse("its list of files is damaged");
        }
        const std::string name = stat.name;
        const std::string clean = cleanText(name);
        if (!name.empty() && name.back() == '/' && safeRelativeName(name)) return {};  // a folder
        const std::optional<std::string> safe = safeRelativeName(name);
        if (!safe || name.find("..") == 0 || name.find("/../") != std::string::npos) {
            return refuse(fmt::format("the name \"{}\" in it leads out of the archive", clean));
        }
        if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 &&
            stat.encryption_method != ZIP_EM_NONE) {
            return refuse(
                fmt::format("\"{}\" in it is encrypted; save it without a password", clean));
        }
        if (stat.size > kMostEntryBytes) {
            return refuse(fmt::format("\"{}\" in it is larger than 512 MiB unpacked", clean));
        }
        total += stat.size;
        if (total > kMostArchiveBytes) return refuse("it is larger than 4 GiB unpacked");
        entries_.try_emplace(*safe, Entry{index, stat.size});
        return {};
    }

    std::vector<std::uint8_t> bytes_;  // data of archive_
    std::string where_;
    std::unique_ptr<zip_t, CloseArchive> archive_;
    std::map<std::string, Entry> entries_;
    mutable std::mutex mutex_;  // libzip reads one entry at a time
};

}  // namespace

Result<std::unique_ptr<Archive>> openArchive(std::vector<std::uint8_t> bytes,
                                             const std::string& where) {
    auto source = std::make_unique<ZipSource>(std::move(bytes), where);
    if (Status open = source->open(); !open) return tl::unexpected(open.error());
    return std::unique_ptr<Archive>(std::move(source));
}

Result<std::unique_ptr<Archive>> openArchive(const std::filesystem::path& path) {
    const Result<std::string> bytes = readNamedFile(path, kMostArchiveBytes);
    if (!bytes) return tl::unexpected(bytes.error());
    return openArchive({bytes->begin(), bytes->end()}, path.string());
}

}  // namespace dollytrack
