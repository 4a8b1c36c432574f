#include "tools/options/placed_model.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/lost_shape.h"
#include "tools/options/exact_text.h"
#include "tools/options/option_types.h"
#include "tools/options/up_option.h"

namespace rimline::tools {

namespace {

constexpr std::size_t k_max_joined_faces = std::size_t{1} << 30;

double parse_finite(const std::string& option, const std::string& text,
                    const std::string& expected) {
    double number = 0.0;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, number);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(number))
        throw CLI::ValidationError(option, "expected " + expected + ", not '" + text + "'");
    return number;
}

void append_positions(MeshSource& all, const PlacedSource& placed) {
    for (const glm::vec3& position : placed.source->positions) {
        const glm::dvec3 there = placed.at + placed.matrix * glm::dvec3(position);
        const double reach = std::max({std::abs(there.x), std::abs(there.y), std::abs(there.z)});
        if (reach > double{k_max_coordinate})
            throw Error(ErrorCode::too_large,
                        placed.name + ": its place is outside of the range of coordinates, 2^60");
        all.positions.emplace_back(there);
    }
    // The matrix turns and scales alike along all axes.
    const double detail = glm::length(placed.matrix[0]) *
                          detail_size(placed.source->positions, placed.source->triangles);
    if (floats_lose_shape(detail, glm::length(placed.at)))
        all.warnings.push_back(placed.name +
                               ": lies so far from the origin of the scene that "
                               "single precision loses its shape; place the models "
                               "nearer to the origin");
}

// The materials of all sources that are joined. Lists are filled up where sources without an entry follow each
// other.
class JoinedMaterials {
public:
    explicit JoinedMaterials(FaceMaterials& all) : all_(all) {}

    void append(const PlacedSource& placed, std::size_t faces_before) {
        const FaceMaterials& own = placed.source->materials;
        const std::size_t faces = placed.source->triangles.size();
        const bool has_own = !placed.paint && !own.empty();
        if (!placed.paint && !has_own) return;
        all_.of_face.resize(faces_before, k_no_material);
        if (placed.paint) {
            all_.of_face.resize(faces_before + faces, paint(*placed.paint));
            return;
        }
        const Offsets offsets = offsets_of(placed.source);
        for (const MaterialId material : own.of_face)
            all_.of_face.push_back(material == k_no_material
                                       ? material
                                       : MaterialId{offsets.material + index(material)});
        append_corners(all_.corner_colors, own.corner_colors, faces_before, glm::vec3(1.0f));
        append_corners(all_.corner_uvs, own.corner_uvs, faces_before, glm::vec2(0.0f));
    }

    /// Called once, after the last append().
    void end(std::size_t faces) {
        if (all_.of_face.empty()) return;
        all_.of_face.resize(faces, k_no_material);
        if (!all_.corner_colors.empty()) all_.corner_colors.resize(3 * faces, glm::vec3(1.0f));
        if (!all_.corner_uvs.empty()) all_.corner_uvs.resize(3 * faces, glm::vec2(0.0f));
    }

private:
    struct Offsets {
        const MeshSource* source;
        std::uint32_t material;
    };

    template <typename Value>
    static void append_corners(std::vector<Value>& all, const std::vector<Value>& own,
                               std::size_t faces_before, const Value& none) {
        if (own.empty()) return;
        all.resize(3 * faces_before, none);
        all.insert(all.end(), own.begin(), own.end());
    }

    // Appends the materials and textures of the source when it occurs first.
    Offsets offsets_of(const MeshSource* source) {
        const auto known = std::ranges::find(offsets_, source, &Offsets::source);
        if (known != offsets_.end()) return *known;
        const auto texture = static_cast<std::uint32_t>(all_.textures.size());
        offsets_.push_back({source, static_cast<std::uint32_t>(all_.materials.size())});
        for (SurfaceMaterial material : source->materials.materials) {
            if (material.texture != k_no_texture)
                material.texture = TextureId{texture + index(material.texture)};
            all_.materials.push_back(material);
        }
        all_.textures.insert(all_.textures.end(), source->materials.textures.begin(),
                             source->materials.textures.end());
        return offsets_.back();
    }

    MaterialId paint(const glm::vec3& color) {
        const SurfaceMaterial painted{.base_color = color};
        const auto known = std::ranges::find(all_.materials, painted);
        const auto at = static_cast<std::uint32_t>(known - all_.materials.begin());
        if (known == all_.materials.end()) all_.materials.push_back(painted);
        return MaterialId{at};
    }

    FaceMaterials& all_;
    std::vector<Offsets> offsets_;
};

}  // namespace

Turn parse_turn(const std::string& option, const std::string& text) {
    const std::string expected = "DEGREES, AXIS,DEGREES or X,Y,Z,DEGREES";
    const std::size_t comma = text.rfind(',');
    const std::size_t begin = comma == std::string::npos ? 0 : comma + 1;
    Turn turn{.axis = {}, .degrees = parse_finite(option, text.substr(begin), expected)};
    if (std::abs(turn.degrees) > 360.0)
        throw CLI::ValidationError(
            option, "expected at most 360 degrees, not '" + text.substr(begin) + "'");
    if (comma == std::string::npos) return turn;
    const std::string name = text.substr(0, comma);
    const auto commas = std::ranges::count(name, ',');
    if (name == "auto" || (commas != 0 && commas != 2))
        throw CLI::ValidationError(option, "expected " + expected + ", not '" + text + "'");
    turn.axis = parse_up(option, name);
    return turn;
}

double parse_scale(const std::string& option, const std::string& text) {
    const std::string expected = "a number from 0.000001 to 1000000";
    const double scale = parse_finite(option, text, expected);
    if (!(scale >= k_min_scale && scale <= k_max_scale))
        throw CLI::ValidationError(option, "expected " + expected + ", not '" + text + "'");
    return scale;
}

UpChoice parse_up_choice(const std::string& option, const std::string& text) {
    if (text == "auto") return {};
    return {parse_up(option, text)};
}

std::string text_of(const Turn& turn) {
    const std::string degrees = exact_text(turn.degrees);
    return turn.axis ? vector_text(*turn.axis) + "," + degrees : degrees;
}

std::string text_of(const UpChoice& up) {
    return up.direction ? vector_text(*up.direction) : "auto";
}

glm::dmat3 rotation_between(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 a = glm::normalize(from), b = glm::normalize(to);
    const double cosine = glm::dot(a, b);
    if (cosine < -1.0 + 1e-12) {
        // Half a turn about any axis across it.
        const glm::dvec3 axis = any_perpendicular(a);
        return 2.0 * glm::outerProduct(axis, axis) - glm::dmat3(1.0);
    }
    // Rodrigues: 1 + [v] + [v]^2 / (1 + cosine) with v = a x b.
    const glm::dvec3 v = glm::cross(a, b);
    const glm::dmat3 cross(0.0, v.z, -v.y, -v.z, 0.0, v.x, v.y, -v.x, 0.0);
    return glm::dmat3(1.0) + cross + cross * cross * (1.0 / (1.0 + cosine));
}

MeshSource join_sources(std::span<const PlacedSource> sources) {
    MeshSource all;
    const bool have_codes = std::ranges::all_of(
        sources, [](const PlacedSource& placed) { return !placed.source->edge_codes.empty(); });
    JoinedMaterials materials(all.materials);
    if (!sources.empty()) {
        all.up = sources.front().source->up;
        all.is_up_known = sources.front().source->is_up_known;
    }
    std::size_t positions = 0, faces = 0;
    for (const PlacedSource& placed : sources) {
        positions += placed.source->positions.size();
        faces += placed.source->triangles.size();
    }
    // What is more is refused below.
    all.positions.reserve(
        std::min<std::size_t>(positions, std::numeric_limits<std::uint32_t>::max()));
    all.triangles.reserve(std::min(faces, k_max_joined_faces));
    for (const PlacedSource& placed : sources) {
        const MeshSource& source = *placed.source;
        const std::size_t faces_before = all.triangles.size();
        if (faces_before + source.triangles.size() > k_max_joined_faces ||
            all.positions.size() + source.positions.size() >
                std::numeric_limits<std::uint32_t>::max())
            throw Error(ErrorCode::too_large,
                        placed.name + ": with the models before it, there are too many faces");
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        append_positions(all, placed);
        for (const auto& [a, b, c] : source.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
        if (have_codes)
            all.edge_codes.insert(all.edge_codes.end(), source.edge_codes.begin(),
                                  source.edge_codes.end());
        materials.append(placed, faces_before);
        for (const std::string& warning : source.warnings)
            if (std::ranges::find(all.warnings, warning) == all.warnings.end())
                all.warnings.push_back(warning);
    }
    materials.end(all.triangles.size());
    return all;
}

}  // namespace rimline::tools
