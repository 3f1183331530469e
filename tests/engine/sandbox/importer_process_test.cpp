#include "engine/io/sandbox/importer_process.h"
#include "engine/io/sandbox/scene_serialization.h"
#include "engine/io/sandbox/shared_memory.h"
#include "tests/support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

namespace dollytrack::importer_process_test {
namespace {

using test::TempFolder;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST(SharedMemory, IsSealedOnceNobodyHasItMappedForWriting) {
    Result<SharedMemory> memory = SharedMemory::make(1);
    ASSERT_TRUE(memory) << memory.error().message;
    const auto map = [&] {
        return ::mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_SHARED, memory->descriptor(), 0);
    };
    void* view = map();
    ASSERT_NE(view, MAP_FAILED);
    *static_cast<std::uint8_t*>(view) = 7;
    std::thread later([view] {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        ::munmap(view, 1);
    });
    const auto bytes = memory->close(1);
    later.join();
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(bytes->front(), 7);
    EXPECT_EQ(map(), MAP_FAILED);
}

TEST(ImporterProcess, HandsASceneBackWithWhatItRead) {
    const TempFolder folder;
    EXPECT_FALSE(folder.write("room.mtl", "newmtl oak\nmap_Kd gone.png\n").empty());
    const auto path =
        folder.write("room.obj", std::string("mtllib room.mtl\nusemtl oak\n") + kTriangle);
    const auto back = runImporterProcess(path, {}, {});
    ASSERT_TRUE(back) << back.error().message;
    bool damaged = true;
    const auto scene = deserializeScene(back->serialized, damaged);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->raw.parts.size(), 1U);
    EXPECT_EQ(scene->textures.missing, std::vector<std::string>{"gone.png"});
    ASSERT_TRUE(back->inputs);
    const auto asked = [&](InputUse::Kind kind, const std::string& name) {
        return std::any_of(back->inputs->begin(), back->inputs->end(), [&](const auto& use) {
            return use.kind == kind && use.path == folder.path() / name;
        });
    };
    EXPECT_TRUE(asked(InputUse::File, "room.obj"));
    EXPECT_TRUE(asked(InputUse::File, "room.mtl"));
    EXPECT_TRUE(asked(InputUse::Missing, "gone.png"));
    EXPECT_FALSE(asked(InputUse::File, "gone.png"));
}

// A chain of nodes deeper than the reader's stack allows.
TEST(ImporterProcess, ItsCrashIsAnError) {
    const TempFolder folder;
    std::string text =
        R"(<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>)"
        R"(<library_visual_scenes><visual_scene id="s">)";
    for (int i = 0; i < 30'000; ++i) text += "<node>";
    for (int i = 0; i < 30'000; ++i) text += "</node>";
    text +=
        R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>)"
        R"(</COLLADA>)";
    const auto back = runImporterProcess(folder.write("chain.dae", text), {}, {});
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().code, ErrorCode::BadInput);
    // A sanitizer catches the signal and ends the process itself.
#if defined(__SANITIZE_ADDRESS__)
    constexpr const char* kEnd = "exit code 1";
#elif defined(__SANITIZE_THREAD__)
    constexpr const char* kEnd = "exit code 66";
#else
    constexpr const char* kEnd = "crashed (signal 11)";
#endif
    EXPECT_NE(back.error().message.find(kEnd), std::string::npos) << back.error().message;
    EXPECT_TRUE(back.error().where.ends_with("chain.dae")) << back.error().where;
}

TEST(ImporterProcess, CancellingEndsIt) {
    const TempFolder folder;
    std::string text;
    for (int i = 0; i < 300'000; ++i) text += kTriangle;
    const auto path = folder.write("large.obj", text);
    const auto cancelled = std::make_shared<std::atomic<bool>>(true);
    const auto back = runImporterProcess(path, {}, JobContext(cancelled, {}));
    ASSERT_FALSE(back);
    EXPECT_EQ(back.error().code, ErrorCode::Cancelled);
}

TEST(ImporterProcess, ForwardsProgress) {
    const TempFolder folder;
    double last = -1.0;
    const JobContext job(nullptr, [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        last = fraction;
    });
    ASSERT_TRUE(runImporterProcess(folder.write("room.obj", kTriangle), {}, job));
    EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace dollytrack::importer_process_test
