#include "tools/bench/other_lines.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/bench/blender_lines_script.h"
#include "tools/bench/python_script.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// OCCT hides all edges of a mesh: half a minute for the bunny.
constexpr std::uint32_t k_max_occt_faces = 100'000;
constexpr const char* k_occt_program = "rimline_occt_lines";
constexpr const char* k_answer = "RIMLINE ";

// A mesh and a camera, as blender_lines.py describes them.
void add_view(const Mesh& mesh, const LineView& view, ScriptInput& input) {
    input.add(std::array<std::uint64_t, 2>{mesh.vertex_count(), mesh.face_count()});
    input.add(mesh.positions());
    input.add(mesh.triangles());
    double tangent = 0.0;
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec2 seen = view.project_from_point(glm::dvec3(position)).position;
        tangent = std::max({tangent, std::abs(seen.x), std::abs(seen.y)});
    }
    for (const glm::dvec3& v :
         {glm::dvec3(view.point().xyz()), view.right(), view.up(), view.forward()})
        input.add(std::array<double, 3>{v.x, v.y, v.z});
    input.add(std::array<double, 1>{1.05 * tangent});
}

// The methods of the line of a program's output that begins with k_answer. None where there is no such line.
std::vector<OtherLines> read_answer(const std::string& text) {
    std::vector<OtherLines> all;
    const std::size_t begin = text.find(k_answer);
    if (begin == std::string::npos) return all;
    const std::size_t first = begin + std::string_view(k_answer).size();
    const auto object = nlohmann::ordered_json::parse(
        text.substr(first, text.find('\n', first) - first), nullptr, false);
    if (!object.is_object()) return all;
    for (const auto& [name, found] : object["methods"].items()) {
        OtherLines& lines = all.emplace_back();
        lines.method = name + " " + object["version"].get<std::string>();
        lines.ms = found["ms"];
        for (const auto& s : found["segments"])
            lines.segments.push_back(
                {{glm::vec3(s[0], s[1], s[2]), glm::vec3(s[3], s[4], s[5])}, s[6].get<int>() != 0});
    }
    return all;
}

std::string beside_this_program(const char* name) {
    std::error_code ignored;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const auto path = self.parent_path() / name;
    return std::filesystem::exists(path, ignored) ? path.string() : name;
}

double distance_between(const glm::dvec3& point, const OtherSegment& segment) {
    const glm::dvec3 from(segment.ends[0]), along = glm::dvec3(segment.ends[1]) - from;
    const double square = glm::dot(along, along);
    const double share =
        square > 0.0 ? glm::clamp(glm::dot(point - from, along) / square, 0.0, 1.0) : 0.0;
    return glm::length(point - (from + share * along));
}

}  // namespace

std::vector<OtherLines> other_lines(const Mesh& mesh, const LineView& view,
                                    const Context& context) {
    ScriptInput input;
    add_view(mesh, view, input);
    std::vector<OtherLines> all;
    if (!input.is_complete())
        return {{.method = "other programs", .skipped = "no temporary file for them"}};
    const auto run = [&](const char* name, std::span<const char* const> arguments,
                         const char* needs) {
        Progress progress(context, "running " + std::string(name));
        progress.call().checkpoint(0.0);
        std::vector<OtherLines> found =
            read_answer(run_program(arguments, input, context).value_or(""));
        if (found.empty()) all.push_back({.method = name, .skipped = needs});
        std::ranges::move(found, std::back_inserter(all));
    };
    const std::array blender{"blender",
                             "--background",
                             "--factory-startup",
                             "--threads",
                             "1",
                             "--debug-freestyle",
                             "--python-exit-code",
                             "1",
                             "--python-expr",
                             k_blender_lines_script};
    run("Blender", blender, "no blender 3 on the path that ends well (Debian: blender)");
    if (mesh.face_count() > k_max_occt_faces) {
        all.push_back({.method = "OCCT", .skipped = "more than 100,000 faces, which take minutes"});
    } else {
        const std::string program = beside_this_program(k_occt_program);
        const std::array occt{program.c_str()};
        run("OCCT", occt, "no rimline_occt_lines beside this program (docs/results/lines.md)");
    }
    return all;
}

OtherErrors compare_lines(std::span<const LinePiece> pieces, std::span<const OtherSegment> segments,
                          double reach) {
    double all = 0.0, drawn = 0.0, wrong = 0.0;
    for (const LinePiece& piece : pieces) {
        const OtherSegment* nearest = nullptr;
        double least = reach;
        for (const OtherSegment& segment : segments) {
            const double distance = distance_between(piece.middle, segment);
            if (distance < least) least = distance, nearest = &segment;
        }
        all += piece.length;
        if (nearest == nullptr) continue;
        drawn += piece.length;
        if (nearest->is_visible == piece.is_hidden) wrong += piece.length;
    }
    return {.wrong_share = drawn > 0.0 ? wrong / drawn : 0.0,
            .missing_share = all > 0.0 ? 1.0 - drawn / all : 0.0};
}

}  // namespace rimline::tools
