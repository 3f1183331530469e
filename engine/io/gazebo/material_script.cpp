#include "engine/io/gazebo/material_script.h"

#include "engine/io/files/input_file.h"
#include "engine/io/gazebo/link_xml.h"
#include "engine/io/gazebo/model_path.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace dollytrack::gazebo {
namespace {

namespace fs = std::filesystem;

/// Splits a script into lines of words. Braces are lines of their own; comments are left out.
class ScriptLines {
  public:
    explicit ScriptLines(std::string_view text) : text_(text) {}

    /// The words of the next line that has any; empty at the end.
    std::vector<std::string> next() {
        std::vector<std::string> words;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (text_.substr(at_).starts_with("//")) {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (text_.substr(at_).starts_with("/*")) {
                const std::size_t end = text_.find("*/", at_ + 2);
                at_ = end == std::string_view::npos ? text_.size() : end + 2;
            } else if (c == '\n') {
                ++at_;
                if (!words.empty()) return words;
            } else if (c == '{' || c == '}') {
                if (!words.empty()) return words;
                ++at_;
                return {std::string(1, c)};
            } else if (isBlank(c)) {
                ++at_;
            } else {
                words.push_back(word());
            }
        }
        return words;
    }

  private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

    /// A word, or text in quotes, which may contain blanks.
    std::string word() {
        if (text_[at_] == '"') {
            const std::size_t end = std::min(text_.find_first_of("\"\n", at_ + 1), text_.size());
            const std::string quoted(text_.substr(at_ + 1, end - at_ - 1));
            at_ = end + (end < text_.size() && text_[end] == '"' ? 1 : 0);
            return quoted;
        }
        const std::size_t end = std::min(text_.find_first_of(" \t\r\n{}", at_), text_.size());
        const std::string plain(text_.substr(at_, end - at_));
        at_ = end;
        return plain;
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

std::string joined(const std::vector<std::string>& words, std::size_t first) {
    std::string text;
    for (std::size_t i = first; i < words.size(); ++i) text += (i > first ? " " : "") + words[i];
    return text;
}

/// A material before blending is resolved: its opacity counts only if `blends`, which a material
/// that inherits from it may still set.
struct WrittenMaterial {
    ScriptMaterial as_written;
    bool blends = false;

    [[nodiscard]] ScriptMaterial resolved() const {
        ScriptMaterial material = as_written;
        if (material.color && !blends) (*material.color)[3] = 1.0F;
        return material;
    }
};

/// Reads one material from its opening brace to its closing one. Only the first block of each kind
/// is read.
class MaterialBlock {
  public:
    MaterialBlock(ScriptLines& lines, WrittenMaterial inherited)
        : lines_(lines), material_(std::move(inherited.as_written)), blends_(inherited.blends) {}

    WrittenMaterial read() {
        std::string kind = "material";  // of the next block
        while (true) {
            const std::vector<std::string> words = lines_.next();
            if (words.empty()) return {material_, blends_};
            if (words.front() == "{") {
                open(kind);
            } else if (words.front() == "}") {
                if (close()) return {material_, blends_};
            } else {
                if (read_depth_ == depth_) set(words);
                kind = words.front();
            }
        }
    }

  private:
    /// The blocks of which the first is read, from the outside in.
    static constexpr std::array<std::string_view, 4> kBlocks = {"material", "technique", "pass",
                                                                "texture_unit"};

    void open(const std::string& kind) {
        const std::size_t level = depth_++;
        if (read_depth_ != level || level >= kBlocks.size()) return;
        if (kind != kBlocks[level] || seen_[level]) return;
        seen_[level] = true;
        read_depth_ = depth_;
    }

    /// Returns whether the material is complete.
    bool close() {
        if (read_depth_ == depth_ && depth_ > 0) --read_depth_;
        if (depth_ > 0) --depth_;
        return depth_ == 0;
    }

    void set(const std::vector<std::string>& words) {
        constexpr std::size_t kInPass = 3;
        constexpr std::size_t kInTextureUnit = 4;
        if (depth_ == kInPass && words.front() == "diffuse") {
            if (const auto color = colorOf(joined(words, 1))) material_.color = color;
        } else if (depth_ == kInPass && words.front() == "scene_blend") {
            blends_ = joined(words, 1) == "alpha_blend";
        } else if (depth_ == kInTextureUnit && words.front() == "texture" && words.size() > 1) {
            material_.texture = words[1];
        } else if (depth_ == kInTextureUnit && words.front() == "scale") {
            const auto scale = numbersOf(joined(words, 1));
            if (scale && scale->size() == 2 && (*scale)[0] > 0.0 && (*scale)[1] > 0.0) {
                material_.texture_scale = {static_cast<float>((*scale)[0]),
                                           static_cast<float>((*scale)[1])};
            }
        }
    }

    ScriptLines& lines_;
    ScriptMaterial material_;
    bool blends_;
    std::size_t depth_ = 0;       // of open braces
    std::size_t read_depth_ = 0;  // of the innermost block that is read
    std::array<bool, kBlocks.size()> seen_{};
};

}  // namespace

std::map<std::string, ScriptMaterial> parseMaterialScript(std::string_view text) {
    std::map<std::string, WrittenMaterial> materials;
    ScriptLines lines(text);
    while (true) {
        const std::vector<std::string> words = lines.next();
        if (words.empty()) break;
        if (words.front() != "material" || words.size() < 2) continue;
        // "material NAME" or "material NAME : PARENT".
        const bool inherits = words.size() > 3 && words[2] == ":";
        const auto parent = inherits ? materials.find(words[3]) : materials.end();
        WrittenMaterial inherited = parent == materials.end() ? WrittenMaterial() : parent->second;
        materials.try_emplace(words[1], MaterialBlock(lines, std::move(inherited)).read());
    }
    std::map<std::string, ScriptMaterial> resolved;
    for (const auto& [name, material] : materials) resolved.emplace(name, material.resolved());
    return resolved;
}

const std::map<std::string, ScriptMaterial>& MaterialScripts::materialsOf(const fs::path& file) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20U;  // of all scripts together
    const auto [at, is_new] = read_.try_emplace(file);
    if (is_new && bytes_ < kMostBytes) {
        if (const Result<std::string> text = readNamedFile(file, kMostBytes - bytes_)) {
            bytes_ += text->size();
            at->second = parseMaterialScript(*text);
        }
    }
    return at->second;
}

std::optional<MaterialScripts::Found> MaterialScripts::find(const fs::path& folder,
                                                            const std::vector<std::string>& uris,
                                                            const std::string& name) {
    std::vector<fs::path> files;
    for (const std::string& uri : uris) {
        const std::vector<fs::path> listed = files_.filesIn(folder, uri);
        files.insert(files.end(), listed.begin(), listed.end());
    }
    for (const fs::path& file : files) {
        if (file.extension() != ".material") continue;
        const std::map<std::string, ScriptMaterial>& materials = materialsOf(file);
        const auto at = materials.find(name);
        if (at == materials.end()) continue;
        Found found{at->second, {}};
        if (found.material.texture.empty()) return found;
        const fs::path picture = fs::path(found.material.texture).filename();
        const auto listed = std::ranges::find(files, picture, &fs::path::filename);
        // A missing picture is searched for beside the script again, and counted as missing.
        found.texture = listed != files.end()
                            ? *listed
                            : files_.find(file.parent_path(), "../textures/" + picture.string())
                                  .value_or(file.parent_path() / picture);
        return found;
    }
    return std::nullopt;
}

bool MaterialScripts::apply(const pugi::xml_node& script, const fs::path& folder, Visual& visual) {
    std::vector<std::string> uris;
    for (const pugi::xml_node& uri : script.children("uri")) uris.push_back(textOf(uri));
    const std::string name = textOf(script.child("name"));
    const auto [at, is_new] = found_.try_emplace({folder, uris, name});
    if (is_new) at->second = find(folder, uris, name);
    if (!at->second) return false;
    const auto& [material, texture] = *at->second;
    if (!visual.color) visual.color = material.color;
    visual.texture = texture;
    visual.texture_scale = material.texture_scale;
    return true;
}

}  // namespace dollytrack::gazebo
