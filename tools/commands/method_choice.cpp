#include "tools/commands/method_choice.h"

namespace rimline::tools {

bool is_in_build(const SilhouetteMethodInfo&) noexcept { return true; }

std::unique_ptr<SilhouetteMethod> make_method(const SilhouetteMethodInfo& info, const Mesh& mesh,
                                              const SilhouetteMethodOptions& options) {
    return make_silhouette_method(info.name, mesh, options);
}

}  // namespace rimline::tools
