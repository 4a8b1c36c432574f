// The volumes that the shaders emit are closed: their boundary is zero, for every mesh, light and form.
//
// What is emitted is modeled by the shaders' own text (shaders/shadow_emission.h, compiled as C++)
// over the edge records that are uploaded. A chain of triangles is closed when every edge between two
// corners, near or far, is run as often one way as the other; no position enters but through the bits.

#include <doctest/doctest.h>

#include <cstdio>
#include <deque>
#include <glm/vec3.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "engine/frame/counted_volume.h"
#include "engine/shadow_choice.h"
#include "engine/stream/edge_records.h"
#include "engine/stream/gpu_mesh.h"
#include "shaders/shadow_emission.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

#ifndef RIMLINE_BOUNDARY_PAIRS
#define RIMLINE_BOUNDARY_PAIRS 100000
#endif

// Sums of directed edges between corners, in an open hash table that is emptied by counting up.
class Boundary {
public:
    explicit Boundary(std::size_t max_edges) {
        std::size_t size = 64;
        while (size < 4 * max_edges) size *= 2;
        slots_.resize(size);
    }

    void clear() {
        ++round_;
        used_.clear();
    }

    // `times` the triangle a, b, c.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, int times) {
        add(a, b, times);
        add(b, c, times);
        add(c, a, times);
    }

    bool is_zero() const {
        for (const std::size_t at : used_)
            if (slots_[at].sum != 0) return false;
        return true;
    }

private:
    struct Slot {
        std::uint64_t key = 0;
        std::uint32_t round = 0;
        std::int32_t sum = 0;
    };

    void add(std::uint32_t from, std::uint32_t to, int times) {
        if (from == to) return;
        const bool forward = from < to;
        const std::uint64_t key =
            forward ? std::uint64_t{from} << 32 | to : std::uint64_t{to} << 32 | from;
        std::size_t at = (key * 0x9e3779b97f4a7c15u >> 20) & (slots_.size() - 1);
        while (slots_[at].round == round_ && slots_[at].key != key)
            at = (at + 1) & (slots_.size() - 1);
        if (slots_[at].round != round_) {
            slots_[at] = {key, round_, 0};
            used_.push_back(at);
        }
        slots_[at].sum += forward ? times : -times;
    }

    std::vector<Slot> slots_;
    std::vector<std::size_t> used_;
    std::uint32_t round_ = 1;
};

// A mesh, and what of it is uploaded.
struct Caster {
    explicit Caster(const MeshSource& source)
        : mesh(source),
          places(mesh),
          loose(loose_edge_records(mesh)),
          closed(is_closed_chain(mesh)) {
        for (const Triangle& t : mesh.triangles())
            triangles.push_back({index(t[0]), index(t[1]), index(t[2])});
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
            edges.push_back(edge_record(mesh, EdgeId{e}));
    }
    Mesh mesh;
    mutable CasterMesh places;
    std::vector<gpu::TriangleRecord> triangles;
    std::vector<gpu::EdgeRecord> edges;
    std::vector<gpu::EdgeRecord> loose;
    bool closed;
};

enum class Drawn {
    general,
    single,
    wrong,  // The general form with the sides of the single one.
};

// The chain that ShadowVolumePass draws, into `boundary`.
class Emission {
public:
    Emission(const Caster& caster, const HomogeneousPoint& light, Boundary& boundary)
        : caster_(caster), pointed_(light.is_direction()), boundary_(boundary) {
        words_.assign(face_word_count(caster.mesh.face_count()), 0);
        for (std::uint32_t f = 0; f < caster.mesh.face_count(); ++f)
            if (is_front(caster.mesh.plane(FaceId{f}), light)) words_[f / 32] |= 1u << (f % 32);
    }

    void emit(Drawn drawn) {
        boundary_.clear();
        const bool single = drawn == Drawn::single;
        for (std::uint32_t f = 0; f < caster_.mesh.face_count(); ++f)
            if (!single || face_bit(words_, FaceId{f})) emit_caps(f);
        const std::uint32_t regular_end = caster_.mesh.edges_of_class(EdgeClass::regular).last;
        for (std::uint32_t e = 0; e < regular_end; ++e)
            if (is_on_silhouette(caster_.mesh, EdgeId{e}, words_))
                add_side(caster_.edges[e], drawn == Drawn::general ? 2 : 1);
        for (const gpu::EdgeRecord& edge : caster_.loose)
            if (!single || face_bit(words_, FaceId{edge.f0})) add_side(edge, 1);
    }

    void emit_part(const FaceRun& run, ShadowForm form) {
        boundary_.clear();
        VolumeCount part;
        append_run({.caster = &caster_.places, .face_words = words_, .form = form}, run, part);
        for (const std::uint32_t face : part.faces) emit_caps(face);
        for (const gpu::EdgeRecord& side : part.sides) add_side(side, 1);
    }

private:
    void emit_caps(std::uint32_t face) {
        const bool front = face_bit(words_, FaceId{face});
        for (const bool dark : {false, true}) {
            if (dark && pointed_) continue;
            const gpu::TriangleRecord& t = caster_.triangles[face];
            boundary_.add(number(gpu::cap_corner(t, dark, 0)), number(gpu::cap_corner(t, dark, 1)),
                          number(gpu::cap_corner(t, dark, 2)), front ? 1 : -1);
        }
    }

    // Where all rays end in one point, all far corners are that point.
    std::uint32_t number(const gpu::VolumeCorner& corner) const {
        if (!corner.is_far) return 2 * corner.vertex;
        return pointed_ ? 1 : 2 * corner.vertex + 1;
    }

    void add_side(const gpu::EdgeRecord& edge, int times) {
        const bool front = face_bit(words_, FaceId{edge.f0});
        for (std::uint32_t first = 0; first < (pointed_ ? 3u : 6u); first += 3)
            boundary_.add(number(gpu::side_corner(edge, front, first)),
                          number(gpu::side_corner(edge, front, first + 1)),
                          number(gpu::side_corner(edge, front, first + 2)), times);
    }

    const Caster& caster_;
    bool pointed_;
    Boundary& boundary_;
    std::vector<std::uint32_t> words_;
};

// Triangles over few vertices, so that edges have any number of faces in any direction.
MeshSource crowded(std::uint32_t vertices, std::uint32_t triangles, Random& random) {
    Indices indices;
    for (std::uint32_t t = 0; t < triangles; ++t)
        indices.push_back({random.below(vertices), random.below(vertices), random.below(vertices)});
    return with_any_positions(vertices, std::move(indices));
}

}  // namespace

TEST_CASE("the boundary of every emitted volume is zero" * doctest::test_suite("plain")) {
    constexpr std::uint64_t k_seed = 11;
    constexpr int k_pairs = RIMLINE_BOUNDARY_PAIRS;
    CAPTURE(k_seed);
    Random random(k_seed);
    std::deque<Caster> casters;
    for (const char* name : {"box", "sphere", "torus", "knot", "spring", "terrain", "scene"})
        casters.emplace_back(make_built_in_shape(name, 100));
    casters.emplace_back(tetrahedron());
    casters.emplace_back(octahedron());
    for (const std::uint32_t wings : {1u, 2u, 3u, 6u}) casters.emplace_back(book(wings));
    for (const bool twisted : {false, true}) {
        casters.emplace_back(band(9, twisted));
        casters.emplace_back(closed_grid(6, 5, twisted));
    }
    for (std::uint32_t i = 0; i < 40; ++i)
        casters.emplace_back(crowded(5 + i % 12, 10 + 5 * i, random));
    for (std::uint32_t i = 0; i < 10; ++i)  // Nothing shared.
        casters.emplace_back(crowded(300, 20, random));
    std::size_t max_edges = 0;
    for (const Caster& caster : casters)
        max_edges = std::max<std::size_t>(max_edges, 12 * caster.mesh.face_count());
    Boundary boundary(max_edges);
    int singles = 0;
    int open = 0;
    for (int pair = 0; pair < k_pairs; ++pair) {
        const Caster& caster = casters[random.below(static_cast<std::uint32_t>(casters.size()))];
        const auto& positions = caster.mesh.positions();
        glm::vec3 place = 3.0f * random.in_cube();
        if (pair % 8 == 0) place[static_cast<int>(random.below(3))] = 0.0f;
        if (pair % 8 == 1)  // On a vertex.
            place = positions[random.below(static_cast<std::uint32_t>(positions.size()))];
        if (pair % 8 == 2) place *= 1e-3f;
        if (pair % 8 == 3) place *= 1e6f;
        const HomogeneousPoint light =
            pair % 3 == 0 ? HomogeneousPoint::direction(place) : HomogeneousPoint::viewpoint(place);
        Emission emission(caster, light, boundary);
        INFO("pair ", pair);
        emission.emit(Drawn::general);
        bool closed = boundary.is_zero();
        // Any run of faces in any order is a volume, in both forms, whatever the mesh is.
        const std::uint32_t faces = caster.mesh.face_count();
        std::vector<std::uint32_t> order(faces), ranks(faces);
        std::iota(order.begin(), order.end(), 0u);
        if (pair % 4 != 0) random.shuffle(order);
        for (std::uint32_t rank = 0; rank < faces; ++rank) ranks[order[rank]] = rank;
        const std::uint32_t first = random.below(faces);
        const std::uint32_t end = first + 1 + random.below(faces - first);
        for (const ShadowForm form : {ShadowForm::general, ShadowForm::single}) {
            emission.emit_part({order, ranks, first, end}, form);
            closed = closed && boundary.is_zero();
        }
        if (caster.closed) {
            ++singles;
            emission.emit(Drawn::single);
            closed = closed && boundary.is_zero();
        }
        if (!closed) REQUIRE(closed);
        emission.emit(Drawn::wrong);
        open += boundary.is_zero() ? 0 : 1;
    }
    std::printf("%d pairs, %d in the single form too; with half the sides %d were open\n", k_pairs,
                singles, open);
    CHECK(singles > k_pairs / 10);
    CHECK(open > k_pairs / 10);
}
