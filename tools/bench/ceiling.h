#pragma once

// A test whether brute force, the baseline, is as fast as a loop on this machine can be.
//
// The plain loop reads 16 bytes a face, does seven operations on them, and reads four bytes an edge and compares
// them. It only counts: it has no packed bits and no index. Brute force (windowed_brute_force.h) reads half the bytes
// a face, as many an edge, and leaves out edges whose surroundings show one side; and it has to find the silhouette.
// With AVX2 it takes 1.1 to 1.6 plain loops on igea, and 0.8 at 4.3 million faces. Slower than
//
//     ceiling = 1.25 * 1.6 plain loops
//
// is a defect of the bench: the ratios would be too good for the octree. (Planes as floats and gathered bits take seven
// plain loops.)
//
// The compiler vectorizes the plain loop for each instruction set, so it measures the machine whatever that has.
// A small mesh lies in the inner caches, from where the loop reads in next to no time: there is no ceiling.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/instruction_set.h"

namespace rimline::tools {

constexpr std::uint32_t k_min_ceiling_faces = 200'000;

/// Counts with the widest registers of the machine.
class PlainLoop {
public:
    explicit PlainLoop(const Mesh& mesh);
    /// The front faces. O(faces).
    std::uint32_t count_front(const HomogeneousPoint& point) const;
    /// The edges whose first face's number is below `limit`. O(edges).
    std::uint32_t count_edges(std::uint32_t limit) const;

private:
    struct FaceKernel {
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
    struct EdgeKernel {
        [[gnu::always_inline]] static inline std::uint32_t run(const std::uint32_t* face,
                                                               std::size_t count,
                                                               std::uint32_t limit) {
            std::uint32_t below = 0;
            for (std::size_t i = 0; i < count; ++i) below += face[i] < limit ? 1u : 0u;
            return below;
        }
    };

    std::vector<float> nx_, ny_, nz_, d_;
    std::vector<std::uint32_t> faces_of_edges_;
    KernelPointer<FaceKernel> face_kernel_;
    KernelPointer<EdgeKernel> edge_kernel_;
};

struct BruteForceCeiling {
    double plain_us;     ///< The plain loop, on this machine.
    double measured_us;  ///< Brute force, on this machine.
    double ceiling_us;   ///< The greatest time allowed on this machine.
    bool is_defect() const noexcept { return measured_us > ceiling_us; }
};

/// Nothing for meshes of fewer faces than k_min_ceiling_faces.
std::optional<BruteForceCeiling> brute_force_ceiling(std::uint32_t faces, double plain_us,
                                                     double measured_us);

}  // namespace rimline::tools
