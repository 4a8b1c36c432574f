#include "engine/measure/ratio_view.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "engine/camera.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/mesh/edge_convexity.h"
#include "silhouette/mesh/solid.h"

namespace rimline {

namespace {

// The limit of faces in the clusters up to which faces are tested one by one. Those that may hide a line
// are copied to be drawn. With more faces the clusters are drawn, which copies nothing.
constexpr std::size_t k_max_copied_faces = 1'000'000;

// The limit of draw calls for the clusters of a view. Beyond it some clusters between others are drawn too.
constexpr std::size_t k_max_face_runs = 256;

const Mesh& drawable(const Mesh& mesh) {
    if (mesh.vertex_count() > k_max_indexed_vertices)
        throw Error(ErrorCode::too_large, "more than 2^24 vertices, too many for visible ratios");
    return mesh;
}

}  // namespace

struct RatioViewBuilder::ThreadScratch {
    BlockScratch blocks;
    std::vector<EdgeId> edges;
    LineReach lines;
    std::vector<glm::vec3> corners;  // On the screen.
};

struct RatioViewBuilder::Scratch {
    tbb::enumerable_thread_specific<ThreadScratch> threads;
};

RatioViewBuilder::RatioViewBuilder(const HoughOctree& octree, const VisibleRatioOptions& options,
                                   Occluders occluders, const std::stop_token& stop)
    : octree_(octree),
      options_(options),
      clusters_(drawable(octree.mesh())),
      occluders_(occluders),
      is_solid_(is_solid(octree.mesh(), {stop, {}})),
      concave_bits_(concave_edge_bits(octree.mesh())),
      scratch_(new Scratch{tbb::enumerable_thread_specific<ThreadScratch>([&octree] {
          return ThreadScratch{octree.make_scratch(), {}, {}, {}};
      })}) {}

RatioViewBuilder::~RatioViewBuilder() = default;

void RatioViewBuilder::build(std::span<const glm::dvec3> eyes, std::span<RatioView> views) const {
    RIMLINE_CHECK(eyes.size() == views.size());
    tbb::parallel_for(std::size_t{0}, eyes.size(), [&](std::size_t v) {
        build_view(eyes[v], views[v], scratch_->threads.local());
    });
}

void RatioViewBuilder::build_view(const glm::dvec3& eye, RatioView& view,
                                  ThreadScratch& scratch) const {
    const Mesh& mesh = octree_.mesh();
    const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(eye));
    Camera camera{.eye = glm::dvec3(point.xyz()),
                  .target = mesh.center(),
                  .up = mesh.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0),
                  .fov_y_deg = options_.fov_deg};
    if (camera.eye == camera.target) camera.target = camera.eye - glm::dvec3(0, 0, 1);
    const Projection projection = make_projection(camera, 1.0, mesh.center(), mesh.radius());
    const SquareView square{.eye_from_object = glm::mat3(camera_from_world(camera)),
                            .eye = point.xyz(),
                            .focal = float(projection.scale.x),
                            .near_distance = float(projection.z[1]),
                            .side_px = float(options_.side_px)};
    view.constants = {.positions = 0,
                      .lines = 0,
                      .eye_from_object = square.eye_from_object,
                      .camera = square.eye,
                      .clip_scale = glm::vec2(projection.scale),
                      .near_distance = square.near_distance,
                      .side_px = square.side_px};
    view.culls_backs = is_solid_ && glm::distance(camera.eye, mesh.center()) > mesh.radius();
    scratch.lines.begin(square);
    select_lines(point, view, scratch);
    select_faces(view, scratch);
}

void RatioViewBuilder::select_lines(const HomogeneousPoint& point, RatioView& view,
                                    ThreadScratch& scratch) const {
    const Mesh& mesh = octree_.mesh();
    TraversalCounters counters;
    octree_.extract(point, scratch.edges, counters, scratch.blocks);
    const auto is_hidden_valley = [&](EdgeId edge) {
        return view.culls_backs && is_concave(concave_bits_, edge);
    };
    const auto hidden = std::partition(scratch.edges.begin(), scratch.edges.end(),
                                       [&](EdgeId edge) { return !is_hidden_valley(edge); });
    view.lines.clear();
    const auto add_line = [&](EdgeId edge) {
        const auto& [from, to] = mesh.edge(edge).vertices;
        view.lines.push_back({index(from), index(to)});
    };
    const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
    if (options_.has_borders)
        for (std::uint32_t e = borders.first; e < borders.last; ++e) add_line(EdgeId{e});
    std::for_each(scratch.edges.begin(), hidden, add_line);
    view.tested_lines = static_cast<std::uint32_t>(view.lines.size());
    std::for_each(hidden, scratch.edges.end(), add_line);
}

void RatioViewBuilder::select_faces(RatioView& view, ThreadScratch& scratch) const {
    const Mesh& mesh = octree_.mesh();
    view.copied_faces.clear();
    if (occluders_ == Occluders::all) {
        view.faces = {{0, 3 * static_cast<std::uint32_t>(clusters_.triangles().size())}};
        return;
    }
    for (std::uint32_t l = 0; l < view.tested_lines; ++l)
        scratch.lines.add(mesh.positions()[view.lines[l].from], mesh.positions()[view.lines[l].to]);
    clusters_.select(scratch.lines, view.culls_backs, view.faces);
    std::size_t face_count = 0;
    for (const IndexRun& run : view.faces) face_count += run.count / 3;
    if (occluders_ == Occluders::clusters || face_count > k_max_copied_faces) {
        join_runs(view.faces, k_max_face_runs);
        return;
    }
    scratch.corners.resize(mesh.vertex_count());
    std::ranges::transform(
        mesh.positions(), scratch.corners.begin(),
        [&](const glm::vec3& position) { return scratch.lines.on_screen(position); });
    clusters_.select_faces(scratch.lines, view.faces, scratch.corners, view.copied_faces);
    if (view.copied_faces.empty()) view.faces.clear();
}

}  // namespace rimline
