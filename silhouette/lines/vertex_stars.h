#pragma once

// The star of each vertex: its faces, and of each face the two other corners.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

class VertexStars {
public:
    /// The corners of a face after one of its corners v, in the face's direction.
    using Link = std::array<std::uint32_t, 2>;

    /// O(vertices + faces). Faces with two equal corners are in no star. Throws Error{cancelled}.
    explicit VertexStars(const Mesh& mesh, const LongCall& call = {});

    /// One link for each face at the vertex. Where the faces of a fan follow each other, so do their links, and
    /// the second corner of one is the first of the next.
    std::span<const Link> links(std::uint32_t vertex) const noexcept {
        return {links_.data() + begin_[vertex], links_.data() + begin_[vertex + 1]};
    }
    /// The faces of these links, in their order.
    std::span<const std::uint32_t> faces(std::uint32_t vertex) const noexcept {
        return {faces_.data() + begin_[vertex], faces_.data() + begin_[vertex + 1]};
    }
    /// Asks the cache for the links of a vertex.
    void fetch(std::uint32_t vertex) const noexcept {
        __builtin_prefetch(links_.data() + begin_[vertex]);
        __builtin_prefetch(links_.data() + begin_[vertex + 1] - 1);
    }
    std::uint64_t size_bytes() const noexcept;

private:
    std::vector<std::uint32_t> begin_;
    std::vector<Link> links_;
    std::vector<std::uint32_t> faces_;
};

}  // namespace rimline
