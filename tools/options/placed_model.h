#pragma once

// A model with its place in a scene of several, and how such models become one.
//
// Nothing in a scene of models moves by itself. Therefore the placed models are joined into one mesh: then all
// that is true of the lines, shadows and views of one mesh is true of the scene, also where models hide each
// other, pass through each other or touch.
//
//     point of the scene = at + turn(scale * upright(point of the model))
//
// `upright` turns the up direction of the model to that of the scene, if the two differ.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "silhouette/mesh/mesh_source.h"
#include "tools/options/color.h"

namespace rimline::tools {

/// The value of --up.
struct UpChoice {
    std::optional<glm::vec3> direction;  ///< Nothing: auto.
    bool operator==(const UpChoice&) const = default;
};

/// A turn about an axis of the scene through the model's origin, counterclockwise where the axis points to the
/// viewer.
struct Turn {
    std::optional<glm::vec3> axis;  ///< Nothing: the scene's up.
    double degrees = 0.0;
    bool operator==(const Turn&) const = default;
};

struct PlacedModel {
    std::string model;            ///< As MODEL.
    std::uint32_t subdivide = 0;  ///< As --subdivide.
    std::string format = {};      ///< Of standard input.
    glm::vec3 at{0.0f};
    Turn turn = {};
    double scale = 1.0;
    /// Which direction of the model becomes the scene's up. Nothing: that of its format or mesh (up_option.h),
    /// but the first model is not turned.
    std::optional<UpChoice> up = {};
    std::optional<Color> paint = {};  ///< Of all its faces, instead of the colors of its file.

    bool operator==(const PlacedModel&) const = default;

    bool is_placed() const noexcept {
        return at != glm::vec3(0.0f) || turn.degrees != 0.0 || scale != 1.0 || up || paint;
    }
};

constexpr double k_min_scale = 1e-6, k_max_scale = 1e6;

/// `DEGREES`, `AXIS,DEGREES` with an axis x, y, z, -x, -y or -z, or `X,Y,Z,DEGREES`. Throws CLI::ValidationError.
Turn parse_turn(const std::string& option, const std::string& text);
/// A number from k_min_scale to k_max_scale. Throws CLI::ValidationError.
double parse_scale(const std::string& option, const std::string& text);
/// `x,y,z`, an axis, or auto. Throws CLI::ValidationError.
UpChoice parse_up_choice(const std::string& option, const std::string& text);
/// The texts that the three parse to the same values.
std::string text_of(const Turn& turn);
std::string text_of(const UpChoice& up);

/// The rotation that turns `from` to `to` by the smallest angle. Exact between axes.
glm::dmat3 rotation_between(const glm::dvec3& from, const glm::dvec3& to);

/// A source and where it goes: scene = at + matrix * point.
struct PlacedSource {
    const MeshSource* source;
    glm::dmat3 matrix{1.0};
    glm::dvec3 at{0.0};
    std::optional<glm::vec3> paint = {};  ///< In linear light.
    std::string name = {};                ///< Begins messages.
};

/// All sources as one, in their order: positions, triangles, materials, warnings, and if all have them, codes of edges;
/// the up axis is that of the first. Positions are rounded to float; a model whose shape is lost by that is a warning.
/// A source that occurs several times has its materials once. Throws Error{too_large} where positions leave the range
/// of coordinates, or if there are more than 2^30 triangles.
MeshSource join_sources(std::span<const PlacedSource> sources);

}  // namespace rimline::tools
