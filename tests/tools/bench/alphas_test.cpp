#include "tools/bench/alphas.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/tools/bench/quiet_context.h"

using namespace rimline;
using tools::AlphaMean;
using tools::AlphaOptions;
using tools::AlphaResult;
using tools::bench_alphas;
using tools::k_alphas;
using tools::means_of;

namespace {

AlphaResult result_of(const char* shape, std::uint32_t faces) {
    AlphaOptions options;
    options.max_origins = 2;
    options.viewpoints = 12;
    return bench_alphas(shape, Mesh(make_built_in_shape(shape, faces)), options, tools::k_quiet);
}

}  // namespace

TEST_CASE("every alpha is counted with every number of origins and both lists" *
          doctest::test_suite("plain")) {
    const AlphaResult result = result_of("knot", 2000);
    CHECK(result.difference == "");
    CHECK(result.center.trial.count == 0);
    REQUIRE(result.rows.size() == 2 * k_alphas.size());
    double missed = 0.0;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const tools::AlphaRow& row = result.rows[i];
        CHECK(row.alpha == k_alphas[i % k_alphas.size()]);
        CHECK(row.trial.count == 1 + i / k_alphas.size());
        REQUIRE(row.literal.size() == 3);
        CHECK(row.literal[0].is_complete);
        CHECK(row.literal[0].missed_edges == 0.0);
        CHECK(!row.literal[1].is_complete);
        CHECK(row.literal[2].is_complete);
        // The switch of the list: with two origins fewer edges are SFO from both than from one.
        if (row.trial.count == 1)
            CHECK(row.literal[0].listed_edges == row.literal[1].listed_edges);
        else
            CHECK(row.literal[0].listed_edges > row.literal[1].listed_edges);
        CHECK(row.literal[1].listed_edges == row.literal[2].listed_edges);
        CHECK(row.literal[2].pbv_checks == 0);
        missed += row.literal[1].missed_edges;
    }
    CHECK(missed > 0.0);
}

TEST_CASE("means over models are geometric and of the counts over those of the center" *
          doctest::test_suite("plain")) {
    const std::vector<AlphaResult> results{result_of("knot", 1000), result_of("torus", 800)};
    const std::vector<AlphaMean> means = means_of(results);
    REQUIRE(!means.empty());
    const auto ratio = [&](std::size_t i) {
        return results[i].rows[0].trial.work / results[i].center.trial.work;
    };
    CHECK(means[0].models == 2);
    CHECK(means[0].work == doctest::Approx(std::sqrt(ratio(0) * ratio(1))));
    const nlohmann::ordered_json json = to_json(results[0]);
    CHECK(json["center"]["alpha"].is_null());
    CHECK(json["rows"][0]["literal"].size() == 3);
    CHECK(to_json(means)[0]["work"] == means[0].work);
}

TEST_CASE("models whose center costs no boxes have no part in means") {
    AlphaResult flat;
    flat.center.literal.resize(3);
    flat.rows.push_back(flat.center);
    CHECK(means_of({flat}).empty());
}
