#include <algorithm>
#include <cmath>

#include "silhouette/mesh/shapes/circle.h"
#include "silhouette/mesh/shapes/shape_makers.h"

namespace rimline {

namespace {

// A random number in [-1, 1) for each point of an integer lattice. It is an integer hash, equal on
// every machine.
double lattice_value(std::int64_t x, std::int64_t z, std::uint32_t octave) {
    constexpr std::uint64_t k_seed = 0x52696d6c696e65u;
    std::uint64_t h = k_seed + octave * 0x9e3779b97f4a7c15u;
    h = (h ^ static_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ h >> 29 ^ static_cast<std::uint64_t>(z)) * 0x94d049bb133111ebu;
    h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
    return static_cast<double>(h >> 11) * 0x1p-52 - 1.0;
}

// Zero first and second derivatives at both ends, so the lattice causes no creases.
double smooth_step(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

double value_noise(double x, double z, std::uint32_t octave) {
    const double x0 = std::floor(x);
    const double z0 = std::floor(z);
    const auto i = static_cast<std::int64_t>(x0);
    const auto j = static_cast<std::int64_t>(z0);
    const double u = smooth_step(x - x0);
    const double v = smooth_step(z - z0);
    const double near =
        lattice_value(i, j, octave) * (1.0 - u) + lattice_value(i + 1, j, octave) * u;
    const double far =
        lattice_value(i, j + 1, octave) * (1.0 - u) + lattice_value(i + 1, j + 1, octave) * u;
    return near * (1.0 - v) + far * v;
}

// Hills: octaves of noise, each on a lattice rotated relative to the previous one. The noise is
// rough at large heights and smooth in the valleys.
double height_at(double x, double z) {
    constexpr std::uint32_t k_octaves = 7;
    const CosSin turn = cos_sin_of_turns(0.103);
    double height = 0.0;
    double amplitude = 0.27;
    double u = 1.7 * x;
    double v = 1.7 * z;
    for (std::uint32_t octave = 0; octave < k_octaves; ++octave) {
        const double roughness = octave < 2 ? 1.0 : std::clamp(0.5 + 1.6 * height, 0.1, 1.3);
        height += amplitude * roughness * value_noise(u, v, octave);
        amplitude *= 0.45;
        const double turned = 2.03 * (turn.cos * u - turn.sin * v);
        v = 2.03 * (turn.sin * u + turn.cos * v);
        u = turned;
    }
    return height;
}

}  // namespace

MeshSource make_terrain(std::uint32_t faces) {
    const auto n = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(0.5 * faces))));
    MeshSource terrain;
    terrain.positions.reserve((std::size_t{n} + 1) * (n + 1));
    terrain.triangles.reserve(2 * std::size_t{n} * n);
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double x = (2.0 * i - n) / n;
            const double z = (2.0 * j - n) / n;
            terrain.positions.push_back(glm::vec3(glm::dvec3(x, height_at(x, z), z)));
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            const std::uint32_t b = a + 1;
            const std::uint32_t d = a + n + 1;
            const std::uint32_t c = d + 1;
            // Diagonals alternate, so slopes are equally rough in both directions.
            if ((i + j) % 2 == 0) {
                terrain.triangles.push_back({a, d, c});
                terrain.triangles.push_back({a, c, b});
            } else {
                terrain.triangles.push_back({a, d, b});
                terrain.triangles.push_back({b, d, c});
            }
        }
    return terrain;
}

}  // namespace rimline
