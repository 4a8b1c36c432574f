// The functions of rimline.wasm, which rimline.mjs alone calls. Pointers are numbers in JavaScript.
//
// A function that can fail throws the message as an Error of JavaScript. All arguments but the content of
// arrays are checked by rimline.mjs.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"

using namespace rimline;

/// Throws an Error of JavaScript with this message, UTF-8.
extern "C" [[noreturn]] __attribute__((import_module("rimline"), import_name("fail"))) void fail(
    const char* message);

namespace {

struct WebMesh {
    explicit WebMesh(const MeshSource& source, Welding welding) : mesh(source, welding) {}

    const HoughOctree& make_octree() {
        if (!octree) octree.emplace(mesh);
        return *octree;
    }

    Mesh mesh;
    std::optional<HoughOctree> octree;  // Made for the first tracker.
    std::vector<EdgeId> found;          // By the last call of mesh_silhouette.
};

// An array of JavaScript: where it lies, and how many numbers it has.
struct Numbers {
    const void* data;
    std::uint32_t count;
};

// What rimline.mjs reads of a tracker, as 32-bit numbers in this order.
struct TrackerState {
    Numbers silhouette, added, removed, flipped, slots, words;
};
static_assert(sizeof(TrackerState) == 48 && alignof(TrackerState) == 4);

struct WebTracker {
    WebTracker(std::shared_ptr<WebMesh> of, const HomogeneousPoint& point)
        : mesh(std::move(of)), tracker(mesh->make_octree(), point) {
        read({});
    }

    void read(const ChangeSet& change) {
        const auto numbers = [](const auto& elements) {
            using Element = typename std::remove_cvref_t<decltype(elements)>::value_type;
            return Numbers{elements.data(),
                           static_cast<std::uint32_t>(elements.size() * (sizeof(Element) / 4))};
        };
        state = {numbers(tracker.silhouette()), numbers(change.added), numbers(change.removed),
                 numbers(change.flipped),       numbers(change.slots), numbers(change.words)};
    }

    std::shared_ptr<WebMesh> mesh;
    SilhouetteTracker tracker;
    TrackerState state;
};

template <typename Call>
auto result_of(Call&& call) {
    try {
        return call();
    } catch (const std::bad_alloc&) {
        fail("out of memory");
    } catch (const std::length_error&) {  // An array of more than half of the 32-bit addresses.
        fail("out of memory");
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void check_positions(std::span<const glm::vec3> positions) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!HomogeneousPoint::is_valid(positions[i]))
            throw Error(ErrorCode::bad_input, "positions: a coordinate of vertex " +
                                                  std::to_string(i) +
                                                  " is not a finite number within 2^60");
}

void check_triangles(const MeshSource& source) {
    for (std::size_t i = 0; i < source.triangles.size(); ++i)
        for (const std::uint32_t corner : source.triangles[i])
            if (corner >= source.positions.size())
                throw Error(ErrorCode::bad_input, "indices: triangle " + std::to_string(i) +
                                                      " has vertex " + std::to_string(corner) +
                                                      " of " +
                                                      std::to_string(source.positions.size()));
}

HomogeneousPoint point_of(float x, float y, float z, bool is_direction) {
    const glm::vec3 vector(x, y, z);
    return is_direction ? HomogeneousPoint::direction(vector) : HomogeneousPoint::viewpoint(vector);
}

constexpr double k_min_radius = 0x1p-50;

}  // namespace

extern "C" {

#define RIMLINE_EXPORT(name) __attribute__((export_name(#name)))

/// The content of a mesh: the caller writes the positions and the corners, and gives it to mesh_create.
RIMLINE_EXPORT(source_create)
MeshSource* source_create(std::uint32_t vertices, std::uint32_t triangles) {
    return result_of([&] {
        auto source = std::make_unique<MeshSource>();
        source->positions.resize(vertices);
        source->triangles.resize(triangles);
        return source.release();
    });
}
RIMLINE_EXPORT(source_positions)
float* source_positions(MeshSource* source) {
    return reinterpret_cast<float*>(source->positions.data());
}
RIMLINE_EXPORT(source_corners)
std::uint32_t* source_corners(MeshSource* source) {
    return reinterpret_cast<std::uint32_t*>(source->triangles.data());
}

using MeshHandle = std::shared_ptr<WebMesh>;

/// Frees the source, also where it throws.
RIMLINE_EXPORT(mesh_create)
MeshHandle* mesh_create(MeshSource* source, bool weld) {
    return result_of([&] {
        const std::unique_ptr<MeshSource> owned(source);
        check_positions(source->positions);
        check_triangles(*source);
        auto mesh =
            std::make_shared<WebMesh>(*source, weld ? Welding::equal_positions : Welding::none);
        if (mesh->mesh.radius() > 0.0 && mesh->mesh.radius() < k_min_radius)
            throw Error(ErrorCode::bad_input,
                        "the mesh is too small, less than 2^-50 in size: scale it up");
        return new MeshHandle(std::move(mesh));
    });
}
RIMLINE_EXPORT(mesh_free)
void mesh_free(MeshHandle* mesh) { delete mesh; }

RIMLINE_EXPORT(mesh_vertex_count)
std::uint32_t mesh_vertex_count(const MeshHandle* mesh) { return (*mesh)->mesh.vertex_count(); }
RIMLINE_EXPORT(mesh_face_count)
std::uint32_t mesh_face_count(const MeshHandle* mesh) { return (*mesh)->mesh.face_count(); }
RIMLINE_EXPORT(mesh_edge_count)
std::uint32_t mesh_edge_count(const MeshHandle* mesh) { return (*mesh)->mesh.edge_count(); }
/// Borders are the last edges.
RIMLINE_EXPORT(mesh_border_count)
std::uint32_t mesh_border_count(const MeshHandle* mesh) {
    return (*mesh)->mesh.edges_of_class(EdgeClass::border).size();
}
RIMLINE_EXPORT(mesh_is_closed)
bool mesh_is_closed(const MeshHandle* mesh) { return (*mesh)->mesh.is_closed(); }
RIMLINE_EXPORT(mesh_is_oriented)
bool mesh_is_oriented(const MeshHandle* mesh) { return (*mesh)->mesh.is_oriented(); }
RIMLINE_EXPORT(mesh_center)
double mesh_center(const MeshHandle* mesh, int axis) { return (*mesh)->mesh.center()[axis]; }
RIMLINE_EXPORT(mesh_radius)
double mesh_radius(const MeshHandle* mesh) { return (*mesh)->mesh.radius(); }

/// Writes the two vertices of each edge, by the numbers of the source.
RIMLINE_EXPORT(mesh_write_edges)
void mesh_write_edges(const MeshHandle* handle, std::uint32_t* vertices) {
    const Mesh& mesh = (*handle)->mesh;
    for (const Edge& edge : mesh.edges())
        for (const VertexId vertex : edge.vertices) *vertices++ = mesh.file_vertex(vertex);
}

/// Returns the number of edges. They are at mesh_found, ascending, until the next call.
RIMLINE_EXPORT(mesh_silhouette)
std::uint32_t mesh_silhouette(MeshHandle* handle, float x, float y, float z, bool is_direction) {
    return result_of([&] {
        WebMesh& mesh = **handle;
        const HomogeneousPoint point = point_of(x, y, z, is_direction);
        if (mesh.octree) {
            TraversalCounters counters;
            mesh.octree->extract(point, mesh.found, counters);
            std::sort(mesh.found.begin(), mesh.found.end());
        } else {
            // An index takes far more time than a test of all faces.
            mesh.found = brute_force_silhouette(mesh.mesh, point);
        }
        return static_cast<std::uint32_t>(mesh.found.size());
    });
}
RIMLINE_EXPORT(mesh_found)
const EdgeId* mesh_found(const MeshHandle* mesh) { return (*mesh)->found.data(); }

/// The mesh may be freed before the tracker.
RIMLINE_EXPORT(tracker_create)
WebTracker* tracker_create(const MeshHandle* mesh, float x, float y, float z, bool is_direction) {
    return result_of([&] { return new WebTracker(*mesh, point_of(x, y, z, is_direction)); });
}
RIMLINE_EXPORT(tracker_free)
void tracker_free(WebTracker* tracker) { delete tracker; }
/// The same address as long as the tracker exists.
RIMLINE_EXPORT(tracker_state)
const TrackerState* tracker_state(const WebTracker* tracker) { return &tracker->state; }
/// Allocates nothing.
RIMLINE_EXPORT(tracker_move)
void tracker_move(WebTracker* tracker, float x, float y, float z, bool is_direction) {
    tracker->read(tracker->tracker.move_to(point_of(x, y, z, is_direction)));
}

}  // extern "C"
