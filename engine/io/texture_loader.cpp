#include "engine/io/texture_loader.h"

#include "engine/core/clean_text.h"
#include "engine/jobs/parallel.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

namespace dollytrack {
namespace {

namespace fs = std::filesystem;

constexpr int kLargestSide = 1024;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 29;
constexpr std::size_t kMostFiles = 20'000;

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// "C:\maps\Wood.PNG" and "../maps/Wood.png" both end in the name that counts.
std::string baseName(const std::string& name) {
    const auto slash = name.find_last_of("/\\");
    return slash == std::string::npos ? name : name.substr(slash + 1);
}

/// "%20" is a space in glTF and Collada references.
std::string percentDecoded(const std::string& name) {
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] == '%' && i + 2 < name.size() &&
            std::isxdigit(static_cast<unsigned char>(name[i + 1])) &&
            std::isxdigit(static_cast<unsigned char>(name[i + 2]))) {
            text += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            text += name[i];
        }
    }
    return text;
}

/// Files under the scene's folder by lower-case name; of equal names the one nearest the top.
std::map<std::string, fs::path> indexFolder(const fs::path& folder) {
    std::map<std::string, fs::path> files;
    std::error_code error;
    std::size_t seen = 0;
    std::vector<fs::path> level = {folder};
    for (int depth = 0; depth < 5 && !level.empty() && seen < kMostFiles; ++depth) {
        std::vector<fs::path> next;
        for (const fs::path& dir : level) {
            std::vector<fs::directory_entry> entries;
            for (fs::directory_iterator it(dir, error), end; !error && it != end;
                 it.increment(error)) {
                if (++seen >= kMostFiles) break;
                entries.push_back(*it);
            }
            std::sort(entries.begin(), entries.end());
            for (const fs::directory_entry& entry : entries) {
                if (entry.is_symlink(error)) continue;
                if (entry.is_directory(error)) {
                    next.push_back(entry.path());
                } else if (entry.is_regular_file(error)) {
                    files.try_emplace(lower(entry.path().filename().string()), entry.path());
                }
            }
        }
        level = std::move(next);
    }
    return files;
}

std::optional<fs::path> locate(const std::string& name, const fs::path& folder,
                               const std::map<std::string, fs::path>& files) {
    for (const std::string& spelling : {name, percentDecoded(name)}) {
        std::string relative = spelling;
        std::replace(relative.begin(), relative.end(), '\\', '/');
        const fs::path direct = fs::path(relative).lexically_normal();
        std::error_code error;
        // A path that leaves the folder is looked up by its last name only.
        if (direct.is_relative() && !direct.empty() && *direct.begin() != ".." &&
            fs::is_regular_file(fs::symlink_status(folder / direct, error))) {
            return folder / direct;
        }
        const auto found = files.find(lower(baseName(relative)));
        if (found != files.end()) return found->second;
    }
    return std::nullopt;
}

/// Width x height as the file's head tells (beyond kMostPixels only roughly), without decoding; 0
/// when OpenCV has to find out. PNG and JPEG alone can blow up from a small file, and both say
/// their size early.
std::int64_t declaredPixels(const std::vector<std::uint8_t>& bytes) {
    const auto big = [&](std::size_t at, int count) {
        std::int64_t value = 0;
        for (int i = 0; i < count; ++i) value = value * 256 + bytes[at + static_cast<unsigned>(i)];
        return value;
    };
    // Each side first: the product of two 32-bit numbers need not fit.
    const auto area = [](std::int64_t width, std::int64_t height) {
        return std::min(width, kMostPixels + 1) * std::min(height, kMostPixels + 1);
    };
    if (bytes.size() > 24 && bytes[0] == 0x89 && bytes[1] == 'P') {
        return area(big(16, 4), big(20, 4));
    }
    if (bytes.size() > 4 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
        for (std::size_t at = 2; at + 9 < bytes.size();) {
            if (bytes[at] != 0xFF) return 0;
            const int marker = bytes[at + 1];
            if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 &&
                marker != 0xCC) {
                return area(big(at + 5, 2), big(at + 7, 2));
            }
            at += 2 + static_cast<std::size_t>(big(at + 2, 2));
        }
    }
    return 0;
}

bool decode(const std::vector<std::uint8_t>& bytes, bool opaque, Texture& texture) {
    if (bytes.empty() || declaredPixels(bytes) > kMostPixels) return false;
    cv::Mat image;
    try {
        image = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
        if (image.empty() || std::int64_t{image.cols} * image.rows > kMostPixels) return false;
        if (image.depth() == CV_16U) {
            image.convertTo(image, CV_8U, 1.0 / 257.0);
        } else if (image.depth() == CV_32F || image.depth() == CV_64F) {
            image.convertTo(image, CV_8U, 255.0);
        } else if (image.depth() != CV_8U) {
            return false;
        }
        const int longest = std::max(image.cols, image.rows);
        if (longest > kLargestSide) {
            const double scale = static_cast<double>(kLargestSide) / longest;
            cv::resize(image, image,
                       {std::max(1, static_cast<int>(std::lround(image.cols * scale))),
                        std::max(1, static_cast<int>(std::lround(image.rows * scale)))},
                       0, 0, cv::INTER_AREA);
        }
        if (image.channels() == 2) cv::extractChannel(image, image, 0);
        cv::cvtColor(image, image,
                     image.channels() == 1   ? cv::COLOR_GRAY2RGBA
                     : image.channels() == 3 ? cv::COLOR_BGR2RGBA
                                             : cv::COLOR_BGRA2RGBA);
    } catch (const cv::Exception&) {
        return false;
    }
    texture.width = image.cols;
    texture.height = image.rows;
    texture.rgba.assign(image.data, image.data + image.total() * 4);
    if (opaque) {
        for (std::size_t i = 3; i < texture.rgba.size(); i += 4) texture.rgba[i] = 255;
    }
    return true;
}

std::vector<std::uint8_t> readBytes(const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    if (error || size > kMostBytes) return {};
    std::ifstream in(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(size);
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
}

}  // namespace

TextureSet loadTextures(const fs::path& scene_path, const std::vector<TextureRequest>& requests,
                        const JobContext& job) {
    TextureSet set;
    set.textures.resize(requests.size());
    if (requests.empty()) return set;
    fs::path folder = scene_path.parent_path();
    if (folder.empty()) folder = ".";
    const auto folderOf = [&](const TextureRequest& request) {
        return request.folder.empty() ? folder : request.folder;
    };
    std::map<fs::path, std::map<std::string, fs::path>> files;  // by the folder they are below
    for (const TextureRequest& request : requests) {
        if (!request.embedded.empty()) continue;
        const auto [at, is_new] = files.try_emplace(folderOf(request));
        if (is_new) at->second = indexFolder(at->first);
    }

    enum class State { Missing, Broken, Found };
    std::vector<State> states(requests.size(), State::Missing);
    parallelFor(requests.size(), [&](std::size_t i) {
        const TextureRequest& request = requests[i];
        Texture& texture = set.textures[i];
        texture.name = cleanText(request.name);
        if (job.cancelled()) return;
        if (request.embedded_width > 0) {
            texture.width = request.embedded_width;
            texture.height = request.embedded_height;
            texture.rgba = request.embedded;
            states[i] = State::Found;
            return;
        }
        std::vector<std::uint8_t> bytes = request.embedded;
        if (bytes.empty()) {
            const fs::path below = folderOf(request);
            const auto path = locate(request.name, below, files.at(below));
            if (!path) return;
            bytes = readBytes(*path);
        }
        states[i] = decode(bytes, request.opaque, texture) ? State::Found : State::Broken;
    });
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (states[i] == State::Found) ++set.found;
        if (states[i] == State::Missing) set.missing.push_back(set.textures[i].name);
        if (states[i] == State::Broken) set.broken.push_back(set.textures[i].name);
    }
    return set;
}

}  // namespace dollytrack
