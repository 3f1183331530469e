// Imports one scene file after the other in one process, as the editor does, and prints a line of
// JSON about each. Usage: import_many [--here] [--cache] < list of files, one a line

#include "engine/core/log.h"
#include "engine/io/scene_import.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <string>
#include <string_view>

namespace {

long peakKib(int who) {
    rusage usage{};
    getrusage(who, &usage);
    return usage.ru_maxrss;
}

}  // namespace

int main(int count, char** arguments) {
    using namespace dollytrack;
    ImportOptions options;
    for (int i = 1; i < count; ++i) {
        options.in_process = options.in_process || std::string_view(arguments[i]) == "--here";
        options.use_cache = options.use_cache || std::string_view(arguments[i]) == "--cache";
    }
    for (std::string path; std::getline(std::cin, path);) {
        const auto begin = std::chrono::steady_clock::now();
        const Result<Scene> scene = importScene(path, options);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        nlohmann::json line = {{"file", path},
                               {"seconds", taken.count()},
                               {"peak_kib", peakKib(RUSAGE_SELF)},
                               {"child_peak_kib", peakKib(RUSAGE_CHILDREN)}};
        if (scene) {
            line["objects"] = scene->objects.size();
            line["triangles"] = scene->triangles.size();
            line["textures"] = scene->report.textures_found;
            line["notes"] = scene->report.notes;
        } else {
            line["code"] = static_cast<int>(scene.error().code);
            line["message"] = scene.error().message;
            line["where"] = scene.error().where;
        }
        using Json = nlohmann::json;
        std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
    }
    return 0;
}
