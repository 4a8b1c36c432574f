#pragma once

// The materials of the faces of a mesh: the colors that its file gives to surfaces.
//
//     color at a point of a face = base color of the face's material
//                                  * color of the corners, interpolated
//                                  * texture of the material at the coordinates of the corners, interpolated
//
// Colors are in linear light, each channel in [0, 1]. A face without a material has no color of its own: the
// program that draws the mesh chooses it. Materials belong to faces, and colors and texture coordinates to the
// corners of faces, not to vertices. Therefore welding, which joins vertices and keeps faces, changes none of
// them.

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "silhouette/mesh/ids.h"
#include "silhouette/picture.h"

namespace rimline {

/// How a texture goes on outside of [0, 1].
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };

/// A picture on surfaces. Its alpha is not used.
struct MaterialTexture {
    /// Begins messages about it: the model's file, the place in it, and what is there.
    std::string place;
    /// Its file, or an empty path.
    std::filesystem::path path = {};
    /// The bytes of a PNG or JPEG file that the model's file holds, or null.
    std::shared_ptr<const std::string> embedded = {};
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_pixelated = false;  ///< Enlarged pixels have sharp edges.
    /// Null before read_textures() (formats/mesh_file.h), and if the picture cannot be read: then it is white.
    std::shared_ptr<const Picture> picture = {};

    bool operator==(const MaterialTexture&) const = default;
};

struct SurfaceMaterial {
    glm::vec3 base_color{1.0f};
    TextureId texture = k_no_texture;
    bool operator==(const SurfaceMaterial&) const = default;
};

struct FaceMaterials {
    std::vector<SurfaceMaterial> materials;
    /// The index in `materials` for each face, or k_no_material. Empty if no face has a material.
    std::vector<MaterialId> of_face;
    /// Three for each face. Empty if all corners are white.
    std::vector<glm::vec3> corner_colors;
    /// Of materials.
    std::vector<MaterialTexture> textures;
    /// Texture coordinates, three for each face: (0, 0) is the left top corner of the picture, (1, 1) the right
    /// bottom one. Empty if no face has a texture.
    std::vector<glm::vec2> corner_uvs;

    /// Whether no face has a color.
    bool empty() const noexcept { return of_face.empty(); }
    /// The texture of a face, or k_no_texture.
    TextureId texture_of(std::size_t face) const noexcept {
        if (corner_uvs.empty() || of_face[face] == k_no_material) return k_no_texture;
        return materials[index(of_face[face])].texture;
    }
    /// Whether a texture has a picture. O(textures).
    bool has_pictures() const noexcept;
    bool operator==(const FaceMaterials&) const = default;
};

/// Whether the sizes of the lists are those of a mesh of `face_count` faces, every index is in range, and all
/// texture coordinates are finite. O(faces).
bool are_materials_of(const FaceMaterials& materials, std::size_t face_count) noexcept;

}  // namespace rimline
