// The same result everywhere: hashes of meshes, silhouettes, change sets, drawings, fields and umbrellas, bit for
// bit, against hashes.txt. They must not depend on the compiler, its optimization, the number of threads, or the
// instruction set. Fields alone are sums that are rounded: they are the same on instruction sets with vectors of
// eight floats and fused multiplication, and on others within TangentialField::error_bound().
//
//     RIMLINE_WRITE_HASHES=hashes.txt identity_tests -tc="built-in*,models*"    appends those of this machine

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "silhouette/field/best_views.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "tests/models.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/skip.h"

namespace rimline {
namespace {

// FNV-1a over numbers, byte by byte from the lowest.
class Hash {
public:
    Hash& operator<<(std::uint64_t number) {
        for (int byte = 0; byte < 8; ++byte) {
            value_ = (value_ ^ (number & 0xff)) * 0x100000001b3u;
            number >>= 8;
        }
        return *this;
    }
    Hash& operator<<(double number) { return *this << std::bit_cast<std::uint64_t>(number); }
    Hash& operator<<(const glm::vec3& v) {
        return *this << double(v.x) << double(v.y) << double(v.z);
    }
    template <typename Id>
    Hash& sorted(std::span<const Id> ids) {
        std::vector<Id> in_order(ids.begin(), ids.end());
        std::ranges::sort(in_order);
        *this << std::uint64_t{in_order.size()};
        for (const Id id : in_order) *this << std::uint64_t{index(id)};
        return *this;
    }
    std::string text() const {
        std::ostringstream out;
        out << std::hex << value_;
        return out.str();
    }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

// Points around a sphere. Only the generator's own numbers, which the standard defines, and exact operations.
class Places {
public:
    Places(const glm::dvec3& center, double radius) : center_(center), radius_(radius) {}
    glm::vec3 next() {
        const auto coordinate = [&] { return double(random_() % 4096) / 512.0 - 4.0; };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        return glm::vec3(center_ + radius_ * glm::dvec3(x, y, z));
    }

private:
    std::mt19937 random_{7};
    glm::dvec3 center_;
    double radius_;
};

using Hashes = std::map<std::string, std::string>;

std::string hash_of_silhouettes(const HoughOctree& octree) {
    Hash hash;
    Places places(octree.mesh().center(), octree.mesh().radius());
    std::vector<EdgeId> edges;
    for (int i = 0; i < 20; ++i) {
        TraversalCounters counters;
        octree.extract(HomogeneousPoint::viewpoint(places.next()), edges, counters);
        hash.sorted(std::span<const EdgeId>(edges));
    }
    return hash.text();
}

std::string hash_of_changes(const HoughOctree& octree) {
    Hash hash;
    Places places(octree.mesh().center(), octree.mesh().radius());
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint(places.next()));
    for (int i = 0; i < 20; ++i) {
        const ChangeSet& changes = tracker.move_to(HomogeneousPoint::viewpoint(places.next()));
        hash.sorted(changes.flipped).sorted(changes.added).sorted(changes.removed);
    }
    return hash.text();
}

std::string hash_of_drawings(const Mesh& mesh) {
    Hash hash;
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    for (const glm::dvec3 direction : {glm::dvec3(1, 2, 3), {-3, 1, 2}, {0, 0, 1}}) {
        const glm::dvec3 eye = mesh.center() + mesh.radius() * direction;
        const LineView view = direction.x < 0.0
                                  ? LineView::orthographic(eye, mesh.center(), {0, 1, 0})
                                  : LineView::perspective(eye, mesh.center(), {0, 1, 0});
        const LineDrawing& drawing =
            drawer.draw(view, brute_force_silhouette(mesh, view.point()), {});
        // Those of runs; after them come the places where strokes are cut.
        for (const LineRun& run : drawing.runs)
            for (const LinePoint& point : drawing.points_of(run))
                hash << point.position.x << point.position.y << point.depth << point.arc;
        for (const LineRun& run : drawing.runs) hash << std::uint64_t{run.hidden_by} << run.length;
        for (const LineChain& chain : drawing.chains)
            hash << std::uint64_t{chain.last_run} << std::uint64_t(chain.kind);
    }
    return hash.text();
}

std::string hash_of_fields(const Mesh& mesh) {
    Hash hash;
    const TangentialField field = make_view_field(mesh);
    Places places({}, 0.4);
    for (int i = 0; i < 50; ++i) hash << field.value(glm::dvec3(places.next()));
    return hash.text();
}

std::string hash_of_points(const Mesh& mesh) {
    Hash hash;
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& position : mesh.positions()) positions.emplace_back(position);
    const PointSurface surface(positions);
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const PointId point{i};
        hash << std::uint64_t(surface.label(point)) << surface.scale(point);
        const auto range = surface.umbrellas_of(point);
        for (std::uint32_t u = range.first; u < range.last; ++u)
            for (const PointId neighbor : surface.umbrella(UmbrellaId{u}).ring)
                hash << std::uint64_t{index(neighbor)};
    }
    const UmbrellaIndex umbrellas(surface);
    PointSilhouette silhouette(umbrellas, umbrellas.viewpoint(glm::dvec3(1, 2, 3)));
    hash << std::uint64_t{silhouette.size()} << std::uint64_t{silhouette.consensus().size()};
    return hash.text();
}

Hashes hashes_of(const Mesh& mesh) {
    Hash mesh_hash;
    for (const glm::vec3& position : mesh.positions()) mesh_hash << position;
    for (const Plane& plane : mesh.planes())
        mesh_hash << glm::vec3(plane.nx, plane.ny, plane.nz) << double(plane.d);
    const HoughOctree octree(mesh);
    return {{"mesh", mesh_hash.text()},           {"silhouettes", hash_of_silhouettes(octree)},
            {"changes", hash_of_changes(octree)}, {"drawings", hash_of_drawings(mesh)},
            {"fields", hash_of_fields(mesh)},     {"points", hash_of_points(mesh)}};
}

std::map<std::string, Hashes> checked_in() {
    std::ifstream file(RIMLINE_HASHES);
    REQUIRE(file);
    std::map<std::string, Hashes> all;
    std::string line, model, kind, hash;
    while (std::getline(file, line)) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        words >> model >> kind >> hash;
        all[model][kind] = hash;
    }
    return all;
}

// On the instruction set in use.
bool has_same_fields() {
    const std::string set(TangentialField::instruction_set());
    return set.starts_with("AVX2") || set.starts_with("AVX3");
}

void check(const std::string& name, const Mesh& mesh) {
    const Hashes hashes = hashes_of(mesh);
    if (const char* const path = std::getenv("RIMLINE_WRITE_HASHES")) {
        std::ofstream file(path, std::ios::app);
        for (const auto& [kind, hash] : hashes) file << name << " " << kind << " " << hash << "\n";
        CHECK(file);
        return;
    }
    const std::map<std::string, Hashes> expected = checked_in();
    const auto found = expected.find(name);
    REQUIRE_MESSAGE(found != expected.end(), name);
    for (const auto& [kind, hash] : hashes) {
        if (kind == "fields" && !has_same_fields()) continue;
        CAPTURE(name);
        CAPTURE(kind);
        CHECK(hash == found->second.at(kind));
    }
}

const std::vector<std::pair<std::string, std::uint32_t>> k_shapes{
    {"box", 12}, {"torus", 2000}, {"knot", 3000}, {"terrain", 2000}, {"scene", 3000}};

TEST_CASE("built-in shapes have the hashes that are checked in") {
    for (const auto& [shape, faces] : k_shapes)
        check("shape:" + shape, Mesh(make_built_in_shape(shape, faces)));
}

TEST_CASE("one thread finds what many find") {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (const auto& [shape, faces] : k_shapes)
        check("shape:" + shape, Mesh(make_built_in_shape(shape, faces)));
}

TEST_CASE("every instruction set finds the same") {
    std::uint32_t sets = 0;
    tests::for_each_instruction_set([&](const std::string& set) {
        CAPTURE(set);
        ++sets;
        for (const auto& [shape, faces] : k_shapes)
            check("shape:" + shape, Mesh(make_built_in_shape(shape, faces)));
    });
    CHECK(sets >= (HWY_ARCH_X86 ? 2u : 1u));
}

TEST_SUITE_BEGIN("plain");

TEST_CASE("models have the hashes that are checked in") {
    bool has_models = false;
    for (const char* name :
         {"alligator.obj", "beetle-alt.obj", "fandisk.obj", "horse.ply", "igea.ply",
          "nefertiti.obj", "ogre.obj", "rocker-arm.obj", "stanford-bunny.obj"}) {
        const auto path = tests::find_model(name);
        if (!path) continue;
        has_models = true;
        check(name, Mesh(read_mesh_file(*path)));
    }
    if (!has_models) RIMLINE_SKIP("no models: set RIMLINE_MODELS");
}

TEST_SUITE_END();

}  // namespace
}  // namespace rimline
