#pragma once

// A test whether packed brute force, the baseline, is as fast as it can be on this machine.
//
// On the machine where it was tuned, with AVX-512, packed brute force takes 63 us for an extraction on the
// bunny of 69k faces and 330 us on igea of 269k. Of these the face bits take 14 and 137 us. That pass reads
// four floats a face and does seven operations on them. The plain loop below does the same and only counts:
// it has no index, no packed words, no edges. So the plain loop measures the machine:
//
//     ceiling = 1.25 * brute force there * plain loop here / face bits there
//
// Brute force slower than the ceiling is a defect of the bench: the ratios would be too good for the octree.
//
// Limits: the loop does not measure the gathers of the edge pass, over half of an extraction. With AVX2
// gathers are much slower relative to plain reads: on one machine an edge took 2.7 times as long as the
// ceiling allows, with face bits as fast as the loop. So the verdict holds for AVX-512 only. The ceiling is
// known for these two meshes only, because a mesh's size decides which caches it fits in.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/instruction_set.h"

namespace rimline::tools {

/// Counts the front faces of a mesh with the widest registers of the machine.
class PlainLoop {
public:
    explicit PlainLoop(const Mesh& mesh);
    /// O(faces).
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
    double plain_us;     ///< The plain loop, on this machine.
    double measured_us;  ///< Packed brute force, on this machine.
    double ceiling_us;   ///< The greatest time allowed on this machine.
    bool is_known;       ///< Whether a time above the ceiling is a defect.
    /// "ok", "defect", or "unknown" for a time above the ceiling that means nothing.
    std::string_view verdict() const noexcept {
        return measured_us <= ceiling_us ? "ok" : is_known ? "defect" : "unknown";
    }
};

/// Nothing for meshes without a known time on the other machine.
std::optional<BruteForceCeiling> brute_force_ceiling(std::uint32_t faces,
                                                     std::string_view instruction_set,
                                                     double plain_us, double measured_us);

}  // namespace rimline::tools
