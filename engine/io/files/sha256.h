#pragma once

#include "engine/core/result.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace dollytrack {
class JobContext;
}

namespace dollytrack {

/// SHA-256 of bytes that come in pieces.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(Sha256&&) noexcept;
    Sha256& operator=(Sha256&&) noexcept;

    void add(std::span<const std::uint8_t> bytes);
    void add(std::string_view text);
    /// 64 lower-case hexadecimal digits. The object is used up afterwards.
    [[nodiscard]] std::string finish();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

[[nodiscard]] std::string sha256Of(std::span<const std::uint8_t> bytes);
[[nodiscard]] std::string sha256Of(std::string_view text);

/// BadInput when the file cannot be read to its end.
[[nodiscard]] Result<std::string> sha256OfFile(const std::filesystem::path& path);
/// The same; Cancelled when the job is.
[[nodiscard]] Result<std::string> sha256OfFile(const std::filesystem::path& path,
                                               const JobContext& job);

}  // namespace dollytrack
