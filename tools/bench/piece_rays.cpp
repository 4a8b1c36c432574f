#include "tools/bench/piece_rays.h"

#include <cfenv>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "tools/bench/embree.h"

namespace rimline::tools {

namespace {

constexpr float k_shortened_by = 1e-3f;  // Of the way from the piece to the eye.

// Embree can change how floats are rounded; the signs of lines must not notice.
class UnchangedRounding {
public:
    UnchangedRounding() { std::fegetenv(&environment_); }
    ~UnchangedRounding() { std::fesetenv(&environment_); }
    UnchangedRounding(const UnchangedRounding&) = delete;
    UnchangedRounding& operator=(const UnchangedRounding&) = delete;

private:
    std::fenv_t environment_{};
};

// The context of one ray, which the filter receives.
struct PieceRay {
    RayContext embree;  // The first member: Embree passes a pointer to it.
    const Mesh* mesh;
    const LinePiece* piece;
    int shared_corners;  // A face with so many of the edge's vertices is left out.
};

void leave_out_faces_at_piece(const RTCFilterFunctionNArguments* arguments) {
    if (arguments->valid[0] == 0) return;
    const auto& ray = *reinterpret_cast<const PieceRay*>(arguments->context);
    const Triangle& face = ray.mesh->triangles()[RTCHitN_primID(arguments->hit, 1, 0)];
    int shared = 0;
    for (const VertexId corner : face)
        shared += corner == ray.piece->vertices[0] || corner == ray.piece->vertices[1] ? 1 : 0;
    if (shared >= ray.shared_corners) arguments->valid[0] = 0;
}

// A buffer with three numbers for each item.
template <typename Number>
Number* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t items) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Number), items);
    if (buffer == nullptr) throw std::bad_alloc();
    return static_cast<Number*>(buffer);
}

}  // namespace

struct PieceRays::Scene {
    struct Release {
        void operator()(RTCDevice handle) const noexcept { rtcReleaseDevice(handle); }
        void operator()(RTCScene handle) const noexcept { rtcReleaseScene(handle); }
        void operator()(RTCGeometry handle) const noexcept { rtcReleaseGeometry(handle); }
    };
    template <typename Handle>
    using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

    explicit Scene(const Mesh& of)
        : mesh(of), device(rtcNewDevice(nullptr)), scene(rtcNewScene(device.get())) {
        const UnchangedRounding unchanged;
        rtcSetSceneFlags(scene.get(), k_filtered_by_query | RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
        const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
        auto* number = new_buffer<float>(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                         mesh.vertex_count());
        for (const glm::vec3& position : mesh.positions())
            for (int k = 0; k < 3; ++k) *number++ = position[k];
        auto* corner = new_buffer<std::uint32_t>(geometry.get(), RTC_BUFFER_TYPE_INDEX,
                                                 RTC_FORMAT_UINT3, mesh.face_count());
        for (const Triangle& face : mesh.triangles())
            for (const VertexId vertex : face) *corner++ = index(vertex);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometry(scene.get(), geometry.get());
        rtcCommitScene(scene.get());
    }

    const Mesh& mesh;
    const Owned<RTCDevice> device;
    const Owned<RTCScene> scene;
};

std::string_view PieceRays::missing() noexcept { return {}; }

PieceRays::PieceRays(const Mesh& mesh) : scene_(std::make_unique<const Scene>(mesh)) {}
PieceRays::~PieceRays() = default;

void PieceRays::find_hidden(const LineView& view, std::span<const LinePiece> pieces, RayWay way,
                            std::vector<std::uint8_t>& is_hidden) const {
    const UnchangedRounding unchanged;
    PieceRay context{};
    context.mesh = &scene_->mesh;
    context.shared_corners = way == RayWay::one_ring ? 1 : 2;
    const glm::dvec3 point(view.point().xyz());
    is_hidden.resize(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const glm::dvec3& from = pieces[i].middle;
        const glm::vec3 way_to_eye(view.is_orthographic() ? point : point - from);
        context.piece = &pieces[i];
        RTCRay ray{};
        ray.org_x = static_cast<float>(from.x);
        ray.org_y = static_cast<float>(from.y);
        ray.org_z = static_cast<float>(from.z);
        ray.dir_x = way_to_eye.x;
        ray.dir_y = way_to_eye.y;
        ray.dir_z = way_to_eye.z;
        ray.tnear = way == RayWay::shortened ? k_shortened_by : 0.0f;
        ray.tfar = view.is_orthographic() ? std::numeric_limits<float>::infinity() : 1.0f;
        ray.mask = ~0u;
        is_hidden[i] =
            is_blocked(scene_->scene.get(), ray, context.embree, leave_out_faces_at_piece) ? 1 : 0;
    }
}

}  // namespace rimline::tools
