// Every exact method against brute force, from the same difficult points.

#include <doctest/doctest.h>

#include <array>
#include <string_view>

#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/models.h"
#include "tests/silhouette/hough/support/generated_meshes.h"
#include "tests/silhouette/hough/test_size.h"
#include "tests/silhouette/methods/proof/proof.h"
#include "tests/skip.h"

namespace rimline {
namespace {

void prove_generated_methods(std::uint32_t first, std::uint32_t last, const tests::Quota& quota) {
    tests::Tally tally;
    for (std::uint32_t number = first; number < last; ++number) {
        const tests::NamedSource made = tests::generated_mesh(number);
        CAPTURE(made.name);
        tests::prove_methods(Mesh(made.source), quota, number, tally);
    }
    MESSAGE("meshes and seeds " << first << " to " << last - 1 << ": " << to_string(tally));
    // Ten methods extract, six of them follow.
    CHECK(tally.extractions >= (last - first) * 10 * quota.extractions);
    CHECK(tally.moves >= (last - first) * 6 * quota.moves);
    CHECK(tally.rounded_bits > 0);
}

TEST_CASE("in small: every exact method equals brute force on meshes of every generated kind") {
    const std::uint32_t each = tests::model_count(60);
    prove_generated_methods(0, 2 * tests::k_generated_kinds, {each, each});
}

TEST_SUITE("long") {
    TEST_CASE("every exact method equals brute force on one half of the generated meshes") {
        prove_generated_methods(0, 100, {2000, 2000});
    }
    TEST_CASE("every exact method equals brute force on the other half of the generated meshes") {
        prove_generated_methods(100, 200, {2000, 2000});
    }
    TEST_CASE("every exact method equals brute force on built-in shapes and hard meshes") {
        const std::uint64_t seed = 401;
        tests::Tally tally;
        for (const auto& [name, source] : tests::made_meshes(3000)) {
            CAPTURE(name);
            tests::prove_methods(Mesh(source), {300, 300}, seed, tally);
        }
        MESSAGE("seed " << seed << ": " << to_string(tally));
        CHECK(tally.meshes > 20);
    }
    TEST_CASE("every exact method equals brute force on models") {
        const std::uint64_t seed = 402;
        constexpr std::array<std::string_view, 9> k_files{
            "alligator.obj", "beetle-alt.obj", "fandisk.obj",    "horse.ply",         "igea.ply",
            "nefertiti.obj", "ogre.obj",       "rocker-arm.obj", "stanford-bunny.obj"};
        tests::Tally tally;
        std::string missing;
        for (const std::string_view file : k_files) {
            const auto path = tests::find_model(std::string(file));
            if (!path) {
                missing.append(" ").append(file);
                continue;
            }
            CAPTURE(file);
            tests::prove_methods(Mesh(read_mesh_file(*path)), {120, 120}, seed, tally);
        }
        MESSAGE("models, seed " << seed << ": " << to_string(tally));
        CHECK(tally.extractions >= tally.meshes * 10 * 120);
        CHECK(tally.moves >= tally.meshes * 6 * 120);
        if (!missing.empty()) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds" + missing);
    }
}

}  // namespace
}  // namespace rimline
