#pragma once

// The list of all silhouette methods: what each is, and how to make one by its name.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

struct SilhouetteMethodInfo {
    std::string_view name;  ///< As --method takes it.
    std::string_view summary;
    std::string_view source;        ///< Paper or thesis section.
    bool has_update = false;        ///< update() is more than extract().
    std::uint32_t max_origins = 0;  ///< Of SilhouetteMethodOptions::origins, how many are used.
    bool has_seed = false;          ///< SilhouetteMethodOptions::seed matters.
    bool directions_only = false;   ///< Viewpoints are refused, with Error{bad_input}.
    bool exact = true;              ///< Always equal to brute force; else a subset.
};

struct SilhouetteMethodOptions {
    /// For methods in Hough or dual space, within k_max_coordinate; empty: the mesh's center. A method
    /// that knows one origin only takes the first.
    std::vector<glm::dvec3> origins;
    std::uint64_t seed = 1;  ///< For randomised ones.
    LongCall call;           ///< Of the octree's build; the others are not to be stopped.
};

/// All there are.
std::span<const SilhouetteMethodInfo> silhouette_methods() noexcept;
/// Null when no method has that name.
const SilhouetteMethodInfo* find_silhouette_method(std::string_view name) noexcept;

/// `mesh` must outlive the method. Null when no method has that name.
std::unique_ptr<SilhouetteMethod> make_silhouette_method(
    std::string_view name, const Mesh& mesh, const SilhouetteMethodOptions& options = {});

}  // namespace rimline
