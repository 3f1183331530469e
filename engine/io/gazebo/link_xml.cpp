#include "engine/io/gazebo/link_xml.h"

#include "engine/io/sandbox/input_file.h"
#include "engine/scene/srgb.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace dollytrack::gazebo {

Result<pugi::xml_document> readXml(const std::filesystem::path& path) {
    constexpr std::uint64_t kMostXmlFileBytes = std::uint64_t{64} << 20U;
    const Result<std::string> text = io::readNamedFile(path, kMostXmlFileBytes);
    if (!text) return tl::unexpected(text.error());
    if (holdsXacro(*text)) {
        return fail(ErrorCode::BadInput,
                    "the file is made of xacro's macros; expand it with ROS's \"xacro in -o "
                    "out.urdf\" and name the result",
                    path.string());
    }
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text->data(), text->size());
    if (parsed) return document;
    const auto line = 1 + std::count(text->begin(), text->begin() + parsed.offset, '\n');
    return fail(ErrorCode::BadInput,
                std::string("the XML cannot be read (") + parsed.description() +
                    "); the file is damaged or was cut off",
                path.string() + ":" + std::to_string(line));
}

std::optional<std::vector<double>> numbersOf(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n,";
    std::vector<double> numbers;
    while (true) {
        const auto begin = text.find_first_not_of(kBlanks);
        if (begin == text.npos) return numbers;
        const auto end = std::min(text.find_first_of(kBlanks, begin), text.size());
        std::string_view word = text.substr(begin, end - begin);
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || last != word.data() + word.size() || !std::isfinite(value)) {
            return std::nullopt;
        }
        numbers.push_back(value);
        text.remove_prefix(end);
    }
}

std::optional<Eigen::Vector3d> vectorOf(std::string_view text) {
    const auto numbers = numbersOf(text);
    if (!numbers || numbers->size() != 3) return std::nullopt;
    return Eigen::Vector3d((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Eigen::Quaterniond turnOf(const Eigen::Vector3d& roll_pitch_yaw) {
    return Eigen::AngleAxisd(roll_pitch_yaw.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(roll_pitch_yaw.y(), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(roll_pitch_yaw.x(), Eigen::Vector3d::UnitX());
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

bool holdsXacro(std::string_view text) {
    return text.find("<xacro:") != std::string_view::npos;
}

}  // namespace dollytrack::gazebo
