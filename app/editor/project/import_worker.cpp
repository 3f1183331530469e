#include "app/editor/project/import_worker.h"

#include "app/project/read_project.h"

#include <exception>
#include <string>
#include <utility>

namespace dollytrack::editor {

void ImportWorker::start(ProjectFile content, const std::filesystem::path& project) {
    awaited_ = content.import;
    worker_.start([request = ++request_, content = std::move(content), project,
                   latest = results_](const JobContext& job) {
        try {
            latest->put(
                {request, contentOf(content, project).and_then([&](const ProjectContent& read) {
                     return importSceneOf(read, job);
                 })});
        } catch (const std::exception& error) {
            latest->put(
                {request, fail(ErrorCode::Failed, std::string("The scene cannot be read again: ") +
                                                      error.what() + ".")});
        }
    });
}

void ImportWorker::cancel() {
    ++request_;
    awaited_ = nullptr;
    worker_.cancel();
}

std::optional<ImportWorker::Outcome> ImportWorker::take() {
    std::optional<Numbered> result = results_->take();
    if (!result || result->request != request_) return std::nullopt;
    return Outcome{std::exchange(awaited_, nullptr), std::move(result->scene)};
}

}  // namespace dollytrack::editor
