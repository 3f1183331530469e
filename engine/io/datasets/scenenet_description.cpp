#include "engine/io/datasets/scenenet_description.h"

#include "engine/core/clean_text.h"
#include "engine/io/datasets/model_library.h"
#include "engine/io/files/file_type.h"
#include "engine/io/files/number_lines.h"

#include <fmt/format.h>

#include <filesystem>

namespace dollytrack {
namespace {

constexpr std::string_view kLayout = "layout_file:";

/// The non-empty lines of a file, with their numbers.
class Lines {
  public:
    Lines(std::string_view text, const std::string& file)
        : lines_(splitLines(withoutByteOrderMark(text))), file_(file) {}

    /// Whether there is another line; false at the end and where the poses begin.
    bool more() {
        while (at_ < lines_.size() && trimmed(lines_[at_]).empty()) ++at_;
        return at_ < lines_.size() && trimmed(lines_[at_]).front() != '#';
    }
    [[nodiscard]] std::string_view peek() const { return trimmed(lines_[at_]); }
    void skip() { ++at_; }
    [[nodiscard]] int number() const { return static_cast<int>(at_) + 1; }
    [[nodiscard]] std::string place() const { return placeOf(file_, number()); }

    Result<std::string_view> next(const char* what) {
        if (!more()) {
            return fail(ErrorCode::BadInput, fmt::format("The file ends where {} should be.", what),
                        place());
        }
        return trimmed(lines_[at_++]);
    }
    Status word(std::string_view expected) {
        const Result<std::string_view> line = next(std::string(expected).c_str());
        if (!line) return tl::unexpected(line.error());
        if (*line == expected) return {};
        --at_;
        return fail(
            ErrorCode::BadInput,
            fmt::format("This line of the SceneNet description should be \"{}\".", expected),
            place());
    }

    Result<std::vector<double>> numbers(const char* what, std::size_t count) {
        const Result<std::string_view> line = next(what);
        if (!line) return tl::unexpected(line.error());
        const int at = number() - 1;
        const std::vector<std::string_view> words = splitWords(*line);
        if (words.size() != count) {
            return fail(ErrorCode::BadInput,
                        fmt::format("{} should be {} number{}, not {}.", what, count,
                                    count == 1 ? "" : "s", words.size()),
                        placeOf(file_, at));
        }
        std::vector<double> values;
        for (const std::string_view word : words) {
            const Result<double> value = parseNumber(word, file_, at);
            if (!value) return tl::unexpected(value.error());
            values.push_back(*value);
        }
        return values;
    }

  private:
    std::vector<std::string_view> lines_;
    std::size_t at_ = 0;
    std::filesystem::path file_;
};

/// The model's hash in "<wnid>/<hash>" or in a path <hash>/models/model_normalized.obj.
std::string hashOf(std::string_view path) {
    std::vector<std::string> parts;
    for (const auto& part : std::filesystem::path(path)) parts.push_back(part.string());
    if (!parts.empty() && parts.back().ends_with(".obj")) parts.pop_back();
    if (!parts.empty() && parts.back() == "models") parts.pop_back();
    return parts.empty() ? std::string() : parts.back();
}

/// Reads WordNet number, height and three matrix rows, with or without keywords.
Result<SceneNetObject> readObject(Lines& lines, bool has_words) {
    SceneNetObject object;
    object.line = lines.number();
    const std::string place = lines.place();
    if (has_words) {
        if (Status ok = lines.word("object"); !ok) return tl::unexpected(ok.error());
    }
    const Result<std::string_view> model = lines.next("the model");
    if (!model) return tl::unexpected(model.error());
    object.hash = hashOf(*model);
    if (has_words) {
        if (Status ok = lines.word("wnid"); !ok) return tl::unexpected(ok.error());
    }
    const Result<std::string_view> wnid = lines.next("the WordNet number");
    if (!wnid) return tl::unexpected(wnid.error());
    object.wnid = std::string(*wnid);
    if (!isPlainName(object.wnid) || !isPlainName(object.hash)) {
        return fail(ErrorCode::BadInput, "The model is not <WordNet number>/<name>.", place);
    }
    if (has_words) {
        if (Status ok = lines.word("scale"); !ok) return tl::unexpected(ok.error());
    }
    const Result<std::vector<double>> height = lines.numbers("The height", 1);
    if (!height) return tl::unexpected(height.error());
    object.height_m = height->front();
    if (!(object.height_m > 0.0 && object.height_m < 1000.0)) {
        return fail(ErrorCode::BadInput, "The height must be above 0 and below 1000 m.", place);
    }
    if (has_words) {
        if (Status ok = lines.word("transformation"); !ok) return tl::unexpected(ok.error());
    }
    for (Eigen::Index row = 0; row < 3; ++row) {
        const auto values = lines.numbers("A row of the transformation", 4);
        if (!values) return tl::unexpected(values.error());
        for (Eigen::Index column = 0; column < 4; ++column) {
            object.scene_from_object.matrix()(row, column) = (*values)[column];
        }
    }
    return object;
}

}  // namespace

Result<SceneNetDescription> parseSceneNet(std::string_view text, const std::string& file) {
    Lines lines(text, file);
    if (!lines.more() || !lines.peek().starts_with(kLayout)) {
        return fail(ErrorCode::BadInput, "A scene of SceneNet RGB-D begins with \"layout_file:\".",
                    lines.place());
    }
    SceneNetDescription scene;
    scene.layout_file = std::string(trimmed(lines.peek().substr(kLayout.size())));
    lines.skip();
    const bool has_words = lines.more() && lines.peek() == "object";
    while (lines.more() && lines.peek() != "end") {  // lights follow after "end"
        Result<SceneNetObject> object = readObject(lines, has_words);
        if (!object) return tl::unexpected(object.error());
        scene.objects.push_back(std::move(*object));
    }
    return scene;
}

}  // namespace dollytrack
