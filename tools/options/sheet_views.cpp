#include "tools/options/sheet_views.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <string_view>

#include "silhouette/mesh/ground_axes.h"
#include "tools/options/name_list.h"

namespace rimline::tools {

namespace {

// By SheetView.
constexpr std::array<std::string_view, 7> k_sheet_view_names{"front", "top",    "right", "iso",
                                                             "left",  "bottom", "back"};
constexpr std::array<SheetCell, 7> k_sheet_cells{
    {{1, 1}, {1, 0}, {2, 1}, {2, 0}, {0, 1}, {1, 2}, {3, 1}}};

}  // namespace

SheetCell cell_of(SheetView view) noexcept { return k_sheet_cells[std::size_t(view)]; }

CLI::Option* add_sheet_views(CLI::App& app, std::vector<SheetView>& views) {
    return add_name_list(
        app, "--views", k_sheet_view_names,
        [&views](const std::vector<std::size_t>& numbers) {
            views.clear();
            for (const std::size_t n : numbers) views.push_back(static_cast<SheetView>(n));
        },
        "Draw a sheet of orthographic views with one scale, in third-angle "
        "projection: some of");
}

LineCamera sheet_camera(SheetView view, const Mesh& mesh, const glm::dvec3& up) {
    const glm::dvec3 upward = glm::normalize(up);
    const auto [right, back] = ground_axes(up);
    glm::dvec3 towards_viewer = -back, up_in_picture = upward;
    switch (view) {
        case SheetView::front: break;
        case SheetView::back: towards_viewer = back; break;
        case SheetView::right: towards_viewer = right; break;
        case SheetView::left: towards_viewer = -right; break;
        case SheetView::iso: towards_viewer = glm::normalize(right - back + upward); break;
        case SheetView::top:
            towards_viewer = upward;
            up_in_picture = back;
            break;
        case SheetView::bottom:
            towards_viewer = -upward;
            up_in_picture = -back;
            break;
    }
    const glm::dvec3 target = mesh.center();
    const glm::dvec3 eye = target + 3.0 * mesh.radius() * towards_viewer;
    return {.name = std::string(k_sheet_view_names[std::size_t(view)]),
            .view = LineView::orthographic(eye, target, up_in_picture),
            .eye = eye,
            .target = target,
            .up = up_in_picture,
            .half_height = mesh.radius(),
            .is_framed = false};
}

}  // namespace rimline::tools
