#include "silhouette/lines/line_identity.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace rimline {

void LineIdentity::find_past(const LineFrame& frame, const ChangeSet& changes) {
    const Mesh& mesh = frame.surface->mesh();
    ++frame_number_;
    place_past_lines(frame);
    label_flipped_faces(mesh, changes);
    past_chains_.clear();
    for (const ViewLine& line : frame.lines) past_chains_.push_back(past_of(mesh, line));
}

void LineIdentity::place_past_lines(const LineFrame& frame) {
    edges_.resize(frame.surface->mesh().edge_count());
    segments_.resize(frame.surface->curves().segments().size());
    for (const auto& [source, chain, is_intersection] : past_lines_)
        (is_intersection ? segments_ : edges_)[source] = {frame_number_, chain};
}

// The nearest edge that left, by the number of faces between, labels a face of a patch.
void LineIdentity::label_flipped_faces(const Mesh& mesh, const ChangeSet& changes) {
    faces_.resize(mesh.face_count());
    for (const FaceId face : changes.flipped) faces_[index(face)] = {frame_number_, k_no_chain};
    queue_.clear();
    const auto label_faces_of = [&](EdgeId edge, std::uint32_t chain) {
        for (const FaceId face : mesh.faces_of(edge)) {
            Stamped& label = faces_[index(face)];
            if (label.frame != frame_number_ || label.chain != k_no_chain) continue;
            label.chain = chain;
            queue_.push_back(face);
        }
    };
    for (const EdgeId edge : changes.removed) {
        const Stamped& past = edges_[index(edge)];
        if (past.frame == frame_number_) label_faces_of(edge, past.chain);
    }
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        const FaceId face = queue_[i];
        for (const EdgeId edge : mesh.edges_of(face))
            if (edge != k_no_edge) label_faces_of(edge, faces_[index(face)].chain);
    }
}

std::uint32_t LineIdentity::past_of(const Mesh& mesh, const ViewLine& line) const {
    const Stamped& past = line.is_intersection() ? segments_[line.source] : edges_[line.source];
    if (past.frame == frame_number_) return past.chain;
    if (line.is_intersection()) return k_no_chain;
    for (const FaceId face : mesh.faces_of(EdgeId{line.source}))
        if (faces_[index(face)].frame == frame_number_) return faces_[index(face)].chain;
    return k_no_chain;
}

// One vote for each pair of a chain and a past chain, the greatest first.
void LineIdentity::count_votes(const LineFrame& frame,
                               std::span<const std::uint32_t> chain_of_line) {
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i) {
        if (chain_of_line[i] == k_no_chain || past_chains_[i] == k_no_chain) continue;
        const auto& [a, b] = frame.flats[i].ends;
        votes_.push_back({chain_of_line[i], past_chains_[i], glm::distance(a, b)});
    }
    const auto by_pair = [](const Vote& a, const Vote& b) {
        return a.chain != b.chain ? a.chain < b.chain : a.past_chain < b.past_chain;
    };
    std::ranges::sort(votes_, by_pair);
    std::size_t kept = 0;
    for (const Vote& vote : votes_)
        if (kept > 0 && !by_pair(votes_[kept - 1], vote))
            votes_[kept - 1].length += vote.length;
        else
            votes_[kept++] = vote;
    votes_.resize(kept);
    std::ranges::sort(votes_, [&](const Vote& a, const Vote& b) {
        return a.length != b.length ? a.length > b.length : by_pair(a, b);
    });
}

void LineIdentity::assign(const LineFrame& frame, std::span<const std::uint32_t> chain_of_line,
                          const ChangeSet* changes, LineDrawing& drawing) {
    constexpr std::uint32_t k_no_id = 0xffffffffu;
    votes_.clear();
    if (changes != nullptr) {
        find_past(frame, *changes);
        count_votes(frame, chain_of_line);
    } else {
        next_id_ = 0;
    }
    for (LineChain& chain : drawing.chains) chain.id = k_no_id;
    is_taken_.assign(past_ids_.size(), 0);
    for (const Vote& vote : votes_) {
        LineChain& chain = drawing.chains[vote.chain];
        if (chain.id != k_no_id || is_taken_[vote.past_chain] != 0) continue;
        chain.id = past_ids_[vote.past_chain];
        is_taken_[vote.past_chain] = 1;
    }
    past_ids_.clear();
    for (LineChain& chain : drawing.chains) {
        if (chain.id == k_no_id) chain.id = next_id_++;
        past_ids_.push_back(chain.id);
    }
    past_lines_.clear();
    for (std::uint32_t i = 0; i < frame.lines.size(); ++i)
        if (chain_of_line[i] != k_no_chain)
            past_lines_.push_back(
                {frame.lines[i].source, chain_of_line[i], frame.lines[i].is_intersection()});
}

}  // namespace rimline
