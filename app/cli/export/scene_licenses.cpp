#include "app/cli/export/scene_licenses.h"

#include "engine/core/clean_lines.h"
#include "engine/core/clean_text.h"
#include "engine/core/log.h"
#include "engine/core/name_pattern.h"
#include "engine/io/files/guarded_folder.h"
#include "render/formats/tables/dataset_card.h"

#include <fmt/format.h>

#include <set>
#include <system_error>
#include <utility>

namespace dollytrack::cli {
namespace {

namespace fs = std::filesystem;

bool isLicenseFile(const std::string& name) {
    static const std::set<std::string> kStems = {"license",  "licenses", "licence",
                                                 "licences", "copying",  "attribution"};
    static const std::set<std::string> kEndings = {"", ".txt", ".md"};
    const fs::path path = inSmallLetters(name);
    return kStems.contains(path.stem().string()) && kEndings.contains(path.extension().string());
}

/// Collects the texts, with warnings of those that are left out.
class LicenseTexts {
  public:
    explicit LicenseTexts(const fs::path& dataset) : dataset_(dataset) {}

    /// The licence files at the top of a folder, in the order of their names.
    void addFolder(const fs::path& path) {
        const auto folder = GuardedFolder::open(path);
        const auto names = folder.and_then([](const GuardedFolder& open) { return open.list(""); });
        if (!names) return warnOfAll(path, names.error());
        std::error_code error;
        const bool is_dataset = fs::equivalent(path, dataset_, error);
        for (const std::string& name : *names) {
            if (!isLicenseFile(name)) continue;
            if (is_dataset) {
                in_dataset_ = true;
                warn(path / name,
                     "left out of the dataset, whose folder contains it; export into another "
                     "folder");
                continue;
            }
            // A link may lead to a private file, which would be published.
            const auto text = folder->openInput(name).and_then(
                [](const InputFile& file) { return file.readAll(render::kMostLicenseBytes); });
            if (text) {
                add(path / name, *text);
            } else {
                warn(path / name,
                     "left out of the dataset: it is a link, too large or unreadable; replace it "
                     "by a readable file below 1 MB");
            }
        }
    }

    /// Nothing if the dataset's folder contains licence files, which LICENSES might replace.
    [[nodiscard]] std::string take() { return in_dataset_ ? std::string() : std::move(all_); }

  private:
    static void warn(const fs::path& file, const char* what) {
        log::warn("export", fmt::format("{}: {}", cleanText(file.string()), what));
    }

    static void warnOfAll(const fs::path& path, const Error& error) {
        log::warn("export", fmt::format("{}: its licences are not in the dataset: {}",
                                        cleanText(path.string()), describe(error)));
    }

    void add(const fs::path& file, const std::string& text) {
        const std::string clean = cleanLines(text);
        if (known_.contains(clean)) return;
        if (all_.size() + clean.size() + 2 > render::kMostLicenseBytes) {
            warn(file,
                 "left out of the dataset: all licence files together exceed 1 MB; shorten them");
            return;
        }
        known_.insert(clean);
        constexpr const char* kReplaced = "\uFFFD";
        if (clean.find(kReplaced) != std::string::npos &&
            text.find(kReplaced) == std::string::npos) {
            warn(file, "some characters are not UTF-8 and are replaced; save the file as UTF-8");
        }
        if (!all_.empty() && !clean.empty()) all_ += all_.ends_with('\n') ? "\n" : "\n\n";
        all_ += clean;
    }

    const fs::path& dataset_;
    bool in_dataset_ = false;  // the dataset's folder contains a licence file
    std::string all_;
    std::set<std::string> known_;
};

}  // namespace

std::string licensesOf(const fs::path& scene, const std::vector<fs::path>& model_folders,
                       const fs::path& dataset) {
    LicenseTexts texts(dataset);
    texts.addFolder(scene.has_parent_path() ? scene.parent_path() : ".");
    // Archives are opened only in the sandboxed importer, because libzip may crash on them.
    for (const fs::path& models : model_folders) {
        std::error_code error;
        if (!fs::is_regular_file(models, error)) texts.addFolder(models);
    }
    return texts.take();
}

}  // namespace dollytrack::cli
