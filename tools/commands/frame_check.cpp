#include "tools/commands/frame_check.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "silhouette/mesh/brute_force.h"

namespace rimline::tools {

namespace {

template <typename Id>
std::vector<Id> sorted(std::span<const Id> ids) {
    std::vector<Id> result(ids.begin(), ids.end());
    std::sort(result.begin(), result.end());
    return result;
}

std::vector<EdgeId> without(const std::vector<EdgeId>& a, const std::vector<EdgeId>& b) {
    std::vector<EdgeId> result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

std::vector<FaceId> turned_faces(std::span<const std::uint32_t> a,
                                 std::span<const std::uint32_t> b) {
    std::vector<FaceId> faces;
    for (std::uint32_t w = 0; w < a.size(); ++w)
        for (std::uint32_t bit = 0; bit < 32; ++bit)
            if (((a[w] ^ b[w]) >> bit & 1u) != 0) faces.push_back(FaceId{w * 32 + bit});
    return faces;
}

}  // namespace

FrameCheck::FrameCheck(const SilhouetteTracker& tracker)
    : tracker_(&tracker),
      slots_(tracker.silhouette().begin(), tracker.silhouette().end()),
      words_(tracker.face_words().begin(), tracker.face_words().end()),
      true_words_(brute_force_face_bits(tracker.mesh(), tracker.point())),
      true_edges_(brute_force_silhouette(tracker.mesh(), tracker.point())) {}

std::optional<std::string> FrameCheck::apply(const ChangeSet& change) {
    slots_.resize(change.silhouette_size, k_no_edge);
    for (const SlotWrite& write : change.slots) {
        if (write.slot >= slots_.size()) return "a slot write lies beyond the silhouette's size";
        slots_[write.slot] = write.edge;
    }
    for (const WordWrite& write : change.words) {
        if (write.word >= words_.size()) return "a word write lies beyond the face bits";
        words_[write.word] = write.bits;
    }
    return std::nullopt;
}

std::optional<std::string> FrameCheck::difference(const ChangeSet& change) {
    const std::vector<std::uint32_t> words_before = std::move(true_words_);
    const std::vector<EdgeId> edges_before = std::move(true_edges_);
    true_words_ = brute_force_face_bits(tracker_->mesh(), change.point);
    true_edges_ = brute_force_silhouette(tracker_->mesh(), change.point);

    if (!std::ranges::equal(tracker_->face_words(), true_words_)) return "the face bits differ";
    if (sorted(tracker_->silhouette()) != true_edges_) return "the silhouette differs";
    if (const auto problem = apply(change)) return problem;
    if (words_ != true_words_) return "the change set's words do not lead to the face bits";
    if (sorted(std::span<const EdgeId>(slots_)) != true_edges_)
        return "the change set's slots do not lead to the silhouette";
    if (sorted(change.flipped) != turned_faces(words_before, true_words_))
        return "the change set's flipped faces differ";
    if (sorted(change.added) != without(true_edges_, edges_before))
        return "the change set's added edges differ";
    if (sorted(change.removed) != without(edges_before, true_edges_))
        return "the change set's removed edges differ";
    return std::nullopt;
}

}  // namespace rimline::tools
