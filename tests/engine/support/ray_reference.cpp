#include "tests/engine/support/ray_reference.h"
#include "silhouette/hough/hough_octree.h"

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace rimline::tests {

namespace {

// Nearer than this, in scene radii, a triangle is one that the ray starts on: a neighbor in the same
// plane, of whose distance only the rounding is left.
constexpr double k_touching = 1e-10;

// The sine of the angle below which a light lies in a surface's plane.
constexpr double k_in_plane = 1e-9;

// Rays for Embree begin this much earlier and end later, in scene radii, so that its float distances
// lose nothing that double precision would keep.
constexpr double k_margin = 1e-5;

// Embree's worker threads and device may ask for subnormals to be flushed; face bits may not see that.
class KeptFloatingPoint {
public:
    KeptFloatingPoint() { std::fegetenv(&environment_); }
    ~KeptFloatingPoint() { std::fesetenv(&environment_); }
    KeptFloatingPoint(const KeptFloatingPoint&) = delete;
    KeptFloatingPoint& operator=(const KeptFloatingPoint&) = delete;

private:
    std::fenv_t environment_;
};

float* make_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    return static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, type, 0, format, 12, std::max<std::size_t>(count, 1)));
}

}  // namespace

// A ray between two points and what it may pass through. Embree calls back with the context alone.
struct RayReference::Query {
    tools::RayContext context;
    const RayReference* reference;
    Ray ray;
    double end;  // Along the ray.
    const Ignored* ignored;
};

RayReference::RayReference(const Scene& scene) : scene_(scene) {
    const KeptFloatingPoint kept;
    const SceneBounds bounds = bounds_of(scene);
    const Camera& camera = scene.camera;
    center_ = bounds.center;
    radius_ = bounds.radius;
    back_ = glm::normalize(camera.eye - camera.target);
    right_ = glm::normalize(glm::cross(camera.up, back_));
    up_ = glm::cross(back_, right_);
    half_height_ = 0.5 * camera.ortho_height;
    if (!camera.is_orthographic()) {
        near_ = 1e-4 * radius_;
        half_height_ = std::tan(0.5 * glm::radians(camera.fov_y_deg));
    }

    device_ = rtcNewDevice("threads=1");
    rays_ = rtcNewScene(device_);
    rtcSetSceneFlags(
        rays_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | tools::k_filtered_by_query));
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const SceneInstance& instance = scene.instances[i];
        const Mesh& mesh = instance.octree->mesh();
        std::vector<glm::dvec3>& vertices = vertices_.emplace_back();
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        float* positions =
            make_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertex_count());
        for (const glm::vec3& position : mesh.positions()) {
            vertices.push_back(instance.rotation * glm::dvec3(position) + instance.translation);
            // Relative to the scene's center, where float is finest.
            const glm::vec3 rounded(vertices.back() - center_);
            for (int axis = 0; axis < 3; ++axis) *positions++ = rounded[axis];
        }
        auto* corners = reinterpret_cast<std::uint32_t*>(
            make_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.face_count()));
        for (const Triangle& triangle : mesh.triangles())
            for (const VertexId vertex : triangle) *corners++ = index(vertex);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(rays_, geometry, static_cast<unsigned>(i));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(rays_);
    RIMLINE_CHECK(rtcGetDeviceError(device_) == RTC_ERROR_NONE);
}

RayReference::~RayReference() {
    rtcReleaseScene(rays_);
    rtcReleaseDevice(device_);
}

Ray RayReference::camera_ray(glm::dvec2 place, glm::dvec2 picture_size) const {
    const double unit = 2.0 * half_height_ / picture_size.y;
    const glm::dvec3 across = unit * (place.x - 0.5 * picture_size.x) * right_ -
                              unit * (place.y - 0.5 * picture_size.y) * up_;
    const Camera& camera = scene_.camera;
    if (!camera.is_orthographic()) return {camera.eye, across - back_};
    // From in front of everything.
    const double start = glm::dot(back_, center_ - camera.eye) + 1.01 * radius_;
    return {camera.eye + across + start * back_, -back_};
}

std::optional<glm::dvec2> RayReference::place_of(const glm::dvec3& world,
                                                 glm::dvec2 picture_size) const {
    if (!scene_.camera.is_orthographic() && depth_of(world) < near_) return std::nullopt;
    const glm::dvec3 from_eye = world - scene_.camera.eye;
    return 0.5 * picture_size + glm::dvec2(glm::dot(from_eye, right_), -glm::dot(from_eye, up_)) /
                                    pixel_size(world, picture_size);
}

glm::dvec3 RayReference::displaced(const glm::dvec3& world, glm::dvec2 pixels,
                                   glm::dvec2 picture_size) const {
    return world + pixel_size(world, picture_size) * (pixels.x * right_ - pixels.y * up_);
}

double RayReference::pixel_size(const glm::dvec3& world, glm::dvec2 picture_size) const {
    const double at_unit_distance = 2.0 * half_height_ / picture_size.y;
    return scene_.camera.is_orthographic() ? at_unit_distance : depth_of(world) * at_unit_distance;
}

double RayReference::depth_of(const glm::dvec3& world) const {
    return glm::dot(back_, scene_.camera.eye - world);
}

glm::dvec3 RayReference::towards_viewer(const glm::dvec3& world) const {
    return scene_.camera.is_orthographic() ? back_ : scene_.camera.eye - world;
}

glm::dvec3 RayReference::normal(std::size_t instance, FaceId face) const {
    const Triangle& t = scene_.instances[instance].octree->mesh().triangles()[index(face)];
    const glm::dvec3& corner = vertex(instance, t[0]);
    return glm::cross(vertex(instance, t[1]) - corner, vertex(instance, t[2]) - corner);
}

std::optional<SurfacePoint> RayReference::first_surface(const Ray& ray) const {
    const glm::vec3 origin(ray.origin - center_);
    const glm::vec3 direction(ray.direction);
    RTCRayHit found{.ray = {.org_x = origin.x,
                            .org_y = origin.y,
                            .org_z = origin.z,
                            .tnear = static_cast<float>(near_),
                            .dir_x = direction.x,
                            .dir_y = direction.y,
                            .dir_z = direction.z,
                            .tfar = std::numeric_limits<float>::infinity(),
                            .mask = ~0u},
                    .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    tools::find_first(rays_, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    SurfacePoint point{found.hit.geomID, FaceId{found.hit.primID}, {}};
    const Triangle& triangle =
        scene_.instances[point.instance].octree->mesh().triangles()[index(point.face)];
    const glm::dvec3 n = normal(point.instance, point.face);
    const double along =
        glm::dot(n, vertex(point.instance, triangle[0]) - ray.origin) / glm::dot(n, ray.direction);
    point.position = ray.origin + along * ray.direction;
    return point;
}

void RayReference::keep_if_blocking(const RTCFilterFunctionNArguments* arguments) {
    // Embree hands over the context it was given, which is a query's first member.
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    const RayReference& reference = *query.reference;
    const std::size_t instance = RTCHitN_geomID(arguments->hit, arguments->N, 0);
    const FaceId face{RTCHitN_primID(arguments->hit, arguments->N, 0)};
    const auto reject = [&] { arguments->valid[0] = 0; };
    if ((*query.ignored)(instance, face)) return reject();
    const Triangle& t =
        reference.scene_.instances[instance].octree->mesh().triangles()[index(face)];
    const glm::dvec3 n = reference.normal(instance, face);
    const double along = glm::dot(n, reference.vertex(instance, t[0]) - query.ray.origin) /
                         glm::dot(n, query.ray.direction);
    const double touching = k_touching * reference.radius_ / glm::length(query.ray.direction);
    if (!(along > touching && along < query.end)) reject();
}

bool RayReference::is_blocked(Query& query, double end) const {
    query.reference = this;
    query.end = end;
    const double margin = k_margin * radius_ / glm::length(query.ray.direction);
    const glm::vec3 origin(query.ray.origin - margin * query.ray.direction - center_);
    const glm::vec3 direction(query.ray.direction);
    const RTCRay ray{.org_x = origin.x,
                     .org_y = origin.y,
                     .org_z = origin.z,
                     .tnear = 0.0f,
                     .dir_x = direction.x,
                     .dir_y = direction.y,
                     .dir_z = direction.z,
                     .tfar = static_cast<float>(end + 2.0 * margin),
                     .mask = ~0u};
    return tools::is_blocked(rays_, ray, query.context, keep_if_blocking);
}

glm::dvec3 RayReference::towards(const Light& light, const glm::dvec3& world) {
    return light.directional ? glm::normalize(light.vector) : light.vector - world;
}

double RayReference::height(const SurfacePoint& point, const Light& light) const {
    const glm::dvec3 to_light = towards(light, point.position);
    const glm::dvec3 n = normal(point.instance, point.face);
    return glm::dot(n, to_light) / (glm::length(n) * glm::length(to_light));
}

bool RayReference::reaches(const SurfacePoint& point, const Ray& camera_ray,
                           const Light& light) const {
    // The viewer and the light on two sides: the surface itself is between. It is too where the light
    // lies in its plane, whichever side is seen.
    const glm::dvec3 to_light = towards(light, point.position);
    const double over = height(point, light);
    const bool seen_in_front =
        glm::dot(normal(point.instance, point.face), camera_ray.direction) < 0.0;
    if (scene_.instances[point.instance].casts_shadows &&
        (seen_in_front ? over < k_in_plane : over > -k_in_plane))
        return false;
    const Ignored ignored = [&](std::size_t instance, FaceId face) {
        return !scene_.instances[instance].casts_shadows ||
               (instance == point.instance && face == point.face);
    };
    Query query{.context = {},
                .reference = this,
                .ray = {point.position, to_light},
                .end = 0.0,
                .ignored = &ignored};
    return !is_blocked(query, light.directional ? std::numeric_limits<double>::infinity() : 1.0);
}

std::size_t RayReference::lights_at(const SurfacePoint& point, const Ray& camera_ray) const {
    std::size_t count = 0;
    for (const Light& light : scene_.lights) count += reaches(point, camera_ray, light) ? 1 : 0;
    return count;
}

bool RayReference::is_hidden(const glm::dvec3& world, const Ignored& ignored) const {
    Query query{.context = {},
                .reference = this,
                .ray = {world, towards_viewer(world)},
                .end = 0.0,
                .ignored = &ignored};
    if (scene_.camera.is_orthographic())
        return is_blocked(query, std::numeric_limits<double>::infinity());
    return is_blocked(query, 1.0 - near_ / depth_of(world));
}

}  // namespace rimline::tests
