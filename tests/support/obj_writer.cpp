#include "tests/support/obj_writer.h"

namespace dollytrack::test {

using Eigen::Vector3d;

ObjWriter& ObjWriter::object(const std::string& name) {
    out_ << "o " << name << "\n";
    return *this;
}

ObjWriter& ObjWriter::material(const std::string& name) {
    out_ << "usemtl " << name << "\n";
    return *this;
}

int ObjWriter::vertex(const Vector3d& p) {
    const Vector3d q = scale_ * (y_up_ ? Vector3d(p.x(), p.z(), -p.y()) : p);
    out_.precision(9);
    out_ << "v " << q.x() << " " << q.y() << " " << q.z() << "\n";
    return ++count_;
}

ObjWriter& ObjWriter::quad(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                           const Vector3d& d) {
    const int i = vertex(a);
    const int j = vertex(b);
    const int k = vertex(c);
    const int l = vertex(d);
    out_ << "f " << i << " " << j << " " << k << " " << l << "\n";
    return *this;
}

ObjWriter& ObjWriter::box(const Vector3d& low, const Vector3d& high) {
    const int first = count_ + 1;
    for (int i = 0; i < 8; ++i) {
        vertex({(i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z()});
    }
    const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces) {
        out_ << "f";
        for (const int corner : face) out_ << " " << first + corner;
        out_ << "\n";
    }
    return *this;
}

ObjWriter& ObjWriter::room(const Vector3d& s, bool named) {
    const auto start = [&](const char* name) {
        if (named) object(name);
    };
    const Vector3d o = Vector3d::Zero();
    start("floor");
    quad(o, {s.x(), 0, 0}, {s.x(), s.y(), 0}, {0, s.y(), 0});
    start("ceiling");
    quad({0, 0, s.z()}, {0, s.y(), s.z()}, s, {s.x(), 0, s.z()});
    start("wall_s");
    quad(o, {0, 0, s.z()}, {s.x(), 0, s.z()}, {s.x(), 0, 0});
    start("wall_n");
    quad({0, s.y(), 0}, {s.x(), s.y(), 0}, s, {0, s.y(), s.z()});
    start("wall_w");
    quad(o, {0, s.y(), 0}, {0, s.y(), s.z()}, {0, 0, s.z()});
    start("wall_e");
    quad({s.x(), 0, 0}, {s.x(), 0, s.z()}, s, {s.x(), s.y(), 0});
    return *this;
}

ObjWriter furnished(double units_per_metre) {
    ObjWriter obj(units_per_metre, false);
    obj.room({5, 4, 2.6}, true);
    obj.object("sofa").box({0.2, 3.0, 0.0}, {2.2, 3.8, 0.8});
    obj.object("chair").box({1.2, 1.6, 0.0}, {1.65, 2.05, 0.9});
    obj.object("lamp").box({4.4, 0.3, 0.0}, {4.7, 0.6, 1.5});
    obj.object("coffee_table").box({2.0, 1.5, 0.0}, {3.2, 2.3, 0.45});
    return obj;
}

}  // namespace dollytrack::test
