#pragma once

// A consumer of published change sets: holds slots and words, brings them up to date by writes alone,
// and compares with brute force. What is wrong is returned, not checked here, so that it can run on
// any thread.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/hough/service/published_change.h"
#include "silhouette/mesh/brute_force.h"

namespace rimline::tests {

template <typename Id>
std::vector<Id> ascending(std::span<const Id> ids) {
    std::vector<Id> result(ids.begin(), ids.end());
    std::sort(result.begin(), result.end());
    return result;
}

class Follower {
public:
    /// `mesh` must outlive the follower.
    explicit Follower(const Mesh& mesh) : mesh_(&mesh) {}

    /// Nothing when `snapshot` is what brute force finds from its point.
    std::optional<std::string> begin(const SilhouetteSnapshot& snapshot) {
        point_ = snapshot.point;
        sequence_ = snapshot.sequence;
        slots_ = snapshot.slots;
        words_ = snapshot.words;
        return difference();
    }

    /// Nothing when `changes` is the next change set and leads to what brute force finds.
    std::optional<std::string> follow(const ChangeSet& changes) {
        if (changes.sequence != sequence_ + 1)
            return "sequence " + std::to_string(changes.sequence) + " after " +
                   std::to_string(sequence_);
        const std::vector<EdgeId> old_edges = ascending<EdgeId>(slots_);
        const std::vector<std::uint32_t> old_words = words_;
        point_ = changes.point;
        sequence_ = changes.sequence;
        slots_.resize(changes.silhouette_size, k_no_edge);
        for (const SlotWrite& write : changes.slots) {
            if (write.slot >= slots_.size()) return "a write beyond the slots";
            slots_[write.slot] = write.edge;
        }
        for (const WordWrite& write : changes.words) {
            if (write.word >= words_.size()) return "a write beyond the words";
            words_[write.word] = write.bits;
        }
        if (const auto problem = difference()) return problem;

        const std::vector<EdgeId> edges = ascending<EdgeId>(slots_);
        if (ascending(changes.added) != without(edges, old_edges)) return "added edges";
        if (ascending(changes.removed) != without(old_edges, edges)) return "removed edges";
        std::vector<std::uint32_t> flips(words_.size(), 0);
        for (const FaceId face : changes.flipped) flips[index(face) / 32] ^= 1u << index(face) % 32;
        for (std::size_t w = 0; w < flips.size(); ++w)
            if (flips[w] != (old_words[w] ^ words_[w])) return "flipped faces";
        return std::nullopt;
    }

    const HomogeneousPoint& point() const { return point_; }
    std::uint64_t sequence() const { return sequence_; }

private:
    std::optional<std::string> difference() const {
        if (words_ != brute_force_face_bits(*mesh_, point_)) return "face words";
        if (ascending<EdgeId>(slots_) != brute_force_silhouette(*mesh_, point_))
            return "silhouette";
        return std::nullopt;
    }

    static std::vector<EdgeId> without(const std::vector<EdgeId>& a, const std::vector<EdgeId>& b) {
        std::vector<EdgeId> result;
        std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
        return result;
    }

    const Mesh* mesh_;
    HomogeneousPoint point_{};
    std::uint64_t sequence_ = 0;
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> words_;
};

}  // namespace rimline::tests
