#include "engine/document/edits_json.h"
#include "engine/io/settings/import_settings.h"
#include "engine/io/settings/project_file.h"
#include "tests/fuzz/memory_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dollytrack;
    const fuzz::MemoryFile file(data, size);
    const auto project = loadProject(file.path());
    if (!project) return 0;
    (void)importOptionsFromJson(project->import);
    (void)editsFromJson(project->edits);
    return 0;
}
