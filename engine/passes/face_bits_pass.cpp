#include "engine/passes/face_bits_pass.h"

#include <random>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/rounding.h"
#include "face_bits_comp.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

struct Constants {
    VkDeviceAddress planes;
    VkDeviceAddress words;
    HomogeneousPoint point;
    std::uint32_t face_count;
    std::uint32_t padding;
};
static_assert(sizeof(Constants) == 40);

constexpr std::uint32_t k_group_size = 64;  // As in shaders/face_bits.comp.

// Planes that pass `point` at the distance of a rounding error: the sign of each depends on how the sum is
// rounded. The output of std::mt19937 is fixed by the standard; that of distributions is not.
std::vector<Plane> near_degenerate_planes(const HomogeneousPoint& point, std::uint32_t count) {
    std::mt19937 random(20051121);
    const auto unit = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; };
    std::vector<Plane> planes;
    for (std::uint32_t i = 0; i < count; ++i) {
        Plane plane{unit(), unit(), unit(), 0.0f};
        const float side = (plane.nx * point.x + plane.ny * point.y) + plane.nz * point.z;
        const auto ulps = static_cast<float>(static_cast<int>(random() % 5) - 2);
        plane.d = side + ulps * std::abs(side) * 0x1p-23f;
        planes.push_back(plane);
    }
    return planes;
}

}  // namespace

FaceBitsPass::FaceBitsPass(const DeviceContext& context)
    : context_(context),
      layout_(make_pipeline_layout(context, "face bits", sizeof(Constants),
                                   VK_SHADER_STAGE_COMPUTE_BIT)),
      pipeline_((require_round_to_nearest(context, "computing face bits"),
                 make_compute_pipeline(context, "face bits", face_bits_comp, layout_))) {}

std::vector<std::uint32_t> FaceBitsPass::compute(std::span<const Plane> planes,
                                                 const HomogeneousPoint& point) {
    const auto face_count = static_cast<std::uint32_t>(planes.size());
    std::vector<std::uint32_t> words(face_word_count(face_count));
    const Buffer plane_buffer = upload_buffer(context_, planes, "planes");
    const Buffer word_buffer(context_, words.size() * 4, BufferPlace::device, "face bits");
    const Constants constants{plane_buffer.address(), word_buffer.address(), point, face_count, 0};
    run_commands(context_, [&](Commands commands) {
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   sizeof constants, &constants);
        commands->CmdDispatch(
            commands, units_of(static_cast<std::uint32_t>(words.size()), k_group_size), 1, 1);
    });
    read_buffer(context_, word_buffer, std::as_writable_bytes(std::span(words)));
    return words;
}

bool test_face_bits(const DeviceContext& context) {
    FaceBitsPass pass(context);
    const std::array points{HomogeneousPoint::viewpoint({0.7310586f, -0.3132617f, 1.3132617f}),
                            HomogeneousPoint::direction({-1.7182818f, 0.5772157f, 0.1234567f})};
    for (const HomogeneousPoint& point : points) {
        const std::vector<Plane> planes = near_degenerate_planes(point, 4096);
        const std::vector<std::uint32_t> words = pass.compute(planes, point);
        for (std::uint32_t f = 0; f < planes.size(); ++f)
            if (face_bit(words, FaceId{f}) != is_front(planes[f], point)) return false;
    }
    return true;
}

}  // namespace rimline
