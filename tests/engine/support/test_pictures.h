#pragma once

// What tests of pictures share: a model with its octree, and pictures of what went wrong.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/picture.h"

namespace rimline::tests {

struct Model {
    explicit Model(const MeshSource& source) : mesh(source), octree(mesh) {}
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;
    Mesh mesh;
    HoughOctree octree;
};

inline double linear_from_srgb(std::uint8_t channel) {
    const double encoded = channel / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// How dark a pixel of a gray picture is: 0 for white, 1 for black, in linear light.
inline double ink_at(const Picture& picture, std::size_t pixel) {
    return 1.0 - linear_from_srgb(picture.rgba[4 * pixel]);
}

inline double ink_at(const Picture& picture, std::size_t x, std::size_t y) {
    return ink_at(picture, y * picture.width + x);
}

/// The ink of a whole picture, in pixels.
inline double ink_of(const Picture& picture) {
    double ink = 0.0;
    for (std::size_t pixel = 0; pixel < picture.rgba.size() / 4; ++pixel)
        ink += ink_at(picture, pixel);
    return ink;
}

struct Mark {
    std::size_t pixel;
    glm::u8vec3 color;
};

/// Writes what was drawn, marked where it is wrong, for who asks by naming a folder in
/// RIMLINE_TEST_PICTURES.
inline void save_picture(const std::string& name, Picture picture, const std::vector<Mark>& marks) {
    const char* folder = std::getenv("RIMLINE_TEST_PICTURES");
    if (!folder) return;
    for (const Mark& mark : marks)
        for (int c = 0; c < 3; ++c)
            picture.rgba[4 * mark.pixel + static_cast<std::size_t>(c)] = mark.color[c];
    const std::vector<std::byte> png = encode_png(picture);
    std::ofstream(std::string(folder) + "/" + name + ".png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

}  // namespace rimline::tests
