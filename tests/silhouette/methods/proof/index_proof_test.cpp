// The index and its tracker against brute force: a small number of comparisons at every run, four million in
// the cases labeled `long`. These are several cases of about a minute, to use two cores. A failure names the
// mesh, the layout, the instruction set, the seed and the point.

#include <doctest/doctest.h>

#include <array>
#include <string_view>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/models.h"
#include "tests/silhouette/hough/support/generated_meshes.h"
#include "tests/silhouette/hough/test_size.h"
#include "tests/silhouette/methods/proof/proof.h"
#include "tests/skip.h"

namespace rimline {
namespace {

constexpr std::uint32_t k_generated = 200;

// The generated meshes [first, last); seeds are their numbers.
tests::Tally prove_generated(std::uint32_t first, std::uint32_t last, const tests::Quota& quota) {
    tests::Tally tally;
    for (std::uint32_t number = first; number < last; ++number) {
        const tests::NamedSource made = tests::generated_mesh(number);
        CAPTURE(made.name);
        tests::prove_index(Mesh(made.source), quota, number, tally);
    }
    MESSAGE("meshes and seeds " << first << " to " << last - 1 << ": " << to_string(tally));
    return tally;
}

tests::Tally prove_made(std::uint32_t faces, const tests::Quota& quota, std::uint64_t seed) {
    tests::Tally tally;
    for (const auto& [name, source] : tests::made_meshes(faces)) {
        CAPTURE(name);
        tests::prove_index(Mesh(source), quota, seed, tally);
    }
    MESSAGE("built-in shapes of " << faces << " faces and hard meshes, seed " << seed << ": "
                                  << to_string(tally));
    CHECK(tally.extractions >= tally.meshes * quota.extractions);
    CHECK(tally.moves >= tally.meshes * quota.moves);
    return tally;
}

// Each file that exists. The case reports itself skipped where one is missing.
void prove_models(std::span<const std::string_view> files, const tests::Quota& quota,
                  std::uint64_t seed) {
    tests::Tally tally;
    std::string missing;
    for (const std::string_view file : files) {
        const auto path = tests::find_model(std::string(file));
        if (!path) {
            missing.append(" ").append(file);
            continue;
        }
        CAPTURE(file);
        tests::prove_index(Mesh(read_mesh_file(*path)), quota, seed, tally);
    }
    MESSAGE("models, seed " << seed << ": " << to_string(tally));
    CHECK(tally.extractions >= tally.meshes * quota.extractions);
    CHECK(tally.moves >= tally.meshes * quota.moves);
    if (!missing.empty()) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds" + missing);
}

TEST_CASE("in small: the index equals brute force on meshes of every generated kind") {
    const std::uint32_t each = tests::model_count(2000);
    const tests::Tally tally = prove_generated(0, 2 * tests::k_generated_kinds, {each, each});
    CHECK(tally.extractions >= 2 * tests::k_generated_kinds * each);
    CHECK(tally.moves >= 2 * tests::k_generated_kinds * each);
    CHECK(tally.rounded_bits > 0);
    CHECK(tally.fresh_moves > 0);
    CHECK(tally.fresh_moves < tally.moves);
    CHECK(tally.instruction_sets.size() >= 2);  // Every machine has scalar code.
}

TEST_CASE("in small: the index equals brute force on built-in shapes and hard meshes") {
    const std::uint32_t each = tests::model_count(1000);
    CHECK(prove_made(500, {each, each}, 300).meshes > 20);
}

TEST_SUITE("long") {
    // Extractions, and as many moves, in each of four parts.
    constexpr std::uint32_t k_part = 1'000'000;
    constexpr std::uint32_t k_part_meshes = k_generated / 4;

    void prove_part(std::uint32_t part) {
        constexpr std::uint32_t k_each = k_part / k_part_meshes;
        const tests::Tally tally =
            prove_generated(part * k_part_meshes, (part + 1) * k_part_meshes, {k_each, k_each});
        CHECK(tally.extractions >= k_part);
        CHECK(tally.moves >= k_part);
        CHECK(tally.rounded_bits > 10'000);
    }

    TEST_CASE("a first million extractions and moves equals brute force") { prove_part(0); }
    TEST_CASE("a second million extractions and moves equals brute force") { prove_part(1); }
    TEST_CASE("a third million extractions and moves equals brute force") { prove_part(2); }
    TEST_CASE("a fourth million extractions and moves equals brute force") { prove_part(3); }

    TEST_CASE("the index equals brute force on built-in shapes and hard meshes of two sizes") {
        CHECK(prove_made(400, {4000, 4000}, 301).meshes > 20);
        CHECK(prove_made(12'000, {2000, 600}, 302).meshes > 20);
    }
    TEST_CASE("the index equals brute force on the smaller models") {
        constexpr std::array<std::string_view, 5> k_files{"alligator.obj", "fandisk.obj",
                                                          "rocker-arm.obj", "beetle-alt.obj",
                                                          "stanford-bunny.obj"};
        prove_models(k_files, {6000, 1500}, 303);
    }
    TEST_CASE("the index equals brute force on the larger models") {
        constexpr std::array<std::string_view, 4> k_files{"horse.ply", "igea.ply", "nefertiti.obj",
                                                          "ogre.obj"};
        prove_models(k_files, {3000, 600}, 304);
    }
}

}  // namespace
}  // namespace rimline
