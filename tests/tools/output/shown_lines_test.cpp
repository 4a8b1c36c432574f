#include "tools/output/shown_lines.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/options/scene_options.h"

namespace rimline::tools {
namespace {

constexpr ImageSize k_picture_size{400, 300};

Camera camera_of(const Mesh& mesh, double ortho_height) {
    return fit_camera({.fov_y_deg = 35.0, .ortho_height = ortho_height}, mesh,
                      default_view_direction({0, 1, 0}), 4.0 / 3.0);
}

// As the engine projects it, without its aspect.
glm::dvec2 in_picture(const Camera& camera, const glm::vec3& position) {
    const glm::dvec3 p = camera_from_world(camera) * (glm::dvec3(position) - camera.eye);
    return camera.is_orthographic() ? glm::dvec2(p) : glm::dvec2(p) / -p.z;
}

double distance_to(const PictureLines& lines, const glm::dvec2& place, bool is_hidden) {
    double least = 1e9;
    for (const PictureLine& line : lines.lines) {
        if (line.is_hidden != is_hidden) continue;
        for (std::uint32_t i = line.first_point; i < line.last_point; ++i) {
            if (i + 1 == line.last_point && !line.is_closed) break;
            const glm::dvec2 a = lines.points[i];
            const glm::dvec2 way =
                lines.points[i + 1 < line.last_point ? i + 1 : line.first_point] - a;
            const double square = std::max(glm::dot(way, way), 1e-300);
            const double share = std::clamp(glm::dot(place - a, way) / square, 0.0, 1.0);
            least = std::min(least, glm::distance(place, a + share * way));
        }
    }
    return least;
}

// How many edges of a box lie on lines over their whole length.
int edges_on_lines(const Mesh& box, const Camera& camera, const PictureLines& lines,
                   bool is_hidden) {
    int count = 0;
    for (const Edge& edge : box.edges()) {
        const glm::vec3 a = box.positions()[index(edge.vertices[0])];
        const glm::vec3 b = box.positions()[index(edge.vertices[1])];
        bool is_on_line = glm::distance(a, b) < 2.01f;  // The diagonals are longer.
        for (float share = 0.02f; share < 1.0f; share += 0.06f)
            is_on_line = is_on_line && distance_to(lines, in_picture(camera, glm::mix(a, b, share)),
                                                   is_hidden) < 1e-3;
        count += is_on_line ? 1 : 0;
    }
    return count;
}

TEST_CASE("nine edges of a box are seen, and three are hidden") {
    const Mesh box(make_built_in_shape("box", 12));
    const HoughOctree octree(box);
    ShownLines shown(octree);
    for (const double ortho_height : {0.0, 5.0}) {
        CAPTURE(ortho_height);
        const Camera camera = camera_of(box, ortho_height);
        for (const char* style : {"ink", "blueprint"}) {
            SceneOptions options{.style = style, .hidden = true};
            const PictureLines& lines = *shown.draw(camera, k_picture_size, options.line_style({}));
            CHECK(edges_on_lines(box, camera, lines, false) == 9);
            CHECK(edges_on_lines(box, camera, lines, true) == 3);
            CHECK(shown.silhouette_count() == 6);
            CHECK(shown.crease_count() == 12);
        }
        SceneOptions options{.style = "toon"};
        const PictureLines& lines = *shown.draw(camera, k_picture_size, options.line_style({}));
        CHECK(edges_on_lines(box, camera, lines, false) == 6);
        CHECK(std::ranges::none_of(lines.lines, &PictureLine::is_hidden));
        CHECK(lines.lines.size() == 1);
        CHECK(lines.lines.front().is_closed);
    }
}

TEST_CASE("short lines are left out, by default those below a 60th of the picture's height") {
    const Mesh knot(make_built_in_shape("knot", 4000));
    const HoughOctree octree(knot);
    ShownLines shown(octree);
    const Camera camera = camera_of(knot, 0.0);
    SceneOptions options{.style = "toon"};
    const auto count = [&](std::optional<double> min_length) {
        options.min_length = min_length;
        return shown.draw(camera, k_picture_size, options.line_style({}))->lines.size();
    };
    const std::size_t all = count(0.0);
    CHECK(count({}) == count(5.0));
    CHECK(count(40.0) < all);
    CHECK(count(1000.0) > 0);  // The outline.
}

TEST_CASE("intersections are drawn in ink and blueprint, and where they are asked for") {
    // Two plates that cross.
    const Mesh mesh(MeshSource{{{-1, -1, 0},
                                {1, -1, 0},
                                {1, 1, 0},
                                {-1, 1, 0},
                                {0.13f, -0.45f, -1},
                                {0.13f, -0.45f, 1},
                                {0.13f, 0.6f, 1},
                                {0.13f, 0.6f, -1}},
                               {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}});
    const HoughOctree octree(mesh);
    ShownLines shown(octree);
    const Camera camera = camera_of(mesh, 0.0);
    const auto is_drawn = [&](const SceneOptions& options) {
        const PictureLines& lines = *shown.draw(camera, k_picture_size, options.line_style({}));
        return distance_to(lines, in_picture(camera, {0.13f, 0.3f, 0}), false) < 1e-3;
    };
    CHECK(is_drawn({.style = "ink"}));
    CHECK(is_drawn({.style = "blueprint"}));
    CHECK(!is_drawn({.style = "toon"}));
    CHECK(is_drawn({.style = "toon", .intersections = "on"}));
    CHECK(!is_drawn({.style = "ink", .intersections = "off"}));
}

TEST_CASE("no lines are drawn from where no point lies beside the eye") {
    const Mesh box(make_built_in_shape("box", 12));
    const HoughOctree octree(box);
    ShownLines shown(octree);
    Camera camera = camera_of(box, 0.0);
    camera.eye = {double{k_max_coordinate}, 0, 0};
    CHECK(shown.draw(camera, k_picture_size, {}) == nullptr);
}

TEST_CASE("lines are divided where the material of the face in front changes, and nowhere else") {
    // The half of a sphere with x > 0 is of another material.
    MeshSource source = make_built_in_shape("sphere", 2000);
    for (const auto& triangle : source.triangles) {
        float x = 0.0f;
        for (const std::uint32_t v : triangle) x += source.positions[v].x;
        source.materials.of_face.push_back(MaterialId{x > 0.0f ? 1u : 0u});
    }
    source.materials.materials = {{.base_color = {1, 0, 0}}, {.base_color = {0, 0, 1}}};
    const Mesh sphere(std::move(source));
    const HoughOctree octree(sphere);
    ShownLines shown(octree);
    Camera camera = camera_of(sphere, 0.0);
    camera.eye = camera.target + glm::dvec3(0, 0, glm::distance(camera.eye, camera.target));
    SceneOptions options{.style = "toon", .has_material_lines = true};
    const PictureLines& lines =
        *shown.draw(camera, k_picture_size, options.line_style({.background = glm::vec3(1.0f)}));
    REQUIRE(lines.colors.size() == 2);
    CHECK(lines.colors[0] == line_shade({1, 0, 0}, false));
    CHECK(lines.colors[1] == line_shade({0, 0, 1}, false));
    // A closed line begins anywhere: two or three parts.
    CHECK(lines.lines.size() >= 2);
    CHECK(lines.lines.size() <= 3);
    double length = 0.0;
    for (const PictureLine& line : lines.lines) {
        CHECK_FALSE(line.is_closed);
        for (std::uint32_t i = line.first_point; i + 1 < line.last_point; ++i) {
            const glm::dvec2 middle = 0.5 * (lines.points[i] + lines.points[i + 1]);
            length += glm::distance(lines.points[i], lines.points[i + 1]);
            // Faces on the border lie on both sides of it.
            if (std::abs(middle.x) > 0.02) CHECK(line.color == (middle.x > 0.0 ? 1u : 0u));
        }
    }
    const PictureLines plain =
        *shown.draw(camera, k_picture_size, SceneOptions{.style = "toon"}.line_style({}));
    REQUIRE(plain.lines.size() == 1);
    CHECK(plain.lines[0].color == k_own_line_color);
    CHECK(plain.colors.empty());
    double plain_length = glm::distance(plain.points.front(), plain.points.back());
    for (std::size_t i = 0; i + 1 < plain.points.size(); ++i)
        plain_length += glm::distance(plain.points[i], plain.points[i + 1]);
    CHECK(length == doctest::Approx(plain_length).epsilon(1e-3));
    // In styles without colors nothing changes.
    options.style = "blueprint";
    CHECK(shown.draw(camera, k_picture_size, options.line_style({}))->colors.empty());
}

}  // namespace
}  // namespace rimline::tools
