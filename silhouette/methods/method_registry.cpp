#include "silhouette/methods/method_registry.h"

#include <algorithm>
#include <array>

#include "silhouette/methods/brute_force_methods.h"
#include "silhouette/methods/cone_tree.h"
#include "silhouette/methods/dual_tree.h"
#include "silhouette/methods/edge_buffer.h"
#include "silhouette/methods/gauss_map.h"
#include "silhouette/methods/octree_methods.h"
#include "silhouette/methods/plane_tree.h"
#include "silhouette/methods/quadric_tree.h"
#include "silhouette/methods/randomised.h"

namespace rimline {

namespace {

using Options = SilhouetteMethodOptions;
using Method = std::unique_ptr<SilhouetteMethod>;

std::optional<glm::dvec3> first_origin(const Options& options) {
    return options.origins.empty() ? std::nullopt : std::optional(options.origins.front());
}

Method make_octree(const Mesh& mesh, const Options& options) {
    return std::make_unique<OctreeMethod>(mesh, HoughOctreeOptions{options.origins}, options.call);
}

Method make_literal(const Mesh& mesh, const Options& options) {
    LiteralOctreeOptions literal;
    literal.origin = first_origin(options);
    return std::make_unique<LiteralMethod>(mesh, literal);
}

Method make_dual(const Mesh& mesh, const Options& options) {
    return std::make_unique<DualTree>(mesh, first_origin(options).value_or(mesh.center()));
}

Method make_randomised(const Mesh& mesh, const Options& options) {
    return std::make_unique<Randomised>(mesh, options.seed);
}

template <typename Made>
Method make(const Mesh& mesh, const Options&) {
    return std::make_unique<Made>(mesh);
}

constexpr std::array k_methods{
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
                         .summary = "every face and edge, packed for vector registers",
                         .source = "brute_force_packed.h",
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

constexpr std::array<Method (*)(const Mesh&, const Options&), k_methods.size()> k_makers{
    make_octree,
    make_literal,
    make<PackedBruteForceMethod>,
    make<ScalarBruteForceMethod>,
    make<EdgeBuffer>,
    make_dual,
    make<PlaneTree>,
    make<GaussMap>,
    make<ConeTree>,
    make<QuadricTree>,
    make_randomised,
};

}  // namespace

std::span<const SilhouetteMethodInfo> silhouette_methods() noexcept { return k_methods; }

const SilhouetteMethodInfo* find_silhouette_method(std::string_view name) noexcept {
    const auto found = std::find_if(k_methods.begin(), k_methods.end(),
                                    [name](const auto& info) { return info.name == name; });
    return found == k_methods.end() ? nullptr : &*found;
}

std::unique_ptr<SilhouetteMethod> make_silhouette_method(std::string_view name, const Mesh& mesh,
                                                         const SilhouetteMethodOptions& options) {
    const SilhouetteMethodInfo* const info = find_silhouette_method(name);
    if (info == nullptr) return nullptr;
    return k_makers[static_cast<std::size_t>(info - k_methods.data())](mesh, options);
}

}  // namespace rimline
