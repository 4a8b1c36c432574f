// Fields of real models: bounds that hold at every lattice point, and maxima that a dense search confirms.

#include <doctest/doctest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/field/points_of_interest.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/models.h"
#include "tests/silhouette/field/reference_sum.h"
#include "tests/skip.h"

namespace rimline {
namespace {

using Weight = FieldOptions::Weight;

// Of every `stride`-th sample.
std::vector<glm::dvec3> lattice(const SearchDomain& domain, int half, std::size_t stride) {
    std::vector<glm::dvec3> points;
    std::size_t count = 0;
    for (int x = -half; x <= half; ++x)
        for (int y = -half; y <= half; ++y)
            for (int z = -half; z <= half; ++z) {
                const glm::dvec3 p = domain.outer_radius / half * glm::dvec3(x, y, z);
                if (domain.contains(p) && count++ % stride == 0) points.push_back(p);
            }
    return points;
}

SearchDomain domain_of(const NamedFunction& named) { return {named.min_radius, named.max_radius}; }

void check_bounds(const UnitPlanes& planes, const NamedFunction& named, std::size_t stride) {
    CAPTURE(named.name);
    const std::vector<glm::dvec3> points = lattice(domain_of(named), 8, stride);
    const std::vector<glm::dvec3> chosen = {points[points.size() / 3], points[points.size() / 2]};
    for (const Weight weight : {Weight::count, Weight::area}) {
        std::vector<double> sums(points.size());
        std::vector<double> discounted_sums(points.size());
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
            sums[i] = tests::reference_sum(planes, named.function, weight, points[i]);
            discounted_sums[i] =
                tests::reference_discounted(planes, named.function, weight, chosen, points[i]);
        });
        for (const double tolerance : {0.0, 1e-3, 2e-2}) {
            CAPTURE(tolerance);
            const TangentialField field(planes, named.function, {tolerance, weight});
            DiscountedField discounted(field);
            for (const glm::dvec3& p : chosen) discounted.discount(p);
            std::vector<double> values(points.size());
            std::vector<double> discounted_values(points.size());
            field.values(points, values);
            discounted.values(points, discounted_values);
            double worst = 0.0;
            for (std::size_t i = 0; i < points.size(); ++i)
                worst = std::max({worst, std::abs(values[i] - sums[i]),
                                  std::abs(discounted_values[i] - discounted_sums[i])});
            CHECK(worst <= field.error_bound());
        }
    }
}

void check_all_bounds(const UnitPlanes& planes, std::size_t stride) {
    for (const char* name : {"origins", "views", "light"})
        check_bounds(planes, *find_named_function(name), stride);
}

void check_maxima(const UnitPlanes& planes) {
    for (const char* name : {"origins", "views", "light"}) {
        CAPTURE(name);
        const NamedFunction& named = *find_named_function(name);
        const TangentialField field(planes, named.function);
        const auto found = find_points_of_interest(field, domain_of(named), {});
        REQUIRE(found.points.size() == 1);
        const TangentialField close(planes, named.function, {1e-4});
        const std::vector<glm::dvec3> points = lattice(domain_of(named), 32, 1);
        std::vector<double> values(points.size());
        close.values(points, values);
        CHECK(close.value(found.points[0].point) >= 0.99 * *std::ranges::max_element(values));
    }
}

#define RIMLINE_PLANES(file)                                                    \
    const auto path = tests::find_model(file);                                  \
    if (!path) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds " file); \
    const UnitPlanes planes(Mesh(read_mesh_file(*path)))

TEST_CASE("bounds hold at samples of the lattice on fandisk.obj") {
    RIMLINE_PLANES("fandisk.obj");
    check_all_bounds(planes, 41);
}

TEST_CASE("bounds hold at samples of the lattice on stanford-bunny.obj") {
    RIMLINE_PLANES("stanford-bunny.obj");
    check_all_bounds(planes, 197);
}

#define RIMLINE_MODEL_CASES(file)                                          \
    TEST_CASE("bounds hold at every point of the lattice on " file) {      \
        RIMLINE_PLANES(file);                                              \
        check_all_bounds(planes, 1);                                       \
    }                                                                      \
    TEST_CASE("found maxima are within 1% of a 65^3 lattice's on " file) { \
        RIMLINE_PLANES(file);                                              \
        check_maxima(planes);                                              \
    }

TEST_SUITE("long") {
    RIMLINE_MODEL_CASES("alligator.obj")
    RIMLINE_MODEL_CASES("beetle-alt.obj")
    RIMLINE_MODEL_CASES("fandisk.obj")
    RIMLINE_MODEL_CASES("horse.ply")
    RIMLINE_MODEL_CASES("igea.ply")
    RIMLINE_MODEL_CASES("nefertiti.obj")
    RIMLINE_MODEL_CASES("ogre.obj")
    RIMLINE_MODEL_CASES("rocker-arm.obj")
    RIMLINE_MODEL_CASES("stanford-bunny.obj")
}

}  // namespace
}  // namespace rimline
