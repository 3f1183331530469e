#include "app/cli/command_line.h"
#include "app/cli/export/dataset_scene.h"
#include "app/cli/export/room_exports.h"
#include "app/cli/terminal/output_file.h"
#include "app/view/dataset_page.h"
#include "engine/core/log.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;

struct ViewArguments {
    std::string folder;
    std::string out;  // empty: beside the dataset
    std::string three = view::kThreeFolder;
    DatasetSceneArguments scene;
    bool overwrite = false;
};

/// The path of the page: --out, by default DATASET.html beside the dataset.
fs::path pageFile(const ViewArguments& arguments) {
    return arguments.out.empty() ? fileBeside(arguments.folder, ".html") : fs::path(arguments.out);
}

std::string picturesText(const view::DatasetPage& page) {
    return page.pictures_of_frames == 0
               ? "no images"
               : fmt::format("images of {} frames, {} px wide", page.pictures_of_frames,
                             page.picture_width_px);
}

Result<ExitCode> runView(const ViewArguments& arguments, const Session& session) {
    const JobContext job = session.job();
    if (const Status status = refuseRooms(arguments.folder); !status) {
        return tl::unexpected(status.error());
    }
    const auto dataset = verify::readStoredDataset(arguments.folder);
    if (!dataset) return tl::unexpected(dataset.error());
    const fs::path file = pageFile(arguments);
    const Result<GuardedFolder> folder = openPageFolder(file, arguments.overwrite);
    if (!folder) return tl::unexpected(folder.error());
    DatasetSceneArguments asked = arguments.scene;
    asked.with_textures = true;
    const auto scene = openDatasetScene(*dataset, asked, job.stage(0.0, 0.4, "loading"));
    if (!scene) return tl::unexpected(scene.error());
    if (!scene->scene) {
        log::warn("view", fmt::format("The page shows the frames without the scene's geometry: {}.",
                                      scene->missing));
    }
    const view::PageOrder order{*dataset, scene->scene.get(), scene->rays.get(), scene->missing,
                                arguments.three};
    const auto page = view::makeDatasetPage(order, job.stage(0.4, 1.0, "page"));
    if (!page) return tl::unexpected(page.error());
    if (page->unreadable_pictures > 0) {
        log::warn("view", fmt::format("Missing or damaged images in the dataset: {}; 'dollytrack "
                                      "verify' names them.",
                                      page->unreadable_pictures));
    }
    const Status written = folder->write(file.filename().string(), page->html);
    if (!written) return tl::unexpected(written.error());
    fmt::print("{}: {:.1f} MB, {} frames, {} triangles, {}\n", file.string(),
               static_cast<double>(page->html.size()) / 1e6, dataset->frames.size(),
               page->triangles, picturesText(*page));
    return kDone;
}

}  // namespace

void addViewCommand(CLI::App& app, Session& session) {
    CLI::App* command = app.add_subcommand(
        "view", "Make one web page that shows a dataset in 3D, its frames and its objects");
    auto arguments = std::make_shared<ViewArguments>();
    command->add_option("dataset", arguments->folder, "Folder of a dataset")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("-o,--out", arguments->out,
                     "File name of the page; default: DATASET.html beside the dataset")
        ->type_name("FILE");
    command->add_flag("--overwrite", arguments->overwrite, "Replace a file of that name");
    addDatasetSceneArguments(*command, arguments->scene);
    command
        ->add_option("--three", arguments->three,
                     "Folder of three.js; default: where Debian's package libjs-three installs it")
        ->capture_default_str()
        ->type_name("DIR");
    command->footer(
        "The page is one file below 10 MB. It opens in any browser, from disk or from a server, "
        "and\nneeds no network. The scene is searched for as in 'verify'; if it is not found, the "
        "page\nshows only boxes and trajectory, with a note. The same dataset gives the same "
        "bytes.\nExample: dollytrack view dataset -o page.html");
    command->callback([&session, arguments] {
        session.action = [&session, arguments] { return runView(*arguments, session); };
    });
}

}  // namespace dollytrack::cli
