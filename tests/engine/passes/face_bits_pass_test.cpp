#include "engine/passes/face_bits_pass.h"

#include <random>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/models.h"

namespace rimline {
namespace {

// Points where rounding decides: vertices, points on planes, and directions in planes, beside plain ones.
std::vector<HomogeneousPoint> points_of(const Mesh& mesh, std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return double(random()) / 2147483648.0 - 1.0; };
    const auto vertex = [&] { return mesh.positions()[random() % mesh.vertex_count()]; };
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 v(unit(), unit(), unit());
        switch (i % 4) {
            case 0:
                points.push_back(HomogeneousPoint::viewpoint(
                    glm::vec3(mesh.center() + 3.0 * mesh.radius() * v)));
                break;
            case 1: points.push_back(HomogeneousPoint::viewpoint(vertex())); break;
            case 2: points.push_back(HomogeneousPoint::direction(glm::vec3(v))); break;
            default: points.push_back(HomogeneousPoint::direction(vertex() - vertex())); break;
        }
    }
    return points;
}

void check_bits(const DeviceContext& context, const Mesh& mesh, std::uint32_t count) {
    constexpr std::uint32_t k_seed = 4711;
    CAPTURE(k_seed);
    FaceBitsPass pass(context);
    for (const HomogeneousPoint& point : points_of(mesh, count, k_seed)) {
        CAPTURE(point.x);
        CAPTURE(point.y);
        CAPTURE(point.z);
        CAPTURE(point.w);
        REQUIRE(pass.compute(mesh.planes(), point) == brute_force_face_bits(mesh, point));
    }
}

TEST_CASE("the GPU's face bits equal the CPU's on every built-in shape") {
    RIMLINE_OPEN_GPU(gpu);
    for (const std::string_view name : k_built_in_shapes) {
        CAPTURE(name);
        check_bits(gpu->context(), Mesh(make_built_in_shape(name, 3000)), 100);
    }
}

TEST_CASE("the GPU's face bits equal the CPU's on planes whose sides hang on the last bit") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint32_t k_seed = 20051121;
    CAPTURE(k_seed);
    std::mt19937 random(k_seed);
    const auto unit = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
    FaceBitsPass pass(gpu->context());
    std::uint32_t fronts = 0;
    for (int i = 0; i < 20; ++i) {
        const HomogeneousPoint point = i % 2 == 0
                                           ? HomogeneousPoint::viewpoint({unit(), unit(), unit()})
                                           : HomogeneousPoint::direction({unit(), unit(), unit()});
        std::vector<Plane> planes;
        for (int f = 0; f < 50'000; ++f) {
            Plane plane{unit(), unit(), unit(), 0.0f};
            plane.d = (plane.nx * point.x + plane.ny * point.y) + plane.nz * point.z;
            plane.d = std::nextafter(plane.d, plane.d + float(int(random() % 3) - 1));
            planes.push_back(plane);
        }
        const std::vector<std::uint32_t> words = pass.compute(planes, point);
        for (std::uint32_t f = 0; f < planes.size(); ++f) {
            REQUIRE(face_bit(words, FaceId{f}) == is_front(planes[f], point));
            fronts += is_front(planes[f], point);
        }
    }
    // The planes are near enough that both answers are common.
    CHECK(fronts > 200'000);
    CHECK(fronts < 800'000);
}

TEST_CASE("the GPU's face bits equal the CPU's on real models" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const char* name : {"stanford-bunny.obj", "fandisk.obj", "beetle-alt.obj"}) {
        CAPTURE(name);
        const auto path = tests::find_model(name);
        if (!path) RIMLINE_SKIP(std::string(name) + " is in no folder of RIMLINE_MODELS");
        check_bits(gpu->context(), Mesh(read_mesh_file(*path)), 40);
    }
}

}  // namespace
}  // namespace rimline
