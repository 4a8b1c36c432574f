#include "silhouette/lines/vertex_stars.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

namespace {

// Of a vertex with more faces the order stays as it is: sorting takes O(faces^2).
constexpr std::size_t k_max_sorted_links = 64;

}  // namespace

VertexStars::VertexStars(const Mesh& mesh, const LongCall& call)
    : begin_(mesh.vertex_count() + 1, 0) {
    call.checkpoint(0.0);
    const std::span<const Triangle> triangles = mesh.triangles();
    const auto has_star = [](const Triangle& t) {
        return t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    };
    for (const Triangle& t : triangles)
        if (has_star(t))
            for (const VertexId v : t) ++begin_[index(v) + 1];
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) begin_[v + 1] += begin_[v];
    links_.resize(begin_.back());
    faces_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = triangles[f];
        if (!has_star(t)) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t place = next[index(t[i])]++;
            links_[place] = {index(t[(i + 1) % 3]), index(t[(i + 2) % 3])};
            faces_[place] = f;
        }
    }
    call.checkpoint(0.5);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.vertex_count(), 4096),
                      [&](const auto& run) {
                          for (std::uint32_t v = run.begin(); v < run.end(); ++v) {
                              const std::uint32_t first = begin_[v], last = begin_[v + 1];
                              if (last - first > k_max_sorted_links) continue;
                              for (std::uint32_t i = first; i + 1 < last; ++i)
                                  for (std::uint32_t j = i + 1; j < last; ++j)
                                      if (links_[j][0] == links_[i][1]) {
                                          std::swap(links_[j], links_[i + 1]);
                                          std::swap(faces_[j], faces_[i + 1]);
                                          break;
                                      }
                          }
                      });
}

std::uint64_t VertexStars::size_bytes() const noexcept {
    return reserved_bytes(begin_, links_, faces_);
}

}  // namespace rimline
