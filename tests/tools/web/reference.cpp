// web_reference MODEL FILE: writes what the native library finds, for the web package to find again.
//
// 32-bit numbers in the order of bytes of the machine:
//
//     vertices, triangles, edges, points
//     positions, 3 floats each | corners, 3 each | the vertices of edges, 2 each
//     for each point: x, y, z as floats, 1 for a direction, the size of the silhouette, its edges by slot
//
// The points follow an orbit, then jump: onto planes of faces and vertices, inside, to infinity, and far away.

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "silhouette/rimline.h"
#include "tools/options/model_argument.h"

using namespace rimline;

namespace {

class Words {
public:
    explicit Words(const std::string& path) : file_(path, std::ios::binary) {}

    template <typename Element>
    void write(std::span<const Element> elements) {
        static_assert(sizeof(Element) % 4 == 0);
        file_.write(reinterpret_cast<const char*>(elements.data()),
                    static_cast<std::streamsize>(elements.size_bytes()));
    }
    void write(std::uint32_t number) { write(std::span<const std::uint32_t>(&number, 1)); }
    bool close() {
        file_.close();
        return bool(file_);
    }

private:
    std::ofstream file_;
};

std::vector<HomogeneousPoint> points_around(const Mesh& mesh) {
    std::mt19937 random(5);
    const auto below = [&](std::uint32_t count) {
        return static_cast<std::uint32_t>(random() % count);
    };
    const auto in_cube = [&] {
        const auto coordinate = [&] { return float(random()) * 0x1p-31f - 1.0f; };
        return glm::vec3(coordinate(), coordinate(), coordinate());
    };
    const glm::vec3 center(mesh.center());
    const float radius = mesh.radius() > 0.0 ? static_cast<float>(mesh.radius()) : 1.0f;

    std::vector<HomogeneousPoint> points;
    const auto add_eye = [&](glm::vec3 eye) { points.push_back(HomogeneousPoint::viewpoint(eye)); };
    const auto add_direction = [&](glm::vec3 direction) {
        points.push_back(HomogeneousPoint::direction(direction));
    };
    for (int i = 0; i < 180; ++i) {
        const float angle_rad = float(i) * std::numbers::pi_v<float> / 360.0f;
        add_eye(center + radius * glm::vec3(2.5f * std::cos(angle_rad), 0.01f * float(i),
                                            2.5f * std::sin(angle_rad)));
    }
    for (int i = 0; i < 60; ++i) {
        const Triangle& triangle = mesh.triangles()[below(mesh.face_count())];
        const glm::vec3 a = mesh.positions()[index(triangle[0])];
        const glm::vec3 b = mesh.positions()[index(triangle[1])];
        const glm::vec3 c = mesh.positions()[index(triangle[2])];
        add_eye(a + 2.0f * (b - a) + 3.0f * (c - a));
        add_eye(b);
        if (c != a) add_direction(c - a);  // Along an edge, so in the planes of its faces.
    }
    for (int i = 0; i < 40; ++i) add_eye(center + 0.1f * radius * in_cube());
    for (int i = 0; i < 40; ++i) add_direction(radius * in_cube());
    for (const glm::vec3 axis :
         {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 0x1p-50f)})
        add_direction(axis);
    for (int i = 0; i < 40; ++i) add_eye(center + std::ldexp(radius, i) * in_cube());
    for (int i = 0; i < 40; ++i) add_eye(center + 3.0f * radius * in_cube());
    return points;
}

void write_reference(const std::string& model, const std::string& path) {
    const MeshSource source = tools::load_model(model, 0, FaceRequirement::faces,
                                                [](const std::string&) { return LongCall{}; });
    const Mesh mesh(source);
    const HoughOctree octree(mesh);
    const std::vector<HomogeneousPoint> points = points_around(mesh);
    const auto size32 = [](std::size_t size) { return static_cast<std::uint32_t>(size); };

    Words words(path);
    words.write(size32(source.positions.size()));
    words.write(mesh.face_count());
    words.write(mesh.edge_count());
    words.write(size32(points.size()));
    words.write(std::span(source.positions));
    words.write(std::span(source.triangles));
    for (const Edge& edge : mesh.edges())
        for (const VertexId vertex : edge.vertices) words.write(mesh.file_vertex(vertex));
    SilhouetteTracker tracker(octree, points[0]);
    for (const HomogeneousPoint& point : points) {
        tracker.move_to(point);
        const glm::vec3 vector = point.xyz();
        words.write(std::span<const glm::vec3>(&vector, 1));
        words.write(std::uint32_t{point.is_direction()});
        words.write(size32(tracker.silhouette().size()));
        words.write(tracker.silhouette());
    }
    if (!words.close()) throw Error(ErrorCode::io, path + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: web_reference MODEL FILE\n");
        return 2;
    }
    try {
        write_reference(argv[1], argv[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "web_reference: %s\n", error.what());
        return 1;
    }
    return 0;
}
