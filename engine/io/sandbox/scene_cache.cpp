#include "engine/io/sandbox/scene_cache.h"

#include "engine/io/files/cache_eviction.h"
#include "engine/io/files/file_descriptor.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/guarded_folder.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/sha256.h"
#include "engine/io/files/user_cache.h"
#include "engine/io/sandbox/binary_archive.h"
#include "engine/io/sandbox/importer_process.h"
#include "engine/io/settings/import_settings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <assimp/version.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string_view>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x31454843414354'44ULL;  // "DTCACHE1"
constexpr const char* kExtension = ".scene";
constexpr const char* kDigestExtension = ".digest";
constexpr std::size_t kDigestLength = 64;

struct EntryHead {
    std::uint64_t magic = kMagic;
    std::uint64_t list_bytes = 0;  // size of the list of inputs, which follows this header
    std::uint64_t list_sum = 0;
    std::uint64_t scene_bytes = 0;  // size of the serialized scene, which follows the list
};

std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A cache file of this user, mapped for reading.
class MappedEntry {
  public:
    MappedEntry(const GuardedFolder& folder, const std::string& name) {
        Result<FileDescriptor> file = folder.openFile(name, O_RDONLY);
        struct stat status {};
        if (!file || ::fstat(file->get(), &status) != 0 || status.st_uid != ::geteuid() ||
            status.st_size <= 0) {
            return;
        }
        file_ = std::move(*file);
        size_ = static_cast<std::size_t>(status.st_size);
        void* view = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file_.get(), 0);
        if (view != MAP_FAILED) view_ = static_cast<const std::uint8_t*>(view);
    }
    ~MappedEntry() {
        if (view_ != nullptr) ::munmap(const_cast<std::uint8_t*>(view_), size_);
    }
    MappedEntry(const MappedEntry&) = delete;
    MappedEntry& operator=(const MappedEntry&) = delete;

    [[nodiscard]] std::span<const std::uint8_t> bytes() const {
        return view_ != nullptr ? std::span(view_, size_) : std::span<const std::uint8_t>();
    }
    /// Makes the entry the most recently used one.
    void touch() const { ::futimens(file_.get(), nullptr); }

  private:
    FileDescriptor file_;
    std::size_t size_ = 0;
    const std::uint8_t* view_ = nullptr;
};

struct Entry {
    std::vector<CachedInput> inputs;
    std::span<const std::uint8_t> serialized;
};

std::optional<Entry> entryIn(std::span<const std::uint8_t> bytes) {
    EntryHead head;
    if (bytes.size() < sizeof(head)) return std::nullopt;
    std::memcpy(&head, bytes.data(), sizeof(head));
    const auto rest = bytes.subspan(sizeof(head));
    if (head.magic != kMagic || head.list_bytes > rest.size() ||
        head.scene_bytes != rest.size() - head.list_bytes) {
        return std::nullopt;
    }
    const auto list = rest.first(head.list_bytes);
    if (head.list_sum != checksumOf(list)) return std::nullopt;
    auto inputs = parseCachedInputs({reinterpret_cast<const char*>(list.data()), list.size()});
    if (!inputs) return std::nullopt;
    return Entry{std::move(*inputs), rest.subspan(head.list_bytes)};
}

/// Content of a .digest file: the digest of a scene file, and a checksum of this digest and the
/// name of the .digest file, which detects changed digits and renamed files.
std::string digestText(const std::string& name, std::string_view digest) {
    return std::string(digest) + " " + sha256Of(name + std::string(digest)) + "\n";
}

FileIdentity identityOf(const fs::path& program) {
    const Result<InputFile> file = openNamedFile(program);
    return file ? file->identity() : FileIdentity{};
}

/// The file of assimp, which Debian may update independently of this program.
fs::path assimpLibrary() {
    Dl_info library{};
    const bool found = ::dladdr(reinterpret_cast<const void*>(&aiGetVersionMajor), &library) != 0;
    return found && library.dli_fname != nullptr ? library.dli_fname : "";
}

bool hasSettled(const FileIdentity& file, std::chrono::nanoseconds settled) {
    const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
    return now - std::chrono::nanoseconds(std::max(file.changed_ns, file.modified_ns)) > settled;
}

}  // namespace

std::optional<SceneCache> SceneCache::ofUser() {
    std::optional<UserCache> cache = userCache("scenes");
    if (!cache) return std::nullopt;
    return SceneCache(std::move(cache->folder), cache->most_bytes);
}

std::string SceneCache::keyOf(const fs::path& scene, const std::string& sha256,
                              const ImportOptions& options, const InputRoots& roots) {
    const FileIdentity importer = identityOf(importerProgram());
    const FileIdentity assimp = identityOf(assimpLibrary());
    using Json = nlohmann::json;
    const std::string settings =
        importOptionsToJson(options).dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string labels;
    if (options.labels) labels = sha256OfFile(*options.labels).value_or("");
    std::string more;
    for (std::size_t i = 1; i < roots.size(); ++i) more += roots[i].string() + '\0';
    return sha256Of(fmt::format("{} {} {} {} {}\n{}\n{}\n{}\n{}\n{}\n{}", kSerializationVersion,
                                importer.size, importer.modified_ns, assimp.size,
                                assimp.modified_ns, lowerExtension(scene), sha256,
                                options.read_textures, settings, labels, more));
}

Result<std::string> SceneCache::digestOf(const fs::path& scene, const JobContext& job) const {
    const Result<InputFile> file = openNamedFile(scene);
    if (!file) return tl::unexpected(file.error());
    const FileIdentity before = file->identity();
    const std::string name =
        sha256Of(fmt::format("{} {} {} {} {}", before.device, before.inode, before.size,
                             before.modified_ns, before.changed_ns));
    const std::string known = name + kDigestExtension;
    {
        const MappedEntry entry(folder_, known);
        const auto bytes = entry.bytes();
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const std::string_view digest = text.substr(0, kDigestLength);
        if (!text.empty() && text == digestText(name, digest)) {
            entry.touch();
            return std::string(digest);
        }
    }
    const bool settled = hasSettled(before, settled_);
    Result<std::string> digest = sha256OfFile(scene, job);
    if (!digest || !settled) return digest;
    const Result<InputFile> after = openNamedFile(scene);
    // A failed write is ignored: the next read only takes longer.
    if (after && after->identity() == before) {
        (void)folder_.write(known, digestText(name, *digest), Durability::Renamed);
    }
    return digest;
}

std::optional<DecodedScene> SceneCache::find(const std::string& key,
                                             const InputRoots& roots) const {
    const MappedEntry file(folder_, key + kExtension);
    const std::optional<Entry> entry = entryIn(file.bytes());
    if (!entry || !areUnchanged(roots, entry->inputs)) return std::nullopt;
    bool damaged = false;
    Result<DecodedScene> read = deserializeScene(entry->serialized, damaged);
    if (!read) return std::nullopt;
    file.touch();
    return std::move(*read);
}

bool SceneCache::keep(const std::string& key, const fs::path& scene, const std::string& sha256,
                      const InputRoots& roots, const std::vector<InputUse>& inputs,
                      std::span<const std::uint8_t> serialized) const {
    const auto kept = cachedInputs(scene, sha256, roots, inputs);
    if (!kept) return false;
    const std::string list = cachedInputsText(*kept);
    const EntryHead head{kMagic, list.size(), checksumOf(bytesOf(list)), serialized.size()};
    const std::size_t size = sizeof(head) + list.size() + serialized.size();
    if (size > most_bytes_) return false;
    evictOldest(folder_, {kExtension, kDigestExtension}, most_bytes_ - size);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(size);
    const auto* first = reinterpret_cast<const std::uint8_t*>(&head);
    bytes.insert(bytes.end(), first, first + sizeof(head));
    bytes.insert(bytes.end(), list.begin(), list.end());
    bytes.insert(bytes.end(), serialized.begin(), serialized.end());
    return folder_.write(key + kExtension, bytes).has_value();
}

}  // namespace dollytrack
