#include "engine/io/sandbox/cached_inputs.h"

#include "engine/io/files/confined_folder.h"
#include "engine/io/files/sha256.h"
#include "engine/io/sandbox/binary_archive.h"
#include "engine/jobs/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

std::string digestOf(const InputFile& file) {
    Sha256 digest;
    std::vector<std::uint8_t> piece(1 << 18);
    for (std::uint64_t at = 0; at < file.size();) {
        const std::size_t got = file.read(at, piece.data(), piece.size());
        if (got == 0) return {};
        digest.add(std::span(piece).first(got));
        at += got;
    }
    return digest.finish();
}

std::string digestOfNames(const ConfinedFolder& folder) {
    Sha256 digest;
    for (const fs::path& name : folder.list()) {
        digest.add(name.native());
        digest.add(std::string_view("\0", 1));
    }
    return digest.finish();
}

/// The path relative to the folder; empty for the folder itself, nullopt if outside it.
std::optional<std::string> pathFrom(const fs::path& folder, const fs::path& path) {
    const fs::path from = path.lexically_normal().lexically_relative(folder);
    if (from == ".") return std::string();
    if (from.empty() || *from.begin() == "..") return std::nullopt;
    return from.string();
}

/// Opens a file below a root; a root that is itself a file was named by the user.
Result<InputFile> openBeneath(const fs::path& root, const std::string& path) {
    return path.empty() ? openNamedFile(root) : ConfinedFolder(root).open(path);
}

/// Whether a reader would find no file there.
bool isMissing(const fs::path& root, const std::string& path) {
    return path.empty() ? !hasFile(root) : !ConfinedFolder(root).has(path);
}

/// The file's digest; empty if it is not the file that was read any more.
std::string digestIfUnchanged(const fs::path& root, const std::string& path,
                              const FileIdentity& read) {
    const Result<InputFile> before = openBeneath(root, path);
    if (!before || before->identity() != read) return {};
    std::string digest = digestOf(*before);
    const Result<InputFile> after = openBeneath(root, path);
    return after && after->identity() == read ? digest : std::string();
}

bool liesBeneath(const InputRoots& roots, const fs::path& path) {
    return std::any_of(roots.begin(), roots.end(),
                       [&](const fs::path& root) { return pathFrom(root, path).has_value(); });
}

/// An input with a digest of its content; nullopt if it cannot be cached.
std::optional<CachedInput> keptInput(const InputRoots& roots, const InputUse& input) {
    for (std::uint32_t root = 0; root < roots.size(); ++root) {
        const std::optional<std::string> path = pathFrom(roots[root], input.path);
        if (!path) continue;
        CachedInput kept{input.kind, root, *path, {}};
        if (input.kind == InputUse::File) {
            kept.digest = digestIfUnchanged(roots[root], *path, input.identity);
            if (kept.digest.empty()) return std::nullopt;
        } else if (input.kind == InputUse::Listing) {
            kept.digest = digestOfNames(ConfinedFolder(roots[root] / *path));
        } else if (!isMissing(roots[root], *path)) {
            return std::nullopt;
        }
        return kept;
    }
    return std::nullopt;
}

template <class Archive, class T>
void inputMembers(Archive& archive, T& input) {
    auto& [kind, root, path, digest] = input;
    archive.number(kind);
    archive.number(root);
    archive.text(path);
    archive.text(digest);
}

}  // namespace

InputRoots inputRoots(const fs::path& scene, const std::vector<fs::path>& more_inputs) {
    InputRoots roots = {scene.has_parent_path() ? scene.parent_path().lexically_normal() : "."};
    for (const fs::path& input : more_inputs) roots.push_back(input.lexically_normal());
    return roots;
}

std::optional<std::vector<CachedInput>> cachedInputs(const fs::path& scene,
                                                     const std::string& scene_sha256,
                                                     const InputRoots& roots,
                                                     const std::vector<InputUse>& inputs) {
    const Result<InputFile> scene_file = openNamedFile(scene);
    if (!scene_file || digestOf(*scene_file) != scene_sha256) return std::nullopt;
    std::vector<CachedInput> all;
    for (const InputUse& input : inputs) {
        if (input.kind == InputUse::Refused) continue;
        if (input.path == scene) {
            if (input.identity != scene_file->identity()) return std::nullopt;
            continue;
        }
        std::optional<CachedInput> kept = keptInput(roots, input);
        if (kept) {
            all.push_back(std::move(*kept));
        } else if (input.kind != InputUse::Missing || liesBeneath(roots, input.path)) {
            return std::nullopt;
        }
        // Missing files outside the roots are ignored, because they could not be opened anyway.
    }
    return all;
}

bool areUnchanged(const InputRoots& roots, const std::vector<CachedInput>& inputs) {
    std::atomic<bool> all = true;
    parallelFor(inputs.size(), [&](std::size_t i) {
        const CachedInput& input = inputs[i];
        if (!all || input.root >= roots.size()) {
            all = false;
            return;
        }
        const fs::path& root = roots[input.root];
        if (input.kind == InputUse::File) {
            const Result<InputFile> file = openBeneath(root, input.path);
            if (!file || digestOf(*file) != input.digest) all = false;
        } else if (input.kind == InputUse::Listing) {
            if (digestOfNames(ConfinedFolder(root / input.path)) != input.digest) all = false;
        } else if (!isMissing(root, input.path)) {
            all = false;
        }
    });
    return all;
}

std::string cachedInputsText(const std::vector<CachedInput>& inputs) {
    return listText(inputs, [](auto& to, const CachedInput& one) { inputMembers(to, one); });
}

std::optional<std::vector<CachedInput>> parseCachedInputs(std::string_view text) {
    return parseListText<CachedInput>(
        text, 24, [](auto& from, CachedInput& one) { inputMembers(from, one); });
}

}  // namespace dollytrack
