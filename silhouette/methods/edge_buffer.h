#pragma once

// The edge buffer: faces tell their edges how they face, and edges that were told both are drawn.
//
// J. Buchanan, M. Sousa, The edge buffer: a data structure for easy silhouette rendering, NPAR 2000.
// Each vertex has a list of the edges to vertices with greater numbers, each with a front and a back
// flag. A pass over the faces sets the flags of their edges, a pass over the lists draws the edges that
// have both and clears them. A face is tested once, not once an edge, and no edge knows its faces.
//
// As flags are set, not toggled, an edge with three or more faces is on the silhouette when it has both
// as well; a border never has. One whose two faces run it the same way is on the silhouette when it has
// one only, and is looked at before the lists are cleared. The lists lie end to end in one array, flags
// apart from ids, and a face keeps the places of its three edges instead of searching for them.

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

    // Of 32 edges, those told both.
    struct ToldBoth {
        static std::uint32_t run(const std::uint8_t* flags);
    };

    const Mesh* mesh_;
    std::vector<SixteenPlanes> planes_;  // By face.
    std::vector<std::array<std::uint32_t, 3>>
        places_;                               // Of a face's edges; the last place is for none.
    std::vector<std::uint8_t> flags_;          // By place, padded.
    std::vector<EdgeId> edges_;                // By place.
    std::vector<std::uint32_t> inconsistent_;  // Places.
    KernelPointer<FrontOfSixteen> front_;
    KernelPointer<ToldBoth> told_both_;
};

}  // namespace rimline
