#include "silhouette/methods/brute_force_packed.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "tests/silhouette/hough/support/hard_meshes.h"
#include "tests/silhouette/hough/support/probe_points.h"

using namespace rimline;

TEST_CASE("packed brute force equals the plain one, bit for bit, on every kind of mesh") {
    constexpr std::uint64_t k_seed = 20;
    CAPTURE(k_seed);
    for (const tests::NamedSource& named : tests::made_meshes(1000)) {
        CAPTURE(named.name);
        const Mesh mesh(named.source);
        const PackedBruteForce packed(mesh);
        tests::ProbePoints probes(mesh, k_seed);
        std::vector<std::uint32_t> words{1, 2, 3};
        std::vector<EdgeId> edges{EdgeId{7}};
        for (int i = 0; i < 200; ++i) {
            CAPTURE(i);
            const HomogeneousPoint point = probes.next();
            packed.face_bits(point, words);
            CHECK(words == brute_force_face_bits(mesh, point));
            packed.silhouette(words, edges);
            CHECK(edges == brute_force_silhouette(mesh, point));
        }
    }
}

TEST_CASE("packed brute force keeps to its edges where classes end within a block") {
    // Triangle soup with shared edges, inconsistent edges and edges of three faces. With one face more each
    // time, every boundary of a class passes through every position of a block.
    MeshSource source;
    for (std::uint32_t n = 0; n < 80; ++n) {
        CAPTURE(n);
        const auto x = static_cast<float>(n);
        source.positions.push_back({x, static_cast<float>(n % 3), static_cast<float>(n * n % 7)});
        if (n < 3) continue;
        source.triangles.push_back({n - 3, n - 2, n - n % 2});
        source.triangles.push_back({n - 2, n - 3 + n % 4, n});
        const Mesh mesh(source);
        const PackedBruteForce packed(mesh);
        std::vector<std::uint32_t> words;
        std::vector<EdgeId> edges;
        for (const HomogeneousPoint& point : {HomogeneousPoint::viewpoint({3, 5, 40}),
                                              HomogeneousPoint::direction({1, -2, 0.5f})}) {
            packed.face_bits(point, words);
            CHECK(words == brute_force_face_bits(mesh, point));
            packed.silhouette(words, edges);
            CHECK(edges == brute_force_silhouette(mesh, point));
        }
    }
}
