#include "silhouette/methods/windowed_brute_force.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/instruction_sets.h"
#include "tests/silhouette/hough/support/probe_points.h"

using namespace rimline;

namespace {

void check_from(WindowedBruteForce& windowed, const Mesh& mesh, const HomogeneousPoint& point) {
    windowed.look_from(point);
    const std::vector<std::uint32_t> expected = brute_force_face_bits(mesh, point);
    std::vector<std::uint32_t> words(expected.size(), 0);
    for (std::uint32_t place = 0; place < mesh.face_count(); ++place) {
        const std::uint32_t f = index(windowed.face_at(place));
        CHECK(windowed.places()[f] == place);
        const std::uint32_t bit = windowed.bits()[place / 16] >> place % 16 & 1u;
        words[f / 32] |= bit << f % 32;
    }
    CHECK(words == expected);
    std::vector<EdgeId> edges{EdgeId{7}};
    windowed.silhouette(edges);
    std::ranges::sort(edges);
    CHECK(edges == brute_force_silhouette(mesh, point));
}

}  // namespace

TEST_CASE("brute force by windows equals the plain one, bit for bit, on every kind of mesh") {
    constexpr std::uint64_t k_seed = 20;
    CAPTURE(k_seed);
    for (const tests::NamedSource& named : tests::made_meshes(1000)) {
        CAPTURE(named.name);
        const Mesh mesh(named.source);
        WindowedBruteForce windowed(mesh);
        tests::ProbePoints probes(mesh, k_seed);
        for (int i = 0; i < 60; ++i) {
            CAPTURE(i);
            check_from(windowed, mesh, probes.next());
        }
    }
}

TEST_CASE("brute force by windows holds meshes of any size") {
    // With one face more each time, the last block and the last window end at every lane.
    MeshSource source;
    for (std::uint32_t n = 0; n < 300; ++n) {
        const auto x = static_cast<float>(n);
        source.positions.push_back({x, static_cast<float>(n % 3), static_cast<float>(n * n % 7)});
        if (n < 3) continue;
        source.triangles.push_back({n - 3, n - 2, n - n % 2});
        if (n % 5 == 0) source.triangles.push_back({n - 2, n - 3 + n % 4, n});
        CAPTURE(source.triangles.size());
        const Mesh mesh(source);
        WindowedBruteForce windowed(mesh);
        check_from(windowed, mesh, HomogeneousPoint::viewpoint({3, 5, 40}));
        check_from(windowed, mesh, HomogeneousPoint::direction({1, -2, 0.5f}));
    }
}

TEST_CASE("every instruction set finds the same by windows") {
    const Mesh mesh(make_built_in_shape("knot", 5000));
    std::uint32_t sets = 0;
    tests::for_each_instruction_set([&](const std::string& set) {
        CAPTURE(set);
        ++sets;
        WindowedBruteForce windowed(mesh);
        tests::ProbePoints probes(mesh, 5);
        for (int i = 0; i < 50; ++i) check_from(windowed, mesh, probes.next());
    });
    CHECK(sets >= (HWY_ARCH_X86 ? 2u : 1u));
}
