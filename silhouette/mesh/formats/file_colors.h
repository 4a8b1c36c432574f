#pragma once

// Colors of a file as materials of its faces, and warnings about what cannot be used.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// Channels in [0, 1]. Larger ones become 1; negative ones and NaN become 0.
glm::vec3 clamped_color(const glm::vec3& color) noexcept;

/// The factor to [0, 1] of the numbers of colors whose range the file does not say. They are in [0, 255] if `largest`,
/// the greatest of them, is 2 or more, otherwise in [0, 1]. Rounded numbers just above 1 do not decide.
float color_number_scale(float largest) noexcept;

/// The product of the colors of vertices and of triangles, in linear light, as colors of corners. Every triangle that
/// has a color gets a white material. A triangle has one if vertices have colors or if its own is not
/// k_no_color. Each list is empty or has a color for each position or triangle. Throws Error{cancelled}.
void color_vertices_and_triangles(MeshSource& source, std::span<const glm::vec3> vertex_colors,
                                  std::span<const glm::vec3> triangle_colors,
                                  const std::stop_token& stop = {});

/// A triangle's color if it has none.
constexpr glm::vec3 k_no_color{-1.0f};

/// 0 where a coordinate is not finite.
glm::vec2 finite_uv(const glm::vec2& uv) noexcept;

/// Appends a white material.
MaterialId add_white_material(FaceMaterials& materials);

/// Gives all triangles that have no material a white one.
void whiten_triangles(MeshSource& source);

/// Gives the corners of all triangles the colors of their vertices, in linear light. There must be a color for
/// each position. Triangles without a material stay without a color. Throws Error{cancelled}.
void color_corners(MeshSource& source, std::span<const glm::vec3> vertex_colors,
                   const std::stop_token& stop = {});

/// Makes the materials empty if no face has one, and drops the texture coordinates if no face has a texture.
void drop_unused_materials(MeshSource& source) noexcept;

/// For each of FaceMaterials::textures whether a face has it. O(faces).
std::vector<bool> used_textures(const FaceMaterials& materials);

/// Appends a warning, with names from the file as printable_text() has them. A file can have one in each line: after
/// 20, one more says that others follow.
void add_warning(std::vector<std::string>& warnings, std::string_view warning);

}  // namespace rimline
