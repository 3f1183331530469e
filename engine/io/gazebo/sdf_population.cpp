#include "engine/io/gazebo/sdf_population.h"

#include "engine/core/clean_text.h"
#include "engine/io/gazebo/link_xml.h"

#include <fmt/format.h>

#include <optional>

namespace dollytrack::gazebo {
namespace {

using Eigen::Vector3d;

/// A positive whole number; 0 if the text is none.
std::size_t countIn(const pugi::xml_node& element, const char* name) {
    constexpr double kMost = 1e6;
    const auto numbers = numbersOf(element.child_value(name));
    if (!numbers || numbers->size() != 1) return 0;
    const double number = numbers->front();
    return number >= 1.0 && number <= kMost ? static_cast<std::size_t>(number) : 0;
}

/// The models' positions relative to the population's pose.
struct Layout {
    Vector3d first;  // along the world's axes
    std::size_t rows = 1;
    std::size_t columns = 1;
    Vector3d row_step = Vector3d::Zero();  // along the population's axes, like the next
    Vector3d column_step = Vector3d::Zero();
    Vector3d middle = Vector3d::Zero();
};

/// Columns are along x and rows along y, and the grid is centred on the population's pose.
std::optional<Layout> gridOf(const pugi::xml_node& distribution) {
    Layout grid;
    grid.rows = countIn(distribution, "rows");
    grid.columns = countIn(distribution, "cols");
    const auto step = vectorOf(distribution.child_value("step"));
    if (grid.rows == 0 || grid.columns == 0 || !step) return std::nullopt;
    grid.column_step = {step->x(), 0.0, 0.0};
    grid.row_step = {0.0, step->y(), 0.0};
    grid.first = -0.5 * (static_cast<double>(grid.columns - 1) * grid.column_step +
                         static_cast<double>(grid.rows - 1) * grid.row_step);
    return grid;
}

/// A row along one axis of a box that is centred on the population's pose. It begins at the box's
/// side and ends one step before the other.
std::optional<Layout> rowOf(const pugi::xml_node& population, int axis) {
    Layout row;
    row.columns = countIn(population, "model_count");
    const auto size = vectorOf(population.child("box").child_value("size"));
    if (row.columns == 0 || !size || !(size->minCoeff() > 0.0)) return std::nullopt;
    row.first = -0.5 * *size;
    row.middle = 0.5 * *size;
    row.middle[axis] = 0.0;
    row.column_step[axis] = (*size)[axis] / static_cast<double>(row.columns);
    return row;
}

}  // namespace

tl::expected<Population, std::string> readPopulation(const pugi::xml_node& element,
                                                     std::size_t most_models) {
    const pugi::xml_node distribution = element.child("distribution");
    const std::string type = textOf(distribution.child("type"));
    if (type == "random" || type == "uniform") {
        return tl::unexpected<std::string>(
            "the positions of its models are random; replace it by a <model> for each position");
    }
    Population population;
    population.model = element.child("model");
    if (!population.model) population.model = element.child("include");
    const std::string name = population.model.name() == std::string_view("include")
                                 ? nameOfInclude(population.model)
                                 : cleanText(population.model.attribute("name").value());
    const auto numbers = numbersOf(element.child_value("pose"));
    const auto layout = type == "grid"       ? gridOf(distribution)
                        : type == "linear-x" ? rowOf(element, 0)
                        : type == "linear-y" ? rowOf(element, 1)
                        : type == "linear-z" ? rowOf(element, 2)
                                             : std::nullopt;
    if (!population.model || !layout || !numbers || numbers->size() != 6) {
        return tl::unexpected<std::string>(
            "its <model>, <pose> or <distribution> is missing or wrong; correct it");
    }
    if (layout->rows > most_models / layout->columns) {
        return tl::unexpected(
            fmt::format("it has more than {} models; reduce their number", most_models));
    }
    const std::vector<double>& pose = *numbers;
    const Eigen::Quaterniond turn = rotationFromRollPitchYaw({pose[3], pose[4], pose[5]});
    // As in Gazebo, the pose turns the steps, but neither the models nor the way to the first.
    const Vector3d origin = Vector3d(pose[0], pose[1], pose[2]) + layout->first;
    for (std::size_t row = 0; row < layout->rows; ++row) {
        for (std::size_t column = 0; column < layout->columns; ++column) {
            const Vector3d offset = layout->middle + static_cast<double>(row) * layout->row_step +
                                    static_cast<double>(column) * layout->column_step;
            population.copies.push_back({fmt::format("{}_clone_{}", name, population.copies.size()),
                                         origin + turn * offset});
        }
    }
    return population;
}

}  // namespace dollytrack::gazebo
