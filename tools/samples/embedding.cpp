// Rimline inside an existing renderer, which creates instance, device, queue, images and command buffer with
// plain Vulkan (foreign_renderer.h), and draws first: a sky, a ground and a knot, flat and without lines or
// shadows. Rimline records its frame into the same command buffer: the lines of the knot, its shadow on itself
// and on the ground, and a ring of its own that winds through it. A compute shader of the renderer then reads
// the silhouette that Rimline keeps on the GPU.
//
//     embedding [PICTURE.png]
//
// Exit 0 if the shader reads the right silhouette, and the picture has what both have drawn.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <vector>

#include "engine/renderer.h"
#include "engine/vulkan/device_context.h"
#include "sample_count_comp.h"
#include "sample_surface_frag.h"
#include "sample_surface_vert.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"
#include "silhouette/picture.h"
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

// The renderer's own matrices, as it has them in its shaders: depth 0 is near, y goes down.
struct View {
    glm::dmat4 camera_from_world;
    glm::dmat4 clip_from_camera;
};

View view_at(double turn) {
    constexpr double k_near = 0.1, k_far = 50.0;
    const VkExtent2D extent = samples::ForeignRenderer::k_extent;
    View view{glm::lookAt(glm::dvec3(5.5 * std::sin(turn), 2.2, 5.5 * std::cos(turn)),
                          glm::dvec3(0.0, -0.2, 0.0), glm::dvec3(0.0, 1.0, 0.0)),
              glm::dmat4(0.0)};
    const double focal = 1.0 / std::tan(0.5 * glm::radians(42.0));
    view.clip_from_camera[0][0] = focal * extent.height / extent.width;
    view.clip_from_camera[1][1] = -focal;
    view.clip_from_camera[2][2] = k_far / (k_near - k_far);
    view.clip_from_camera[3][2] = k_far * k_near / (k_near - k_far);
    view.clip_from_camera[2][3] = -1.0;
    return view;
}

using Corners = std::array<glm::vec3, 65536>;

std::uint32_t put_corners(const Mesh& mesh, std::span<glm::vec3> corners) {
    std::size_t count = 0;
    for (const Triangle& triangle : mesh.triangles())
        for (const VertexId vertex : triangle) corners[count++] = mesh.positions()[index(vertex)];
    return static_cast<std::uint32_t>(count);
}

// What the renderer draws by itself.
struct Surface {
    samples::SharedBuffer<Corners> corners;
    std::uint32_t corner_count;
    std::array<float, 4> color;
};

void draw_surface(const samples::SurfacePipeline& pipeline, VkCommandBuffer commands,
                  const Surface& surface, const View& view) {
    const glm::mat4 clip_from_world(view.clip_from_camera * view.camera_from_world);
    samples::SurfacePipeline::Constants constants{
        .clip_from_world = {}, .color = surface.color, .corners = surface.corners.address()};
    std::copy_n(&clip_from_world[0][0], 16, constants.clip_from_world.begin());
    pipeline.draw(commands, surface.corner_count, constants);
}

constexpr std::size_t k_pixel_count = std::size_t{samples::ForeignRenderer::k_extent.width} *
                                      samples::ForeignRenderer::k_extent.height;
using Pixels = std::array<std::array<std::uint8_t, 4>, k_pixel_count>;  // Blue, green, red, alpha.

Picture picture_of(const Pixels& pixels) {
    const VkExtent2D extent = samples::ForeignRenderer::k_extent;
    Picture picture{.width = extent.width, .height = extent.height, .rgba = {}};
    for (const auto& [blue, green, red, alpha] : pixels)
        picture.rgba.insert(picture.rgba.end(), {red, green, blue, alpha});
    return picture;
}

// A share of the pixels has the color, given as linear light.
void require_color(const Pixels& pixels, const glm::vec3& linear, const char* what) {
    const auto encoded = [](float channel) {
        return channel <= 0.0031308f ? 12.92f * channel
                                     : 1.055f * std::pow(channel, 1.0f / 2.4f) - 0.055f;
    };
    const auto count = std::ranges::count_if(pixels, [&](const std::array<std::uint8_t, 4>& pixel) {
        for (int channel = 0; channel < 3; ++channel)
            if (std::abs(float(pixel[std::size_t(2 - channel)]) -
                         255.0f * encoded(linear[channel])) > 1.5f)
                return false;
        return true;
    });
    if (count < 300) throw Error(ErrorCode::io, std::string("the picture has no ") + what);
}

void run(const char* picture_path) {
    samples::ForeignRenderer foreign;
    const DeviceContext context = make_device_context({.instance = foreign.instance,
                                                       .physical_device = foreign.physical_device,
                                                       .device = foreign.device,
                                                       .queue = foreign.queue,
                                                       .queue_family = 0,
                                                       .features = {.geometry_shader = true},
                                                       .loader = vkGetInstanceProcAddr});
    const samples::SharedBuffer<Counted> result(foreign);
    const samples::SharedBuffer<Pixels> pixels(foreign);
    const samples::ComputePipeline count(foreign, sample_count_comp, sizeof(Constants));
    const samples::SurfacePipeline surfaces(foreign, sample_surface_vert, sample_surface_frag);

    constexpr std::array<float, 4> k_sky{0.35f, 0.45f, 0.65f, 1.0f};
    constexpr std::array<float, 4> k_ground_color{0.5f, 0.5f, 0.4f, 1.0f};
    constexpr std::array<float, 4> k_knot_color{0.8f, 0.55f, 0.2f, 1.0f};
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    Surface knot{samples::SharedBuffer<Corners>(foreign), 0, k_knot_color};
    knot.corner_count = put_corners(mesh, knot.corners.content());
    Surface ground{samples::SharedBuffer<Corners>(foreign), 6, k_ground_color};
    constexpr float k_side = 4.0f, k_height = -1.4f;
    for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t corner = i < 3 ? i : 6 - i;  // 0 1 2, 3 2 1
        ground.corners.content()[i] = {(corner & 1) != 0 ? k_side : -k_side, k_height,
                                       (corner & 2) != 0 ? k_side : -k_side};
    }

    const HoughOctree octree(mesh);
    const Mesh ring(make_built_in_shape("torus", 5'000));
    const HoughOctree ring_octree(ring);
    Scene scene{.camera = {}, .palette = {.ink = glm::vec3(0.1f, 0.0f, 0.3f)}};
    // The renderer has drawn the knot: Rimline adds lines and shadows.
    scene.instances.push_back(
        {.octree = &octree, .name = "knot", .has_surfaces = false, .is_solid = is_solid(mesh)});
    scene.instances.push_back({.octree = &ring_octree,
                               .name = "ring",
                               .translation = {0.9, 0.2, 0.0},
                               .material = {.color = {0.2f, 0.6f, 0.5f}},
                               .is_solid = true});
    scene.lights.push_back({.vector = {1, 2, 1}});
    Renderer renderer(context, {.samples = 1});
    for (int frame = 0; frame < 5; ++frame) {
        const View view = view_at(0.05 * frame);
        scene.camera = camera_of(view.camera_from_world, view.clip_from_camera);
        result.content() = {};
        const PictureTarget target{
            .image = foreign.color.image,
            .view = foreign.color.view,
            .format = foreign.k_format,
            .extent = foreign.k_extent,
            .initial_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
            .use = PictureUse::over,
            .backdrop = BackdropDepth{.image = foreign.depth.image,
                                      .view = foreign.depth.view,
                                      .format = foreign.k_depth_format,
                                      .layout = VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL}};
        const UploadPoint uploaded = renderer.prepare(scene, target);
        const VkCommandBuffer commands = foreign.begin_frame();
        foreign.begin_surfaces(k_sky);
        draw_surface(surfaces, commands, ground, view);
        draw_surface(surfaces, commands, knot, view);
        foreign.end_surfaces();
        renderer.record(commands, scene, target);
        foreign.copy_picture(pixels.handle());
        const SilhouetteBuffers silhouette = renderer.silhouette(0, std::nullopt).value();
        const Constants constants{silhouette.slots.address,      silhouette.face_words.address,
                                  silhouette.arguments.address,  result.address(),
                                  (mesh.face_count() + 31) / 32, 0};
        count.dispatch(commands, 4, &constants, sizeof constants);
        // Submits, after what was uploaded, and waits for the results.
        foreign.end_frame(uploaded.timeline, uploaded.value);
        const Counted& counted = result.content();
        if (!(counted == expected_from(mesh, silhouette.point)))
            throw Error(ErrorCode::io, "not the silhouette");
        std::printf("frame %d: %u silhouette edges, %u front faces\n", frame, counted.edges,
                    counted.front_faces);
        const auto rgb = [](const std::array<float, 4>& c) { return glm::vec3(c[0], c[1], c[2]); };
        // The shadow leaves half of what the renderer has drawn.
        require_color(pixels.content(), rgb(k_sky), "sky");
        require_color(pixels.content(), rgb(k_ground_color), "ground");
        require_color(pixels.content(), 0.5f * rgb(k_ground_color), "shadow on the ground");
        require_color(pixels.content(), rgb(k_knot_color), "knot");
        require_color(pixels.content(), 0.5f * rgb(k_knot_color), "shadow on the knot");
        require_color(pixels.content(), scene.palette.ink, "lines");
        require_color(pixels.content(), scene.instances[1].material.color, "ring");
    }
    if (picture_path != nullptr) {
        const std::vector<std::byte> png = encode_png(picture_of(pixels.content()));
        std::ofstream file(picture_path, std::ios::binary);
        file.write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
        file.close();
        if (!file) throw Error(ErrorCode::io, std::string(picture_path) + ": cannot write");
    }
}

}  // namespace

int main(int argument_count, char** arguments) {
    try {
        run(argument_count > 1 ? arguments[1] : nullptr);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "embedding: %s\n", error.what());
        return 1;
    }
}
