#pragma once

// Which line of this frame is which of the last.
//
// An edge that stays on the silhouette keeps its line. An edge that joined takes the line of an edge that left
// across the patch of faces that flipped: only a change set knows it. Creases, borders and intersections stay where
// they are. So each line knows the chain that it, or what it came from, belonged to: its past chain. A chain takes
// the id of the past chain that most of its length belonged to. Of several chains that come from one past chain, the
// one with most of its length takes the id, and the others get ids that no chain had.
//
//          left                 the silhouette moves over a patch of faces, from the edges that left to those
//       .--------.              that joined. The edges that left label the faces beside them, and these label
//      /  patch   \             their neighbors, breadth first
//     .------------.
//         joined
//
// After Kalnins et al., Coherent Stylized Silhouettes (2003), who find the past of a silhouette by looking for it
// in the picture.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/lines/line_drawing.h"
#include "silhouette/lines/line_frame.h"

namespace rimline {

class LineIdentity {
public:
    /// Sets the ids of the drawing's chains. `chain_of_line`: the chain of each line of the frame, or k_no_chain.
    /// `changes` lead from the frame before, which this was called for, to this one; null if there is none: ids are
    /// indices then. O(lines log lines + flipped faces).
    void assign(const LineFrame& frame, std::span<const std::uint32_t> chain_of_line,
                const ChangeSet* changes, LineDrawing& drawing);

private:
    // A chain of the frame before, valid in the frame in the stamp.
    struct Stamped {
        std::uint32_t frame = 0, chain = k_no_chain;
    };
    struct PastLine {
        std::uint32_t source, chain;  // As ViewLine::source.
        bool is_intersection;
    };
    struct Vote {
        std::uint32_t chain, past_chain;
        double length;  // In the picture, of the lines of the chain that were in the past chain.
    };

    void find_past(const LineFrame& frame, const ChangeSet& changes);
    void place_past_lines(const LineFrame& frame);
    void label_flipped_faces(const Mesh& mesh, const ChangeSet& changes);
    std::uint32_t past_of(const Mesh& mesh, const ViewLine& line) const;
    void count_votes(const LineFrame& frame, std::span<const std::uint32_t> chain_of_line);

    std::uint32_t frame_number_ = 0, next_id_ = 0;
    std::vector<PastLine> past_lines_;  // Those with a chain.
    // By edge, by segment of an intersection, and by face that flipped. Empty before the first change set.
    std::vector<Stamped> edges_, segments_, faces_;
    std::vector<FaceId> queue_;
    std::vector<std::uint32_t> past_chains_;  // By line, or k_no_chain.
    std::vector<std::uint32_t> past_ids_;     // By chain of the frame before.
    std::vector<Vote> votes_;
    std::vector<std::uint8_t> is_taken_;  // By chain of the frame before.
};

}  // namespace rimline
