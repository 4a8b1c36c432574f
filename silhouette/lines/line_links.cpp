#include "silhouette/lines/line_links.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/lines/exact_signs.h"

namespace rimline {

namespace {

// Lines that bend by 120 degrees or more from each other are not one line where several meet: the greatest double
// below the cosine of the angle between them.
constexpr double k_max_cos_of_ways = 0x1.fffffffffffffp-2;
constexpr std::uint64_t k_way_pairs_a_checkpoint = 1u << 20;

}  // namespace

void LineLinks::link(LineEnd a, LineEnd b) noexcept {
    next_[a] = b;
    next_[b] = a;
}

void LineLinks::find(const LineFrame& frame, SmoothNormals& normals, const std::stop_token& stop) {
    std::uint64_t last_pairs = straightest_.pairs();
    next_.assign(2 * frame.lines.size(), k_no_end);
    const std::size_t nodes = frame.end_begin.size() - 1;
    const auto is_drawn = [&](LineEnd end) { return frame.lines[end / 2].is_drawn; };
    const auto kind_of = [&](LineEnd end) { return frame.lines[end / 2].kind; };
    for (std::uint32_t node = 0; node < nodes; ++node) {
        if (straightest_.pairs() - last_pairs >= k_way_pairs_a_checkpoint) {
            LongCall{stop, {}}.checkpoint(0.0);
            last_pairs = straightest_.pairs();
        }
        const std::span<const LineEnd> ends = frame.ends_at(node);
        if (ends.size() == 2) {  // As most have.
            if (is_drawn(ends[0]) && is_drawn(ends[1]) && kind_of(ends[0]) == kind_of(ends[1]))
                link(ends[0], ends[1]);
            continue;
        }
        for (std::uint32_t k = 0; k < k_line_kinds; ++k) {
            const auto kind = static_cast<LineKind>(k);
            ends_.clear();
            for (const LineEnd end : ends)
                if (is_drawn(end) && kind_of(end) == kind) ends_.push_back(end);
            if (ends_.size() == 2)
                link(ends_[0], ends_[1]);
            else if (ends_.size() > 2 &&
                     !(kind == LineKind::silhouette &&
                       link_around_sectors(frame, frame.node_vertices[node], normals)))
                link_best(frame);
        }
    }
}

// Returns whether the vertex has one closed fan of faces, and around it fronts and backs between the silhouettes in
// turn. Else it links nothing.
bool LineLinks::link_around_sectors(const LineFrame& frame, std::uint32_t vertex,
                                    SmoothNormals& normals) {
    const std::span<const VertexStars::Link> links = frame.surface->stars().links(vertex);
    const std::size_t count = links.size();
    for (std::size_t i = 0; i < count; ++i)
        if (links[i][1] != links[(i + 1) % count][0]) return false;
    ring_.assign(count, k_no_end);
    for (const LineEnd end : ends_) {
        const std::uint32_t other = frame.lines[end / 2].vertices[1 - end % 2];
        const auto starts_there = [&](const VertexStars::Link& link) { return link[0] == other; };
        const auto found = std::ranges::find_if(links, starts_there);
        if (found == links.end()) return false;
        ring_[static_cast<std::size_t>(found - links.begin())] = end;
    }
    const auto is_front = [&](const VertexStars::Link& link) {
        return seen_side(frame.view->point(), frame.position(vertex), frame.position(link[0]),
                         frame.position(link[1])) > 0;
    };
    std::size_t first = count;  // A silhouette after which the sector is to be linked around.
    const bool links_around_fronts = !(normals.facing(vertex) > 0.0);
    bool was_front = is_front(links.back());
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_now_front = is_front(links[i]);
        if ((is_now_front != was_front) != (ring_[i] != k_no_end)) return false;
        if (ring_[i] != k_no_end && is_now_front == links_around_fronts) first = i;
        was_front = is_now_front;
    }
    if (first == count) return false;
    LineEnd open = k_no_end;
    for (std::size_t k = 0; k < count; ++k) {
        const LineEnd end = ring_[(first + k) % count];
        if (end == k_no_end) continue;
        if (open != k_no_end) link(open, end);
        open = open == k_no_end ? end : k_no_end;
    }
    return true;
}

// Links pairs of ends_, the one that bends least first.
void LineLinks::link_best(const LineFrame& frame) {
    ways_.clear();
    for (const LineEnd end : ends_) {
        const FlatLine& flat = frame.flats[end / 2];
        const glm::dvec2 way = flat.ends[1 - end % 2] - flat.ends[end % 2];
        ways_.push_back(way / std::max(glm::length(way), 1e-300));
    }
    straightest_.each(std::span<const glm::dvec2>(ways_), k_max_cos_of_ways,
                      [&](std::size_t i, std::size_t j) { link(ends_[i], ends_[j]); });
}

}  // namespace rimline
