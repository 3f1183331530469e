#pragma once

#include "engine/core/result.h"
#include "engine/jobs/background_worker.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace dollytrack {

/// Reads one project at a time in the background: project files contain whole plans, and network
/// disks are slow. Main thread only.
template <class Answer>
class ProjectReader {
  public:
    /// `wake` is called from another thread when a project has been read.
    explicit ProjectReader(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Starts reading; a project that is being read is forgotten. `read` runs in the background.
    void start(const std::filesystem::path& project,
               std::function<Result<Answer>(const std::filesystem::path&)> read) {
        reading_ = project;
        worker_.start([question = ++question_, project, read = std::move(read),
                       latest = answers_](const JobContext&) {
            try {
                latest->put({question, read(project)});
            } catch (const std::exception& error) {
                latest->put(
                    {question, fail(ErrorCode::Failed, error.what(), project.filename().string())});
            }
        });
    }

    void cancel() {
        ++question_;
        reading_.clear();
    }

    /// The project that is being read; empty: none.
    [[nodiscard]] const std::filesystem::path& reading() const { return reading_; }

    /// What was read, once. To be called every frame.
    [[nodiscard]] std::optional<Result<Answer>> take() {
        std::optional<Numbered> answer = answers_->take();
        if (!answer || answer->question != question_) return std::nullopt;
        reading_.clear();
        return std::move(answer->content);
    }

  private:
    struct Numbered {
        std::uint64_t question = 0;
        Result<Answer> content;
    };

    std::uint64_t question_ = 0;
    std::filesystem::path reading_;
    std::shared_ptr<LatestValue<Numbered>> answers_ = std::make_shared<LatestValue<Numbered>>();
    BackgroundWorker worker_;
};

}  // namespace dollytrack
