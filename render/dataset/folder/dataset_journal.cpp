#include "render/dataset/folder/dataset_journal.h"

#include "engine/io/files/bounded_json.h"
#include "engine/io/files/durable_file.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/sha256.h"

#include <fcntl.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <optional>
#include <string>
#include <utility>

namespace dollytrack::render {
namespace {

using nlohmann::json;

constexpr int kVersion = 3;
constexpr auto kSyncEvery = std::chrono::seconds(2);
constexpr std::size_t kChecksum = 16;  // hexadecimal digits

std::string lineOf(const std::string& text) {
    return sha256Of(std::string_view(text)).substr(0, kChecksum) + " " + text + "\n";
}

/// The JSON of a line; null if its checksum is wrong.
json readLine(std::string_view line) {
    if (line.size() <= kChecksum + 1) return {};
    const std::string_view text = line.substr(kChecksum + 1);
    if (line.compare(0, kChecksum, sha256Of(text), 0, kChecksum) != 0) return {};
    return parseBoundedJson(text, "").value_or(json());
}

/// Reads a file line by line in portions. Reading stops at an overlong line and at a torn last
/// line, which has no line end.
class JournalLines {
  public:
    explicit JournalLines(const GuardedFolder& folder) : file_(folder.openInput(kJournalFile)) {}

    /// The next line, valid until the next call; none at the end.
    std::optional<std::string_view> next() {
        for (std::size_t searched = begin_;;) {
            const std::size_t end = text_.find('\n', searched);
            if (end != std::string::npos) {
                const std::size_t begin = std::exchange(begin_, end + 1);
                return std::string_view(text_).substr(begin, end - begin);
            }
            text_.erase(0, std::exchange(begin_, 0));
            searched = text_.size();
            if (!file_ || searched > kLongestLine) return std::nullopt;
            text_.resize(searched + kPortion);
            const std::size_t got = file_->read(read_, text_.data() + searched, kPortion);
            text_.resize(searched + got);
            read_ += got;
            if (got == 0) return std::nullopt;
        }
    }

  private:
    static constexpr std::size_t kPortion = std::size_t{1} << 20U;        // bytes
    static constexpr std::size_t kLongestLine = std::size_t{256} << 20U;  // bytes

    Result<InputFile> file_;
    std::uint64_t read_ = 0;  // bytes read so far
    std::string text_;        // portion in memory
    std::size_t begin_ = 0;   // start of the next line in `text_`
};

json toJson(const JournalEntry& entry) {
    json masks = json::array();
    for (const ObjectMask& mask : entry.masks) {
        masks.push_back({mask.object_id, mask.area, mask.bbox, compressCounts(mask.counts)});
    }
    json instances = json::array();
    for (const InstanceInFrame& one : entry.instances) {
        instances.push_back({one.object_id, one.visible_px, one.silhouette_px, one.whole_px,
                             one.occluder, one.occluded_px, one.box, one.amodal_box});
    }
    json views = json::array();
    for (const ObjectView& view : entry.views) {
        views.push_back({view.object_id, view.visible_fraction, view.visible_px, view.box_share,
                         view.mask_share});
    }
    return {{"frame", entry.index},
            {"files", entry.sha256s},
            {"masks", std::move(masks)},
            {"instances", std::move(instances)},
            {"views", std::move(views)},
            {"well_shown", entry.well_shown},
            {"quality", entry.quality ? json(static_cast<int>(*entry.quality)) : json()}};
}

/// Throws nlohmann's exceptions.
JournalEntry entryFrom(const json& value) {
    JournalEntry entry;
    entry.index = value.at("frame").get<int>();
    entry.sha256s = value.at("files").get<std::map<std::string, std::string>>();
    for (const json& one : value.at("masks")) {
        ObjectMask mask;
        mask.object_id = one.at(0).get<int>();
        mask.area = one.at(1).get<std::uint32_t>();
        mask.bbox = one.at(2).get<std::array<int, 4>>();
        mask.counts = decompressCounts(one.at(3).get_ref<const std::string&>());
        entry.masks.push_back(std::move(mask));
    }
    for (const json& one : value.at("instances")) {
        InstanceInFrame instance;
        instance.object_id = one.at(0).get<int>();
        instance.visible_px = one.at(1).get<std::uint32_t>();
        instance.silhouette_px = one.at(2).get<std::uint32_t>();
        instance.whole_px = one.at(3).get<std::uint64_t>();
        instance.occluder = one.at(4).get<int>();
        instance.occluded_px = one.at(5).get<std::uint32_t>();
        instance.box = one.at(6).get<std::array<int, 4>>();
        instance.amodal_box = one.at(7).get<std::array<int, 4>>();
        entry.instances.push_back(instance);
    }
    for (const json& one : value.at("views")) {
        ObjectView view;
        view.object_id = one.at(0).get<int>();
        view.frame = entry.index;
        view.visible_fraction = one.at(1).get<double>();
        view.visible_px = one.at(2).get<double>();
        view.box_share = one.at(3).get<double>();
        view.mask_share = one.at(4).get<double>();
        entry.views.push_back(view);
    }
    entry.well_shown = value.at("well_shown").get<std::vector<int>>();
    if (const json& quality = value.at("quality"); !quality.is_null()) {
        entry.quality = static_cast<PictureQuality>(quality.get<int>());
    }
    return entry;
}

}  // namespace

std::string differences(const DatasetIdentity& a, const DatasetIdentity& b) {
    DatasetIdentity all = a;
    all.insert(b.begin(), b.end());
    std::string names;
    for (const auto& [name, value] : all) {
        const auto in_a = a.find(name);
        const auto in_b = b.find(name);
        if (in_a != a.end() && in_b != b.end() && in_a->second == in_b->second) continue;
        names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

JournalContents readJournal(const GuardedFolder& folder) {
    JournalContents contents;
    JournalLines lines(folder);
    while (const std::optional<std::string_view> line = lines.next()) {
        contents.whole_bytes += line->size() + 1;
        const json value = readLine(*line);
        if (!value.is_object()) continue;
        try {
            if (value.contains("identity")) {
                if (value.at("dollytrack_journal").get<int>() != kVersion) return contents;
                contents.identity = value.at("identity").get<DatasetIdentity>();
                contents.drawn_by = value.value("drawn_by", "");
                // Journals of earlier versions lack it.
                if (value.contains("writes")) {
                    contents.names = datasetNamesFrom(value.at("writes"));
                }
            } else {
                JournalEntry entry = entryFrom(value);
                const bool known = !entry.quality || static_cast<std::size_t>(*entry.quality) <
                                                         kPictureQualities.size();
                if (!known) continue;
                const int index = entry.index;
                contents.entries.insert_or_assign(index, std::move(entry));  // the later entry is
                                                                             // valid
            }
        } catch (const json::exception&) {
            continue;
        }
    }
    return contents;
}

DatasetJournal::DatasetJournal(std::filesystem::path path, FileDescriptor file,
                               std::uint64_t length)
    : path_(std::move(path)),
      file_(std::move(file)),
      length_(length),
      synced_(std::chrono::steady_clock::now()) {}

Result<DatasetJournal> DatasetJournal::open(const GuardedFolder& folder, std::uint64_t length) {
    const std::filesystem::path path = folder.path() / kJournalFile;
    Result<FileDescriptor> file = folder.openFile(kJournalFile, O_WRONLY | O_CREAT | O_APPEND);
    if (!file) return tl::unexpected(file.error());
    if (::ftruncate(file->get(), static_cast<off_t>(length)) != 0) {
        return tl::unexpected(writeError(errno, path));
    }
    return DatasetJournal(path, std::move(*file), length);
}

Result<DatasetJournal> DatasetJournal::begin(const GuardedFolder& folder,
                                             const DatasetIdentity& identity,
                                             const std::string& drawn_by,
                                             const DatasetNames& names) {
    Result<DatasetJournal> journal = open(folder, 0);
    if (!journal) return journal;
    const json header = {{"dollytrack_journal", kVersion},
                         {"identity", identity},
                         {"drawn_by", drawn_by},
                         {"writes", toJson(names)}};
    Status status =
        journal->appendLine(header.dump(-1, ' ', false, json::error_handler_t::replace));
    if (status) status = journal->sync();
    if (!status) return tl::unexpected(std::move(status.error()));
    return journal;
}

Result<DatasetJournal> DatasetJournal::resume(const GuardedFolder& folder,
                                              const JournalContents& contents) {
    return open(folder, contents.whole_bytes);
}

Status DatasetJournal::append(const JournalEntry& entry) {
    if (Status status = appendLine(toJson(entry).dump()); !status) return status;
    if (std::chrono::steady_clock::now() - synced_ < kSyncEvery) return {};
    return sync();
}

Status DatasetJournal::appendLine(const std::string& json) {
    const std::string line = lineOf(json);
    if (const int error = writeAll(file_.get(), line)) {
        // The part that was written must not spoil a later line.
        if (::ftruncate(file_.get(), static_cast<off_t>(length_)) != 0) {
            (void)file_.close();  // nothing may be appended to the partial line
        }
        return tl::unexpected(writeError(error, path_));
    }
    length_ += line.size();
    return {};
}

Status DatasetJournal::sync() {
    synced_ = std::chrono::steady_clock::now();
    if (::fdatasync(file_.get()) != 0 && errno != EINVAL) {
        return tl::unexpected(writeError(errno, path_));
    }
    return {};
}

}  // namespace dollytrack::render
