#include "app/editor/export/export_note.h"
#include "app/editor/files/owner_mark.h"
#include "engine/io/settings/project_file.h"
#include "tests/app/editor/parts/fake_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>
#include <map>

// Exports that a killed editor leaves to the next one.
namespace dollytrack::editor::export_recovery_test {
namespace {

namespace fs = std::filesystem;
using fixture::contentOf;
using fixture::endOf;
using fixture::eventually;
using fixture::FakeProgram;
using fixture::kFinish;
using ui::ExportState;

// Snapshots of a killed editor would otherwise stay forever; those of a running one are in use.
TEST(ExportRecovery, RemovesWhatDeadEditorsLeft) {
    const FakeProgram program(kFinish);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) _exit(0);
    waitpid(child, nullptr, 0);
    const fs::path folder = program.file("snapshots");
    fs::create_directories(folder);
    const auto put = [&](const std::string& name) {
        std::ofstream(folder / name) << "{}";
        return folder / name;
    };
    const std::string dead = std::to_string(child) + "-77";
    const fs::path of_dead = put("export-" + dead + "-1.dolly");
    const fs::path half = put("export-" + dead + "-2.dolly.tmp.5");
    // The same process number, but another process: ours started later.
    const fs::path reused = put("export-" + std::to_string(getpid()) + "-1-1.dolly");
    const OwnerMark self(folder);
    const fs::path of_living = put("export-" + self.text() + "-99.dolly");
    const fs::path foreign = put("room.dolly");
    const ExportQueue queue(folder, program.path());
    EXPECT_TRUE(eventually(
        [&] { return !fs::exists(of_dead) && !fs::exists(half) && !fs::exists(reused); }));
    EXPECT_TRUE(fs::exists(of_living));
    EXPECT_TRUE(fs::exists(foreign));
}

/// Runs an editor that queues one export of its own snapshot and one of a project file, and is
/// killed when the first has reported two frames.
void exportAndDie(const FakeProgram& program) {
    const pid_t editor = fork();
    ASSERT_GE(editor, 0);
    if (editor == 0) {
        ExportQueue queue(program.file("snapshots"), program.path());
        const auto project = std::make_shared<ProjectFile>();
        project->scene = program.file("room.obj");
        ui::ExportRequest request = program.request("room");
        request.range = "0:8:1";
        request.modalities = {"rgb"};
        request.formats = {"coco"};
        request.overwrite = true;
        request.rig = "cameras.json";
        queue.add(request, project);
        queue.addFile(program.request("other"), "/some/other.dolly");
        const auto noted = [&] {
            int frames = 0;
            int notes = 0;
            std::error_code not_yet;
            for (const auto& entry : fs::directory_iterator(program.file("snapshots"), not_yet)) {
                if (entry.path().extension() != ".json") continue;
                const Result<ExportNote> note = readNote(entry.path());
                ++notes;
                if (note) frames += note->frames_done;
            }
            return notes == 2 && frames == 2;
        };
        const bool reached = eventually(noted);
        kill(getpid(), reached ? SIGKILL : SIGABRT);
    }
    int status = 0;
    waitpid(editor, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

TEST(ExportRecovery, OffersWhatAKilledEditorLeft) {
    const FakeProgram program(
        "[ -e \"$out/../go\" ] || {\n"
        "echo '{\"stage\":\"rendering\",\"frames_done\":2,\"frames\":8}' >&2\n"
        "while true; do sleep 0.05; done; }\n" +
        std::string(kFinish));
    exportAndDie(program);
    std::ofstream(program.file("go")) << "";
    ExportQueue queue(program.file("snapshots"), program.path());
    ASSERT_TRUE(eventually([&] { return queue.jobs().size() == 2; }));
    std::vector<int> found;
    eventually([&] {
        for (const ExportQueue::Found& one : queue.takeFound()) {
            found.push_back(one.job.id);
            EXPECT_TRUE(one.editor_died);
        }
        return found.size() == 2;
    });
    ASSERT_EQ(found.size(), 2U);
    EXPECT_TRUE(queue.takeFound().empty()) << "once";
    std::map<std::string, ui::ExportJob> jobs;
    for (const ui::ExportJob& job : queue.jobs()) jobs[job.request.name] = job;
    EXPECT_EQ(jobs["room"].state, ExportState::Cancelled);
    EXPECT_EQ(jobs["room"].frames_done, 2);
    EXPECT_EQ(jobs["room"].frames, 8);
    EXPECT_EQ(jobs["other"].frames_done, 0);
    EXPECT_EQ(queue.unfinished(), 0) << "nothing begins unasked";
    for (const int id : found) {
        queue.resume(id);
        EXPECT_EQ(endOf(queue, id), ExportState::Done);
    }
    const std::string words = contentOf(program.file("room") / "arguments");
    EXPECT_NE(words.find("--range 0:8:1 --progress json --modalities rgb --formats coco "
                         "--rig cameras.json --overwrite --resume\n"),
              std::string::npos)
        << words;
    const std::string other = contentOf(program.file("other") / "arguments");
    EXPECT_TRUE(other.starts_with("export /some/other.dolly ")) << other;
    EXPECT_EQ(other.find("--resume"), std::string::npos) << "it had not begun: " << other;
    for (const int id : found) queue.remove(id);
    for (const auto& entry : fs::directory_iterator(program.file("snapshots"))) {
        EXPECT_NE(entry.path().extension(), ".json") << entry.path();
        EXPECT_NE(entry.path().extension(), ".dolly") << entry.path();
    }
}

/// Runs `work` in another process, since the notes of a living process belong to that process.
void asEditor(const std::function<void()>& work) {
    const pid_t editor = fork();
    ASSERT_GE(editor, 0);
    if (editor == 0) {
        work();
        _exit(::testing::Test::HasFailure() ? 1 : 0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(editor, &status, 0), editor);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

// A cancelled job is still in the queue, but the next editor does not ask about it.
TEST(ExportRecovery, DoesNotAskAboutWhatTheUserCancelled) {
    const FakeProgram program(
        "echo '{\"stage\":\"rendering\",\"frames_done\":2,\"frames\":8}' >&2\n"
        "exec sleep 600\n");
    asEditor([&] {
        ExportQueue queue(program.file("snapshots"), program.path());
        const int running = queue.addFile(program.request("cancelled"), "/some/a.dolly");
        const int waiting = queue.addFile(program.request("waiting"), "/some/b.dolly");
        ASSERT_TRUE(eventually([&] { return queue.jobs().front().frames_done == 2; }));
        queue.cancel(waiting);
        queue.cancel(running);
        EXPECT_EQ(endOf(queue, running), ExportState::Cancelled);
        queue.addFile(program.request("stopped"), "/some/c.dolly");
        ASSERT_TRUE(eventually([&] { return queue.jobs().back().frames_done == 2; }));
    });
    for (int i = 0; i < 2; ++i) {
        asEditor([&] {
            ExportQueue queue(program.file("snapshots"), program.path());
            ASSERT_TRUE(eventually([&] { return queue.jobs().size() == 3; }));
            std::vector<ExportQueue::Found> found;
            ASSERT_TRUE(eventually([&] {
                for (ExportQueue::Found& one : queue.takeFound()) found.push_back(std::move(one));
                return !found.empty();
            }));
            ASSERT_EQ(found.size(), 1U);
            EXPECT_EQ(found.front().job.request.name, "stopped");
            EXPECT_FALSE(found.front().editor_died);
        });
    }
}

// Two editors start at the same time: each job goes to exactly one of them.
TEST(ExportRecovery, LeavesAJobToOneOfTwoEditors) {
    const FakeProgram program(
        "echo '{\"stage\":\"rendering\",\"frames_done\":2,\"frames\":8}' >&2\n"
        "while true; do sleep 0.05; done\n");
    exportAndDie(program);
    const pid_t second = fork();
    ASSERT_GE(second, 0);
    if (second == 0) {
        std::size_t count = 0;
        {
            const ExportQueue queue(program.file("snapshots"), program.path());
            std::this_thread::sleep_for(std::chrono::seconds(1));
            count = queue.jobs().size();
        }
        _exit(static_cast<int>(count));
    }
    std::size_t ours = 0;
    {
        const ExportQueue queue(program.file("snapshots"), program.path());
        std::this_thread::sleep_for(std::chrono::seconds(1));
        ours = queue.jobs().size();
    }
    int status = 0;
    waitpid(second, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(ours + static_cast<std::size_t>(WEXITSTATUS(status)), 2U);
    // The editor that took a job also took its snapshot, so the next editor still finds both.
    EXPECT_EQ(std::ranges::count(fs::directory_iterator(program.file("snapshots")), ".dolly",
                                 [](const auto& entry) { return entry.path().extension(); }),
              1);
}

}  // namespace
}  // namespace dollytrack::editor::export_recovery_test
