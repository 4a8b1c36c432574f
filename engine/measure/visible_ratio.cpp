#include "engine/measure/visible_ratio.h"
#include "engine/vulkan/commands.h"

#include <algorithm>

namespace rimline {

namespace {

// Viewpoints in a batch at most. More save no time, and leave the GPU idle while the first batch is
// prepared.
constexpr std::uint32_t k_max_views = 16;

// Memory of a viewpoint, in bytes a pixel: 8 for the depth and stencil image, 4 for lines and faces.
constexpr std::uint64_t k_view_bytes_a_pixel = 12;
// One part in so many of a batch's memory is for lines and faces.
constexpr std::uint64_t k_upload_share = 3;

Occluders chosen(Occluders occluders, const DeviceContext& context) {
    if (occluders != Occluders::automatic) return occluders;
    return context.type == VK_PHYSICAL_DEVICE_TYPE_CPU ? Occluders::faces : Occluders::clusters;
}

bool has_queries(const VisibleRatioMethod& method, const DeviceContext& context) noexcept {
    return method.counts_by_query && context.features.occlusion_query_precise;
}

}  // namespace

VisibleRatioPass::VisibleRatioPass(const DeviceContext& context, const HoughOctree& octree,
                                   const VisibleRatioOptions& options, const std::stop_token& stop)
    : context_(context),
      octree_(octree),
      options_(options),
      builder_(octree, options, chosen(options.method.occluders, context), stop),
      drawing_(context, octree.mesh(), builder_.triangles(),
               {.side_px = options.side_px,
                .max_views = k_max_views,
                .has_queries = has_queries(options.method, context),
                .has_separate_targets = options.method.has_separate_targets}),
      timeline_(make_timeline(context, "visible ratios")),
      command_pool_(make_command_pool(context, "visible ratios", context.queue_family)) {
    RIMLINE_CHECK(options.side_px > 0 && options.fov_deg > 0.0 && options.fov_deg < 180.0);
    RIMLINE_CHECK(options.method.has_separate_targets || counts_by_query());
    for (Batch& batch : batches_) batch.commands = make_commands(context, command_pool_);
}

bool VisibleRatioPass::counts_by_query() const noexcept {
    return has_queries(options_.method, context_);
}

// As many as a batch's share of the budget holds, at least 1.
std::size_t VisibleRatioPass::views_a_batch() const noexcept {
    const std::uint64_t view_bytes =
        k_view_bytes_a_pixel * std::uint64_t{options_.side_px} * options_.side_px;
    const std::uint64_t fitting = options_.budget_bytes / batches_.size() / view_bytes;
    return static_cast<std::size_t>(std::clamp<std::uint64_t>(fitting, 1, k_max_views));
}

// Builds the views of a batch from the first of `eyes`, at least one. Returns how many of them the batch's
// memory holds.
std::size_t VisibleRatioPass::build_views(std::span<const glm::dvec3> eyes) {
    const std::size_t count = std::min(eyes.size(), views_a_batch());
    views_.resize(std::max(views_.size(), count));
    builder_.build(eyes.first(count), std::span(views_).first(count));
    const std::uint64_t max_bytes = options_.budget_bytes / batches_.size() / k_upload_share;
    std::uint64_t upload_bytes = views_[0].upload_bytes();
    for (std::size_t v = 1; v < count; ++v) {
        upload_bytes += views_[v].upload_bytes();
        if (upload_bytes > max_bytes) return v;
    }
    return count;
}

// Prepares and submits views from the first of `eyes`: at least one. Returns how many.
std::size_t VisibleRatioPass::submit(Batch& batch, std::span<const glm::dvec3> eyes,
                                     bool keeps_stencil) {
    const auto views = std::span<const RatioView>(views_.data(), build_views(eyes));
    drawing_.prepare(batch.targets, views, keeps_stencil);
    for (const RatioView& view : views) {
        work_.lines += view.lines.size();
        if (view.copied_faces.empty())
            for (const IndexRun& run : view.faces) work_.faces += run.count / 3;
        work_.faces += view.copied_faces.size();
    }
    const Commands commands = begin_commands(context_, batch.commands);
    drawing_.record(commands, batch.targets, views, keeps_stencil);
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    enqueue(batch);
    batch.view_count = views.size();
    return views.size();
}

void VisibleRatioPass::enqueue(Batch& batch) {
    submit_commands(context_, {.queue = context_.queue,
                               .commands = batch.commands,
                               .signal = SemaphorePoint{timeline_, submitted_ + 1}});
    batch.end = ++submitted_;
}

void VisibleRatioPass::wait_for(const Batch& batch) const {
    wait_for_timeline(context_, timeline_, batch.end);
}

// Waits for the batch and writes its results into the ratios of all viewpoints.
void VisibleRatioPass::finish(Batch& batch, std::span<VisibleRatio> ratios) const {
    wait_for(batch);
    ratios = ratios.subspan(batch.first_view, batch.view_count);
    if (counts_by_query()) {
        std::array<std::uint32_t, 2 * k_max_views> counts{};
        batch.targets.queries.read(std::span(counts).first(2 * batch.view_count));
        for (std::size_t v = 0; v < ratios.size(); ++v)
            ratios[v] = {.visible_pixels = counts[2 * v], .total_pixels = counts[2 * v + 1]};
    } else {
        const std::size_t pixels = std::size_t{options_.side_px} * options_.side_px;
        const auto* stencil =
            reinterpret_cast<const std::uint8_t*>(batch.targets.stencils.mapped());
        for (VisibleRatio& ratio : ratios) {
            ratio = {};
            for (const std::uint8_t value : std::span(stencil, pixels)) {
                ratio.total_pixels += value != k_stencil_nothing;
                ratio.visible_pixels += value == k_stencil_visible;
            }
            stencil += drawing_.stencil_stride();
        }
    }
    batch.view_count = 0;
}

std::vector<VisibleRatio> VisibleRatioPass::measure(std::span<const glm::dvec3> eyes,
                                                    const LongCall& call) {
    work_ = {};
    std::vector<VisibleRatio> ratios(eyes.size());
    if (octree_.mesh().edge_count() == 0) return ratios;

    // However this call ends, nothing of it is in progress when it returns.
    struct Finisher {
        VisibleRatioPass& pass;
        ~Finisher() {
            for (Batch& batch : pass.batches_) {
                if (batch.end > 0) try {
                        pass.wait_for(batch);
                    } catch (const Error&) {
                        // A lost device runs nothing any more.
                    }
                batch.view_count = 0;
            }
        }
    } const finisher{*this};
    std::size_t begun = 0;
    for (std::size_t b = 0; begun < eyes.size(); b = 1 - b) {
        call.checkpoint(double(begun) / double(eyes.size()));
        Batch& batch = batches_[b];
        if (batch.view_count > 0) finish(batch, ratios);
        batch.first_view = begun;
        begun += submit(batch, eyes.subspan(begun), !counts_by_query());
    }
    for (Batch& batch : batches_)
        if (batch.view_count > 0) finish(batch, ratios);
    call.checkpoint(1.0);
    return ratios;
}

std::vector<LinePixel> VisibleRatioPass::mask(const glm::dvec3& eye) {
    const std::size_t pixels = std::size_t{options_.side_px} * options_.side_px;
    std::vector<LinePixel> mask(pixels, LinePixel::none);
    if (octree_.mesh().edge_count() == 0) return mask;
    Batch& batch = batches_[0];
    submit(batch, {&eye, 1}, true);
    batch.view_count = 0;
    wait_for(batch);
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto value = static_cast<std::uint8_t>(batch.targets.stencils.mapped()[i]);
        if (value != k_stencil_nothing)
            mask[i] = value == k_stencil_visible ? LinePixel::visible : LinePixel::hidden;
    }
    return mask;
}

}  // namespace rimline
