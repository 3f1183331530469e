#include "engine/io/format_table/input_check.h"
#include "engine/io/import/scene_import.h"
#include "engine/io/sandbox/scene_reading.h"
#include "tests/support/obj_writer.h"
#include "tests/support/temp_folder.h"

#include <assimp/postprocess.h>
#include <benchmark/benchmark.h>
#include <assimp/Importer.hpp>

#include <cstdlib>

namespace {

using namespace dollytrack;

/// The file that DOLLYTRACK_BENCH_SCENE names, or else a room of 33,334 boxes (400,000 triangles).
const std::filesystem::path& benchScene() {
    static const test::TempFolder folder;
    static const std::filesystem::path path = [] {
        if (const char* given = std::getenv("DOLLYTRACK_BENCH_SCENE")) {
            return std::filesystem::path(given);
        }
        test::ObjWriter obj;
        obj.room({10, 10, 3}, true);
        for (int i = 0; i < 100; ++i) {
            obj.object("book_" + std::to_string(i));
            for (int k = 0; k < 334; ++k) {
                const Eigen::Vector3d low(0.1 * i, 0.02 * k, 0.0);
                obj.box(low, low + Eigen::Vector3d(0.05, 0.015, 0.2));
            }
        }
        return folder.write("room.obj", obj.text());
    }();
    return path;
}

/// The baseline: only reading the file with assimp, clean-up included.
void assimpAlone(benchmark::State& state) {
    const std::string path = benchScene().string();
    for (auto _ : state) {
        Assimp::Importer importer;
        benchmark::DoNotOptimize(importer.ReadFile(path, 0));
    }
}
BENCHMARK(assimpAlone)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Reading it with what a renderer needs: triangles, joined vertices, normals.
void assimpWithSteps(benchmark::State& state) {
    const std::string path = benchScene().string();
    for (auto _ : state) {
        Assimp::Importer importer;
        benchmark::DoNotOptimize(importer.ReadFile(path, aiProcess_Triangulate |
                                                             aiProcess_JoinIdenticalVertices |
                                                             aiProcess_GenSmoothNormals));
    }
}
BENCHMARK(assimpWithSteps)->Unit(benchmark::kMillisecond)->UseRealTime();

void importWhole(benchmark::State& state) {
    for (auto _ : state) {
        const Result<Scene> scene = importScene(benchScene());
        if (!scene) state.SkipWithError(describe(scene.error()).c_str());
    }
}
BENCHMARK(importWhole)->Unit(benchmark::kMillisecond)->UseRealTime();

void importWithoutTextures(benchmark::State& state) {
    ImportOptions options;
    options.read_textures = false;
    for (auto _ : state) {
        const Result<Scene> scene = importScene(benchScene(), options);
        if (!scene) state.SkipWithError(describe(scene.error()).c_str());
    }
}
BENCHMARK(importWithoutTextures)->Unit(benchmark::kMillisecond)->UseRealTime();

/// Imports the geometry of the file: in this process, in a separate one, or from the cache.
void readBy(benchmark::State& state, const std::filesystem::path& path,
            const ImportOptions& options) {
    const SceneFormat* format = *checkSceneFile(path);
    for (auto _ : state) {
        const auto reading = readSceneFile(*format, path, options, {});
        if (!reading) state.SkipWithError(describe(reading.error()).c_str());
    }
}

const std::filesystem::path& smallScene() {
    static const test::TempFolder folder;
    static const std::filesystem::path path = [] {
        test::ObjWriter obj;
        obj.room({4, 3, 2.5}, true);
        return folder.write("room.obj", obj.text());
    }();
    return path;
}

void readSmall(benchmark::State& state) {
    ImportOptions options;
    options.in_process = state.range(0) == 0;
    readBy(state, smallScene(), options);
}
BENCHMARK(readSmall)
    ->ArgName("isolated")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void readCached(benchmark::State& state) {
    ImportOptions options;
    options.use_cache = true;
    readBy(state, benchScene(), options);
}
BENCHMARK(readCached)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
