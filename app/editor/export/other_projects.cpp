#include "app/editor/export/other_projects.h"

#include "app/project/read_project.h"

#include <exception>
#include <utility>

namespace dollytrack::editor {
namespace {

Result<RenderMode> renderModeOf(const std::filesystem::path& project) {
    try {
        Result<ProjectContent> content = readProject(project);
        if (!content) return tl::unexpected(std::move(content.error()));
        return content->params.picture.render_mode;
    } catch (const std::exception& error) {
        return fail(ErrorCode::Failed, error.what(), project.filename().string());
    }
}

}  // namespace

void OtherProjects::read(const std::filesystem::path& project) {
    waiting_.push_back(project);
    if (waiting_.size() == 1) readNext();
}

void OtherProjects::readNext() {
    worker_.start(
        [question = ++question_, file = waiting_.front(), latest = answers_](const JobContext&) {
            latest->put({question, {file, renderModeOf(file)}});
        });
}

void OtherProjects::cancel() {
    waiting_.clear();
    ++question_;
}

std::optional<OtherProject> OtherProjects::take() {
    std::optional<Answer> answer = answers_->take();
    if (!answer || answer->question != question_) return std::nullopt;
    waiting_.pop_front();
    if (!waiting_.empty()) readNext();
    return std::move(answer->project);
}

}  // namespace dollytrack::editor
