// Imports several scene files in one process, as the editor does, and prints a line of JSON about
// each. Usage: import_many [--here] [--cache] [--models DIR] < list of files, one a line

#include "engine/core/log.h"
#include "engine/io/files/sha256.h"
#include "engine/io/import/scene_import.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

namespace {

/// Processor time of this process and of the ended child processes, s.
double processorTime() {
    double seconds = 0.0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime}) {
            seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return seconds;
}

long peakKib(int who) {
    rusage usage{};
    getrusage(who, &usage);
    return usage.ru_maxrss;
}

template <class T>
std::string_view bytesOf(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A digest that changes with any vertex, triangle, object or texture image.
std::string digestOf(const dollytrack::Scene& scene) {
    dollytrack::Sha256 digest;
    digest.add(bytesOf(scene.positions));
    digest.add(bytesOf(scene.normals));
    digest.add(bytesOf(scene.triangles));
    for (const dollytrack::Object& object : scene.objects) {
        digest.add(object.name + ' ' + std::to_string(object.nyu40) + ' ' +
                   std::to_string(object.first_triangle) + '\n');
    }
    for (const dollytrack::Texture& texture : scene.textures) digest.add(bytesOf(texture.rgba));
    return digest.finish();
}

}  // namespace

int main(int count, char** arguments) {
    using namespace dollytrack;
    ImportOptions options;
    for (int i = 1; i < count; ++i) {
        const std::string_view next = i + 1 < count ? arguments[i + 1] : "";
        if (std::string_view(arguments[i]) == "--models") options.model_folders.emplace_back(next);
        options.in_process = options.in_process || std::string_view(arguments[i]) == "--here";
        options.use_cache = options.use_cache || std::string_view(arguments[i]) == "--cache";
    }
    for (std::string path; std::getline(std::cin, path);) {
        const auto begin = std::chrono::steady_clock::now();
        const double used = processorTime();
        const Result<Scene> scene = importScene(path, options);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
        nlohmann::json line = {{"file", path},
                               {"seconds", taken.count()},
                               {"processor_seconds", processorTime() - used},
                               {"peak_kib", peakKib(RUSAGE_SELF)},
                               {"child_peak_kib", peakKib(RUSAGE_CHILDREN)}};
        if (scene) {
            line["objects"] = scene->objects.size();
            line["triangles"] = scene->triangles.size();
            line["textures"] = scene->report.textures_found;
            line["notes"] = scene->report.notes;
            line["warnings"] = scene->report.warnings;
            line["digest"] = digestOf(*scene);
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
