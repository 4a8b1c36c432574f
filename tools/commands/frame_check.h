#pragma once

// The comparison of `--verify`. In every frame it compares with brute force:
//   the face bits and the silhouette of the tracker;
//   the slots and words of a consumer that receives only change sets;
//   the flipped faces and the added and removed edges, computed from this frame and the one before.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/silhouette_tracker.h"

namespace rimline::tools {

class FrameCheck {
public:
    /// Copies the tracker's state, as a consumer does before its first change set. `tracker` must outlive
    /// this object.
    explicit FrameCheck(const SilhouetteTracker& tracker);

    /// Call it after every move with the change set of the move. Returns the first difference, or nothing if
    /// all is equal. O(faces + edges).
    std::optional<std::string> difference(const ChangeSet& change);

private:
    std::optional<std::string> apply(const ChangeSet& change);

    const SilhouetteTracker* tracker_;
    // The consumer's copy.
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> words_;
    // Brute-force results of the last frame.
    std::vector<std::uint32_t> true_words_;
    std::vector<EdgeId> true_edges_;
};

}  // namespace rimline::tools
