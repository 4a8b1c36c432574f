#include "tools/bench/sample_tests.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/frame/drawn_rect.h"
#include "engine/frame/frame_view.h"
#include "engine/frame/render_targets.h"
#include "engine/frame/scene_data.h"
#include "engine/frame/silhouette_points.h"
#include "engine/renderer.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/rounded_to_float.h"

namespace rimline::tools {

namespace {

// Depths are read only after the frame.
std::vector<float> depths_of(const DeviceContext& context, const Image& image) {
    const VkExtent2D extent = image.description().extent;
    const std::size_t pixels = std::size_t{extent.width} * extent.height;
    const Buffer buffer(context, pixels * sizeof(float), BufferPlace::readback, "depths");
    run_commands(context, [&](Commands commands) {
        record_barrier(commands,
                       {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
                       {{image, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL}});
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                                       .imageExtent = {extent.width, extent.height, 1}};
        commands->CmdCopyImageToBuffer(commands, image.handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.handle(), 1,
                                       &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    const auto* values = reinterpret_cast<const float*>(buffer.mapped());
    return {values, values + pixels};
}

// Rasterizes the volumes of one caster.
class Counter {
public:
    Counter(const FrameView& view, const VkRect2D& drawn, std::span<const float> depths,
            SampleTests& tests)
        : view_(view), drawn_(drawn), depths_(depths), tests_(tests) {}

    void count(const ShadowReport& shadow) {
        const SceneInstance& instance = view_.scene.instances[shadow.instance];
        const Mesh& mesh = instance.mesh();
        reach_ = shadow.reach;
        point_ = view_.instances[shadow.instance].lights[shadow.light].point;
        camera_ = rounded_to_float(point_in_object(instance, view_.scene.camera.eye));
        eye_from_object_ = glm::dmat3(glm::mat3(view_.eye_from_world * instance.rotation));
        extrusion_ =
            view_.projection.is_orthographic()
                ? finite_extrusion(view_.scene.lights[shadow.light], instance, view_.bounds)
                : 0.0;
        const bool single = shadow.choice.form == ShadowForm::single;
        ends_in_one_point_ = shadow.choice.ends_in_one_point;
        const auto is_front_face = [&](FaceId face) { return is_front(mesh.plane(face), point_); };
        if (shadow.choice.method == ShadowMethod::fail)
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
                if (single && !is_front_face(FaceId{f})) continue;
                const auto corner = [&](std::size_t c) {
                    return mesh.positions()[index(mesh.triangles()[f][c])];
                };
                triangle({near(corner(0)), near(corner(1)), near(corner(2))}, 1);
                if (!ends_in_one_point_)
                    triangle({far(corner(0)), far(corner(1)), far(corner(2))}, 1);
            }
        const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
            int times = 0;
            if (e < regular_end) {
                const auto& [f0, f1] = mesh.edge(EdgeId{e}).faces;
                if (is_front_face(f0) != is_front_face(f1)) times = single ? 1 : 2;
            } else {
                for (const FaceId face : mesh.faces_of(EdgeId{e}))
                    times += !single || is_front_face(face) ? 1 : 0;
            }
            if (times == 0) continue;
            const auto& [v0, v1] = mesh.edge(EdgeId{e}).vertices;
            const glm::vec3 a = mesh.positions()[index(v0)];
            const glm::vec3 b = mesh.positions()[index(v1)];
            triangle({near(b), near(a), far(b)}, times);
            if (!ends_in_one_point_) triangle({near(a), far(a), far(b)}, times);
        }
    }

private:
    glm::dvec4 clip(const glm::dvec3& object, double weight) const {
        const Projection& p = view_.projection;
        const glm::dvec3 eye = eye_from_object_ * object;
        const double w = p.w[0] * eye.z + p.w[1] * weight;
        return {p.scale * glm::dvec2(eye) + p.shift * w, p.z[0] * eye.z + p.z[1] * weight, w};
    }
    glm::dvec4 near(const glm::vec3& position) const {
        return clip(glm::dvec3(position) - camera_, 1.0);
    }
    glm::dvec4 far(const glm::vec3& position) const {
        const double w = point_.w;
        const glm::dvec3 light(point_.xyz());
        if (ends_in_one_point_) return clip(camera_ * w - light, -w);
        const glm::dvec3 away = glm::dvec3(position) * w - light;
        return extrusion_ == 0.0 ? clip(away, 0.0)
                                 : clip(glm::dvec3(position) - camera_ + extrusion_ * away, 1.0);
    }

    void triangle(const std::array<glm::dvec4, 3>& corners, int times) {
        // Clipped at the near plane in perspective: w - z >= 0. A little more, so that w is positive.
        std::array<glm::dvec4, 4> polygon;
        std::size_t count = 0;
        const auto before = [&](const glm::dvec4& corner) {
            return view_.projection.is_orthographic() ? 1.0 : corner.w - corner.z - 1e-12;
        };
        for (std::size_t c = 0; c < 3; ++c) {
            const glm::dvec4& a = corners[c];
            const glm::dvec4& b = corners[(c + 1) % 3];
            const double before_a = before(a);
            const double before_b = before(b);
            if (before_a > 0.0) polygon[count++] = a;
            if ((before_a > 0.0) != (before_b > 0.0))
                polygon[count++] = a + before_a / (before_a - before_b) * (b - a);
        }
        if (count < 3) return;
        std::array<glm::dvec3, 4> places;
        for (std::size_t c = 0; c < count; ++c) {
            const glm::dvec3 ndc = glm::dvec3(polygon[c]) / polygon[c].w;
            places[c] = {(0.5 * ndc.x + 0.5) * view_.size.width,
                         (0.5 * ndc.y + 0.5) * view_.size.height, ndc.z};
        }
        rasterize(std::span(places).first(count), times);
    }

    // A convex polygon, in pixels and depth.
    void rasterize(std::span<const glm::dvec3> places, int times) {
        const glm::dvec3 u = places[1] - places[0];
        const glm::dvec3 v = places.back() - places[0];
        const double area = u.x * v.y - u.y * v.x;
        const glm::dvec2 slope =
            area == 0.0 ? glm::dvec2(0.0)
                        : glm::dvec2(u.z * v.y - u.y * v.z, u.x * v.z - u.z * v.x) / area;
        double top = places[0].y;
        double bottom = top;
        for (const glm::dvec3& place : places) {
            top = std::min(top, place.y);
            bottom = std::max(bottom, place.y);
        }
        const auto first_row = static_cast<std::int64_t>(
            std::ceil(std::clamp(top - 0.5, double(drawn_.offset.y), 1e6)));
        const auto end_row = static_cast<std::int64_t>(std::ceil(
            std::clamp(bottom - 0.5, -1.0, double(drawn_.offset.y) + drawn_.extent.height)));
        for (std::int64_t row = first_row; row < end_row; ++row) {
            const double y = static_cast<double>(row) + 0.5;
            double left = 1e30;
            double right = -1e30;
            for (std::size_t c = 0; c < places.size(); ++c) {
                const glm::dvec3& a = places[c];
                const glm::dvec3& b = places[(c + 1) % places.size()];
                if ((a.y <= y) == (b.y <= y)) continue;
                const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                left = std::min(left, x);
                right = std::max(right, x);
            }
            const auto first = static_cast<std::int64_t>(
                std::ceil(std::clamp(left - 0.5, double(drawn_.offset.x), 1e6)));
            const auto end = static_cast<std::int64_t>(std::ceil(
                std::clamp(right - 0.5, -1.0, double(drawn_.offset.x) + drawn_.extent.width)));
            for (std::int64_t x = first; x < end; ++x)
                sample(x, row,
                       places[0].z + slope.x * (static_cast<double>(x) + 0.5 - places[0].x) +
                           slope.y * (y - places[0].y),
                       times);
        }
    }

    void sample(std::int64_t x, std::int64_t y, double depth, int times) {
        tests_.drawn_area += times;
        if (x < reach_.x || x >= reach_.x + std::int64_t{reach_.width} || y < reach_.y ||
            y >= reach_.y + std::int64_t{reach_.height})
            return;
        tests_.rectangle += times;
        if (depth >= double{reach_.min_depth}) tests_.ended += times;
        const float surface =
            depths_[static_cast<std::size_t>(y) * view_.size.width + static_cast<std::size_t>(x)];
        if (surface >= reach_.min_depth && surface <= reach_.max_depth) tests_.depth += times;
    }

    const FrameView& view_;
    VkRect2D drawn_;
    std::span<const float> depths_;
    SampleTests& tests_;
    ShadowReach reach_;
    HomogeneousPoint point_{};
    glm::dvec3 camera_{0.0};
    glm::dmat3 eye_from_object_{1.0};
    double extrusion_ = 0.0;
    bool ends_in_one_point_ = false;
};

}  // namespace

SampleTests count_sample_tests(const DeviceContext& context, const Scene& scene,
                               std::uint32_t width, std::uint32_t height) {
    Renderer renderer(context, {.samples = 1, .scale = 1});
    renderer.render(scene, width, height);
    const std::vector<float> depths = depths_of(context, renderer.targets()->depth());
    CasterMeshes casters;
    for (const SceneInstance& instance : scene.instances)
        casters.try_emplace(&instance.mesh(), instance.mesh());
    const FrameView view(scene, {width, height}, casters);
    SampleTests tests;
    Counter counter(view, drawn_rect(view), depths, tests);
    for (const ShadowReport& shadow : renderer.report().shadows) counter.count(shadow);
    return tests;
}

}  // namespace rimline::tools
