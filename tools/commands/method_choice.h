#pragma once

// The methods of `rimline silhouette --method`. A build without the other methods (RIMLINE_METHODS=OFF) has
// `octree` and `brute-scalar` only.

#include <memory>

#include "silhouette/methods/method_registry.h"

namespace rimline::tools {

bool is_in_build(const SilhouetteMethodInfo& info) noexcept;

/// `info` must be in the build. `mesh` must outlive the method.
std::unique_ptr<SilhouetteMethod> make_method(const SilhouetteMethodInfo& info, const Mesh& mesh,
                                              const SilhouetteMethodOptions& options);

}  // namespace rimline::tools
