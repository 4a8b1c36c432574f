#include "silhouette/hough/baselines/brute_force_methods.h"

#include <bit>

#include "silhouette/hough/baselines/brute_force.h"

namespace rimline {

void ScalarBruteForceMethod::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                                     TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    edges = brute_force_silhouette(*mesh_, point);
    counters.face_checks += mesh_->face_count();
    counters.edge_checks += mesh_->edge_count();
}

void PackedBruteForceMethod::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                                     TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.face_bits(point, words_);
    brute_force_.silhouette(words_, edges);
    counters.face_checks += mesh_->face_count();
    counters.edge_checks += mesh_->edges_of_class(EdgeClass::border).first;
}

void PackedBruteForceMethod::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                                    TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.face_bits(point, words_);
    counters.face_checks += mesh_->face_count();
    if (!followed_.has_started()) {
        followed_.start(words_, counters);
    } else {
        flipped_.clear();
        const std::span<const std::uint32_t> old_words = followed_.face_words();
        for (std::uint32_t w = 0; w < words_.size(); ++w)
            for (std::uint32_t turned = words_[w] ^ old_words[w]; turned != 0; turned &= turned - 1)
                flipped_.push_back(
                    FaceId{32 * w + static_cast<std::uint32_t>(std::countr_zero(turned))});
        followed_.turn(flipped_, counters);
    }
    edges.assign(followed_.edges().begin(), followed_.edges().end());
}

}  // namespace rimline
