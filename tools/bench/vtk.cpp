#include "tools/bench/vtk.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/bench/python_script.h"
#include "tools/bench/vtk_silhouette_script.h"
#include "tools/progress.h"

namespace rimline::tools {

VtkResult time_vtk(const Mesh& mesh, std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                   const Context& context) {
    VtkResult result;
    std::vector<double> viewpoints;
    for (const HomogeneousPoint& point : points)
        viewpoints.insert(viewpoints.end(), {double{point.x}, double{point.y}, double{point.z}});
    ScriptInput input;
    input.add(std::array<std::uint64_t, 4>{mesh.vertex_count(), mesh.face_count(), points.size(),
                                           rounds});
    input.add(mesh.positions());
    input.add(mesh.triangles());
    input.add(viewpoints);
    if (!input.is_complete()) {
        result.skipped = "no temporary file for it";
        return result;
    }
    Progress progress(context, "running VTK");
    progress.call().checkpoint(0.0);
    const std::optional<std::string> text = run_python(k_vtk_silhouette_script, input, context);
    const auto object = nlohmann::json::parse(text.value_or(""), nullptr, false);
    if (object.is_discarded() || !object.contains("us") || object["us"].size() != points.size()) {
        result.skipped = "no python3 that imports VTK 9 (Debian: python3-vtk9)";
        return result;
    }
    result.version = object["version"];
    result.us = object["us"].get<std::vector<double>>();
    for (const double lines : object["lines"])
        result.mean_lines += lines / static_cast<double>(points.size());
    return result;
}

}  // namespace rimline::tools
