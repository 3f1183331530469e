#pragma once

#include <Eigen/Core>

#include <sstream>
#include <string>

namespace dollytrack::test {

/// Writes small OBJ scenes. Arguments are in metres with z up; the text has the file's unit and
/// axes.
class ObjWriter {
  public:
    /// `units_per_metre` 100 gives centimetres; `y_up` stores (x, z, -y).
    explicit ObjWriter(double units_per_metre = 1.0, bool y_up = true)
        : scale_(units_per_metre), y_up_(y_up) {}

    ObjWriter& object(const std::string& name);
    ObjWriter& material(const std::string& name);
    /// A closed box of six quads.
    ObjWriter& box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
    ObjWriter& quad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                    const Eigen::Vector3d& d);
    /// Floor, ceiling and four walls of zero thickness from the origin to `size`; as named objects,
    /// or all in the current object.
    ObjWriter& room(const Eigen::Vector3d& size, bool named);

    [[nodiscard]] std::string text() const { return out_.str(); }

  private:
    int vertex(const Eigen::Vector3d& p);

    double scale_;
    bool y_up_;
    int count_ = 0;
    std::ostringstream out_;
};

/// A room of 5 x 4 x 2.6 m, z up, with four objects: sofa, chair, lamp, coffee_table.
[[nodiscard]] ObjWriter furnished(double units_per_metre = 1.0);

}  // namespace dollytrack::test
