#include "render/dataset/dataset_resume.h"

#include "engine/core/log.h"
#include "engine/io/files/bounded_json.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/text_file.h"
#include "engine/jobs/parallel.h"
#include "engine/plan/plan_json.h"
#include "render/gl/context.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {
namespace {

using Json = nlohmann::ordered_json;

bool isWhole(const GuardedFolder& folder, const std::string& file, const std::string& sha256) {
    const auto bytes = folder.read(file);
    return bytes && sha256Of(std::span<const std::uint8_t>(*bytes)) == sha256;
}

/// Calls check(i) for all i in parallel, in portions; reports progress and checks for cancellation
/// in between.
template <class Check>
void checkAll(std::size_t count, const JobContext& job, const Check& check) {
    constexpr std::size_t kPortion = 64;
    for (std::size_t begin = 0; begin < count && !job.cancelled(); begin += kPortion) {
        const std::size_t end = std::min(begin + kPortion, count);
        parallelFor(end - begin, [&](std::size_t i) { check(begin + i); });
        job.report(static_cast<double>(end) / static_cast<double>(count));
    }
}

/// dataset.json with its list of files apart; null values if it cannot be read.
SplitJson readCard(const DatasetFolder& folder) {
    const Result<InputFile> file = folder.folder().openInput(kCardFile);
    if (!file) return {};
    const Result<std::string> text = file->readAll(kMostTextBytes);
    return text ? parseSplitJson(*text, kCardFile, "files").value_or(SplitJson{}) : SplitJson{};
}

tl::unexpected<Error> damaged(const DatasetFolder& folder, const std::string& file,
                              std::size_t count) {
    return fail(ErrorCode::BadInput,
                "the dataset is complete, but " +
                    (count == 1 ? std::string("this file is")
                                : "this and " + std::to_string(count - 1) + " more files are") +
                    " missing or damaged; export it again with --overwrite instead of --resume",
                (folder.path() / file).string());
}

/// The journal's frames whose files all exist and are intact. Incomplete if cancelled.
std::map<int, JournalEntry> wholeFrames(const DatasetFolder& folder,
                                        std::map<int, JournalEntry> entries,
                                        const JobContext& job) {
    std::vector<const JournalEntry*> list;
    for (const auto& [index, entry] : entries) list.push_back(&entry);
    std::vector<char> whole(list.size(), 0);
    checkAll(list.size(), job, [&](std::size_t i) {
        const auto& hashes = list[i]->sha256s;
        whole[i] = std::all_of(hashes.begin(), hashes.end(), [&](const auto& file) {
            return isWhole(folder.unfinished(), file.first, file.second);
        });
    });
    std::size_t i = 0;
    std::erase_if(entries, [&](const auto&) { return whole[i++] == 0; });
    return entries;
}

/// Compares a complete dataset with the wanted one as far as possible without rendering.
Result<RecordedResults> checkComplete(const DatasetFolder& folder, const DatasetOrder& order,
                                      const JobContext& job) {
    const auto [found, listed] = readCard(folder);
    if (!found.is_object()) return damaged(folder, "dataset.json", 1);
    std::string differing;
    const Json expected = datasetCardJson(order.contents, order.card);
    for (const auto& [name, value] : expected.items()) {
        // These result from the images; all other fields determine them.
        if (name == "files" || name == "metrics") continue;
        if (!found.contains(name) || found[name] != value) {
            differing += (differing.empty() ? "" : ", ") + name;
        }
    }
    const std::string licenses =
        order.card.licenses.empty() ? "" : sha256Of(std::string_view(order.card.licenses));
    const auto hashes = listed.find("files");
    if (hashes != listed.end() && hashes->is_object() &&
        hashes->value(kLicensesFile, nlohmann::json("")) != licenses) {
        differing += (differing.empty() ? "" : ", ") + std::string(kLicensesFile);
    }
    if (!differing.empty()) {
        return fail(
            ErrorCode::Usage,
            "the folder contains another complete dataset (different: " + differing +
                "); choose another folder, or pass --overwrite instead of --resume to replace it",
            folder.path().string());
    }
    try {
        std::vector<std::pair<std::string, std::string>> files;
        for (const auto& [file, hash] : listed.at("files").items()) {
            files.emplace_back(file, hash.get<std::string>());
        }
        std::vector<char> whole(files.size(), 0);
        checkAll(files.size(), job, [&](std::size_t i) {
            whole[i] = isWhole(folder.folder(), files[i].first, files[i].second);
        });
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
        const auto first = std::find(whole.begin(), whole.end(), 0);
        if (first != whole.end()) {
            return damaged(folder, files[first - whole.begin()].first,
                           static_cast<std::size_t>(std::count(whole.begin(), whole.end(), 0)));
        }
        const Json& metrics = found.at("metrics");
        const Result<CaptureMetrics> captures = captureMetricsFromJson(metrics.at("counted"));
        if (!captures) return damaged(folder, "dataset.json", 1);
        RecordedResults counted{*captures, {}};
        if (metrics.contains("pictures")) {  // older datasets lack it
            counted.pictures = pictureTallyFrom(metrics["pictures"]);
        }
        return counted;
    } catch (const nlohmann::json::exception&) {
        return damaged(folder, "dataset.json", 1);
    }
}

}  // namespace

std::set<std::string> filesOf(const std::map<int, JournalEntry>& entries) {
    std::set<std::string> files;
    for (const auto& [index, entry] : entries) {
        for (const auto& [file, hash] : entry.sha256s) files.insert(file);
    }
    return files;
}

Result<EarlierExport> findEarlierExport(const DatasetFolder& folder, const DatasetOrder& order,
                                        const DatasetIdentity& identity, const JobContext& job) {
    EarlierExport earlier;
    JournalContents& journal = earlier.journal;
    journal = readJournal(folder.folder());
    const bool begun = journal.identity.has_value();
    if (folder.isComplete() && !(begun && folder.isStaged())) {
        const Result<RecordedResults> counted = checkComplete(folder, order, job);
        if (counted) {
            log::info("export", "the dataset in the folder is complete and undamaged");
            earlier.complete = *counted;
            return earlier;
        }
        // With a journal, an export that was to replace it was interrupted before its first frame.
        if (!begun || counted.error().code == ErrorCode::Cancelled) {
            return tl::unexpected(counted.error());
        }
        journal.entries.clear();
    }
    if (!begun) {
        log::info("export", "there is nothing to resume in the folder; starting a new export");
        return EarlierExport{};
    }
    if (*journal.identity != identity) {
        return fail(ErrorCode::Usage,
                    "the folder contains another unfinished dataset (different: " +
                        differences(*journal.identity, identity) +
                        "); resume it with its original arguments, or leave out --resume to start "
                        "a new export (with --overwrite beside a complete dataset)",
                    folder.path().string());
    }
    // Not an error, but the bytes may differ from those of a single run.
    if (journal.drawn_by != gl::rendererName()) {
        log::warn("export", "the finished frames were rendered by " + journal.drawn_by +
                                ", the others will be by " + gl::rendererName() +
                                "; colours may differ slightly");
    }
    const int count = static_cast<int>(order.contents.frames.size());
    std::erase_if(journal.entries,
                  [&](const auto& one) { return one.first < 0 || one.first >= count; });
    const std::size_t listed = journal.entries.size();
    journal.entries = wholeFrames(folder, std::move(journal.entries), job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "the export was cancelled");
    const std::size_t found = journal.entries.size();
    log::info("export", "resuming: " + std::to_string(found) + " of " + std::to_string(count) +
                            " frames are done");
    if (found < listed) {
        log::warn("export", "missing or damaged, rendered again: " +
                                std::to_string(listed - found) + " of the finished frames");
    }
    return earlier;
}

}  // namespace dollytrack::render
