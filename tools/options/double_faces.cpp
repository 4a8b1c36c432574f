#include "tools/options/double_faces.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "silhouette/mesh/equal_positions.h"

namespace rimline::tools {

namespace {

// Keeps `per_face` values of each face that is kept.
template <typename T>
void keep_faces(std::vector<T>& values, std::size_t per_face, const std::vector<bool>& keeps) {
    if (values.empty()) return;
    std::size_t end = 0;
    for (std::size_t f = 0; f < keeps.size(); ++f)
        for (std::size_t i = 0; keeps[f] && i < per_face; ++i)
            values[end++] = values[f * per_face + i];
    values.resize(end);
}

}  // namespace

std::uint32_t remove_double_faces(MeshSource& source) {
    const std::vector<std::uint32_t> first = first_equal_positions<float>(source.positions);
    using Corners = std::array<std::uint32_t, 3>;
    std::vector<Corners> corners;
    corners.reserve(source.triangles.size());
    for (const auto& [a, b, c] : source.triangles) {
        corners.push_back({first[a], first[b], first[c]});
        std::ranges::sort(corners.back());
    }
    std::vector<std::uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, [&](std::uint32_t f, std::uint32_t g) {
        return corners[f] != corners[g] ? corners[f] < corners[g] : f < g;
    });
    std::vector<bool> keeps(corners.size(), true);
    std::uint32_t removed = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        const Corners& c = corners[order[i]];
        if (c != corners[order[i - 1]] || c[0] == c[1] || c[1] == c[2]) continue;
        keeps[order[i]] = false;
        ++removed;
    }
    if (removed == 0) return 0;
    keep_faces(source.triangles, 1, keeps);
    keep_faces(source.materials.of_face, 1, keeps);
    keep_faces(source.materials.corner_colors, 3, keeps);
    keep_faces(source.materials.corner_uvs, 3, keeps);
    return removed;
}

void draw_double_faces_once(const std::string& model, MeshSource& source) {
    const std::uint32_t doubles = remove_double_faces(source);
    if (doubles == 0) return;
    std::string warning = model + ": ";
    warning.append(std::to_string(doubles))
        .append(
            " faces lie on others, as those of sheets that are there twice: each is drawn once, "
            "both sides "
            "in the color of the first");
    source.warnings.push_back(std::move(warning));
}

}  // namespace rimline::tools
