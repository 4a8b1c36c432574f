// Rimline inside an existing renderer, which creates instance, device, queue, image and command buffer with
// plain Vulkan (foreign_renderer.h). Rimline records a frame into the renderer's command buffer. A compute
// shader of the renderer then reads the silhouette that Rimline keeps on the GPU. Exit 0 if the shader reads
// the right one.

#include <bit>
#include <cstdio>

#include "engine/renderer.h"
#include "engine/vulkan/device_context.h"
#include "sample_count_comp.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"
#include "tools/samples/foreign_renderer.h"

namespace {

using namespace rimline;

// The push constants of the renderer's shader (sample_count.comp).
struct Constants {
    VkDeviceAddress slots, face_words, arguments, result;
    std::uint32_t word_count, padding;
};
struct Counted {
    std::uint32_t edges, edge_number_sum, front_faces;
    bool operator==(const Counted&) const = default;
};

// The expected result.
Counted expected_from(const Mesh& mesh, const HomogeneousPoint& point) {
    Counted counted{};
    for (const EdgeId edge : brute_force_silhouette(mesh, point)) {
        ++counted.edges;
        counted.edge_number_sum += index(edge);
    }
    for (const std::uint32_t word : brute_force_face_bits(mesh, point))
        counted.front_faces += static_cast<std::uint32_t>(std::popcount(word));
    return counted;
}

void run() {
    samples::ForeignRenderer foreign;
    const DeviceContext context = make_device_context({.instance = foreign.instance,
                                                       .physical_device = foreign.physical_device,
                                                       .device = foreign.device,
                                                       .queue = foreign.queue,
                                                       .queue_family = 0,
                                                       .features = {.geometry_shader = true},
                                                       .loader = vkGetInstanceProcAddr});
    const samples::SharedBuffer<Counted> result(foreign);
    const samples::ComputePipeline count(foreign, sample_count_comp, sizeof(Constants));

    const Mesh mesh(make_built_in_shape("knot", 20'000));
    const HoughOctree octree(mesh);
    Scene scene{.camera = {.eye = {0, 1, 5}}};
    scene.instances.push_back(
        {.octree = &octree,
         .name = "knot",
         .material = {.color = {0.9f, 0.8f, 0.6f}, .line_color = glm::vec3(0.1f, 0.0f, 0.3f)},
         .is_solid = is_solid(mesh)});
    scene.lights.push_back({.vector = {1, 2, 1}});
    Renderer renderer(context);
    for (int frame = 0; frame < 5; ++frame) {
        scene.camera.eye.x = 0.05 * frame;
        result.content() = {};
        const PictureTarget target{.image = foreign.image,
                                   .view = foreign.view,
                                   .format = foreign.k_format,
                                   .extent = foreign.k_extent};
        const UploadPoint uploaded = renderer.prepare(scene, target);
        const VkCommandBuffer commands = foreign.begin_frame();
        renderer.record(commands, scene, target);
        const SilhouetteBuffers silhouette = renderer.silhouette(0, std::nullopt).value();
        const Constants constants{
            silhouette.slots, silhouette.face_words,         silhouette.arguments,
            result.address(), (mesh.face_count() + 31) / 32, 0};
        count.dispatch(commands, 4, &constants, sizeof constants);
        // Submits, after what was uploaded, and waits for the result.
        foreign.end_frame(uploaded.timeline, uploaded.value);
        const Counted& counted = result.content();
        if (!(counted == expected_from(mesh, silhouette.point)))
            throw Error(ErrorCode::io, "not the silhouette");
        std::printf("frame %d: %u silhouette edges, %u front faces\n", frame, counted.edges,
                    counted.front_faces);
    }
}

}  // namespace

int main() {
    try {
        run();
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "embedding: %s\n", error.what());
        return 1;
    }
}
