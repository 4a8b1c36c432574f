#pragma once

// What a consumer of change sets holds: slots and words, kept up to date by writes alone; and the
// checks that a change set says what happened, no more and no less.

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"

namespace rimline::tests {

template <typename Id>
std::vector<Id> sorted(std::span<const Id> ids) {
    std::vector<Id> result(ids.begin(), ids.end());
    std::sort(result.begin(), result.end());
    return result;
}

template <typename Id>
std::vector<Id> without(const std::vector<Id>& a, const std::vector<Id>& b) {
    std::vector<Id> result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

class ShadowConsumer {
public:
    explicit ShadowConsumer(const SilhouetteTracker& tracker)
        : sequence_(tracker.sequence()),
          slots_(tracker.silhouette().begin(), tracker.silhouette().end()),
          words_(tracker.face_words().begin(), tracker.face_words().end()) {}

    /// Fails the running test case unless `changes` leads from what is held to the tracker's state,
    /// and that is what brute force finds.
    void follow(const SilhouetteTracker& tracker, const ChangeSet& changes) {
        const Mesh& mesh = tracker.mesh();
        const std::vector<std::uint32_t> words = brute_force_face_bits(mesh, tracker.point());
        const std::vector<EdgeId> edges = brute_force_silhouette(mesh, tracker.point());
        const std::vector<EdgeId> old_edges = sorted(std::span<const EdgeId>(slots_));

        // The tracker.
        REQUIRE(std::ranges::equal(tracker.face_words(), words));
        REQUIRE(sorted(tracker.silhouette()) == edges);

        // The lists: comparing sorted copies with sets' differences finds duplicates too.
        REQUIRE(changes.point == tracker.point());
        REQUIRE(changes.sequence == ++sequence_);
        REQUIRE(tracker.sequence() == sequence_);
        REQUIRE(changes.silhouette_size == edges.size());
        REQUIRE(sorted(changes.flipped) == differing_faces(words));
        REQUIRE(sorted(changes.added) == without(edges, old_edges));
        REQUIRE(sorted(changes.removed) == without(old_edges, edges));

        // The writes: each place once, in use, and really changed. In reverse, as any order will do.
        const std::size_t old_size = slots_.size();
        slots_.resize(changes.silhouette_size);
        std::set<std::uint32_t> places;
        for (std::size_t i = changes.slots.size(); i-- > 0;) {
            const SlotWrite write = changes.slots[i];
            REQUIRE(write.slot < changes.silhouette_size);
            REQUIRE(places.insert(write.slot).second);
            REQUIRE((write.slot >= old_size || slots_[write.slot] != write.edge));
            slots_[write.slot] = write.edge;
        }
        places.clear();
        for (std::size_t i = changes.words.size(); i-- > 0;) {
            const WordWrite write = changes.words[i];
            REQUIRE(write.word < words_.size());
            REQUIRE(places.insert(write.word).second);
            REQUIRE(words_[write.word] != write.bits);
            words_[write.word] = write.bits;
        }
        REQUIRE(std::ranges::equal(tracker.silhouette(), slots_));
        REQUIRE(words_ == words);
        REQUIRE(changes.slots.size() <= changes.added.size() + changes.removed.size());
    }

private:
    std::vector<FaceId> differing_faces(const std::vector<std::uint32_t>& words) const {
        std::vector<FaceId> faces;
        for (std::uint32_t f = 0; f < 32 * words.size(); ++f)
            if (((words[f / 32] ^ words_[f / 32]) >> (f % 32) & 1u) != 0)
                faces.push_back(FaceId{f});
        return faces;
    }

    std::uint64_t sequence_;
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> words_;
};

}  // namespace rimline::tests
