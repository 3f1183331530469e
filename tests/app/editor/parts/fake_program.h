#pragma once

#include "app/editor/export/export_queue.h"
#include "tests/support/temp_folder.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

// A stand-in for the export program, and functions that wait for its results.
namespace dollytrack::editor::fixture {

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Checks repeatedly, for at most a minute, whether `holds` becomes true.
inline bool eventually(const std::function<bool()>& holds) {
    for (int i = 0; i < 6000; ++i) {
        if (holds()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

/// A shell script in place of the real program. The arguments are export PROJECT --out DIR --range
/// ...
class FakeProgram {
  public:
    explicit FakeProgram(const std::string& body) {
        path_ = folder_.write("program",
                              "#!/bin/sh\nout=\"$4\"\nmkdir -p \"$out\"\n"
                              "echo \"$@\" > \"$out/arguments\"\n" +
                                  body + "\n");
        std::filesystem::permissions(path_, std::filesystem::perms::owner_all);
    }
    [[nodiscard]] std::filesystem::path path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const {
        return folder_.path() / name;
    }

    [[nodiscard]] ui::ExportRequest request(const std::string& name) const {
        ui::ExportRequest request;
        request.name = name;
        request.folder = file(name);
        return request;
    }

  private:
    dollytrack::test::TempFolder folder_;
    std::filesystem::path path_;
};

/// The body of a program that ends successfully.
inline constexpr const char* kFinish =
    "echo '{\"done\":true,\"exit_code\":0,\"frames_done\":8,\"frames\":8}' >&2\n"
    "touch \"$out/dataset.json\" \"$out/contact_sheet.jpg\"";

inline ui::ExportJob jobOf(const ExportQueue& queue, int id) {
    for (const ui::ExportJob& job : queue.jobs()) {
        if (job.id == id) return job;
    }
    return {};
}

/// Waits for a job to come to an end.
inline ui::ExportState endOf(const ExportQueue& queue, int id) {
    eventually([&] {
        const ui::ExportState state = jobOf(queue, id).state;
        return state != ui::ExportState::Waiting && state != ui::ExportState::Running &&
               state != ui::ExportState::Stopping;
    });
    return jobOf(queue, id).state;
}

}  // namespace dollytrack::editor::fixture
