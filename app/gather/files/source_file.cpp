#include "app/gather/files/source_file.h"

#include "app/gather/files/hashing_file_writer.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/sha256.h"

#include <span>
#include <vector>

namespace dollytrack::gather {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 20U;  // bytes

tl::unexpected<Error> damaged(const SourceFile& file) {
    return fail(ErrorCode::BadInput,
                "the file is damaged: dataset.json has another SHA-256; export the dataset again, "
                "or leave the dataset out with --skip-damaged",
                file.path.string());
}

/// Calls `take` for successive pieces of the file; `take` returns false to stop.
template <class Take>
std::string hashPieces(const InputFile& file, const Take& take) {
    thread_local std::vector<std::uint8_t> piece(kPiece);
    Sha256 hash;
    std::uint64_t at = 0;
    while (const std::size_t got = file.read(at, piece.data(), piece.size())) {
        const std::span<const std::uint8_t> bytes(piece.data(), got);
        hash.add(bytes);
        at += got;
        if (!take(std::string_view(reinterpret_cast<const char*>(piece.data()), got))) break;
    }
    return hash.finish();
}

}  // namespace

Result<std::string> readProven(const SourceFile& file, std::uint64_t most) {
    Result<std::string> bytes = readNamedFile(file.path, most);
    if (bytes && sha256Of(std::string_view(*bytes)) != file.sha256) return damaged(file);
    return bytes;
}

Status readProven(const SourceFile& file, std::string& into, std::uint64_t most) {
    const Result<InputFile> from = openNamedFile(file.path);
    if (!from) return tl::unexpected(from.error());
    if (from->size() > most) return tl::unexpected(from->readAll(most).error());
    into.resize(from->size());
    into.resize(from->read(0, into.data(), into.size()));
    return sha256Of(std::string_view(into)) == file.sha256 ? Status() : damaged(file);
}

Status copyProven(const SourceFile& file, const GuardedFolder& to, const std::string& name) {
    const Result<InputFile> from = openNamedFile(file.path);
    if (!from) return tl::unexpected(from.error());
    Result<FileDescriptor> copy = openNew(to, name);
    if (!copy) return tl::unexpected(copy.error());
    int error = 0;
    const std::string sha256 = hashPieces(*from, [&](std::string_view bytes) {
        error = writeAll(copy->get(), bytes);
        return error == 0;
    });
    if (error == 0) error = copy->close();
    if (error != 0) return tl::unexpected(writeError(error, to.path() / name));
    return sha256 == file.sha256 ? Status() : damaged(file);
}

Status prove(const SourceFile& file) {
    const Result<InputFile> from = openNamedFile(file.path);
    if (!from) return tl::unexpected(from.error());
    const std::string sha256 = hashPieces(*from, [](std::string_view) { return true; });
    return sha256 == file.sha256 ? Status() : damaged(file);
}

std::optional<std::string> sha256Within(const GuardedFolder& folder, const std::string& name,
                                        const JobContext& job) {
    const Result<InputFile> file = folder.openInput(name);
    if (!file) return std::nullopt;
    std::string sha256 = hashPieces(*file, [&](std::string_view) { return !job.cancelled(); });
    if (job.cancelled()) return std::nullopt;
    return sha256;
}

}  // namespace dollytrack::gather
