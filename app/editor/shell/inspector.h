#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <memory>

namespace dollytrack::editor {

/// Reports the editor's state to other programs: a Unix socket that answers each line "state" with
/// one line of JSON. Tests use it to find widgets on the screen and to check the effect of real
/// mouse and key events. It is read-only.
class Inspector {
  public:
    /// `wake` triggers drawing, so that the answer is current.
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
