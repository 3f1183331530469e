#include "tests/support/imported_scene.h"

#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace dollytrack::test {

Scene imported(const std::filesystem::path& path, const ImportOptions& options) {
    Result<Scene> scene = importScene(path, options);
    EXPECT_TRUE(scene) << (scene ? "" : describe(scene.error()));
    return scene ? std::move(*scene) : Scene{};
}

Scene importedText(const std::string& text, const std::string& name) {
    const TempFolder folder;
    return imported(folder.write(name, text));
}

const Object* find(const Scene& scene, const std::string& name) {
    const auto at = std::find_if(scene.objects.begin(), scene.objects.end(),
                                 [&](const Object& object) { return object.name == name; });
    return at == scene.objects.end() ? nullptr : &*at;
}

void expectBox(const Scene& scene, const std::string& name, const Eigen::Vector3d& low,
               const Eigen::Vector3d& high) {
    Eigen::AlignedBox3d box;
    if (const Object* object = find(scene, name)) {
        for (std::uint32_t i = 0; i < object->vertex_count; ++i) {
            box.extend(scene.positions[object->first_vertex + i].cast<double>());
        }
    }
    EXPECT_TRUE(!box.isEmpty() && (box.min() - low).norm() < 1e-4 &&
                (box.max() - high).norm() < 1e-4)
        << name << ": " << box.min().transpose() << " to " << box.max().transpose();
}

int countTargets(const Scene& scene) {
    return static_cast<int>(std::count_if(scene.objects.begin(), scene.objects.end(),
                                          [](const Object& o) { return o.role == Role::Target; }));
}

bool says(const std::vector<std::string>& lines, const std::string& words) {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
        return line.find(words) != std::string::npos;
    });
}

}  // namespace dollytrack::test
