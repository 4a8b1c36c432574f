#pragma once

// Makes a method that finds silhouettes by its name (method_info.h).

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/methods/method_info.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

struct SilhouetteMethodOptions {
    /// For methods in Hough or dual space, within k_max_coordinate. Empty: the mesh's center. A method
    /// that uses one origin only takes the first.
    std::vector<glm::dvec3> origins;
    std::uint64_t seed = 1;  ///< For methods that use random numbers.
    LongCall call;           ///< Stops the octree's build. The other builds cannot be stopped.
};

/// `mesh` must outlive the method. Null when no method has that name.
std::unique_ptr<SilhouetteMethod> make_silhouette_method(
    std::string_view name, const Mesh& mesh, const SilhouetteMethodOptions& options = {});

}  // namespace rimline
