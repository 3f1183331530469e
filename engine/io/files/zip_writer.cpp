#include "engine/io/files/zip_writer.h"

#include <zip.h>

#include <memory>

namespace dollytrack {
namespace {

constexpr zip_uint16_t kDate = (1U << 5U) | 1U;  // 1980-01-01, the format's first day

struct FreeSource {
    void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct DiscardArchive {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};

bool isPacked(const std::string& name) {
    for (const char* extension : {".jpg", ".jpeg", ".png", ".gif"}) {
        if (name.ends_with(extension)) return true;
    }
    return false;
}

bool addFile(zip_t* archive, const ArchiveFile& file) {
    zip_source_t* content = zip_source_buffer(archive, file.bytes.data(), file.bytes.size(), 0);
    if (!content) return false;
    const zip_int64_t index = zip_file_add(archive, file.name.c_str(), content, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
        zip_source_free(content);
        return false;
    }
    const auto at = static_cast<zip_uint64_t>(index);
    const zip_int32_t method = isPacked(file.name) ? ZIP_CM_STORE : ZIP_CM_DEFLATE;
    return zip_file_set_dostime(archive, at, 0, kDate, 0) == 0 &&
           zip_set_file_compression(archive, at, method, 0) == 0;
}

/// All bytes written into a buffer.
std::vector<std::uint8_t> bytesOf(zip_source_t* buffer) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_source_stat(buffer, &stat) != 0 || zip_source_open(buffer) != 0) return {};
    std::vector<std::uint8_t> bytes(stat.size);
    const zip_int64_t got = zip_source_read(buffer, bytes.data(), bytes.size());
    zip_source_close(buffer);
    if (got != static_cast<zip_int64_t>(bytes.size())) return {};
    return bytes;
}

}  // namespace

Result<std::vector<std::uint8_t>> makeArchive(const std::vector<ArchiveFile>& files) {
    const auto failed = [] { return fail(ErrorCode::Failed, "the archive cannot be created"); };
    const std::unique_ptr<zip_source_t, FreeSource> buffer(
        zip_source_buffer_create(nullptr, 0, 0, nullptr));
    if (!buffer) return failed();
    zip_source_keep(buffer.get());  // one reference here, one for the archive
    std::unique_ptr<zip_t, DiscardArchive> archive(
        zip_open_from_source(buffer.get(), ZIP_TRUNCATE, nullptr));
    if (!archive) {
        zip_source_free(buffer.get());
        return failed();
    }
    for (const ArchiveFile& file : files) {
        if (!addFile(archive.get(), file)) return failed();
    }
    if (zip_close(archive.get()) != 0) return failed();
    static_cast<void>(archive.release());  // zip_close() has freed it
    std::vector<std::uint8_t> bytes = bytesOf(buffer.get());
    if (bytes.empty()) return failed();
    return bytes;
}

}  // namespace dollytrack
