#include "silhouette/lines/vertex_stars.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "silhouette/gradual_resize.h"
#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_faces_a_checkpoint = 1u << 16;

// Of a vertex with more faces the order stays as it is: sorting takes O(faces^2).
constexpr std::size_t k_max_sorted_links = 64;

}  // namespace

VertexStars::VertexStars(const Mesh& mesh, const LongCall& call) {
    call.checkpoint(0.0);
    const std::span<const Triangle> triangles = mesh.triangles();
    // Of those with a star at each corner.
    const auto for_each_face = [&](auto&& visit) {
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            if (f % k_faces_a_checkpoint == 0) LongCall{call.stop, {}}.checkpoint(0.0);
            const Triangle& t = triangles[f];
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) visit(f, t);
        }
    };
    resize_gradually(begin_, mesh.vertex_count() + std::size_t{1}, call.stop);
    for_each_face([&](std::uint32_t, const Triangle& t) {
        for (const VertexId v : t) ++begin_[index(v) + 1];
    });
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) begin_[v + 1] += begin_[v];
    resize_gradually(links_, begin_.back(), call.stop);
    resize_gradually(faces_, begin_.back(), call.stop);
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for_each_face([&](std::uint32_t f, const Triangle& t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t place = next[index(t[i])]++;
            links_[place] = {index(t[(i + 1) % 3]), index(t[(i + 2) % 3])};
            faces_[place] = f;
        }
    });
    call.checkpoint(0.5);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.vertex_count(), 4096),
                      [&](const auto& run) {
                          LongCall{call.stop, {}}.checkpoint(0.5);
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
