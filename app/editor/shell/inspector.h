#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <memory>

namespace dollytrack::editor {

/// Tells a program outside what the editor shows: a Unix socket that answers each line "state"
/// with one line of JSON. With it a test can find widgets on the screen, use real mouse and keys on
/// them, and check what came of it. It can only look, never change anything.
class Inspector {
  public:
    /// `wake` makes the window draw, so that the answer is of now.
    Inspector(const std::filesystem::path& socket, std::function<void()> wake);
    ~Inspector();
    Inspector(const Inspector&) = delete;
    Inspector& operator=(const Inspector&) = delete;

    [[nodiscard]] bool asked() const;
    void answer(const nlohmann::json& state);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace dollytrack::editor
