#include "engine/passes/line_path_choice.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include "engine/frame/draw_data.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/line_pass.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

TEST_CASE("by default lines are pulled on every GPU, and made by a geometry shader on the CPU") {
    for (const bool has_geometry_shader : {true, false}) {
        for (const VkPhysicalDeviceType gpu :
             {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
              VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER})
            CHECK(choose_line_path(LinePath::automatic, gpu, has_geometry_shader) ==
                  LinePath::pulling);
        CHECK(choose_line_path(LinePath::automatic, VK_PHYSICAL_DEVICE_TYPE_CPU,
                               has_geometry_shader) ==
              (has_geometry_shader ? LinePath::geometry : LinePath::pulling));
    }
}

TEST_CASE("a path that is asked for is taken on every device that can draw it") {
    for (const VkPhysicalDeviceType type :
         {VK_PHYSICAL_DEVICE_TYPE_CPU, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU}) {
        for (const LinePath path : {LinePath::geometry, LinePath::pulling, LinePath::all_edges,
                                    LinePath::quads, LinePath::adjacency})
            CHECK(choose_line_path(path, type, true) == path);
        CHECK(choose_line_path(LinePath::pulling, type, false) == LinePath::pulling);
        CHECK(choose_line_path(LinePath::quads, type, false) == LinePath::quads);
        CHECK(choose_line_path(LinePath::geometry, type, false) == LinePath::pulling);
        CHECK_THROWS_AS(choose_line_path(LinePath::all_edges, type, false), Error);
        CHECK_THROWS_AS(choose_line_path(LinePath::adjacency, type, false), Error);
    }
}

TEST_CASE("the pass of lines takes the default of its device's type") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext context = gpu->context();
    const DrawData data(context, 1);
    context.type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    CHECK(LinePass(context, data.layout(), k_surface_format).path() == LinePath::pulling);
    context.type = VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (context.features.geometry_shader)
        CHECK(LinePass(context, data.layout(), k_surface_format).path() == LinePath::geometry);
}

}  // namespace
}  // namespace rimline
