#include "engine/io/gazebo/link_xml.h"

#include "engine/core/clean_text.h"
#include "engine/io/files/input_file.h"
#include "engine/io/files/number_lines.h"
#include "engine/scene/label_table.h"
#include "engine/scene/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::gazebo {

namespace {

bool isMacro(const pugi::xml_node& node) {
    return std::string_view(node.name()).starts_with("xacro:");
}

}  // namespace

std::string XmlFile::placeOf(const std::filesystem::path& path,
                             const pugi::xml_node& element) const {
    const std::ptrdiff_t offset = element.offset_debug();
    if (offset < 0 || !line_ends) return path.string();
    const auto line =
        std::lower_bound(line_ends->begin(), line_ends->end(), static_cast<std::size_t>(offset)) -
        line_ends->begin() + 1;
    return dollytrack::placeOf(path, static_cast<int>(line));
}

Result<XmlFile> readXml(const std::filesystem::path& path, std::uint64_t most) {
    const Result<std::string> text = readNamedFile(path, kMostXmlBytes);
    if (!text) return tl::unexpected(text.error());
    if (text->size() > most) {
        return fail(ErrorCode::BadInput,
                    "the scene's files have more than 64 MiB of XML; split the scene",
                    path.string());
    }
    return parseXml(*text, path);
}

Result<XmlFile> parseXml(std::string_view text, const std::filesystem::path& path) {
    XmlFile file;
    file.bytes = text.size();
    const pugi::xml_parse_result parsed = file.document.load_buffer(text.data(), text.size());
    // Other encodings are converted before they are parsed, so that offsets are not those of
    // `text`.
    const bool offsets_are_of_text = parsed.encoding == pugi::encoding_utf8;
    if (!parsed) {
        std::string where = path.string();
        if (offsets_are_of_text) {
            const auto before = text.substr(0, static_cast<std::size_t>(parsed.offset));
            where = dollytrack::placeOf(
                path, static_cast<int>(1 + std::count(before.begin(), before.end(), '\n')));
        }
        return fail(ErrorCode::BadInput,
                    std::string("the XML cannot be read (") + parsed.description() +
                        "); the file is damaged or truncated",
                    where);
    }
    if (offsets_are_of_text) {
        file.line_ends.emplace();
        for (auto at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
            file.line_ends->push_back(at);
        }
    }
    if (file.document.find_node(isMacro)) {
        return fail(ErrorCode::BadInput,
                    "the file contains xacro macros; expand it with ROS's \"xacro in.urdf.xacro -o "
                    "out.urdf\" and name the result",
                    path.string());
    }
    return file;
}

std::string textOf(const pugi::xml_node& node) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::string_view text = node.child_value();
    const auto begin = text.find_first_not_of(kBlanks);
    if (begin == text.npos) return {};
    return std::string(text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1));
}

std::string nameOfInclude(const pugi::xml_node& include) {
    std::string name = cleanText(textOf(include.child("name")));
    if (!name.empty()) return name;
    std::string uri = cleanText(textOf(include.child("uri")));
    while (uri.ends_with('/')) uri.pop_back();
    return uri.substr(uri.rfind('/') + 1);
}

std::optional<std::vector<double>> numbersOf(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n,";
    std::vector<double> numbers;
    while (true) {
        const auto begin = text.find_first_not_of(kBlanks);
        if (begin == text.npos) return numbers;
        const auto end = std::min(text.find_first_of(kBlanks, begin), text.size());
        const auto number = numberFrom(text.substr(begin, end - begin));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
        text.remove_prefix(end);
    }
}

std::optional<Eigen::Vector3d> vectorOf(std::string_view text) {
    const auto numbers = numbersOf(text);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    return Eigen::Vector3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Eigen::Quaterniond rotationFromRollPitchYaw(const Eigen::Vector3d& roll_pitch_yaw) {
    return Eigen::AngleAxisd(roll_pitch_yaw.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(roll_pitch_yaw.y(), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(roll_pitch_yaw.x(), Eigen::Vector3d::UnitX());
}

bool isPlainLinkName(std::string_view name) {
    static constexpr std::array<std::string_view, 11> kPlain = {"link", "base",   "body", "part",
                                                                "root", "visual", "mesh", "object",
                                                                "node", "child",  "clone"};
    const std::vector<std::string> words = wordsOfName(name);
    return std::ranges::all_of(words, [](const std::string& word) {
        return word.size() < 2 || std::ranges::find(kPlain, word) != kPlain.end();
    });
}

void noteUnknownShape(const pugi::xml_node& geometry, UnknownShapes& shapes) {
    constexpr std::size_t kMostNames = 100;
    for (const pugi::xml_node& shape : geometry.children()) {
        const std::string name = cleanText(shape.name());
        if (shape.type() != pugi::node_element || name == "empty") continue;
        if (shapes.size() < kMostNames || shapes.contains(name)) ++shapes[name];
        return;
    }
}

std::optional<Eigen::Vector4f> colorOf(std::string_view text) {
    const auto numbers = numbersOf(text);
    if (!numbers || (numbers->size() != 3 && numbers->size() != 4)) return std::nullopt;
    Eigen::Vector4f color = Eigen::Vector4f::Ones();
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        const auto value = static_cast<float>(std::clamp((*numbers)[i], 0.0, 1.0));
        color[static_cast<Eigen::Index>(i)] = i < 3 ? linearFromSrgb(value) : value;
    }
    return color;
}

}  // namespace dollytrack::gazebo
