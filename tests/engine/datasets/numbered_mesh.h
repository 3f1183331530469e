#pragma once

#include <Eigen/Core>

#include <array>
#include <sstream>
#include <string>
#include <vector>

namespace dollytrack::test {

/// A box of twelve triangles, z up, with a number.
struct NumberedBox {
    Eigen::Vector3f low;
    Eigen::Vector3f high;
    int number;
};

struct Triangles {
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::array<int, 3>> faces;
    std::vector<int> of_face;
    std::vector<int> of_position;
};

inline Triangles trianglesOf(const std::vector<NumberedBox>& boxes) {
    Triangles all;
    for (const NumberedBox& box : boxes) {
        const int base = static_cast<int>(all.positions.size());
        for (int i = 0; i < 8; ++i) {
            all.positions.emplace_back((i & 1) != 0 ? box.high.x() : box.low.x(),
                                       (i & 2) != 0 ? box.high.y() : box.low.y(),
                                       (i & 4) != 0 ? box.high.z() : box.low.z());
            all.of_position.push_back(box.number);
        }
        for (const std::array<int, 4>& quad :
             {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
              std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
            all.faces.push_back({base + quad[0], base + quad[1], base + quad[2]});
            all.faces.push_back({base + quad[0], base + quad[2], base + quad[3]});
            all.of_face.insert(all.of_face.end(), 2, box.number);
        }
    }
    return all;
}

/// A room of 4 x 3 x 2.5 m made of slabs, with two chairs and a lamp.
inline std::vector<NumberedBox> numberedRoom(int floor, int wall, int chair, int other, int lamp) {
    return {{{0, 0, -0.1F}, {4, 3, 0}, floor},      {{0, 0, 0}, {4, 0.1F, 2.5F}, wall},
            {{0, 2.9F, 0}, {4, 3, 2.5F}, wall},     {{0, 0, 0}, {0.1F, 3, 2.5F}, wall},
            {{3.9F, 0, 0}, {4, 3, 2.5F}, wall},     {{1, 1, 0}, {1.5F, 1.5F, 0.9F}, chair},
            {{2.5F, 1, 0}, {3, 1.5F, 0.9F}, other}, {{2, 2, 0}, {2.2F, 2.2F, 1.5F}, lamp}};
}

inline std::string asciiPly(const Triangles& mesh, bool faces_numbered,
                            const std::string& property) {
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
         << "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!faces_numbered) text << "property ushort " << property << "\n";
    text << "element face " << mesh.faces.size() << "\nproperty list uchar int vertex_indices\n";
    if (faces_numbered) text << "property int " << property << "\n";
    text << "end_header\n";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        text << mesh.positions[i].transpose();
        if (!faces_numbered) text << " " << mesh.of_position[i];
        text << "\n";
    }
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        text << "3 " << mesh.faces[i][0] << " " << mesh.faces[i][1] << " " << mesh.faces[i][2];
        if (faces_numbered) text << " " << mesh.of_face[i];
        text << "\n";
    }
    return text.str();
}

}  // namespace dollytrack::test
