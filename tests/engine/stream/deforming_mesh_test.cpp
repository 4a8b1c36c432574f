#include "engine/stream/deforming_mesh.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "engine/vulkan/commands.h"
#include "silhouette/mesh/corner_normals.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/moving_face.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

constexpr float k_crease = 0.7f;

// The mesh on the GPU.
GpuMesh uploaded(const DeviceContext& context, const Mesh& mesh, float crease_angle_rad) {
    return upload_at_once(context, [&](UploadBatch& batch) {
        TextureSamplers samplers;  // It has no textures.
        return GpuMesh(batch, samplers, mesh, crease_angle_rad);
    });
}

class DeformingSubject {
public:
    DeformingSubject(const DeviceContext& context, const MeshSource& source, float crease_angle_rad)
        : context_(context),
          mesh_(source),
          gpu_mesh_(uploaded(context, mesh_, crease_angle_rad)),
          deforming_(upload_at_once(context,
                                    [&](UploadBatch& batch) {
                                        return DeformingMesh(batch, mesh_, gpu_mesh_,
                                                             crease_angle_rad, 2);
                                    })),
          silhouette_(upload_at_once(context, [&](UploadBatch& batch) {
              return GpuSilhouette(batch, deforming_.topology(), deforming_.faces());
          })) {}

    const Mesh& mesh() const { return mesh_; }
    const GpuSilhouette& silhouette() const { return silhouette_; }

    void run(const DeformPass& pass, const GpuSilhouettePass& silhouettes,
             const Deformation& deformation, const HomogeneousPoint& point) {
        deforming_.move(deformation, frame_++ % 2);
        run_commands(context_, [&](Commands commands) {
            pass.record(commands, std::array<const DeformingMesh*, 1>{&deforming_});
            silhouettes.record(commands, std::array{SilhouetteRun{&silhouette_, point}});
        });
    }
    template <typename T>
    std::vector<T> read(const Buffer& buffer, std::size_t count) const {
        std::vector<T> values(count);
        read_buffer(context_, buffer, std::as_writable_bytes(std::span(values)));
        return values;
    }
    std::vector<glm::vec3> positions() const {
        return read<glm::vec3>(deforming_.position_buffer(), mesh_.vertex_count());
    }
    std::vector<glm::vec3> normals() const {
        return read<glm::vec3>(deforming_.corner_normal_buffer(), 3 * mesh_.face_count());
    }

private:
    const DeviceContext& context_;
    Mesh mesh_;
    GpuMesh gpu_mesh_;
    DeformingMesh deforming_;
    GpuSilhouette silhouette_;
    std::uint32_t frame_ = 0;
};

// Bits and edges from the positions that the GPU has now.
void check_silhouette(const DeformingSubject& subject, const HomogeneousPoint& point) {
    const Mesh& mesh = subject.mesh();
    const std::vector<std::uint32_t> words =
        moving_face_bits(mesh.triangles(), subject.positions(), point);
    std::vector<EdgeId> edges;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        if (is_on_silhouette(mesh, EdgeId{e}, words)) edges.push_back(EdgeId{e});
    const GpuSilhouette& silhouette = subject.silhouette();
    REQUIRE(subject.read<std::uint32_t>(silhouette.face_words(), words.size()) == words);
    const auto counts = subject.read<GpuSilhouetteCounts>(silhouette.counts(), 1).front();
    REQUIRE(counts.silhouette == edges.size());
    REQUIRE(subject.read<EdgeId>(silhouette.slots(), edges.size()) == edges);
}

MeshSource at(MeshSource source, std::span<const glm::vec3> positions) {
    source.positions.assign(positions.begin(), positions.end());
    return source;
}

TEST_CASE("a wave moves every vertex as its formula says, and silhouettes follow it bit for bit") {
    RIMLINE_OPEN_GPU(gpu);
    const DeformPass pass(gpu->context());
    const GpuSilhouettePass silhouettes(gpu->context());
    for (const char* name : {"spring", "terrain", "scene"}) {
        CAPTURE(name);
        DeformingSubject subject(gpu->context(), make_built_in_shape(name, 8000), k_crease);
        const Mesh& mesh = subject.mesh();
        for (int frame = 0; frame < 12; ++frame) {
            CAPTURE(frame);
            Wave wave = default_wave(mesh, {0, 1, 0}, frame / 12.0);
            wave.center += glm::dvec3(0.3, 0.1, -0.2);
            const HomogeneousPoint point =
                frame % 2 == 0 ? HomogeneousPoint::viewpoint({2.0f, 0.5f, 0.1f * float(frame)})
                               : HomogeneousPoint::direction({0.3f, 1.0f, 0.2f});
            subject.run(pass, silhouettes, wave, point);
            const std::vector<glm::vec3> positions = subject.positions();
            const BoundingSphere sphere = bounding_sphere(mesh, wave);
            for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
                const glm::dvec3 rest(mesh.positions()[v]);
                const double turns =
                    glm::dot(wave.travel, rest - wave.center) / wave.length - wave.turns;
                const glm::dvec3 exact = rest + wave.amplitude * wave.direction *
                                                    std::sin(2.0 * std::numbers::pi * turns);
                REQUIRE(glm::distance(exact, glm::dvec3(positions[v])) < 2e-5 * mesh.radius());
                REQUIRE(glm::distance(sphere.center, glm::dvec3(positions[v])) <=
                        sphere.radius * (1.0 + 1e-6));
            }
            check_silhouette(subject, point);
        }
    }
}

TEST_CASE("positions of the caller's are drawn as they are, frame after frame") {
    RIMLINE_OPEN_GPU(gpu);
    const DeformPass pass(gpu->context());
    const GpuSilhouettePass silhouettes(gpu->context());
    constexpr std::uint64_t k_seed = 401;
    CAPTURE(k_seed);
    tests::Random random(k_seed);
    DeformingSubject subject(gpu->context(), make_built_in_shape("torus", 3000), k_crease);
    std::vector<glm::vec3> positions(subject.mesh().positions().begin(),
                                     subject.mesh().positions().end());
    for (int frame = 0; frame < 10; ++frame) {
        for (glm::vec3& p : positions) p += 0.02f * random.in_cube();
        const HomogeneousPoint point = HomogeneousPoint::viewpoint(3.0f * random.in_cube());
        subject.run(pass, silhouettes,
                    MovedPositions{.positions = positions, .center = {}, .radius = 3.0}, point);
        REQUIRE(subject.positions() == positions);
        check_silhouette(subject, point);
    }
}

TEST_CASE("a mesh at rest is shaded as it is without deforming") {
    RIMLINE_OPEN_GPU(gpu);
    const DeformPass pass(gpu->context());
    const GpuSilhouettePass silhouettes(gpu->context());
    for (const char* name : {"box", "knot", "scene"}) {
        CAPTURE(name);
        DeformingSubject subject(gpu->context(), make_built_in_shape(name, 4000), k_crease);
        Wave still = default_wave(subject.mesh(), {0, 1, 0}, 0.3);
        still.amplitude = 0.0;
        subject.run(pass, silhouettes, still, HomogeneousPoint::viewpoint({3, 2, 1}));
        const std::vector<glm::vec3> expected = corner_normals(subject.mesh(), k_crease);
        const std::vector<glm::vec3> normals = subject.normals();
        for (std::size_t i = 0; i < expected.size(); ++i)
            REQUIRE(glm::distance(expected[i], normals[i]) < 1e-4f);
    }
}

TEST_CASE("normals follow the positions: smooth ones equal those of the deformed mesh itself") {
    RIMLINE_OPEN_GPU(gpu);
    const DeformPass pass(gpu->context());
    const GpuSilhouettePass silhouettes(gpu->context());
    const float all = std::numbers::pi_v<float>;
    const MeshSource source = make_built_in_shape("knot", 4000);
    DeformingSubject subject(gpu->context(), source, all);
    subject.run(pass, silhouettes, default_wave(subject.mesh(), {0, 1, 0}, 0.2),
                HomogeneousPoint::viewpoint({3, 2, 1}));
    REQUIRE(subject.mesh().vertex_count() == source.positions.size());
    const Mesh deformed(at(source, subject.positions()));
    const std::vector<glm::vec3> expected = corner_normals(deformed, all);
    const std::vector<glm::vec3> normals = subject.normals();
    float moved = 0.0f;
    const std::vector<glm::vec3> at_rest = corner_normals(subject.mesh(), all);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        REQUIRE(glm::distance(expected[i], normals[i]) < 1e-4f);
        moved = std::max(moved, glm::distance(at_rest[i], normals[i]));
    }
    CHECK(moved > 0.1f);
}

TEST_CASE("normals are of length 1 on degenerate, cancelling, tiny and huge faces") {
    RIMLINE_OPEN_GPU(gpu);
    const DeformPass pass(gpu->context());
    const GpuSilhouettePass silhouettes(gpu->context());
    const auto scaled = [](MeshSource source, float scale) {
        for (glm::vec3& p : source.positions) p *= scale;
        return source;
    };
    const MeshSource folded{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    const MeshSource line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {1, 1, 2}}};
    for (const MeshSource& source : {folded, line, scaled(tests::tetrahedron(), 0x1p-90f),
                                     scaled(tests::tetrahedron(), 0x1p58f), MeshSource{}}) {
        DeformingSubject subject(gpu->context(), source, std::numbers::pi_v<float>);
        const HomogeneousPoint point = HomogeneousPoint::direction({0, 0, 1});
        subject.run(pass, silhouettes,
                    MovedPositions{subject.mesh().positions(), subject.mesh().center(),
                                   subject.mesh().radius()},
                    point);
        check_silhouette(subject, point);
        for (const glm::vec3& normal : subject.normals())
            REQUIRE(std::abs(glm::length(normal) - 1.0f) < 1e-5f);
    }
}

TEST_CASE("a deformation that leaves the range of coordinates is refused") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(tests::tetrahedron());
    const GpuMesh gpu_mesh = uploaded(gpu->context(), mesh, k_crease);
    DeformingMesh deforming = upload_at_once(gpu->context(), [&](UploadBatch& batch) {
        return DeformingMesh(batch, mesh, gpu_mesh, k_crease, 1);
    });
    Wave wave = default_wave(mesh, {0, 1, 0}, 0.0);
    deforming.move(wave, 0);
    wave.amplitude = 0x1p60;
    CHECK_THROWS_WITH_AS(deforming.move(wave, 0), doctest::Contains("range of coordinates"), Error);
}

}  // namespace
}  // namespace rimline
