// What the commands do in a build without the other silhouette methods.

#include "silhouette/methods/octree_method.h"
#include "silhouette/methods/scalar_brute_force_method.h"
#include "tools/absent_part.h"
#include "tools/commands/literal_origins.h"
#include "tools/commands/method_choice.h"

namespace rimline::tools {

bool is_in_build(const SilhouetteMethodInfo& info) noexcept {
    return info.name == "octree" || info.name == "brute-scalar";
}

std::unique_ptr<SilhouetteMethod> make_method(const SilhouetteMethodInfo& info, const Mesh& mesh,
                                              const SilhouetteMethodOptions& options) {
    if (info.name == "octree")
        return std::make_unique<OctreeMethod>(mesh, HoughOctreeOptions{options.origins},
                                              options.call);
    RIMLINE_CHECK(info.name == "brute-scalar");
    return std::make_unique<ScalarBruteForceMethod>(mesh);
}

std::vector<LiteralTrial> count_literal_work(const Mesh&, std::span<const glm::dvec3>,
                                             std::uint32_t, const LongCall&) {
    throw absent_part_error("origins --literal", BuildPart::methods);
}

}  // namespace rimline::tools
