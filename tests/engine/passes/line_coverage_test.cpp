// Lines against rays: the silhouette by brute force, the borders and creases, sampled every quarter of a
// pixel along their length, each sample seen or hidden as rays find it. Samples that are seen must be inked,
// and nothing may be inked that is far from a sample that may be seen.
//
// What is seen is asked at the sample itself, where only the edge's own faces are left out: on a mesh
// finer than pixels a silhouette is a zigzag, and half of it lies behind its own neighbors. A sample is
// clearly seen when what lies a pixel outwards is free too, and clearly hidden when a pixel all around
// is covered by faces that do not touch the edge. A crease has surface on both sides: it is clearly seen
// when a pixel to either side is free too, so far in front of it that the surface beside it, unless it is
// steep, is not in the way. What lies between may be inked or not; how much ink
// that is, the doubtful pixels, is bounded as well.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/creases.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/ray_reference.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/models.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

constexpr std::uint32_t k_line_coverage_size = 512;
constexpr glm::dvec2 k_picture(k_line_coverage_size);
constexpr float k_line_width_px = 2.5f;
constexpr double k_sample_step_px = 0.25;
constexpr double k_ink = 0.5;         // Darker pixels are inked ...
constexpr double k_trace = 0.05;      // ... and these not white.
constexpr double k_covered_px = 1.0;  // Ink lies no farther than this from what is clearly seen.

constexpr RendererOptions k_usual{};
constexpr RendererOptions k_line_coverage_plain{.samples = 1, .scale = 1};

enum class Sight {
    clear,  ///< Seen, and so is what lies a pixel outwards.
    seen,
    between,  ///< Hidden, but not all around.
    hidden,
};

struct Sample {
    glm::dvec2 place;
    Sight sight;
};

// The samples of all lines of a scene's first instance.
class LineReference {
public:
    LineReference(const Scene& scene, const RayReference& rays)
        : scene_(scene), rays_(rays), mesh_(scene.instances[0].octree->mesh()) {
        const Camera& camera = scene.camera;
        const HomogeneousPoint point =
            camera.is_orthographic()
                ? HomogeneousPoint::direction(glm::vec3(glm::normalize(camera.eye - camera.target)))
                : HomogeneousPoint::viewpoint(glm::vec3(camera.eye));
        for (const EdgeId edge : brute_force_silhouette(mesh_, point)) add_edge(edge);
        const Mesh::EdgeRange borders = mesh_.edges_of_class(EdgeClass::border);
        for (std::uint32_t e = borders.first; e < borders.last; ++e) add_edge(EdgeId{e});
        if (scene.crease_angle_deg <= 0.0f) return;
        for (const Crease& crease : find_creases(mesh_, glm::radians(scene.crease_angle_deg)))
            add_edge(crease.edge);
    }

    const std::vector<Sample>& samples() const noexcept { return samples_; }

private:
    void add_edge(EdgeId edge) {
        const glm::dvec3& a = rays_.vertex(0, mesh_.edge(edge).vertices[0]);
        const glm::dvec3& b = rays_.vertex(0, mesh_.edge(edge).vertices[1]);
        const auto from = rays_.place_of(a, k_picture);
        const auto to = rays_.place_of(b, k_picture);
        if (!from || !to) return;
        const double length = glm::distance(*from, *to);
        const int steps = std::max(1, static_cast<int>(std::ceil(length / k_sample_step_px)));
        for (int i = 0; i <= steps; ++i) {
            // In the world even steps are uneven in the picture, but for edges seen almost end on none
            // that matters.
            const glm::dvec3 world = a + (b - a) * (double(i) / steps);
            const std::optional<glm::dvec2> place = rays_.place_of(world, k_picture);
            if (!place || glm::any(glm::lessThan(*place, glm::dvec2(2.0))) ||
                glm::any(glm::greaterThan(*place, k_picture - 2.0)))
                continue;
            samples_.push_back({*place, sight_of(edge, world, *to - *from)});
        }
    }

    // The corner of a face that is not the edge's.
    glm::vec3 opposite(EdgeId edge, FaceId face) const {
        const auto& ends = mesh_.edge(edge).vertices;
        for (const VertexId corner : mesh_.triangles()[index(face)])
            if (corner != ends[0] && corner != ends[1]) return mesh_.positions()[index(corner)];
        return mesh_.positions()[index(ends[0])];
    }

    Sight sight_of(EdgeId edge, const glm::dvec3& world, const glm::dvec2& along) const {
        const std::span<const FaceId> own = mesh_.faces_of(edge);
        const auto hidden_at = [&](glm::dvec2 offset, const RayReference::Ignored& ignored) {
            return rays_.is_hidden(rays_.displaced(world, offset, k_picture), ignored);
        };
        const RayReference::Ignored own_faces = [&](std::size_t instance, FaceId face) {
            return instance == 0 && std::find(own.begin(), own.end(), face) != own.end();
        };
        if (glm::length(along) > 1e-9 && !hidden_at({0, 0}, own_faces)) {
            // Outwards is away from where the faces lie in the picture; of a crease that is nowhere.
            const glm::dvec2 across = glm::normalize(glm::dvec2(-along.y, along.x));
            double inwards = 0.0;
            double on_other_side = 0.0;
            const glm::dvec2 place = *rays_.place_of(world, k_picture);
            for (const FaceId face : own) {
                const auto corner = rays_.place_of(placed(opposite(edge, face)), k_picture);
                if (!corner) continue;
                double side = glm::dot(*corner - place, across);
                if (std::abs(side) > std::abs(inwards)) std::swap(side, inwards);
                on_other_side = side;
            }
            if (inwards * on_other_side < 0.0) {
                const bool free = !rays_.is_hidden(before(world, across), own_faces) &&
                                  !rays_.is_hidden(before(world, -across), own_faces);
                return free ? Sight::clear : Sight::seen;
            }
            const glm::dvec2 out = inwards > 0.0 ? -across : across;
            const glm::dvec2 ahead = 0.5 * glm::normalize(along);
            if (!hidden_at(out, own_faces) && !hidden_at(out + ahead, own_faces) &&
                !hidden_at(out - ahead, own_faces))
                return Sight::clear;
            return Sight::seen;
        }
        const auto& ends = mesh_.edge(edge).vertices;
        const RayReference::Ignored touching = [&](std::size_t instance, FaceId face) {
            if (instance != 0) return false;
            const Triangle& t = mesh_.triangles()[index(face)];
            return std::any_of(t.begin(), t.end(),
                               [&](VertexId v) { return v == ends[0] || v == ends[1]; });
        };
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (!hidden_at({x, y}, touching)) return Sight::between;
        return Sight::hidden;
    }

    // So many pixels to the right and down, and four of them nearer to the viewer.
    glm::dvec3 before(const glm::dvec3& world, const glm::dvec2& offset) const {
        const Camera& camera = scene_.camera;
        const glm::dvec3 beside = rays_.displaced(world, offset, k_picture);
        const double pixel = glm::distance(rays_.displaced(world, {1, 0}, k_picture), world);
        const glm::dvec3 back =
            camera.is_orthographic() ? camera.eye - camera.target : camera.eye - beside;
        return beside + 4.0 * pixel * glm::normalize(back);
    }

    glm::dvec3 placed(const glm::vec3& position) const {
        return scene_.instances[0].rotation * glm::dvec3(position) +
               scene_.instances[0].translation;
    }

    const Scene& scene_;
    const RayReference& rays_;
    const Mesh& mesh_;
    std::vector<Sample> samples_;
};

// Calls with each pixel whose center is within `radius` of `place`.
template <typename Function>
void for_pixels_around(glm::dvec2 place, double radius, Function&& function) {
    const auto first = [&](double c) { return std::max(0, int(std::floor(c - radius))); };
    const auto last = [&](double c) {
        return std::min(int(k_line_coverage_size) - 1, int(std::floor(c + radius)));
    };
    for (int y = first(place.y); y <= last(place.y); ++y)
        for (int x = first(place.x); x <= last(place.x); ++x)
            if (glm::distance(place, glm::dvec2(x + 0.5, y + 0.5)) <= radius)
                function(static_cast<std::size_t>(y) * k_line_coverage_size +
                         static_cast<std::size_t>(x));
}

double darkness(const Picture& picture, std::size_t pixel) {
    return 1.0 - linear_from_srgb(picture.rgba[4 * pixel + 1]);
}

struct Coverage {
    std::size_t samples = 0;
    std::size_t clear = 0;
    std::size_t seen = 0;  // The clear ones included.
    std::size_t hidden = 0;
    std::size_t bare = 0;      // Clearly seen without ink ...
    std::size_t faint = 0;     // ... and seen, but not clearly, without ink.
    std::size_t inked = 0;     // Pixels that are not white.
    std::size_t stray = 0;     // Of those, far from what may be seen ...
    std::size_t doubtful = 0;  // ... and far from what is seen.
};

Coverage compare(const Picture& picture, const std::vector<Sample>& samples,
                 const std::string& name) {
    Coverage coverage{.samples = samples.size()};
    std::vector<bool> may_be_inked(std::size_t{k_line_coverage_size} * k_line_coverage_size);
    std::vector<bool> near_seen(may_be_inked.size());
    std::vector<Mark> marks;
    for (const Sample& sample : samples) {
        if (sample.sight == Sight::hidden) {
            ++coverage.hidden;
            continue;
        }
        for_pixels_around(sample.place, k_line_width_px,
                          [&](std::size_t pixel) { may_be_inked[pixel] = true; });
        if (sample.sight == Sight::between) continue;
        ++coverage.seen;
        for_pixels_around(sample.place, k_line_width_px,
                          [&](std::size_t pixel) { near_seen[pixel] = true; });
        coverage.clear += sample.sight == Sight::clear ? 1 : 0;
        bool inked = false;
        for_pixels_around(sample.place, k_covered_px, [&](std::size_t pixel) {
            inked = inked || darkness(picture, pixel) >= k_ink;
        });
        if (inked) continue;
        ++(sample.sight == Sight::clear ? coverage.bare : coverage.faint);
        if (sample.sight != Sight::clear) continue;
        for_pixels_around(sample.place, 0.8, [&](std::size_t pixel) {
            marks.push_back({pixel, {255, 0, 0}});
        });
    }
    for (std::size_t pixel = 0; pixel < may_be_inked.size(); ++pixel) {
        if (darkness(picture, pixel) < k_trace) continue;
        ++coverage.inked;
        if (!near_seen[pixel]) {
            ++coverage.doubtful;
            marks.push_back({pixel, {0, 160, 255}});
        }
        if (may_be_inked[pixel]) continue;
        ++coverage.stray;
        marks.push_back({pixel, {255, 0, 255}});
    }
    save_picture("lines_" + name, picture, {});
    save_picture("marks_" + name, picture, marks);
    return coverage;
}

Scene line_scene(const Model& model) {
    const glm::dvec3 up = model.mesh.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    Scene scene{.camera = fit_camera({.up = up}, model.mesh, default_view_direction(up), 1.0),
                .palette = {.background = glm::vec3(1.0f),
                            .ink = glm::vec3(0.0f),
                            .shade = glm::vec3(1.0f)},
                .shadows = false,
                .line_width_px = k_line_width_px};
    scene.instances.push_back({.octree = &model.octree});
    return scene;
}

Coverage coverage_of(const Gpu& gpu, const std::string& name, const Scene& scene,
                     const std::vector<Sample>& samples, const RendererOptions& options) {
    Renderer renderer(gpu.context(), options);
    const Picture picture = renderer.render(scene, k_line_coverage_size, k_line_coverage_size);
    const Coverage coverage = compare(picture, samples, name + "_" + std::to_string(options.scale));
    std::printf(
        "%-18s scale %u: %6zu samples, %5zu seen, %5zu clearly, %5zu hidden; %zu bare, %zu faint; "
        "%5zu pixels inked, %zu stray, %zu doubtful\n",
        name.c_str(), options.scale, coverage.samples, coverage.seen, coverage.clear,
        coverage.hidden, coverage.bare, coverage.faint, coverage.inked, coverage.stray,
        coverage.doubtful);
    return coverage;
}

void check_lines(const Gpu& gpu, const std::string& name, const Scene& scene,
                 const std::vector<Sample>& samples,
                 std::initializer_list<RendererOptions> all_options = {k_usual,
                                                                       k_line_coverage_plain}) {
    for (const RendererOptions& options : all_options) {
        const Coverage coverage = coverage_of(gpu, name, scene, samples, options);
        const auto inked = static_cast<double>(coverage.inked);
        INFO(name, " at scale ", options.scale);
        CHECK(coverage.clear > 500);
        // A quarter of a pixel here and there, where one line ends at another.
        CHECK(double(coverage.bare) <= 1e-4 * double(coverage.clear));
        // The line pass looks at surfaces up to two of its own pixels away: in the usual picture one
        // pixel, as far as the rays look.
        const bool usual = options.scale > 1;
        CHECK(double(coverage.stray) <= (usual ? 0.0 : 2e-3 * inked));
        CHECK(double(coverage.doubtful) <= (usual ? 1e-2 : 2e-2) * inked);
    }
}

void check_lines(const Gpu& gpu, const std::string& name, const Scene& scene) {
    const RayReference rays(scene);
    const LineReference lines(scene, rays);
    check_lines(gpu, name, scene, lines.samples());
}

}  // namespace

TEST_CASE("lines of built-in shapes are inked where rays see them and nowhere else" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const char* name : {"torus", "knot", "spring", "box", "terrain", "scene"}) {
        const Model model(make_built_in_shape(name));
        check_lines(*gpu, name, line_scene(model));
    }
}

TEST_CASE("creases are inked where rays see them ridges and valleys alike" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const char* name : {"box", "scene"}) {
        const Model model(make_built_in_shape(name));
        Scene scene = line_scene(model);
        scene.crease_angle_deg = 30.0f;
        check_lines(*gpu, std::string(name) + ", creased", scene);
        scene.camera.ortho_height = 2.2 * model.mesh.radius();
        check_lines(*gpu, std::string(name) + ", creased, flat", scene);
    }
    const auto path = find_model("fandisk.obj");
    if (!path) RIMLINE_SKIP("RIMLINE_MODELS lacks fandisk.obj");
    const Model model(read_mesh_file(*path));
    Scene scene = line_scene(model);
    scene.crease_angle_deg = 30.0f;
    check_lines(*gpu, "fandisk, creased", scene);
}

TEST_CASE("lines are inked where rays see them in every style and by every line path" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model model(make_built_in_shape("scene"));
    Scene scene = line_scene(model);
    scene.crease_angle_deg = 30.0f;
    const RayReference rays(scene);
    const LineReference lines(scene, rays);
    // Surfaces are white in all of them: of shade all light is left, so that there is none to hatch.
    for (const auto& [style, name] : {std::pair{Style::toon, "toon"},
                                      {Style::blueprint, "blueprint"},
                                      {Style::hatch, "hatch"}}) {
        scene.style = style;
        scene.line_width_px = style_defaults(style).line_width_px;
        check_lines(*gpu, name, scene, lines.samples(), {k_usual});
    }
    scene.style = Style::ink;
    scene.line_width_px = k_line_width_px;
    for (const auto& [path, name] : {std::pair{LinePath::pulling, "pulling"},
                                     {LinePath::all_edges, "all edges"},
                                     {LinePath::quads, "quads"},
                                     {LinePath::adjacency, "adjacency"}}) {
        RendererOptions options = k_usual;
        options.line_path = path;
        check_lines(*gpu, name, scene, lines.samples(), {options});
    }
}

TEST_CASE("the foot of a thing is inked where it stands on the ground not where it stands in it" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model box(make_built_in_shape("box", 12));
    for (const float height : {-1e-2f, -1e-3f, -2e-4f, 2e-4f, 1e-3f}) {
        MeshSource square{{{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}}, {{0, 2, 1}, {0, 3, 2}}};
        for (glm::vec3& corner : square.positions) corner.y = -1.0f - height;
        const Model ground(square);
        for (const bool orthographic : {false, true}) {
            Scene scene = line_scene(box);
            scene.camera.ortho_height = orthographic ? 4.0 : 0.0;
            scene.instances.push_back({.octree = &ground.octree, .has_lines = false});
            const RayReference rays(scene);
            const LineReference lines(scene, rays);
            for (const RendererOptions& options : {k_usual, k_line_coverage_plain}) {
                const std::string name = (orthographic ? "foot, flat " : "foot ") +
                                         std::to_string(int(std::lround(height * 1e4f)));
                const Coverage coverage = coverage_of(*gpu, name, scene, lines.samples(), options);
                INFO(name, " at scale ", options.scale);
                CHECK(coverage.bare == 0);
                CHECK(coverage.doubtful == 0);
                CHECK((20 * coverage.seen > 19 * coverage.samples) == (height > 0.0f));
                if (height > 0.0f) CHECK(coverage.faint == 0);
            }
        }
    }
}

TEST_CASE("lines of models are inked where rays see them and nowhere else" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    std::string missing;
    for (const char* name :
         {"stanford-bunny.obj", "igea.ply", "horse.ply", "nefertiti.obj", "fandisk.obj",
          "rocker-arm.obj", "beetle-alt.obj", "ogre.obj", "alligator.obj"}) {
        const auto path = find_model(name);
        if (!path) {
            missing += std::string(missing.empty() ? "" : ", ") + name;
            continue;
        }
        const Model model(read_mesh_file(*path));
        check_lines(*gpu, name, line_scene(model));
    }
    if (!missing.empty()) RIMLINE_SKIP("RIMLINE_MODELS lacks " + missing);
}
