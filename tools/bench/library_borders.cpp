#include "tools/bench/library_borders.h"

#include <array>
#include <nlohmann/json.hpp>

#include "tools/bench/library_borders_script.h"
#include "tools/bench/python_script.h"
#include "tools/progress.h"

namespace rimline::tools {

std::vector<LibraryBorders> library_borders(std::span<const glm::dvec3> positions,
                                            bool has_all_settings, const Context& context) {
    ScriptInput input;
    input.add(std::array<std::uint64_t, 2>{positions.size(), has_all_settings});
    input.add(std::vector<glm::vec3>(positions.begin(), positions.end()));
    if (!input.is_complete()) return {};
    Progress progress(context, "running Open3D and PCL");
    progress.call().checkpoint(0.0);
    const auto text = run_python(k_library_borders_script, input, context);
    const auto object = nlohmann::ordered_json::parse(text.value_or("{}"), nullptr, false);
    std::vector<LibraryBorders> borders;
    if (!object.is_object()) return borders;
    for (const auto& [method, numbers] : object.items()) {
        borders.push_back({method, std::vector<std::uint8_t>(positions.size(), 0)});
        for (const std::uint32_t number : numbers) borders.back().is_border.at(number) = 1;
    }
    return borders;
}

}  // namespace rimline::tools
