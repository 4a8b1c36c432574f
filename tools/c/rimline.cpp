// rimline.h: no exception leaves this file, and no argument of a caller meets a check that ends the program.

#include "tools/c/rimline.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <type_traits>
#include <vector>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/printable_text.h"
#include "tools/bindings/bound_drawer.h"
#include "tools/bindings/bound_mesh.h"
#include "tools/bindings/bound_renderer.h"
#include "tools/bindings/option_names.h"
#include "tools/options/model_argument.h"
#include "tools/options/up_option.h"
#include "tools/options/view_choice.h"
#include "tools/usage_words.h"

using rimline::ErrorCode;
using rimline::HomogeneousPoint;
using rimline::LongCall;
using rimline::tools::UsageError;

struct rimline_error {
    rimline_status status;
    std::string message;
};
struct rimline_bytes {
    std::string bytes;
};
struct rimline_mesh {
    rimline::tools::SharedMesh shared;
    std::vector<std::string> warnings;
};
struct rimline_tracker {
    rimline::tools::SharedMesh mesh;
    rimline::SilhouetteTracker tracker;
};
struct rimline_drawer {
    rimline::tools::BoundDrawer drawer;
};
struct rimline_drawing {
    std::unique_ptr<rimline::tools::BoundDrawing> drawing;
};
struct rimline_renderer {
    rimline::tools::BoundRenderer renderer;
    pid_t opened_by = getpid();
};
struct rimline_picture {
    rimline::Picture picture;
};

namespace {

rimline_status status_of(ErrorCode code) {
    switch (code) {
        case ErrorCode::bad_input: return RIMLINE_BAD_INPUT;
        case ErrorCode::no_device: return RIMLINE_NO_DEVICE;
        case ErrorCode::device_lost: return RIMLINE_DEVICE_LOST;
        case ErrorCode::io: return RIMLINE_IO;
        case ErrorCode::too_large: return RIMLINE_TOO_LARGE;
        case ErrorCode::cancelled: return RIMLINE_CANCELLED;
    }
    return RIMLINE_UNEXPECTED;
}

// What rimline_error_free() does not free, for failures of memory.
rimline_error g_out_of_memory{RIMLINE_OUT_OF_MEMORY, "out of memory"};

rimline_status fail(rimline_error** error, rimline_status status, const char* message) noexcept {
    if (error == nullptr) return status;
    try {
        *error = new rimline_error{status, rimline::printable_text(message)};
    } catch (const std::bad_alloc&) {
        *error = &g_out_of_memory;
    }
    return status;
}

rimline_status fail_in_options(rimline_error** error, const char* message) noexcept {
    try {
        return fail(error, RIMLINE_BAD_ARGUMENT,
                    rimline::tools::with_plain_names(message, '-').c_str());
    } catch (const std::bad_alloc&) {
        return fail(error, RIMLINE_OUT_OF_MEMORY, "out of memory");
    }
}

// Calls work() and turns what it throws into a status.
template <typename Work>
rimline_status guarded(rimline_error** error, Work&& work) noexcept {
    if (error != nullptr) *error = nullptr;
    try {
        work();
        return RIMLINE_OK;
    } catch (const rimline::Error& failure) {
        return fail(error, status_of(failure.code()), failure.what());
    } catch (const UsageError& failure) {
        return fail_in_options(error, failure.what());
    } catch (const CLI::ParseError& failure) {
        return fail_in_options(error, failure.what());
    } catch (const std::bad_alloc&) {
        return fail(error, RIMLINE_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& failure) {
        return fail(error, RIMLINE_UNEXPECTED, failure.what());
    } catch (...) {
        return fail(error, RIMLINE_UNEXPECTED, "unexpected");
    }
}

template <typename Pointer>
Pointer* given(Pointer* pointer, const char* name) {
    if (pointer == nullptr) throw UsageError(std::string(name) + " is NULL");
    return pointer;
}

// The progress function of the caller, which ends the call through a stop token.
class CallersCall {
public:
    explicit CallersCall(const rimline_call* call) {
        call_.stop = stop_.get_token();
        if (call == nullptr) return;
        // Fields that a later version adds are read where the size covers them.
        if (call->struct_size < offsetof(rimline_call, user) + sizeof call->user)
            throw UsageError("call: struct_size is not set");
        if (call->progress == nullptr) return;
        call_.progress = [this, progress = call->progress, user = call->user](double share) {
            last_ = std::max(last_, share);
            if (progress(last_, user) == 0) return;
            stop_.request_stop();
            throw rimline::Error(ErrorCode::cancelled, "cancelled");
        };
    }
    CallersCall(const CallersCall&) = delete;
    CallersCall& operator=(const CallersCall&) = delete;

    const LongCall& get() const noexcept { return call_; }

private:
    std::stop_source stop_;
    LongCall call_;
    double last_ = 0.0;
};

// Of `count` faces or edges, whose vertices are to be written.
void check_numbers(const uint32_t* numbers, size_t count, const uint32_t* vertices,
                   uint32_t number_count, const std::string& kind) {
    if (count == 0) return;
    given(numbers, (kind + "s").c_str());
    given(vertices, "vertices");
    for (size_t i = 0; i < count; ++i)
        if (numbers[i] >= number_count)
            throw UsageError(kind + "s: there is no " + kind + " " + std::to_string(numbers[i]) +
                             " among " + std::to_string(number_count));
}

HomogeneousPoint point_of(const rimline_point* point) {
    given(point, "point");
    const glm::dvec3 place(point->x, point->y, point->z);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(place[axis]) <= double{rimline::k_max_coordinate}))  // NaN too.
            throw UsageError("point: a coordinate is not a finite number within 2^60");
    if (point->is_direction == 0) return HomogeneousPoint::viewpoint(glm::vec3(place));
    const HomogeneousPoint direction =
        HomogeneousPoint::direction(glm::vec3(rimline::tools::long_direction(place)));
    if (direction.xyz() == glm::vec3(0.0f)) throw UsageError("point: a direction is zero");
    return direction;
}

void parse(CLI::App& app, const rimline_option* options, size_t count) {
    if (count > 0) given(options, "options");
    std::vector<std::string> words;
    for (size_t i = count; i-- > 0;) {  // CLI11 takes them from the end.
        const std::string name = given(options[i].name, "options: a name");
        const CLI::Option* const option = app.get_option_no_throw("--" + name);
        if (option == nullptr || name == "help")
            throw UsageError("options: there is no option '" + name + "'");
        if (std::ranges::any_of(options + i + 1, options + count,
                                [&](const rimline_option& later) { return name == later.name; }))
            throw UsageError("options: '" + name + "' is given twice");
        // An empty one would take the next option for its value.
        const bool has_value = options[i].value != nullptr && *options[i].value != '\0';
        if (!has_value && option->get_expected_max() != 0)
            throw UsageError("options: " + name + " needs a value");
        words.push_back("--" + name +
                        (options[i].value == nullptr ? "" : "=" + std::string(options[i].value)));
    }
    try {
        app.parse(words);
    } catch (const CLI::ParseError& error) {
        throw UsageError(rimline::tools::usage_words(error, app));
    }
}

rimline_bytes* bytes_of(std::string bytes) { return new rimline_bytes{std::move(bytes)}; }

template <typename Element>
std::string raw_bytes(const std::vector<Element>& elements) {
    return {reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(Element)};
}

// Writes as much of `filled` as the caller's struct has.
template <typename Struct>
void store(const Struct& filled, Struct* target) {
    const size_t size = target->struct_size;
    if (size < sizeof target->struct_size) throw UsageError("struct_size is not set");
    std::memcpy(target, &filled, std::min(size, sizeof filled));
    target->struct_size = size;
}

template <typename Id>
const uint32_t* numbers(std::span<const Id> ids) {
    static_assert(sizeof(Id) % sizeof(uint32_t) == 0);
    return reinterpret_cast<const uint32_t*>(ids.data());
}

}  // namespace

const char* rimline_version(void) { return RIMLINE_VERSION; }

rimline_status rimline_error_status(const rimline_error* error) {
    return error == nullptr ? RIMLINE_OK : error->status;
}
const char* rimline_error_message(const rimline_error* error) {
    return error == nullptr ? "" : error->message.c_str();
}
void rimline_error_free(rimline_error* error) {
    if (error != &g_out_of_memory) delete error;
}

const void* rimline_bytes_data(const rimline_bytes* bytes) {
    return bytes == nullptr ? nullptr : bytes->bytes.data();
}
size_t rimline_bytes_size(const rimline_bytes* bytes) {
    return bytes == nullptr ? 0 : bytes->bytes.size();
}
void rimline_bytes_free(rimline_bytes* bytes) { delete bytes; }

rimline_status rimline_mesh_load(const char* path, const rimline_call* call, rimline_mesh** mesh,
                                 rimline_error** error) {
    return guarded(error, [&] {
        *given(mesh, "mesh") = nullptr;
        const std::string name = given(path, "path");
        if (name.empty() || name == "-") throw UsageError("path: expected the name of a file");
        const CallersCall long_call(call);
        std::vector<std::string> warnings;
        try {
            auto shared =
                rimline::tools::load_bound_mesh(name, 0, true, "", warnings, long_call.get());
            *mesh = new rimline_mesh{std::move(shared), std::move(warnings)};
        } catch (const CLI::ValidationError& failure) {  // A shape that does not exist.
            const std::string message = failure.what();
            throw UsageError("path" + message.substr(message.find(": ")));
        }
    });
}

rimline_status rimline_mesh_create(const float* positions, size_t vertex_count,
                                   const uint32_t* corners, size_t face_count,
                                   const rimline_call* call, rimline_mesh** mesh,
                                   rimline_error** error) {
    return guarded(error, [&] {
        *given(mesh, "mesh") = nullptr;
        if (vertex_count > 0) given(positions, "positions");
        if (face_count > 0) given(corners, "corners");
        if (vertex_count >= 0xffffffffu) throw UsageError("vertex_count: more than 2^32 - 2");
        if (face_count > (size_t{1} << 30)) throw UsageError("face_count: more than 2^30");
        const CallersCall long_call(call);
        rimline::MeshSource source;
        source.positions.resize(vertex_count);
        for (size_t i = 0; i < vertex_count; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const float coordinate = positions[3 * i + size_t(axis)];
                if (!(std::abs(coordinate) <= rimline::k_max_coordinate))
                    throw UsageError("positions: a coordinate of vertex " + std::to_string(i) +
                                     " is not a finite number within 2^60");
                source.positions[i][axis] = coordinate;
            }
        source.triangles.resize(face_count);
        for (size_t face = 0; face < face_count; ++face)
            for (size_t corner = 0; corner < 3; ++corner) {
                const uint32_t vertex = corners[3 * face + corner];
                if (vertex >= vertex_count)
                    throw UsageError("corners: face " + std::to_string(face) + " has vertex " +
                                     std::to_string(vertex) + " of " +
                                     std::to_string(vertex_count));
                source.triangles[face][corner] = vertex;
            }
        std::vector<std::string> warnings;
        if (std::string warning = rimline::lost_shape_warning("the mesh", source); !warning.empty())
            warnings.push_back(std::move(warning));
        auto shared = std::make_shared<rimline::tools::BoundMesh>(
            "the mesh", std::move(source), rimline::Welding::equal_positions, long_call.get());
        *mesh = new rimline_mesh{std::move(shared), std::move(warnings)};
    });
}

const char* rimline_mesh_warning(const rimline_mesh* mesh, size_t index) {
    return mesh == nullptr || index >= mesh->warnings.size() ? nullptr
                                                             : mesh->warnings[index].c_str();
}

void rimline_mesh_free(rimline_mesh* mesh) { delete mesh; }

rimline_status rimline_mesh_get_info(const rimline_mesh* mesh, rimline_mesh_info* info,
                                     rimline_error** error) {
    return guarded(error, [&] {
        const rimline::Mesh& m = given(mesh, "mesh")->shared->mesh();
        given(info, "info");
        const glm::dvec3 center = m.center();
        store(rimline_mesh_info{.struct_size = 0,
                                .input_vertices = m.file_vertex_count(),
                                .vertices = m.vertex_count(),
                                .faces = m.face_count(),
                                .edges = m.edge_count(),
                                .border_edges = m.edges_of_class(rimline::EdgeClass::border).size(),
                                .is_closed = m.is_closed() ? 1 : 0,
                                .is_oriented = m.is_oriented() ? 1 : 0,
                                .center = {center.x, center.y, center.z},
                                .radius = m.radius()},
              info);
    });
}

rimline_status rimline_mesh_positions(const rimline_mesh* mesh, const float** positions,
                                      size_t* vertex_count, rimline_error** error) {
    return guarded(error, [&] {
        *given(positions, "positions") = nullptr;
        *given(vertex_count, "vertex_count") = 0;
        const std::vector<glm::vec3>& all = given(mesh, "mesh")->shared->positions();
        static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
        *positions = reinterpret_cast<const float*>(all.data());
        *vertex_count = all.size();
    });
}

rimline_status rimline_mesh_face_vertices(const rimline_mesh* mesh, const uint32_t* faces,
                                          size_t count, uint32_t* vertices, rimline_error** error) {
    return guarded(error, [&] {
        const rimline::Mesh& m = given(mesh, "mesh")->shared->mesh();
        check_numbers(faces, count, vertices, m.face_count(), "face");
        for (size_t i = 0; i < count; ++i)
            for (size_t k = 0; k < 3; ++k)
                vertices[3 * i + k] = m.file_vertex(m.triangles()[faces[i]][k]);
    });
}

rimline_status rimline_mesh_edge_vertices(const rimline_mesh* mesh, const uint32_t* edges,
                                          size_t count, uint32_t* vertices, rimline_error** error) {
    return guarded(error, [&] {
        const rimline::Mesh& m = given(mesh, "mesh")->shared->mesh();
        check_numbers(edges, count, vertices, m.edge_count(), "edge");
        for (size_t i = 0; i < count; ++i)
            for (size_t end = 0; end < 2; ++end)
                vertices[2 * i + end] =
                    m.file_vertex(m.edge(rimline::EdgeId{edges[i]}).vertices[end]);
    });
}

rimline_status rimline_mesh_silhouette(const rimline_mesh* mesh, const rimline_point* point,
                                       rimline_bytes** edges, rimline_error** error) {
    return guarded(error, [&] {
        *given(edges, "edges") = nullptr;
        const rimline::Mesh& m = given(mesh, "mesh")->shared->mesh();
        *edges = bytes_of(raw_bytes(rimline::brute_force_silhouette(m, point_of(point))));
    });
}

rimline_status rimline_tracker_create(const rimline_mesh* mesh, const rimline_point* point,
                                      const rimline_call* call, rimline_tracker** tracker,
                                      rimline_error** error) {
    return guarded(error, [&] {
        *given(tracker, "tracker") = nullptr;
        const rimline::tools::SharedMesh& shared = given(mesh, "mesh")->shared;
        const HomogeneousPoint start = point_of(point);
        const CallersCall long_call(call);
        *tracker = new rimline_tracker{
            shared, rimline::SilhouetteTracker(shared->octree(long_call.get()), start)};
    });
}

void rimline_tracker_free(rimline_tracker* tracker) { delete tracker; }

rimline_status rimline_tracker_move(rimline_tracker* tracker, const rimline_point* point,
                                    rimline_changes* changes, rimline_error** error) {
    return guarded(error, [&] {
        given(tracker, "tracker");
        const HomogeneousPoint to = point_of(point);
        if (changes != nullptr && changes->struct_size < sizeof changes->struct_size)
            throw UsageError("changes: struct_size is not set");
        const rimline::ChangeSet& c = tracker->tracker.move_to(to);
        if (changes == nullptr) return;
        store(rimline_changes{.struct_size = 0,
                              .sequence = c.sequence,
                              .silhouette_count = c.silhouette_size,
                              .flipped = numbers(c.flipped),
                              .flipped_count = c.flipped.size(),
                              .added = numbers(c.added),
                              .added_count = c.added.size(),
                              .removed = numbers(c.removed),
                              .removed_count = c.removed.size(),
                              .slots = numbers(c.slots),
                              .slot_count = c.slots.size(),
                              .words = numbers(c.words),
                              .word_count = c.words.size()},
              changes);
    });
}

rimline_status rimline_tracker_silhouette(const rimline_tracker* tracker, const uint32_t** edges,
                                          size_t* count, rimline_error** error) {
    return guarded(error, [&] {
        const std::span<const rimline::EdgeId> silhouette =
            given(tracker, "tracker")->tracker.silhouette();
        *given(edges, "edges") = numbers(silhouette);
        *given(count, "count") = silhouette.size();
    });
}

rimline_status rimline_tracker_face_words(const rimline_tracker* tracker, const uint32_t** words,
                                          size_t* count, rimline_error** error) {
    return guarded(error, [&] {
        const std::span<const std::uint32_t> bits = given(tracker, "tracker")->tracker.face_words();
        *given(words, "words") = bits.data();
        *given(count, "count") = bits.size();
    });
}

rimline_status rimline_drawer_create(const rimline_mesh* mesh, const rimline_call* call,
                                     rimline_drawer** drawer, rimline_error** error) {
    return guarded(error, [&] {
        *given(drawer, "drawer") = nullptr;
        const CallersCall long_call(call);
        *drawer = new rimline_drawer{{given(mesh, "mesh")->shared, long_call.get()}};
    });
}

void rimline_drawer_free(rimline_drawer* drawer) { delete drawer; }

rimline_status rimline_drawer_draw(rimline_drawer* drawer, const rimline_option* options,
                                   size_t option_count, const rimline_call* call,
                                   rimline_drawing** drawing, rimline_error** error) {
    return guarded(error, [&] {
        *given(drawing, "drawing") = nullptr;
        given(drawer, "drawer");
        rimline::tools::DrawOptions parsed;
        parse(parsed.app, options, option_count);
        const CallersCall long_call(call);
        *drawing = new rimline_drawing{drawer->drawer.draw(parsed, false, long_call.get())};
    });
}

void rimline_drawing_free(rimline_drawing* drawing) { delete drawing; }

rimline_status rimline_drawing_page(const rimline_drawing* drawing, double* width_mm,
                                    double* height_mm, size_t* line_count, rimline_error** error) {
    return guarded(error, [&] {
        const rimline::tools::PageDrawing& page = given(drawing, "drawing")->drawing->page;
        if (width_mm != nullptr) *width_mm = page.size_mm.x;
        if (height_mm != nullptr) *height_mm = page.size_mm.y;
        if (line_count != nullptr) *line_count = page.lines.size();
    });
}

rimline_status rimline_drawing_line(const rimline_drawing* drawing, size_t index,
                                    rimline_line* line, rimline_error** error) {
    return guarded(error, [&] {
        const std::vector<rimline::tools::PageLine>& lines =
            given(drawing, "drawing")->drawing->page.lines;
        given(line, "line");
        if (index >= lines.size())
            throw UsageError("index: there is no line " + std::to_string(index) + " among " +
                             std::to_string(lines.size()));
        const rimline::tools::PageLine& l = lines[index];
        store(rimline_line{.struct_size = 0,
                           .kind = static_cast<rimline_line_kind>(l.kind),
                           .is_hidden = l.is_hidden ? 1 : 0,
                           .is_closed = l.is_closed ? 1 : 0,
                           .points = &l.points.front().x,
                           .point_count = l.points.size()},
              line);
    });
}

rimline_status rimline_drawing_encode(const rimline_drawing* drawing, int format,
                                      rimline_bytes** file, rimline_error** error) {
    return guarded(error, [&] {
        *given(file, "file") = nullptr;
        const rimline::tools::PageDrawing& page = given(drawing, "drawing")->drawing->page;
        switch (format) {
            case RIMLINE_SVG: *file = bytes_of(drawing_svg(page)); return;
            case RIMLINE_PDF: *file = bytes_of(drawing_pdf(page)); return;
            case RIMLINE_DXF: *file = bytes_of(drawing_dxf(page)); return;
            default: throw UsageError("format: unknown");
        }
    });
}

rimline_status rimline_renderer_create(const char* device, rimline_renderer** renderer,
                                       rimline_error** error) {
    return guarded(error, [&] {
        *given(renderer, "renderer") = nullptr;
        *renderer = new rimline_renderer{.renderer = {device == nullptr ? "" : device, false}};
    });
}

void rimline_renderer_free(rimline_renderer* renderer) {
    // A child of fork() has none of the device's threads: closing it would wait for them.
    if (renderer != nullptr && renderer->opened_by == getpid()) delete renderer;
}

rimline_status rimline_renderer_render(rimline_renderer* renderer, const rimline_mesh* mesh,
                                       const rimline_option* options, size_t option_count,
                                       const rimline_call* call, rimline_picture** picture,
                                       rimline_error** error) {
    return guarded(error, [&] {
        *given(picture, "picture") = nullptr;
        given(renderer, "renderer");
        given(mesh, "mesh");
        rimline::tools::RenderOptions parsed;
        parse(parsed.app, options, option_count);
        const CallersCall long_call(call);
        *picture =
            new rimline_picture{renderer->renderer.render(mesh->shared, parsed, long_call.get())};
    });
}

void rimline_picture_free(rimline_picture* picture) { delete picture; }

rimline_status rimline_picture_pixels(const rimline_picture* picture, uint32_t* width,
                                      uint32_t* height, const uint8_t** rgba,
                                      rimline_error** error) {
    return guarded(error, [&] {
        const rimline::Picture& p = given(picture, "picture")->picture;
        if (width != nullptr) *width = p.width;
        if (height != nullptr) *height = p.height;
        if (rgba != nullptr) *rgba = p.rgba.data();
    });
}

rimline_status rimline_picture_encode_png(const rimline_picture* picture, rimline_bytes** file,
                                          rimline_error** error) {
    return guarded(error, [&] {
        *given(file, "file") = nullptr;
        *file = bytes_of(raw_bytes(rimline::encode_png(given(picture, "picture")->picture)));
    });
}

rimline_status rimline_best_views(const rimline_mesh* mesh, rimline_renderer* renderer,
                                  size_t capacity, const rimline_call* call, rimline_view* views,
                                  size_t* count, rimline_error** error) {
    return guarded(error, [&] {
        *given(count, "count") = 0;
        rimline::tools::BoundMesh& bound = *given(mesh, "mesh")->shared;
        if (capacity == 0) return;
        given(views, "views");
        const rimline::Mesh& m = bound.mesh();
        rimline::tools::check_viewing_range(bound.name(), m);
        const CallersCall long_call(call);
        const rimline::tools::ViewChoice choice{
            .count = static_cast<std::uint32_t>(std::min<size_t>(capacity, 64))};
        const glm::dvec3 up = rimline::tools::choose_up(m, std::nullopt, false).up;
        const rimline::TangentialField field = make_view_field(
            m, choice.field_options(), rimline::view_function(), long_call.get().stop);
        const LongCall prepared = long_call.get().part(0.0, 0.1),
                       searched = long_call.get().part(0.1, 1.0);
        rimline::BestViews best;
        const auto find = [&](const rimline::VisibleRatios& ratios) {
            best = find_best_views(field, choice.options(m, up, ratios), searched);
        };
        rimline::tools::measure_views(bound, renderer == nullptr ? nullptr : &renderer->renderer,
                                      prepared, find);
        for (const rimline::BestView& view : best.views)
            views[(*count)++] = {.eye = {view.eye.x, view.eye.y, view.eye.z},
                                 .score = view.score(),
                                 .visible_ratio = view.visible_ratio};
    });
}
