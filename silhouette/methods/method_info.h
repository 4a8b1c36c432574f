#pragma once

// The list of all methods that find silhouettes: their names, abilities and sources.
//
// It is a header alone, so that a program built without the other methods knows their names too.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace rimline {

struct SilhouetteMethodInfo {
    std::string_view name;  ///< As --method takes it.
    std::string_view summary;
    std::string_view source;        ///< Paper or thesis section.
    bool has_update = false;        ///< update() is more than extract().
    std::uint32_t max_origins = 0;  ///< How many of SilhouetteMethodOptions::origins are used.
    bool has_seed = false;          ///< SilhouetteMethodOptions::seed matters.
    bool directions_only = false;   ///< Refuses viewpoints with Error{bad_input}.
    bool exact = true;              ///< Always equal to brute force; else a subset of it.
};

inline constexpr std::array k_silhouette_methods{
    SilhouetteMethodInfo{.name = "octree",
                         .summary = "octree over Hough space, laid out for today's machines",
                         .source = "hough_octree.h, after Olson, chapter 3",
                         .has_update = true,
                         .max_origins = 0xffffffffu},
    SilhouetteMethodInfo{.name = "literal",
                         .summary = "the same as the thesis describes it",
                         .source = "Olson, A Plane View of Geometric Silhouettes, chapter 3",
                         .has_update = true,
                         .max_origins = 1},
    SilhouetteMethodInfo{.name = "brute",
                         .summary = "every face and edge, by windows of faces in vector registers",
                         .source = "windowed_brute_force.h",
                         .has_update = true},
    SilhouetteMethodInfo{.name = "brute-scalar",
                         .summary = "every face and edge, one by one",
                         .source = "brute_force.h"},
    SilhouetteMethodInfo{.name = "edge-buffer",
                         .summary = "faces flag their edges, lists of edges are swept",
                         .source = "Buchanan, Sousa, The edge buffer, NPAR 2000"},
    SilhouetteMethodInfo{.name = "dual",
                         .summary = "boxes of geometric duals, which a plane cuts",
                         .source = "Pop, Duncan, Barequet, Goodrich, Huang, Kumar, Efficient "
                                   "perspective-accurate silhouette computation, SoCG 2001",
                         .has_update = true,
                         .max_origins = 1},
    SilhouetteMethodInfo{.name = "plane-tree",
                         .summary = "boxes of planes in four dimensions",
                         .source = "Hertzmann, Zorin, Illustrating Smooth Surfaces, SIGGRAPH 2000",
                         .has_update = true},
    SilhouetteMethodInfo{.name = "gauss",
                         .summary = "boxes of normals on a cube, for directions only",
                         .source =
                             "Gooch et al., Interactive Technical Illustration, I3D 1999, and "
                             "Benichou, Elber, Output Sensitive Extraction of Silhouettes, "
                             "Pacific Graphics 1999",
                         .has_update = true,
                         .directions_only = true},
    SilhouetteMethodInfo{.name = "cone-tree",
                         .summary = "clusters with cones where all faces are front or back",
                         .source = "Sander, Gu, Gortler, Hoppe, Snyder, Silhouette Clipping, "
                                   "SIGGRAPH 2000"},
    SilhouetteMethodInfo{.name = "quadric",
                         .summary = "boxes and ellipsoids of planes in four dimensions",
                         .source = "after Soroka, Peters, Marschner, Quadric-Based Silhouette "
                                   "Sampling for Differentiable Rendering, SIGGRAPH 2025"},
    SilhouetteMethodInfo{.name = "randomised",
                         .summary = "random edges, and along the silhouette from those; not exact",
                         .source = "Markosian et al., Real-Time Nonphotorealistic Rendering, "
                                   "SIGGRAPH 1997",
                         .has_update = true,
                         .has_seed = true,
                         .exact = false},
};

/// All methods, the octree first.
constexpr std::span<const SilhouetteMethodInfo> silhouette_methods() noexcept {
    return k_silhouette_methods;
}

/// Null when no method has that name.
constexpr const SilhouetteMethodInfo* find_silhouette_method(std::string_view name) noexcept {
    const auto found = std::ranges::find(k_silhouette_methods, name, &SilhouetteMethodInfo::name);
    return found == k_silhouette_methods.end() ? nullptr : &*found;
}

}  // namespace rimline
