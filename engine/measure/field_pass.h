#pragma once

// The tangential distance field (silhouette/field/tangential_field.h) on the GPU: the sum over all planes,
// in a compute shader. For devices that do arithmetic faster than a CPU opens clusters, and for callers
// whose planes or points are there already; it is the same sum, with a bound of its own.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/error.h"
#include "silhouette/field/tangential_field.h"

namespace rimline {

class FieldPass {
public:
    /// Uploads the planes. The function has 32 knots or fewer (RIMLINE_CHECK). The context's device must
    /// outlive the pass. Throws Error{too_large} where the device cannot hold the planes, 20 bytes each.
    FieldPass(const DeviceContext& context, const UnitPlanes& planes,
              const TangentialFunction& function,
              FieldOptions::Weight weight = FieldOptions::Weight::count);

    /// One value for each point; points are in unit coordinates, no farther than 4 from the center
    /// (RIMLINE_CHECK). Submits and waits, in batches of up to 512 KiB of sums; `call` is told after each,
    /// and where it is cancelled Error{cancelled} is thrown. One thread at a time.
    void values(std::span<const glm::dvec3> points, std::span<double> out,
                const LongCall& call = {});

    /// No value differs by more from the exact sum: rounding in float, whatever the device's order of it
    /// within a product and a sum. About 1e-5 of the greatest value for the named functions.
    double error_bound() const noexcept { return error_bound_; }

private:
    void sum_batch(std::span<const glm::dvec3> points, std::span<double> out);

    DeviceContext context_;
    std::uint32_t tile_count_ = 0;
    std::uint32_t piece_count_ = 0;
    double error_bound_ = 0.0;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
    Buffer planes_, pieces_;
    Buffer points_, sums_;  // Of a batch; they grow.
};

}  // namespace rimline
