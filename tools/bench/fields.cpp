#include "tools/bench/fields.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "silhouette/field/named_functions.h"
#include "silhouette/field/origins.h"
#include "silhouette/field/points_of_interest.h"
#include "silhouette/field/tangential_field.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr double k_asked_error = 1e-3;
constexpr std::uint32_t k_origins = 4;
constexpr SearchDomain k_ball{0.0, 3.0};

std::vector<glm::dvec3> lattice_points() {
    std::vector<glm::dvec3> points;
    for (int x = -8; x <= 8; ++x)
        for (int y = -8; y <= 8; ++y)
            for (int z = -8; z <= 8; ++z) {
                const glm::dvec3 p = k_ball.outer_radius / 8.0 * glm::dvec3(x, y, z);
                if (k_ball.contains(p)) points.push_back(p);
            }
    return points;
}

// One way to sum the lattice.
struct Sum {
    const TangentialField* field;
    std::vector<double> values;
    double ms = INFINITY;
};

void sum_in_turn(std::vector<Sum>& sums, std::span<const glm::dvec3> points, std::uint32_t rounds,
                 const Context& context) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    Progress progress(context, "summing votes");
    const LongCall call = progress.call();
    for (std::uint32_t round = 0; round <= rounds; ++round)
        for (Sum& sum : sums) {
            call.checkpoint(static_cast<double>(round) / (rounds + 1));
            sum.values.resize(points.size());
            const double us = time_step_us([&] {
                sum.field->values(points, sum.values, {call.stop, {}});
            });
            if (round > 0) sum.ms = std::min(sum.ms, us / 1000.0);
        }
}

double greatest_error(const std::vector<double>& a, const std::vector<double>& b) {
    double greatest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
    return greatest;
}

// The reference for brute force.
double plain_sum(const UnitPlanes& planes, const TangentialFunction& f, const glm::dvec3& p) {
    double sum = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) sum += f.value(planes.distance(i, p));
    return sum;
}

}  // namespace

const LatticeRow* FieldBenchResult::measured() const {
    const LatticeRow* best = nullptr;
    for (const LatticeRow& row : lattice)
        if (row.error <= k_asked_error && (best == nullptr || row.ms < best->ms)) best = &row;
    return best;
}

FieldBenchResult bench_fields(const std::string& model, const Mesh& mesh,
                              const FieldBenchOptions& options, const Context& context) {
    FieldBenchResult result;
    result.model = model;
    result.faces = mesh.face_count();
    const UnitPlanes planes(mesh);
    const TangentialFunction function = origin_function();
    const std::vector<glm::dvec3> points = lattice_points();
    result.points = static_cast<std::uint32_t>(points.size());

    const auto build_start = std::chrono::steady_clock::now();
    const TangentialField brute(planes, function, {0.0});
    result.build_ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - build_start)
            .count();
    std::vector<double> exact(points.size());
    brute.values(points, exact, {context.stop, {}});
    for (std::size_t i = 0; i < points.size(); i += 100) {
        context.checkpoint();
        if (std::abs(exact[i] - plain_sum(planes, function, points[i])) > brute.error_bound())
            result.difference = "the sum over all planes at point " + std::to_string(i);
    }
    const double greatest = *std::ranges::max_element(exact);
    if (!(greatest > 0.0)) return result;

    std::vector<TangentialField> fields;
    for (const double bound : {5e-2, 2e-2, 1e-2, 3e-3, k_asked_error}) {
        result.lattice.push_back({bound});
        // Rounding is part of the bound.
        const double budget = bound * greatest - brute.error_bound();
        fields.emplace_back(planes, function,
                            FieldOptions{std::max(budget, 0.0) / brute.max_value()});
    }
    std::vector<Sum> sums = {{&brute, {}}};
    for (const TangentialField& field : fields) sums.push_back({&field, {}});
    sum_in_turn(sums, points, options.rounds, context);
    result.brute_ms = sums[0].ms;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        LatticeRow& row = result.lattice[i];
        row.ms = sums[i + 1].ms;
        row.error = greatest_error(sums[i + 1].values, exact) / greatest;
        // Brute force has errors too.
        if (row.error * greatest > fields[i].error_bound() + brute.error_bound())
            result.difference = "a sum in clusters";
        TangentialField::Work work;
        for (const glm::dvec3& p : points) fields[i].value(p, work);
        row.clusters = static_cast<double>(work.clusters) / static_cast<double>(points.size());
        row.planes = static_cast<double>(work.planes) / static_cast<double>(points.size());
    }

    result.origins_ms = INFINITY;
    for (std::uint32_t round = 0; round < 3; ++round) {
        Progress progress(context, "choosing origins");
        const auto start = std::chrono::steady_clock::now();
        find_origins(mesh, k_origins, {}, progress.call());
        result.origins_ms = std::min(
            result.origins_ms,
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count());
    }
    return result;
}

void print_result(const FieldBenchResult& result) {
    std::printf("%s: %u faces\n", result.model.c_str(), result.faces);
    std::printf("  a lattice of %u points, function origins, one thread; built in %.0f ms\n",
                result.points, result.build_ms);
    std::printf("  %-28s %10s %8s %10s %10s %10s\n", "", "ms", "ratio", "error", "clusters",
                "planes");
    std::printf("  %-28s %10.2f\n", "all planes", result.brute_ms);
    for (const LatticeRow& row : result.lattice) {
        char name[40];
        std::snprintf(name, sizeof name, "clusters, bound %g", row.bound);
        std::printf("  %-28s %10.2f %8.1f %10.2e %10.0f %10.0f\n", name, row.ms,
                    result.brute_ms / row.ms, row.error, row.clusters, row.planes);
    }
    std::printf("  %u origins: %.0f ms\n", k_origins, result.origins_ms);
}

nlohmann::ordered_json to_json(const FieldBenchResult& result) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const LatticeRow& row : result.lattice)
        rows.push_back({{"bound", row.bound},
                        {"error", row.error},
                        {"ms", row.ms},
                        {"ratio", result.brute_ms / row.ms},
                        {"clusters", row.clusters},
                        {"planes", row.planes}});
    return {{"model", result.model},       {"faces", result.faces},
            {"points", result.points},     {"build_ms", result.build_ms},
            {"brute_ms", result.brute_ms}, {"lattice", std::move(rows)},
            {"origins", k_origins},        {"origins_ms", result.origins_ms}};
}

std::vector<Target> targets_of(const FieldBenchResult& result) {
    std::vector<Target> targets;
    const bool is_igea = result.faces == k_igea_faces;
    if (const LatticeRow* const row = result.measured())
        targets.push_back({.what = "a lattice, measured errors within 1e-3, against all",
                           .value = result.brute_ms / row->ms,
                           .reach = is_igea ? 10.0 : 1.0,
                           .aim = is_igea ? 50.0 : 0.0});
    if (is_igea)
        targets.push_back({.what = "four origins",
                           .value = result.origins_ms,
                           .reach = 1000.0,
                           .aim = 200.0,
                           .less_is_better = true,
                           .is_time = true,
                           .unit = " ms"});
    return targets;
}

}  // namespace rimline::tools
