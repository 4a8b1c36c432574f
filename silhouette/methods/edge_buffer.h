#pragma once

// The edge buffer: each face sets a front or a back flag of its edges; edges with both flags are drawn.
//
// J. Buchanan, M. Sousa, The edge buffer: a data structure for easy silhouette rendering, NPAR 2000.
// Each vertex has a list of the edges to vertices with greater numbers, each with a front and a back
// flag. A pass over the faces sets the flags of their edges, a pass over the lists draws the edges that
// have both and clears them. Each face is tested only once, and edges do not store their faces.
//
// Flags are set, not toggled: an edge with three or more faces is also on the silhouette when it has both
// flags. A border never has both. An inconsistent edge, whose two faces traverse it in the same direction,
// is on the silhouette when it has one flag only; such edges are examined before the flags are cleared. The
// lists are stored one after another in one array, flags apart from ids. A face stores the positions of its
// three edges instead of searching for them.

#include "silhouette/methods/edge_leaves.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class EdgeBuffer final : public SilhouetteMethod {
public:
    explicit EdgeBuffer(const Mesh& mesh);

    /// O(faces + edges), as is update().
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;

private:
    static constexpr std::uint8_t k_front = 1;
    static constexpr std::uint8_t k_back = 2;
    static constexpr std::uint8_t k_inconsistent = 4;  // Never cleared.
    static constexpr std::uint32_t k_sweep = 32;

    // Those of 32 edges that have both flags.
    struct BothFlags {
        static std::uint32_t run(const std::uint8_t* flags);
    };

    const Mesh* mesh_;
    std::vector<SixteenPlanes> planes_;  // One a face.
    std::vector<std::array<std::uint32_t, 3>>
        places_;                               // Of a face's edges; the last place means no edge.
    std::vector<std::uint8_t> flags_;          // One a place, padded.
    std::vector<EdgeId> edges_;                // One a place.
    std::vector<std::uint32_t> inconsistent_;  // Places.
    KernelPointer<FrontOfSixteen> front_;
    KernelPointer<BothFlags> both_flags_;
};

}  // namespace rimline
