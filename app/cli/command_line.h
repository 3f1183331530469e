#pragma once

#include "app/cli/exit_code.h"
#include "engine/core/result.h"
#include "engine/jobs/job.h"

#include <atomic>
#include <functional>
#include <memory>

namespace CLI {
class App;
}

namespace dollytrack::cli {

class ProgressLines;

/// State shared by all subcommands. Parsing a subcommand stores its work in `action`.
struct Session {
    std::shared_ptr<std::atomic<bool>> cancelled = std::make_shared<std::atomic<bool>>(false);
    std::function<Result<ExitCode>()> action;
    bool quiet = false;
    int threads = 0;                       // value of --threads; 0: one per core
    std::shared_ptr<ProgressLines> lines;  // set for --progress json

    /// A job context that shows progress on stderr (a bar unless `quiet`, or JSON lines) and is
    /// cancelled by Ctrl-C.
    [[nodiscard]] JobContext job() const;
};

void addInfoCommand(CLI::App& app, Session& session);
void addPlanCommand(CLI::App& app, Session& session);
void addCompareCommand(CLI::App& app, Session& session);
void addSweepCommand(CLI::App& app, Session& session);
void addEditCommand(CLI::App& app, Session& session);
void addRepairCommand(CLI::App& app, Session& session);
void addExportCommand(CLI::App& app, Session& session);
void addVerifyCommand(CLI::App& app, Session& session);
void addViewCommand(CLI::App& app, Session& session);
void addStatisticsCommand(CLI::App& app, Session& session);
void addEvaluateCommand(CLI::App& app, Session& session);
void addBatchCommand(CLI::App& app, Session& session);
void addGatherCommand(CLI::App& app, Session& session);
void addGenerateCommand(CLI::App& app, Session& session);
void addParamsCommand(CLI::App& app, Session& session);

}  // namespace dollytrack::cli
