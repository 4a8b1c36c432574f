#include "silhouette/methods/method_registry.h"

#include <array>
#include <optional>

#include "silhouette/methods/brute_force_method.h"
#include "silhouette/methods/cone_tree.h"
#include "silhouette/methods/dual_tree.h"
#include "silhouette/methods/edge_buffer.h"
#include "silhouette/methods/gauss_map.h"
#include "silhouette/methods/literal_method.h"
#include "silhouette/methods/octree_method.h"
#include "silhouette/methods/plane_tree.h"
#include "silhouette/methods/quadric_tree.h"
#include "silhouette/methods/randomised.h"
#include "silhouette/methods/scalar_brute_force_method.h"

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

// In the order of k_silhouette_methods.
constexpr std::array<Method (*)(const Mesh&, const Options&), k_silhouette_methods.size()> k_makers{
    make_octree,      make_literal,      make<BruteForceMethod>, make<ScalarBruteForceMethod>,
    make<EdgeBuffer>, make_dual,         make<PlaneTree>,        make<GaussMap>,
    make<ConeTree>,   make<QuadricTree>, make_randomised,
};

}  // namespace

std::unique_ptr<SilhouetteMethod> make_silhouette_method(std::string_view name, const Mesh& mesh,
                                                         const SilhouetteMethodOptions& options) {
    const SilhouetteMethodInfo* const info = find_silhouette_method(name);
    if (info == nullptr) return nullptr;
    return k_makers[static_cast<std::size_t>(info - k_silhouette_methods.data())](mesh, options);
}

}  // namespace rimline
