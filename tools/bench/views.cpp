#include "tools/bench/views.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "engine/measure/view_ratios.h"
#include "engine/view_defaults.h"
#include "silhouette/field/best_views.h"
#include "silhouette/field/sun_choice.h"
#include "tools/bench/light_measures.h"
#include "tools/bench/mesh_variants.h"
#include "tools/bench/view_measures.h"
#include "tools/options/simplified_mesh.h"
#include "tools/output/view_pictures.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr double k_noise = 1e-3;
constexpr std::uint32_t k_simplification = 4;

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// The ways of choosing that need the mesh only.
struct Choices {
    BestViews weighted, by_area, voted;
    ViewMeasures measures;
    double ms = 0.0;

    const std::vector<double>& measure(std::size_t which) const {
        return which == 0 ? measures.area : which == 1 ? measures.entropy : measures.silhouette;
    }
};
constexpr const char* k_measures[] = {"projected area", "viewpoint entropy",
                                      "visible silhouette length"};

// For a variant of the model only the first view is used.
Choices choose_all(const Mesh& mesh, const Device& device, const ViewsBenchOptions& options,
                   bool is_variant, const Context& context) {
    const HoughOctree octree(mesh);
    VisibleRatioPass pass(device.context(), octree, {}, context.stop);
    const auto start = std::chrono::steady_clock::now();
    const TangentialField field = make_view_field(mesh);
    BestViewsOptions views;
    views.count = is_variant ? 1 : options.views;
    ViewRatios ratios(device.context(), octree, context.stop);
    views.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
        return ratios.measure(eyes, context.stop);
    };
    Choices choices;
    choices.weighted = find_best_views(field, views, {context.stop, {}});
    choices.ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    FieldOptions area{.tolerance = k_view_tolerance};
    area.weight = FieldOptions::Weight::area;
    choices.by_area = find_best_views(make_view_field(mesh, area), views, {context.stop, {}});
    views.visible_ratios = {};
    choices.voted = find_best_views(field, views, {context.stop, {}});
    choices.measures = measure_views(mesh, pass, options.candidates, !is_variant, context);
    return choices;
}

void measure_set(ViewSet& set, const Mesh& mesh) {
    std::vector<bool> seen(mesh.face_count(), false);
    for (const glm::dvec3& eye : set.eyes) {
        const std::vector<bool> more = faces_seen(mesh, eye);
        for (std::size_t f = 0; f < seen.size(); ++f)
            if (more[f]) seen[f] = true;
    }
    set.seen = double(std::count(seen.begin(), seen.end(), true)) / double(seen.size());
    set.min_apart_deg = set.eyes.size() > 1 ? 180.0 : 0.0;
    double pairs = 0.0;
    for (std::size_t i = 0; i < set.eyes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double apart =
                angle_deg(set.eyes[i] - mesh.center(), set.eyes[j] - mesh.center());
            set.min_apart_deg = std::min(set.min_apart_deg, apart);
            set.max_apart_deg = std::max(set.max_apart_deg, apart);
            set.mean_apart_deg += apart;
            pairs += 1.0;
        }
    if (pairs > 0.0) set.mean_apart_deg /= pairs;
}

std::vector<glm::dvec3> eyes_of(const BestViews& best) {
    std::vector<glm::dvec3> eyes;
    for (const BestView& view : best.views) eyes.push_back(view.eye);
    return eyes;
}

std::vector<glm::dvec3> eyes_of(const ViewMeasures& measures,
                                const std::vector<std::size_t>& chosen) {
    std::vector<glm::dvec3> eyes;
    for (const std::size_t i : chosen) eyes.push_back(measures.eyes[i]);
    return eyes;
}

ViewSet random_set(const Mesh& mesh, const ViewMeasures& measures,
                   const ViewsBenchOptions& options) {
    std::mt19937 random(options.seed);
    ViewSet mean{.name = "random, mean of " + std::to_string(options.random_sets)};
    for (std::uint32_t i = 0; i < options.random_sets; ++i) {
        ViewSet set;
        for (std::uint32_t v = 0; v < options.views; ++v)
            set.eyes.push_back(measures.eyes[random() % measures.eyes.size()]);
        measure_set(set, mesh);
        const double share = 1.0 / options.random_sets;
        mean.seen += share * set.seen;
        mean.min_apart_deg += share * set.min_apart_deg;
        mean.mean_apart_deg += share * set.mean_apart_deg;
        mean.max_apart_deg += share * set.max_apart_deg;
    }
    return mean;
}

glm::dvec3 first_direction(const Mesh& mesh, const std::vector<glm::dvec3>& eyes) {
    return eyes.empty() ? glm::dvec3(0.0) : glm::normalize(eyes[0] - mesh.center());
}

// The angles between the first views of the mesh and of the variant for each way, in the order of the sets.
// Empty where the variant has so few faces that it has no extent.
std::vector<double> first_moves(const Mesh& mesh, const Choices& choices, const Mesh& variant,
                                const Device& device, const ViewsBenchOptions& options,
                                const Context& context) {
    if (variant.radius() == 0.0) return {};
    const Choices changed = choose_all(variant, device, options, true, context);
    const auto moved = [&](const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
        return angle_deg(first_direction(mesh, from), first_direction(variant, to));
    };
    std::vector<double> moves = {moved(eyes_of(choices.weighted), eyes_of(changed.weighted)),
                                 moved(eyes_of(choices.by_area), eyes_of(changed.by_area)),
                                 moved(eyes_of(choices.voted), eyes_of(changed.voted))};
    for (std::size_t i = 0; i < std::size(k_measures); ++i) {
        const auto first = [&](const Mesh& of, const Choices& c) {
            return eyes_of(c.measures, best_apart(of, c.measures.eyes, c.measure(i), 1));
        };
        moves.push_back(moved(first(mesh, choices), first(variant, changed)));
    }
    return moves;
}

// Directions distributed evenly over the half that lights the side towards the viewer.
std::vector<glm::dvec3> random_suns(const glm::dvec3& towards_viewer, std::uint32_t count,
                                    std::mt19937& random) {
    std::vector<glm::dvec3> suns;
    while (suns.size() < count) {
        const auto signed_unit = [&] { return 2.0 * (double(random() >> 5) * 0x1p-27) - 1.0; };
        const double x = signed_unit(), y = signed_unit(), z = signed_unit();
        const glm::dvec3 v(x, y, z);
        const double length = glm::length(v);
        if (length > 0.1 && length < 1.0 && glm::dot(v, towards_viewer) > 0.0)
            suns.push_back(v / length);
    }
    return suns;
}

std::vector<LightSet> measure_lights(const Mesh& mesh, const std::vector<glm::dvec3>& eyes,
                                     const ViewsBenchOptions& options, const Context& context) {
    std::vector<LightSet> sets{
        {.name = "chosen"},
        {.name = "over the viewer's shoulder"},
        {.name = "random, mean of " + std::to_string(options.random_lights)}};
    std::mt19937 random(options.seed);
    const glm::dvec3 up = direction_of(mesh.up());
    for (const glm::dvec3& eye : eyes) {
        context.checkpoint();
        const LitView view(mesh, eye);
        const auto add = [&](LightSet& set, const glm::dvec3& sun, double share) {
            const LightMeasure measure = view.measure(sun);
            set.away += share * measure.away;
            set.unlit += share * measure.unlit;
            set.contrast += share * measure.contrast;
        };
        const double share = 1.0 / double(eyes.size());
        if (const auto sun = choose_sun(mesh, eye, {context.stop, {}}))
            add(sets[0], sun->direction, share);
        add(sets[1], default_sun({.eye = eye, .target = mesh.center(), .up = up}).vector, share);
        for (const glm::dvec3& sun :
             random_suns(eye - mesh.center(), options.random_lights, random))
            add(sets[2], sun, share / options.random_lights);
    }
    return sets;
}

}  // namespace

ViewsResult bench_views(const std::string& model, const Mesh& mesh, const Device& device,
                        const ViewsBenchOptions& options, const Context& context) {
    ViewsResult result{.model = model, .faces = mesh.face_count()};
    Progress progress(context, "choosing views of " + model);
    const LongCall call = progress.call();
    const Choices choices = choose_all(mesh, device, options, false, context);
    call.checkpoint(0.3);
    result.renders = choices.weighted.renders;
    result.own_candidates = choices.weighted.candidates;
    result.ms = choices.ms;
    {
        // The candidates that the same search would draw for every sample of the lattice, view by view.
        BestViewsOptions all;
        all.count = options.views;
        all.stride = 1;
        all.visible_ratios = [](std::span<const glm::dvec3> eyes) {
            return std::vector<double>(eyes.size(), 1.0);
        };
        result.lattice_candidates =
            find_best_views(make_view_field(mesh), all, {context.stop, {}}).candidates;
    }
    call.checkpoint(0.4);
    result.sets = {{.name = "planes' votes, visible ratio", .eyes = eyes_of(choices.weighted)},
                   {.name = "the same, weighed by area", .eyes = eyes_of(choices.by_area)},
                   {.name = "planes' votes alone", .eyes = eyes_of(choices.voted)}};
    for (std::size_t i = 0; i < std::size(k_measures); ++i)
        result.sets.push_back(
            {.name = k_measures[i],
             .eyes = eyes_of(choices.measures, best_apart(mesh, choices.measures.eyes,
                                                          choices.measure(i), options.views))});
    const Mesh simple(simplified(mesh, mesh.face_count() / k_simplification));
    const Mesh noisy(with_noise(mesh, k_noise, options.seed));
    const std::vector<double> simplified_moves =
        first_moves(mesh, choices, simple, device, options, context);
    call.checkpoint(0.6);
    const std::vector<double> noisy_moves =
        first_moves(mesh, choices, noisy, device, options, context);
    call.checkpoint(0.8);
    for (std::size_t i = 0; i < result.sets.size(); ++i) {
        if (!simplified_moves.empty()) result.sets[i].simplified_deg = simplified_moves[i];
        if (!noisy_moves.empty()) result.sets[i].noisy_deg = noisy_moves[i];
    }
    result.sets.push_back(
        {.name = "most faces not yet seen, greedy",
         .eyes = eyes_of(choices.measures, greedy_coverage(choices.measures, options.views))});
    for (ViewSet& set : result.sets) measure_set(set, mesh);
    result.sets.push_back(random_set(mesh, choices.measures, options));
    call.checkpoint(0.9);
    result.lights = measure_lights(mesh, eyes_of(choices.weighted), options, context);
    call.checkpoint(1.0);
    return result;
}

std::vector<Target> targets_of(const ViewsResult& result) {
    std::vector<Target> targets;
    if (result.faces == k_bunny_faces) {
        targets.push_back({.what = "viewpoints drawn, of every candidate",
                           .value = double(result.lattice_candidates) / double(result.renders),
                           .reach = 5.0,
                           .aim = 20.0});
        targets.push_back({.what = "four best views",
                           .value = result.ms / 1000.0,
                           .reach = 5.0,
                           .aim = 1.0,
                           .less_is_better = true,
                           .is_time = true,
                           .unit = "s"});
    }
    return targets;
}

}  // namespace rimline::tools
