#pragma once

// What `--verify` compares in every frame, all against brute force:
//   the tracker's face bits and silhouette;
//   the slots and words of a consumer that knows the tracker only through its change sets;
//   the flipped faces and the joined and leaving edges, against the frame before.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/silhouette_tracker.h"

namespace rimline::tools {

class FrameCheck {
public:
    /// Takes over the tracker's state as a consumer does before its first change set. `tracker` must
    /// outlive it.
    explicit FrameCheck(const SilhouetteTracker& tracker);

    /// Call it after every move, with what the move returned. Nothing when all is equal, else what
    /// differs first. O(faces + edges).
    std::optional<std::string> difference(const ChangeSet& change);

private:
    std::optional<std::string> apply(const ChangeSet& change);

    const SilhouetteTracker* tracker_;
    // The consumer's copy.
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> words_;
    // The truth of the frame before.
    std::vector<std::uint32_t> true_words_;
    std::vector<EdgeId> true_edges_;
};

}  // namespace rimline::tools
