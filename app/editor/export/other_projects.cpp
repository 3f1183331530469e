#include "app/editor/export/other_projects.h"

#include "app/project/read_project.h"

#include <utility>

namespace dollytrack::editor {
namespace {

Result<RenderMode> renderModeOf(const std::filesystem::path& project) {
    Result<ProjectContent> content = readProject(project);
    if (!content) return tl::unexpected(std::move(content.error()));
    return content->params.picture.render_mode;
}

}  // namespace

void OtherProjects::read(const std::filesystem::path& project) {
    waiting_.push_back(project);
    if (waiting_.size() == 1) readNext();
}

void OtherProjects::readNext() {
    reader_.start(waiting_.front(), renderModeOf);
}

void OtherProjects::cancel() {
    waiting_.clear();
    reader_.cancel();
}

std::optional<OtherProject> OtherProjects::take() {
    std::optional<Result<RenderMode>> mode = reader_.take();
    if (!mode) return std::nullopt;
    OtherProject project{waiting_.front(), std::move(*mode)};
    waiting_.pop_front();
    if (!waiting_.empty()) readNext();
    return project;
}

}  // namespace dollytrack::editor
