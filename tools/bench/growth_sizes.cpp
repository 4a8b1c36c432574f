#include "tools/bench/growth_sizes.h"

#include "tools/options/model_argument.h"

namespace rimline::tools {

std::vector<GrowthSize> growth_sizes(const std::string& model, std::uint32_t min_faces,
                                     std::uint32_t max_faces, const Context& context) {
    std::vector<GrowthSize> sizes;
    if (is_built_in_shape(model)) {
        const std::string shape = model.substr(0, model.find(':', model.find(':') + 1));
        for (std::uint64_t decade = 1; decade <= max_faces; decade *= 10)
            for (const std::uint64_t faces : {decade, 3 * decade})
                if (faces >= min_faces && faces <= max_faces)
                    sizes.push_back({shape + ":" + std::to_string(faces), 0});
    } else {
        const std::uint64_t faces =
            load_model(model, 0, FaceRequirement::faces, context).triangles.size();
        std::uint32_t subdivide = 0;
        for (std::uint64_t n = faces; n <= max_faces; n *= 4, ++subdivide)
            if (n >= min_faces) sizes.push_back({model, subdivide});
    }
    if (sizes.empty())
        throw UsageError("--growth: " + model + " has no size from " + std::to_string(min_faces) +
                         " to " + std::to_string(max_faces) + " faces");
    return sizes;
}

}  // namespace rimline::tools
