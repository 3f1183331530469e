#pragma once

#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <string>

namespace dollytrack::editor {

/// A file's modification time in local time: "2024-05-31 17:04:09".
[[nodiscard]] inline std::string localTime(std::filesystem::file_time_type written) {
    const auto age = std::filesystem::file_time_type::clock::now() - written;
    const std::time_t when =
        std::time(nullptr) - std::chrono::duration_cast<std::chrono::seconds>(age).count();
    std::tm local{};
    localtime_r(&when, &local);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
    return text.data();
}

}  // namespace dollytrack::editor
