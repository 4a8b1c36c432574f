#include "tools/bench/figures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/methods/literal/active_region.h"
#include "silhouette/methods/literal/literal_octree.h"
#include "silhouette/methods/literal/literal_tracker.h"
#include "tools/bench/transform_octree.h"
#include "tools/bench/vertex_clustering.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_distance_steps = 60;

std::vector<std::uint32_t> histogram(const std::vector<double>& ascending, double farthest) {
    std::vector<std::uint32_t> counts(k_distance_steps, 0);
    for (const double distance : ascending) {
        const double step = farthest > 0.0 ? distance / farthest * k_distance_steps : 0.0;
        ++counts[std::min(static_cast<std::uint32_t>(step), k_distance_steps - 1)];
    }
    return counts;
}

// `unit` is a length in the space of `points`.
PointSpread spread_of(std::span<const glm::dvec3> points, std::span<const OctreeNode> nodes,
                      double unit, std::uint32_t sample) {
    PointSpread spread;
    spread.points = static_cast<std::uint32_t>(points.size());
    spread.leaf_depths = leaf_depth_histogram(nodes);
    spread.nodes = static_cast<std::uint32_t>(nodes.size());
    if (points.empty()) return spread;

    std::vector<double> distances;
    for (const glm::dvec3& point : points) distances.push_back(glm::length(point) / unit);
    std::sort(distances.begin(), distances.end());
    spread.farthest = distances.back();
    spread.percentile_99 = distances[(distances.size() - 1) * 99 / 100];
    spread.distances = histogram(distances, spread.farthest);
    const std::size_t count = std::min<std::size_t>(sample, points.size());
    // In tree order, so that the sample is distributed over space.
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 point = points[i * points.size() / count] / unit;
        spread.sample.push_back({point.x, point.y, point.z});
    }
    return spread;
}

// The same on every machine: std::mt19937 is defined exactly, the distributions are not.
std::vector<HomogeneousPoint> random_points(const UnitSphere& unit, std::uint32_t count) {
    std::mt19937 engine(1);
    const auto random = [&] { return static_cast<double>(engine()) * 0x1p-32; };
    std::vector<HomogeneousPoint> points;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double z = 2.0 * random() - 1.0;
        const double angle = 2.0 * std::numbers::pi * random();
        const double radii = 1.0 + 2.0 * random();
        const double across = std::sqrt(1.0 - z * z);
        points.push_back(
            unit.viewpoint(radii, {across * std::cos(angle), across * std::sin(angle), z}));
    }
    return points;
}

// The literal octree in both readings of "sufficiently small", and the index.
class Extractors {
public:
    Extractors(const Mesh& mesh, const glm::dvec3& origin)
        : literal_(mesh, literal_options(origin, 1)),
          all_boxes_(mesh, literal_options(origin, 0)),
          index_(mesh, {{origin}}) {}

    const LiteralOctree& literal() const { return literal_; }
    const HoughOctree& index() const { return index_; }

    ExtractionWork mean_work(std::span<const HomogeneousPoint> points, std::string& difference,
                             const Context& context) const {
        LiteralCounters literal;
        LiteralCounters all_boxes;
        TraversalCounters index;
        std::uint64_t silhouette = 0;
        std::vector<EdgeId> edges;
        for (std::size_t i = 0; i < points.size(); ++i) {
            context.checkpoint();
            const std::vector<EdgeId> truth = brute_force_silhouette(index_.mesh(), points[i]);
            const auto compare = [&](const char* method) {
                std::sort(edges.begin(), edges.end());
                if (edges != truth && difference.empty())
                    difference = std::string(method) + ", viewpoint " + std::to_string(i);
            };
            literal_.extract(points[i], edges, literal);
            compare("literal octree");
            all_boxes_.extract(points[i], edges, all_boxes);
            compare("literal octree with all boxes");
            index_.extract(points[i], edges, index);
            compare("octree");
            silhouette += truth.size();
        }
        const auto mean = [&](std::uint64_t sum) {
            return points.empty() ? 0.0
                                  : static_cast<double>(sum) / static_cast<double>(points.size());
        };
        ExtractionWork work;
        work.points = static_cast<std::uint32_t>(points.size());
        work.silhouette = mean(silhouette);
        work.literal_boxes = {mean(literal.pbv_checks), mean(literal.ebv_checks)};
        work.literal_all_boxes = {mean(all_boxes.pbv_checks), mean(all_boxes.ebv_checks)};
        work.literal_faces = mean(literal.face_checks);
        work.index_boxes = mean(index.box_checks);
        work.index_faces = mean(index.face_checks);
        return work;
    }

private:
    static LiteralOctreeOptions literal_options(const glm::dvec3& origin,
                                                std::uint32_t small_leaf) {
        LiteralOctreeOptions options;
        options.origin = origin;
        options.small_leaf = small_leaf;
        return options;
    }

    LiteralOctree literal_;
    LiteralOctree all_boxes_;
    HoughOctree index_;
};

std::vector<ExtractionWork> work_on_spheres(const Extractors& extractors, const UnitSphere& unit,
                                            std::uint32_t viewpoints, std::string& difference,
                                            const Context& context) {
    std::vector<ExtractionWork> spheres;
    for (const std::vector<HomogeneousPoint>& points : viewpoints_on_spheres(unit, viewpoints)) {
        spheres.push_back(extractors.mean_work(points, difference, context));
        spheres.back().radius = static_cast<double>(spheres.size());
    }
    return spheres;
}

// Box checks of a full traversal at nodes above all active-set candidates: the most that a walk along
// candidates saves.
std::uint32_t checks_above_candidates(const LiteralOctree& octree, const ActiveRegion& region,
                                      std::uint32_t number) {
    if (octree.candidates().candidate_above[number] != k_no_node) return 0;
    const LiteralOctree::Box& points = octree.point_boxes()[number];
    const RegionSides sides = region.sides_of(points.box, points.reach);
    std::uint32_t checks = 1;
    if (sides.is_apart() || sides.is_contained()) return checks;
    for (const std::uint32_t child : octree.nodes()[number].children)
        if (child != k_no_node) checks += checks_above_candidates(octree, region, child);
    return checks;
}

struct Traversal {
    const char* name;
    TransformOctree octree;
    OrbitWork::Counts OrbitWork::*counts;
    std::vector<std::uint32_t> words;
};

OrbitWork work_on_orbit(const Extractors& extractors, const UnitSphere& unit,
                        const FigureOptions& options, std::string& difference,
                        const Context& context) {
    const Mesh& mesh = extractors.index().mesh();
    const Orbit orbit(unit.center, {0.0, 1.0, 0.0}, options.orbit_radii * unit.radius);
    const HomogeneousPoint start = orbit.viewpoint(0.0);
    const LiteralOctree& octree = extractors.literal();
    LiteralTracker full(octree, start, {LiteralUpdate::full_traversal});
    LiteralTracker incremental(octree, start, {LiteralUpdate::incremental});
    LiteralTracker as_written(octree, start, {LiteralUpdate::incremental_as_written});
    SilhouetteTracker index(extractors.index(), start);
    using enum PlaneTransform;
    using enum NodeBoxes;
    std::vector<Traversal> traversals;
    traversals.push_back({"dual", {mesh, unit.center, dual, tight}, &OrbitWork::dual, {}});
    traversals.push_back(
        {"dual, octants", {mesh, unit.center, dual, octants}, &OrbitWork::dual_octants, {}});
    traversals.push_back(
        {"Hough, octants", {mesh, unit.center, hough, octants}, &OrbitWork::full_octants, {}});
    for (Traversal& traversal : traversals) traversal.words = brute_force_face_bits(mesh, start);

    OrbitWork work;
    const auto add = [](OrbitWork::Counts& counts, std::uint64_t boxes, std::uint64_t faces) {
        counts.boxes.push_back(static_cast<std::uint32_t>(boxes));
        counts.faces.push_back(static_cast<std::uint32_t>(faces));
    };
    HomogeneousPoint previous = start;
    for (std::uint32_t i = 1; i <= options.frames; ++i) {
        context.checkpoint();
        const HomogeneousPoint point = orbit.viewpoint(2.0 * std::numbers::pi * i / options.frames);
        const std::vector<std::uint32_t> truth = brute_force_face_bits(mesh, point);
        const auto compare = [&](std::span<const std::uint32_t> words, const char* method) {
            if (!std::equal(words.begin(), words.end(), truth.begin(), truth.end()) &&
                difference.empty())
                difference = std::string(method) + ", frame " + std::to_string(i);
        };

        const LiteralCounters& all = full.move_to(point);
        compare(full.face_words(), "full traversal");
        add(work.full, all.box_checks(), all.face_checks);
        work.above_candidates.push_back(
            octree.nodes().empty()
                ? 0
                : checks_above_candidates(
                      octree, ActiveRegion(octree.v_sphere(previous), octree.v_sphere(point)), 0));
        work.contained.push_back(static_cast<std::uint32_t>(all.contained_faces));
        const LiteralCounters& walk = incremental.move_to(point);
        compare(incremental.face_words(), "incremental update");
        add(work.incremental, walk.box_checks(), walk.face_checks);
        for (Traversal& traversal : traversals) {
            const LiteralCounters counters =
                traversal.octree.move(previous, point, traversal.words);
            compare(traversal.words, traversal.name);
            add(work.*traversal.counts, counters.box_checks(), counters.face_checks);
        }
        const ChangeSet& changes = index.move_to(point);
        compare(index.face_words(), "tracker");
        add(work.index, changes.counters.box_checks, changes.counters.face_checks);
        work.turned.push_back(static_cast<std::uint32_t>(changes.flipped.size()));

        const LiteralCounters& lossy = as_written.move_to(point);
        add(work.as_written, lossy.box_checks(), lossy.face_checks);
        std::uint32_t wrong = 0;
        for (std::size_t word = 0; word < truth.size(); ++word)
            wrong += static_cast<std::uint32_t>(
                std::popcount(as_written.face_words()[word] ^ truth[word]));
        work.wrong_faces.push_back(wrong);
        previous = point;
    }
    return work;
}

ResolutionWork work_at_resolution(const Mesh& mesh, std::uint32_t points, std::string& difference,
                                  const Context& context) {
    const UnitSphere unit = unit_sphere(mesh);
    return {
        mesh.face_count(),
        Extractors(mesh, unit.center).mean_work(random_points(unit, points), difference, context)};
}

}  // namespace

FigureData bench_figures(const std::string& model, const Mesh& mesh, const FigureOptions& options,
                         const Context& context) {
    if (mesh.face_count() > options.max_faces) {
        FigureOptions rest = options;
        rest.max_faces = std::numeric_limits<std::uint32_t>::max();
        const Mesh coarse(cluster_vertices(mesh, options.max_faces));
        return bench_figures(model, coarse, rest, context);
    }
    FigureData data;
    data.model = model;
    data.faces = mesh.face_count();
    data.edges = mesh.edge_count();
    data.unit = unit_sphere(mesh);

    Progress progress(context, "counting " + model);
    const LongCall call = progress.call();
    call.checkpoint(0.0);
    const Extractors extractors(mesh, data.unit.center);
    const LiteralOctree& octree = extractors.literal();
    const TransformOctree dual(mesh, data.unit.center, PlaneTransform::dual, NodeBoxes::tight);
    data.sfo_edges = octree.statistics().sfo_edges;
    data.hough = spread_of(octree.hough_points(), octree.nodes(), data.unit.radius, options.sample);
    data.dual = spread_of(dual.points(), dual.nodes(), 1.0 / data.unit.radius, options.sample);
    data.dual.left_out = static_cast<std::uint32_t>(dual.faces_at_infinity());

    call.checkpoint(0.1);
    data.extraction =
        work_on_spheres(extractors, data.unit, options.viewpoints, data.difference, context);
    call.checkpoint(0.5);
    data.orbit = work_on_orbit(extractors, data.unit, options, data.difference, context);
    call.checkpoint(0.8);
    for (const std::uint32_t faces : options.resolutions)
        if (faces < mesh.face_count())
            data.resolutions.push_back(work_at_resolution(Mesh(cluster_vertices(mesh, faces)),
                                                          options.random_points, data.difference,
                                                          context));
    data.resolutions.push_back(
        {mesh.face_count(), extractors.mean_work(random_points(data.unit, options.random_points),
                                                 data.difference, context)});
    data.layout = picture_layout(extractors.index(), 1.25, std::numbers::pi / 6.0, 0.02);
    return data;
}

}  // namespace rimline::tools
