#include "tools/options/double_faces.h"

#include <algorithm>
#include <array>
#include <bit>
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
    const auto corners_of = [&](std::size_t face) {
        const auto& [a, b, c] = source.triangles[face];
        Corners corners{first[a], first[b], first[c]};
        std::ranges::sort(corners);
        return corners;
    };
    // Open addressing, at most half full.
    constexpr std::uint32_t k_free = 0xffffffffu;
    const std::size_t capacity = std::bit_ceil(2 * source.triangles.size() + 1);
    std::vector<std::uint32_t> table(capacity, k_free);
    std::vector<bool> keeps(source.triangles.size(), true);
    std::uint32_t removed = 0;
    for (std::uint32_t face = 0; face < source.triangles.size(); ++face) {
        const Corners corners = corners_of(face);
        if (corners[0] == corners[1] || corners[1] == corners[2]) continue;
        std::uint64_t hash = 0;
        for (const std::uint32_t corner : corners)
            hash = std::rotl((hash ^ corner) * 0x9e3779b97f4a7c15u, 29);
        std::size_t slot = hash & (capacity - 1);
        while (table[slot] != k_free && corners_of(table[slot]) != corners)
            slot = (slot + 1) & (capacity - 1);
        if (table[slot] == k_free) {
            table[slot] = face;
        } else {
            keeps[face] = false;
            ++removed;
        }
    }
    if (removed == 0) return 0;
    keep_faces(source.triangles, 1, keeps);
    keep_faces(source.edge_codes, 1, keeps);
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
