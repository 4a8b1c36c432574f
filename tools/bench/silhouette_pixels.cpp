#include "tools/bench/silhouette_pixels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/creases.h"
#include "tools/bench/line_pieces.h"

namespace rimline::tools {

namespace {

constexpr double k_places_per_pixel = 4.0;
constexpr float k_crease_rad =
    static_cast<float>(k_counted_crease_degrees * std::numbers::pi / 180.0);

class TruePixelFinder {
public:
    TruePixelFinder(const Mesh& mesh, const PieceRays& rays, const Camera& camera,
                    std::uint32_t width, std::uint32_t height)
        : mesh_(mesh),
          rays_(rays),
          view_(LineView::perspective(camera.eye, camera.target, camera.up)),
          size_(width, height),
          pixels_per_unit_(0.5 * height / std::tan(glm::radians(0.5 * camera.fov_y_deg))) {}

    const HomogeneousPoint& point() const { return view_.point(); }

    void mark(EdgeId edge, PixelMask& mask) {
        const auto& vertices = mesh_.edge(edge).vertices;
        const glm::dvec3 a(mesh_.positions()[index(vertices[0])]);
        const glm::dvec3 b(mesh_.positions()[index(vertices[1])]);
        const double length = glm::distance(pixel_of(a), pixel_of(b));
        const auto count = static_cast<std::uint32_t>(std::ceil(k_places_per_pixel * length)) + 1;
        places_.clear();
        for (std::uint32_t i = 0; i < count; ++i)
            places_.push_back({.middle = glm::mix(a, b, (i + 0.5) / count),
                               .vertices = vertices,
                               .length = 0.0,
                               .is_hidden = false});
        rays_.find_hidden(view_, places_, RayWay::own_faces, is_hidden_);
        for (std::uint32_t i = 0; i < count; ++i)
            if (is_hidden_[i] == 0) mark(pixel_of(places_[i].middle), mask);
    }

private:
    glm::dvec2 pixel_of(const glm::dvec3& point) const {
        const glm::dvec2 position = view_.project(point).position;
        return 0.5 * size_ + pixels_per_unit_ * glm::dvec2(position.x, -position.y);
    }

    static void mark(const glm::dvec2& place, PixelMask& mask) {
        if (!(place.x >= 0.0 && place.y >= 0.0 && place.x < mask.width && place.y < mask.height))
            return;
        const auto x = static_cast<std::size_t>(place.x);
        const auto y = static_cast<std::size_t>(place.y);
        mask.at[y * mask.width + x] = 1;
    }

    const Mesh& mesh_;
    const PieceRays& rays_;
    LineView view_;
    glm::dvec2 size_;
    double pixels_per_unit_;  // Of picture coordinates.
    std::vector<LinePiece> places_;
    std::vector<std::uint8_t> is_hidden_;
};

// Widens along rows or columns: `count` lines of `length` pixels, `step` apart.
void widen(std::vector<std::uint8_t>& at, std::size_t count, std::size_t next, std::size_t length,
           std::size_t step, int reach) {
    std::vector<std::uint8_t> line(length);
    for (std::size_t l = 0; l < count; ++l) {
        std::uint8_t* const first = at.data() + l * next;
        std::fill(line.begin(), line.end(), std::uint8_t{0});
        for (std::size_t i = 0; i < length; ++i) {
            if (first[i * step] == 0) continue;
            const auto side = static_cast<std::size_t>(reach);
            const std::size_t begin = i < side ? 0 : i - side;
            const std::size_t end = std::min(length, i + side + 1);
            std::fill(line.begin() + std::ptrdiff_t(begin), line.begin() + std::ptrdiff_t(end),
                      std::uint8_t{1});
        }
        for (std::size_t i = 0; i < length; ++i) first[i * step] = line[i];
    }
}

}  // namespace

std::uint64_t PixelMask::count() const {
    return std::accumulate(at.begin(), at.end(), std::uint64_t{0});
}

PixelMask PixelMask::widened(int reach) const {
    PixelMask wide = *this;
    widen(wide.at, height, width, width, 1, reach);
    widen(wide.at, width, 1, height, width, reach);
    return wide;
}

TruePixels::TruePixels(PixelMask of_silhouettes, PixelMask of_borders, PixelMask of_creases)
    : silhouettes(std::move(of_silhouettes)),
      borders(std::move(of_borders)),
      creases(std::move(of_creases)),
      near_silhouettes(silhouettes.widened(k_compared_width_px)),
      near_borders(borders.widened(k_compared_width_px)),
      near_creases(creases.widened(k_compared_width_px)) {}

TruePixels find_true_pixels(const Mesh& mesh, const PieceRays& rays, const Camera& camera,
                            std::uint32_t width, std::uint32_t height) {
    TruePixelFinder finder(mesh, rays, camera, width, height);
    PixelMask silhouettes(width, height), sharp(width, height), open(width, height);
    for (const EdgeId edge : brute_force_silhouette(mesh, finder.point()))
        finder.mark(edge, silhouettes);
    const auto borders = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t i = 0; i < borders.size(); ++i) finder.mark(EdgeId{borders.first + i}, open);
    for (const Crease& crease : find_creases(mesh, k_crease_rad)) finder.mark(crease.edge, sharp);
    return {std::move(silhouettes), std::move(open), std::move(sharp)};
}

OutlineHits& OutlineHits::operator+=(const OutlineHits& other) noexcept {
    truth += other.truth;
    missed += other.missed;
    marked += other.marked;
    borders += other.borders;
    creases += other.creases;
    extra += other.extra;
    return *this;
}

OutlineHits count_hits(const TruePixels& truth, const PixelMask& marked) {
    const PixelMask found = marked.widened(1);
    OutlineHits hits;
    for (std::size_t i = 0; i < marked.at.size(); ++i) {
        hits.truth += truth.silhouettes.at[i];
        hits.missed += truth.silhouettes.at[i] & (found.at[i] ^ 1u);
        if (marked.at[i] == 0) continue;
        ++hits.marked;
        if (truth.near_silhouettes.at[i] != 0) continue;
        if (truth.near_borders.at[i] != 0)
            ++hits.borders;
        else if (truth.near_creases.at[i] != 0)
            ++hits.creases;
        else
            ++hits.extra;
    }
    return hits;
}

}  // namespace rimline::tools
