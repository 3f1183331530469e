#include "app/editor/export/export_queue.h"

#include "app/editor/export/export_folders.h"
#include "app/editor/export/export_note.h"
#include "app/editor/files/owner_mark.h"
#include "engine/io/settings/project_file.h"
#include "tests/app/editor/parts/fake_program.h"
#include "tests/support/obj_writer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

namespace dollytrack::editor::export_queue_test {
namespace {

namespace fs = std::filesystem;
using fixture::contentOf;
using fixture::endOf;
using fixture::eventually;
using fixture::FakeProgram;
using fixture::jobOf;
using fixture::kFinish;
using ui::ExportState;

TEST(ExportQueue, RunsTheProgramAndReadsItsProgress) {
    const FakeProgram program(
        "echo '{\"stage\":\"rendering\",\"fraction\":0.25,\"frames_done\":2,\"frames\":8,"
        "\"frames_per_s\":4.5,\"seconds_left\":1.5}' >&2\n"
        "while [ ! -e \"$out/go\" ]; do sleep 0.02; done\n" +
        std::string(kFinish));
    std::atomic<int> news = 0;
    ExportQueue queue(program.file("snapshots"), program.path(), [&] { ++news; });
    ui::ExportRequest request = program.request("room");
    request.range = "0:8:1";
    request.modalities = {"rgb", "depth"};
    request.overwrite = true;
    const int id = queue.addFile(request, "/some/room.dolly");
    ASSERT_TRUE(eventually([&] { return jobOf(queue, id).frames_done == 2; }));
    const ui::ExportJob running = jobOf(queue, id);
    EXPECT_EQ(running.state, ExportState::Running);
    EXPECT_EQ(running.stage, "rendering");
    EXPECT_EQ(running.fraction, 0.25);
    EXPECT_EQ(running.frames_per_s, 4.5);
    EXPECT_EQ(running.seconds_left, 1.5);
    std::ofstream(request.folder / "go") << "";
    EXPECT_EQ(endOf(queue, id), ExportState::Done);
    EXPECT_EQ(jobOf(queue, id).frames_done, 8);
    EXPECT_EQ(jobOf(queue, id).contact_sheet, request.folder / "contact_sheet.jpg");
    EXPECT_EQ(contentOf(request.folder / "arguments"),
              "export /some/room.dolly --out " + request.folder.string() +
                  " --range 0:8:1 --progress json --modalities rgb,depth --overwrite\n");
    EXPECT_GT(news, 2);
}

struct BadEnding {
    const char* what;
    const char* script;
    const char* says;  // part of the error
};

class ExportQueueEndings : public testing::TestWithParam<BadEnding> {};

TEST_P(ExportQueueEndings, AreFailuresWithAReason) {
    const FakeProgram program(GetParam().script);
    ExportQueue queue(program.file("snapshots"), program.path());
    const int id = queue.addFile(program.request("room"), "room.dolly");
    EXPECT_EQ(endOf(queue, id), ExportState::Failed);
    const std::string message = jobOf(queue, id).error.message;
    EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
    // The next job runs all the same.
    const int next = queue.addFile(program.request("other"), "room.dolly");
    EXPECT_EQ(endOf(queue, next), ExportState::Failed);
}

INSTANTIATE_TEST_SUITE_P(
    , ExportQueueEndings,
    testing::Values(
        BadEnding{"Error",
                  "echo '{\"error\":{\"code\":\"cannot_write\",\"message\":\"The disk is full.\","
                  "\"where\":\"x\"}}' >&2; exit 6",
                  "The disk is full."},
        BadEnding{"Crash", "kill -SEGV $$", "ended by the system (Segmentation fault)"},
        BadEnding{"Silence", "exit 0", "ended without finishing"},
        BadEnding{"SilenceOverAnEarlierDataset", "touch \"$out/dataset.json\"",
                  "ended without finishing"},
        BadEnding{"EmptyPromise", "echo '{\"done\":true}' >&2", "ended without finishing"},
        BadEnding{"SilentFailure", "exit 1", "exit code 1"},
        BadEnding{"Garbage",
                  "head -c 300000 /dev/zero | tr '\\0' x >&2; echo >&2; "
                  "echo '{\"fraction\":\"many\",\"frames\":-5,\"stage\":7}' >&2; "
                  "echo '[1,2' >&2; echo '{\"error\":5}' >&2; echo 'last words' >&2; exit 1",
                  "Its last message: last words"},
        BadEnding{"ClosedEar", "exec 2>&-; sleep 0.3; exit 1", "exit code 1"}),
    [](const auto& tested) { return std::string(tested.param.what); });

TEST(ExportQueue, SaysWhenThereIsNoProgram) {
    const dollytrack::test::TempFolder folder;
    ExportQueue queue(folder.path(), folder.path() / "missing");
    const int id = queue.addFile({}, "room.dolly");
    EXPECT_EQ(endOf(queue, id), ExportState::Failed);
    EXPECT_NE(jobOf(queue, id).error.message.find("No such file"), std::string::npos);
}

TEST(ExportQueue, CancelsAndGoesOnWhereItEnded) {
    const FakeProgram program(
        "case \"$*\" in *--resume*) " + std::string(kFinish) +
        "; exit 0;; esac\n"
        "trap 'exit 143' TERM\n"
        "echo '{\"stage\":\"rendering\",\"fraction\":0.5,\"frames_done\":4,\"frames\":8}' >&2\n"
        "while true; do sleep 0.02; done");
    ExportQueue queue(program.file("snapshots"), program.path());
    const int id = queue.addFile(program.request("room"), "room.dolly");
    ASSERT_TRUE(eventually([&] { return jobOf(queue, id).frames_done == 4; }));
    queue.cancel(id);
    EXPECT_EQ(endOf(queue, id), ExportState::Cancelled);
    EXPECT_EQ(jobOf(queue, id).frames_done, 4);
    queue.resume(id);
    EXPECT_EQ(endOf(queue, id), ExportState::Done);
}

TEST(ExportQueue, WorksInTheOrderShownAndNotWhileHeld) {
    const FakeProgram program("echo \"$out\" >> \"$(dirname \"$out\")/order\"\n" +
                              std::string(kFinish));
    ExportQueue queue(program.file("snapshots"), program.path());
    queue.hold(true);
    const int a = queue.addFile(program.request("a"), "room.dolly");
    const int b = queue.addFile(program.request("b"), "room.dolly");
    const int c = queue.addFile(program.request("c"), "room.dolly");
    const int d = queue.addFile(program.request("d"), "room.dolly");
    queue.move(c, -1);
    queue.move(c, -1);
    queue.move(c, -1);  // already the first one
    queue.move(a, 1);
    queue.remove(d);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_FALSE(fs::exists(program.file("order")));
    EXPECT_EQ(queue.unfinished(), 3);  // waiting jobs count: closing the editor loses them
    queue.hold(false);
    for (const int id : {a, b, c}) EXPECT_EQ(endOf(queue, id), ExportState::Done);
    EXPECT_EQ(queue.unfinished(), 0);
    EXPECT_EQ(contentOf(program.file("order")), program.file("c").string() + "\n" +
                                                    program.file("b").string() + "\n" +
                                                    program.file("a").string() + "\n");
}

TEST(ExportQueue, KeepsASnapshotUntilTheJobIsRemoved) {
    const FakeProgram program(kFinish);
    ExportQueue queue(program.file("snapshots"), program.path());
    const auto project = std::make_shared<ProjectFile>();
    project->scene = program.file("room.obj");
    const int id = queue.add(program.request("room"), project);
    EXPECT_EQ(endOf(queue, id), ExportState::Done);
    const auto snapshots = [&] {
        return std::ranges::count(fs::directory_iterator(program.file("snapshots")), ".dolly",
                                  [](const auto& entry) { return entry.path().extension(); });
    };
    EXPECT_EQ(snapshots(), 1);
    queue.remove(id);
    EXPECT_EQ(snapshots(), 0);
    EXPECT_TRUE(queue.jobs().empty());
    EXPECT_TRUE(fs::exists(program.file("room") / "dataset.json"));
}

TEST(ExportQueue, TellsWhichJobWillWriteIntoAFolder) {
    const FakeProgram program(kFinish);
    ExportQueue queue(program.file("snapshots"), program.path());
    queue.hold(true);
    const int waits = queue.addFile(program.request("room"), "room.dolly");
    const auto nameOf = [&](const fs::path& folder) {
        const std::vector<ui::ExportJob> jobs = queue.jobs();
        const ui::ExportJob* job = jobThatWillWrite(folder, jobs);
        return job != nullptr ? job->request.name : "";
    };
    EXPECT_EQ(nameOf(program.file("room")), "room");
    EXPECT_EQ(nameOf(program.file("room") / ""), "room");
    EXPECT_EQ(nameOf(program.file("other") / ".." / "room"), "room");
    EXPECT_EQ(nameOf(program.file("room_2")), "");
    EXPECT_EQ(nameOf(program.file("room").parent_path()), "");
    queue.hold(false);
    EXPECT_EQ(endOf(queue, waits), ExportState::Done);
    EXPECT_EQ(nameOf(program.file("room")), "") << "what is there may be replaced";
}

// An existing file with the snapshot's name is not the project that was queued.
TEST(ExportQueue, WritesItsSnapshotOverAnotherOfThatName) {
    const FakeProgram program("cp \"$2\" \"$out/copy\"\n" + std::string(kFinish));
    const fs::path folder = program.file("snapshots");
    fs::create_directories(folder);
    std::ofstream(exportFile(folder, OwnerMark(folder).text(), 1, ".dolly")) << "old";
    ExportQueue queue(folder, program.path());
    const auto project = std::make_shared<ProjectFile>();
    project->scene = program.file("room.obj");
    const int id = queue.add(program.request("room"), project);
    EXPECT_EQ(endOf(queue, id), ExportState::Done);
    EXPECT_EQ(contentOf(program.file("room") / "copy"),
              projectText(*project, folder / "any.dolly").value());
}

// A project without a scene cannot be written: the JSON library throws.
TEST(ExportQueue, FailsAloneWhereItsSnapshotCannotBeWritten) {
    const FakeProgram program(
        "echo '{\"stage\":\"rendering\",\"frames_done\":2,\"frames\":8}' >&2\n"
        "while [ ! -e \"$out/../go\" ]; do sleep 0.02; done\n" +
        std::string(kFinish));
    const auto broken = std::make_shared<ProjectFile>();
    ExportQueue queue(program.file("snapshots"), program.path());
    const int before = queue.add(program.request("before"), broken);
    EXPECT_EQ(endOf(queue, before), ExportState::Failed);
    const int running = queue.addFile(program.request("running"), "room.dolly");
    ASSERT_TRUE(eventually([&] { return jobOf(queue, running).frames_done == 2; }));
    const int meanwhile = queue.add(program.request("meanwhile"), broken);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(jobOf(queue, running).state, ExportState::Running);
    std::ofstream(program.file("go")) << "";
    EXPECT_EQ(endOf(queue, running), ExportState::Done);
    EXPECT_EQ(endOf(queue, meanwhile), ExportState::Failed);
    EXPECT_FALSE(jobOf(queue, meanwhile).error.message.empty());
}

bool isAlive(pid_t process) {
    const std::string status = contentOf("/proc/" + std::to_string(process) + "/stat");
    // The format is "pid (name) state"; Z is a dead process that nobody has waited for.
    const std::size_t name_end = status.rfind(')');
    return name_end != std::string::npos && status[name_end + 2] != 'Z';
}

constexpr const char* kDeaf =
    "trap '' TERM INT HUP\necho $$ > \"$out/pid\"\n"
    "while true; do sleep 0.05; done";

TEST(ExportQueue, EndsEvenAProgramThatDoesNotListen) {
    const FakeProgram program(kDeaf);
    pid_t process = 0;
    const auto begin = std::chrono::steady_clock::now();
    {
        ExportQueue queue(program.file("snapshots"), program.path());
        queue.addFile(program.request("room"), "room.dolly");
        const fs::path pid = program.file("room") / "pid";
        ASSERT_TRUE(eventually([&] { return !contentOf(pid).empty(); }));
        process = std::stoi(contentOf(pid));
        ASSERT_TRUE(isAlive(process));
    }
    EXPECT_FALSE(isAlive(process));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

// A killed editor cannot clean up, so the operating system has to end its child process.
TEST(ExportQueue, LeavesNothingBehindWhenItsProgramIsKilled) {
    const FakeProgram program(kDeaf);
    const pid_t editor = fork();
    ASSERT_GE(editor, 0);
    if (editor == 0) {
        ExportQueue queue(program.file("snapshots"), program.path());
        queue.addFile(program.request("room"), "room.dolly");
        pause();
        _exit(1);
    }
    const fs::path pid = program.file("room") / "pid";
    const bool started = eventually([&] { return !contentOf(pid).empty(); });
    kill(editor, SIGKILL);
    waitpid(editor, nullptr, 0);
    ASSERT_TRUE(started);
    const pid_t process = std::stoi(contentOf(pid));
    EXPECT_TRUE(eventually([&] { return !isAlive(process); }));
    if (isAlive(process)) kill(process, SIGKILL);
}

std::map<std::string, std::string> filesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = fs::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && name.front() != '.') files[name] = contentOf(entry.path());
    }
    return files;
}

// With the real program and a room with two boxes: an export that is cancelled and continued writes
// the same files as an uninterrupted one.
TEST(ExportQueueGl, ContinuesToTheSameBytes) {
    const dollytrack::test::TempFolder folder;
    dollytrack::test::ObjWriter room;
    room.room({4, 3, 2.6}, true);
    room.object("table").box({2.6, 0.8, 0}, {3.4, 2.2, 0.74});
    room.object("sofa").box({0.1, 0.6, 0}, {0.9, 2.4, 0.7});
    const auto project = std::make_shared<ProjectFile>();
    project->scene = folder.write("room.obj", room.text());
    project->parameters = {{"camera", {{"width_px", 160}, {"height_px", 120}}}};
    ExportQueue queue(folder.path() / "snapshots", DOLLYTRACK_PROGRAM);
    const auto request = [&](const char* name) {
        ui::ExportRequest made;
        made.name = name;
        made.folder = folder.path() / name;
        made.range = "0:40:1";
        return made;
    };
    const int whole = queue.add(request("whole"), project);
    const ExportState end = endOf(queue, whole);
    if (jobOf(queue, whole).error.code == ErrorCode::NoOpenGl) GTEST_SKIP() << "no OpenGL here";
    ASSERT_EQ(end, ExportState::Done) << describe(jobOf(queue, whole).error);
    EXPECT_EQ(jobOf(queue, whole).frames_done, jobOf(queue, whole).frames);
    EXPECT_FALSE(jobOf(queue, whole).contact_sheet.empty());

    const int broken = queue.add(request("broken"), project);
    eventually([&] {
        const ui::ExportJob job = jobOf(queue, broken);
        return job.frames_done > 0 || job.state == ExportState::Done;
    });
    queue.cancel(broken);
    if (endOf(queue, broken) == ExportState::Cancelled) queue.resume(broken);
    ASSERT_EQ(endOf(queue, broken), ExportState::Done) << describe(jobOf(queue, broken).error);
    EXPECT_EQ(filesIn(folder.path() / "whole"), filesIn(folder.path() / "broken"));
}

}  // namespace
}  // namespace dollytrack::editor::export_queue_test
