#include "engine/io/files/sha256.h"

#include "engine/io/files/input_file.h"
#include "engine/jobs/job.h"

#include <openssl/evp.h>

#include <array>
#include <cstdint>
#include <vector>

namespace dollytrack {

struct Sha256::Impl {
    EVP_MD_CTX* context = EVP_MD_CTX_new();

    Impl() { EVP_DigestInit_ex(context, EVP_sha256(), nullptr); }
    ~Impl() { EVP_MD_CTX_free(context); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::add(std::span<const std::uint8_t> bytes) {
    EVP_DigestUpdate(impl_->context, bytes.data(), bytes.size());
}

void Sha256::add(std::string_view text) {
    EVP_DigestUpdate(impl_->context, text.data(), text.size());
}

std::string Sha256::finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned size = 0;
    EVP_DigestFinal_ex(impl_->context, digest.data(), &size);
    std::string hex;
    hex.reserve(2UL * size);
    for (unsigned i = 0; i < size; ++i) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        hex += kDigits[digest[i] >> 4U];
        hex += kDigits[digest[i] & 15U];
    }
    return hex;
}

std::string sha256Of(std::span<const std::uint8_t> bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.finish();
}

std::string sha256Of(std::string_view text) {
    Sha256 hash;
    hash.add(text);
    return hash.finish();
}

Result<std::string> sha256OfFile(const std::filesystem::path& path) {
    return sha256OfFile(path, JobContext());
}

Result<std::string> sha256OfFile(const std::filesystem::path& path, const JobContext& job) {
    const Result<InputFile> file = openNamedFile(path);
    if (!file) return tl::unexpected(file.error());
    Sha256 hash;
    std::vector<std::uint8_t> block(1UL << 16U);
    std::uint64_t done = 0;
    while (const std::size_t count = file->read(done, block.data(), block.size())) {
        hash.add(std::span(block).first(count));
        done += count;
        if (job.cancelled())
            return fail(ErrorCode::Cancelled, "hashing was cancelled", path.string());
    }
    if (done < file->size()) {
        return fail(ErrorCode::BadInput, "the file cannot be read to its end", path.string());
    }
    return hash.finish();
}

}  // namespace dollytrack
