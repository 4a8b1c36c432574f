#pragma once

// What tests of shadows draw: lights, cameras, and meshes of every kind that volumes are known to
// break on.

#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <optional>

#include "engine/scene.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline::tests {

inline Light sun(const glm::dvec3& direction) { return {.vector = direction, .directional = true}; }
inline Light lamp(const glm::dvec3& position) { return {.vector = position, .directional = false}; }

inline Camera looking(const glm::dvec3& eye, const glm::dvec3& target, double ortho_height = 0.0) {
    return {.eye = eye, .target = target, .ortho_height = ortho_height};
}

// About an axis, by an angle.
inline glm::dmat3 turned(const glm::dvec3& axis, double angle_rad) {
    const glm::dvec3 a = glm::normalize(axis);
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const auto column = [&](const glm::dvec3& v) {
        return c * v + s * glm::cross(a, v) + (1.0 - c) * glm::dot(a, v) * a;
    };
    return {column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
}

inline SceneInstance instance_of(const Model& model, const glm::dmat3& rotation = glm::dmat3(1.0),
                                 const glm::dvec3& translation = glm::dvec3(0.0)) {
    return {.octree = &model.octree, .rotation = rotation, .translation = translation};
}

inline SceneInstance ground_of(const Model& ground, bool casts_shadows = false) {
    SceneInstance instance = instance_of(ground);
    instance.casts_shadows = casts_shadows;
    return instance;
}

inline MeshSource square(double half, double height) {
    const auto h = static_cast<float>(half);
    const auto y = static_cast<float>(height);
    return {{{-h, y, -h}, {h, y, -h}, {h, y, h}, {-h, y, h}}, {{0, 2, 1}, {0, 3, 2}}};
}

// The faces of a shape whose middle has a positive height.
inline MeshSource upper_half(MeshSource shape) {
    std::erase_if(shape.triangles, [&](const std::array<std::uint32_t, 3>& t) {
        return shape.positions[t[0]].y + shape.positions[t[1]].y + shape.positions[t[2]].y <= 0.0f;
    });
    return shape;
}

// A sheet with a half turn: not orientable, so that one of its edges' rows is inconsistent.
inline MeshSource half_turned_sheet(std::uint32_t quads) {
    MeshSource strip;
    for (std::uint32_t q = 0; q < quads; ++q) {
        const double turn = 2.0 * glm::pi<double>() * q / quads;
        for (const double side : {-0.4, 0.4}) {
            const double r = 1.0 + side * std::cos(0.5 * turn);
            strip.positions.emplace_back(r * std::cos(turn), side * std::sin(0.5 * turn) + 0.6,
                                         r * std::sin(turn));
        }
        const bool last = q + 1 == quads;
        const std::uint32_t low = last ? 1 : 2 * q + 2;
        const std::uint32_t high = last ? 0 : 2 * q + 3;
        strip.triangles.push_back({2 * q, low, high});
        strip.triangles.push_back({2 * q, high, 2 * q + 1});
    }
    return strip;
}

inline MeshSource floating_soup(std::uint32_t count, std::uint64_t seed) {
    Random random(seed);
    MeshSource soup;
    for (std::uint32_t f = 0; f < count; ++f) {
        const glm::vec3 middle = random.in_cube() + glm::vec3(0.0f, 1.2f, 0.0f);
        for (int corner = 0; corner < 3; ++corner)
            soup.positions.push_back(middle + 0.5f * random.in_cube());
        soup.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    return soup;
}

inline MeshSource moved(MeshSource source, const glm::dvec3& by) {
    for (glm::vec3& position : source.positions) position = glm::vec3(glm::dvec3(position) + by);
    return source;
}

inline MeshSource turned_inside_out(MeshSource source) {
    for (auto& triangle : source.triangles) std::swap(triangle[1], triangle[2]);
    return source;
}

// Every third face turned over: closed, but not consistently oriented.
inline MeshSource partly_turned_over(MeshSource source) {
    for (std::size_t f = 0; f < source.triangles.size(); f += 3)
        std::swap(source.triangles[f][1], source.triangles[f][2]);
    return source;
}

// A tube along a closed curve that lies in the plane and crosses itself: a figure of eight. Where the
// tube meets itself it intersects; its cross-section is an eight too, so that half of its inside has a
// negative winding number.
inline MeshSource figure_eight(std::uint32_t rings, std::uint32_t sides) {
    MeshSource tube;
    for (std::uint32_t r = 0; r < rings; ++r) {
        const double a = 2.0 * glm::pi<double>() * r / rings;
        const glm::dvec3 center(1.2 * std::sin(a), 0.25 * std::sin(a), 0.8 * std::sin(2.0 * a));
        const glm::dvec3 along = glm::normalize(
            glm::dvec3(1.2 * std::cos(a), 0.25 * std::cos(a), 1.6 * std::cos(2 * a)));
        const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)));
        const glm::dvec3 over = glm::cross(across, along);
        for (std::uint32_t s = 0; s < sides; ++s) {
            const double b = 2.0 * glm::pi<double>() * s / sides;
            tube.positions.emplace_back(center + 0.35 * std::sin(b) * across +
                                        0.35 * std::sin(2.0 * b) * over);
        }
    }
    for (std::uint32_t r = 0; r < rings; ++r)
        for (std::uint32_t s = 0; s < sides; ++s) {
            const auto at = [&](std::uint32_t ring, std::uint32_t side) {
                return ring % rings * sides + side % sides;
            };
            tube.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
            tube.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
        }
    return tube;
}

// Two boxes that share an edge, four faces to it.
inline MeshSource boxes_on_an_edge() {
    MeshSource boxes = make_built_in_shape("box", 12);
    for (glm::vec3& position : boxes.positions) position *= 0.5f;
    const auto count = static_cast<std::uint32_t>(boxes.positions.size());
    const std::size_t faces = boxes.triangles.size();
    for (std::uint32_t v = 0; v < count; ++v)
        boxes.positions.push_back(boxes.positions[v] + glm::vec3(1.0f, 0.0f, 1.0f));
    for (std::size_t f = 0; f < faces; ++f) {
        const auto t = boxes.triangles[f];
        boxes.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    }
    return boxes;
}

// Scenes of one to three casters of every kind over a ground, one or two lights, and a camera anywhere,
// in shadow and within a caster too. Some are 10^6 away from the origin.
class RandomScenes {
public:
    explicit RandomScenes(std::uint64_t seed) : random_(seed) {
        for (const char* name : {"box", "torus", "knot", "spring", "sphere", "terrain", "scene"})
            models_.emplace_back(make_built_in_shape(name, 1000));
        models_.emplace_back(half_turned_sheet(40));
        models_.emplace_back(floating_soup(40, seed));
        models_.emplace_back(figure_eight(32, 14));
        models_.emplace_back(turned_inside_out(make_built_in_shape("torus", 600)));
        models_.emplace_back(partly_turned_over(make_built_in_shape("sphere", 300)));
        models_.emplace_back(upper_half(make_built_in_shape("sphere", 600)));
        models_.emplace_back(boxes_on_an_edge());
        ground_.emplace(square(20.0, -1.6));
    }

    Scene next() {
        const glm::dvec3 away =
            random_.below(8) == 0 ? glm::dvec3(1e6, -2.5e5, 5e5) : glm::dvec3(0.0);
        Scene scene;
        scene.instances.push_back(ground_of(*ground_, random_.below(2) == 0));
        scene.instances.back().translation = away;
        for (std::uint32_t i = 1 + random_.below(3); i > 0; --i)
            scene.instances.push_back(
                instance_of(models_[random_.below(static_cast<std::uint32_t>(models_.size()))],
                            turned(within(1.0), 3.0 * random_.signed_unit()), away + within(1.5)));
        for (std::uint32_t i = 1 + random_.below(2); i > 0; --i)
            scene.lights.push_back(random_.below(2) == 0
                                       ? sun(within(1.0) + glm::dvec3(0, 0.8, 0))
                                       : lamp(away + within(3.0) + glm::dvec3(0, 1.5, 0)));
        scene.camera = looking(away + within(4.0) + glm::dvec3(0, 2.2, 0), away + within(1.0),
                               random_.below(3) == 0 ? 6.0 : 0.0);
        return scene;
    }

private:
    glm::dvec3 within(double radius) { return radius * glm::dvec3(random_.in_cube()); }

    Random random_;
    std::deque<Model> models_;
    std::optional<Model> ground_;
};

}  // namespace rimline::tests
