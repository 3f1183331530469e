#include "render/dataset/folder/dataset_listing.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/text_file.h"
#include "render/formats/tables/dataset_card.h"
#include "render/formats/tables/fold_files.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace dollytrack::render {
namespace {

using nlohmann::json;

/// Matches 000000.png, 000000_000001.flo, EuRoC images named by 19-digit times, and temporary
/// files of a killed run (000000.png.tmp.123).
bool isFrameFile(const std::string& name, int frames) {
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    int number = 0;
    const auto read = std::from_chars(name.data(), name.data() + digits, number);
    constexpr std::size_t kTimeDigits = 19;
    return digits >= 6 && digits < name.size() && (name[digits] == '.' || name[digits] == '_') &&
           (digits == kTimeDigits || (read.ec == std::errc() && number < frames));
}

/// Parses the parts that `keep` accepts; discarded if it is not JSON.
template <class Keep>
Result<json> parseCard(const GuardedFolder& folder, const std::string& card, const Keep& keep) {
    const Result<InputFile> file = folder.openInput(card);
    if (!file) return tl::unexpected(file.error());
    const Result<std::string> text = file->readAll(kMostTextBytes);
    if (!text) {
        return fail(ErrorCode::CannotWrite, "dataset.json cannot be read; choose another folder",
                    (folder.path() / card).string());
    }
    return parseBoundedJson<json>(*text, card, keep).value_or(json(json::value_t::discarded));
}

}  // namespace

DatasetNames namesOf(const ModalitySet& modalities, const FormatSet& formats, int frames,
                     const std::vector<std::string>& folders) {
    DatasetNames names;
    names.frames = frames;
    names.folders.insert(folders.begin(), folders.end());
    names.folders.insert(kFoldFolder);
    for (const Modality* modality : modalities) names.folders.insert(modality->name);
    names.files = {kCardFile, "contact_sheet.jpg"};
    for (const Format* format : formats) {
        names.folders.insert(format->folders.begin(), format->folders.end());
        names.files.insert(format->files.begin(), format->files.end());
    }
    return names;
}

json toJson(const DatasetNames& names) {
    return {{"frames", names.frames}, {"folders", names.folders}, {"files", names.files}};
}

DatasetNames datasetNamesFrom(const json& value) {
    DatasetNames names;
    names.frames = value.at("frames").get<int>();
    names.folders = value.at("folders").get<std::set<std::string>>();
    names.files = value.at("files").get<std::set<std::string>>();
    const auto leads_out = [](const std::string& name) { return !GuardedFolder::isPlain(name); };
    std::erase_if(names.folders, leads_out);
    std::erase_if(names.files, leads_out);
    return names;
}

Result<std::vector<std::string>> filesNamed(const GuardedFolder& folder,
                                            const DatasetNames& names) {
    std::vector<std::string> files;
    for (const std::string& wanted : names.files) {
        const std::size_t slash = wanted.rfind('/');
        const std::string within = slash == std::string::npos ? "" : wanted.substr(0, slash);
        const std::string prefix = slash == std::string::npos ? "" : wanted.substr(0, slash + 1);
        const Result<std::vector<std::string>> found = folder.list(within);
        if (!found) return found;
        for (const std::string& name : *found) {
            const std::string path = prefix + name;
            if (completedName(path) == wanted) files.push_back(path);
        }
    }
    for (const std::string& subfolder : names.folders) {
        const Result<std::vector<std::string>> found = folder.list(subfolder);
        if (!found) return found;
        for (const std::string& name : *found) {
            const bool fold = subfolder == kFoldFolder && isFoldFile(name);
            if (fold || isFrameFile(name, names.frames)) files.push_back(subfolder + "/" + name);
        }
    }
    // dataset.json comes first, because it declares the others complete.
    std::ranges::stable_partition(files, [](const std::string& file) { return file == kCardFile; });
    return files;
}

Result<bool> hasOurCard(const GuardedFolder& folder) {
    if (!folder.has(kCardFile)) return false;
    // A foreign file may be huge, so only its `format` is kept.
    const Result<json> card = parseCard(folder, kCardFile, onlyField("format"));
    if (!card) return tl::unexpected(card.error());
    return card->is_object() && card->contains("format") && (*card)["format"] == kDatasetFormat;
}

std::size_t framesListed(const GuardedFolder& folder) {
    std::size_t count = 0;
    std::string section;
    const Result<json> card =
        parseCard(folder, kCardFile, [&](int depth, json::parse_event_t event, json& parsed) {
            if (depth == 1 && event == json::parse_event_t::key) {
                section = parsed.get<std::string>();
            }
            const bool begins = event == json::parse_event_t::object_start;
            if (begins && depth == 2 && section == "frames") ++count;
            return depth < 2;
        });
    return card && !card->is_discarded() ? count : 0;
}

Result<std::set<std::string>> filesListed(const GuardedFolder& folder, const std::string& card) {
    const Result<json> found = parseCard(folder, card, onlyField("files"));
    if (!found) return tl::unexpected(found.error());
    std::set<std::string> files;
    if (!found->is_object() || !found->contains("files")) return files;
    for (const auto& [name, hash] : found->at("files").items()) {
        if (GuardedFolder::isPlain(name)) files.insert(name);
    }
    return files;
}

}  // namespace dollytrack::render
