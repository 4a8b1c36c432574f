#pragma once

// Is the brute force that we are compared with as fast as it can be made here?
//
// On the machine where it was tuned, with AVX-512, the packed brute force takes 63 us for an extraction
// on the bunny of 69k faces and 330 us on igea of 269k, of which 14 and 137 us go to the face bits. That
// pass reads four floats a face and does seven operations on them, and so does the plain loop below,
// which only counts; no index, no packed words, no edges. So the plain loop measures the machine:
//
//     ceiling = 1.25 * brute force there * plain loop here / face bits there
//
// A brute force slower than the ceiling is a defect of the bench, as its ratios would flatter us.
//
// The limits: what the loop cannot see are the gathers of the edge pass, over half of an extraction. With
// AVX2 they are so much slower against plain reads (on one machine an edge took 2.7 times as long as the
// ceiling has room for, with face bits as fast as the loop) that being above tells nothing; so the
// verdict is for AVX-512 alone. The ceiling is known for these two meshes only, as their size decides
// what fits in which cache.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/instruction_set.h"

namespace rimline::tools {

/// Counts the front faces of a mesh, by the widest registers there are.
class PlainLoop {
public:
    explicit PlainLoop(const Mesh& mesh);
    /// Valid until the object moves or dies; O(faces).
    std::uint32_t count_front(const HomogeneousPoint& point) const;

private:
    struct Kernel {
        [[gnu::always_inline]] static inline std::uint32_t run(const float* nx, const float* ny,
                                                               const float* nz, const float* d,
                                                               std::size_t count, float x, float y,
                                                               float z, float w) {
            std::uint32_t front = 0;
            for (std::size_t i = 0; i < count; ++i)
                front += (nx[i] * x + ny[i] * y) + nz[i] * z > w * d[i] ? 1u : 0u;
            return front;
        }
    };

    std::vector<float> nx_, ny_, nz_, d_;
    KernelPointer<Kernel> kernel_;
};

struct BruteForceCeiling {
    double plain_us;     ///< The plain loop, here.
    double measured_us;  ///< The packed brute force, here.
    double ceiling_us;   ///< What it may take here.
    bool is_known;       ///< Whether being above it is a defect.
    /// "ok", "defect", or "unknown" where it is above and that tells nothing.
    std::string_view verdict() const noexcept {
        return measured_us <= ceiling_us ? "ok" : is_known ? "defect" : "unknown";
    }
};

/// Nothing for meshes whose time on the other machine is not known.
std::optional<BruteForceCeiling> brute_force_ceiling(std::uint32_t faces,
                                                     std::string_view instruction_set,
                                                     double plain_us, double measured_us);

}  // namespace rimline::tools
