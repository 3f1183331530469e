#include "app/editor/project/import_worker.h"

#include "app/project/read_project.h"

#include <exception>
#include <string>
#include <utility>

namespace dollytrack::editor {

void ImportWorker::start(ProjectFile content, const std::filesystem::path& project) {
    awaited_ = content.import;
    worker_.start([question = ++question_, content = std::move(content), project,
                   latest = answers_](const JobContext& job) {
        try {
            latest->put(
                {question, contentOf(content, project).and_then([&](const ProjectContent& read) {
                     return importSceneOf(read, job);
                 })});
        } catch (const std::exception& error) {
            latest->put(
                {question, fail(ErrorCode::Failed, std::string("The scene cannot be read again: ") +
                                                       error.what() + ".")});
        }
    });
}

void ImportWorker::cancel() {
    ++question_;
    awaited_ = nullptr;
    worker_.cancel();
}

std::optional<ImportWorker::Outcome> ImportWorker::take() {
    std::optional<Answer> answer = answers_->take();
    if (!answer || answer->question != question_) return std::nullopt;
    return Outcome{std::exchange(awaited_, nullptr), std::move(answer->scene)};
}

}  // namespace dollytrack::editor
