#include "silhouette/mesh/shapes/built_in_shape.h"

#include <algorithm>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/shapes/shape_makers.h"

namespace rimline {

namespace {

struct Maker {
    std::string_view name;
    std::uint32_t default_faces;
    MeshSource (*make)(std::uint32_t faces);
};

MeshSource make_default_torus(std::uint32_t faces) { return make_torus(faces, 1.0, 0.4); }

constexpr std::array<Maker, 7> k_makers{{{"sphere", 20'480, make_sphere},
                                         {"torus", 20'000, make_default_torus},
                                         {"knot", 40'000, make_knot},
                                         {"box", 12, make_box},
                                         {"spring", 40'000, make_spring},
                                         {"terrain", 80'000, make_terrain},
                                         {"scene", 40'000, make_scene}}};

}  // namespace

MeshSource make_built_in_shape(std::string_view name, std::uint32_t faces) {
    const auto maker = std::find_if(k_makers.begin(), k_makers.end(),
                                    [&](const Maker& m) { return m.name == name; });
    RIMLINE_CHECK(maker != k_makers.end());
    if (faces > 1u << 28)
        throw Error(ErrorCode::too_large, "shape:" + std::string(name) + ": " +
                                              std::to_string(faces) +
                                              " faces asked for; at most 268435456 are made");
    MeshSource source = maker->make(faces == 0 ? maker->default_faces : faces);
    source.is_up_known = true;
    return source;
}

}  // namespace rimline
