#include "engine/frame/frame_passes.h"

#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <utility>

#include "engine/frame/drawn_rect.h"
#include "engine/frame/scene_data.h"
#include "engine/frame/silhouette_points.h"
#include "engine/vulkan/conditional_commands.h"
#include "engine/vulkan/debug_names.h"

namespace rimline {

namespace {

AttachmentFormats surface_formats(std::uint32_t samples) {
    return {k_surface_format, k_depth_stencil_format, samples};
}

// The part of the picture to draw: without the background around the scene, unless a grid is drawn on it, or a
// shadow may fall on a backdrop.
DrawnArea drawn_area(const FrameView& view, const PictureTarget& target) {
    const Scene& scene = view.scene;
    if (target.backdrop && scene.shadows && !scene.lights.empty())
        return DrawnArea::whole(target.extent);
    if (target.use != PictureUse::whole) return {drawn_rect(view), {}};
    const Palette& palette = scene.palette;
    const auto around = composite_of(palette.background, target.format);
    if (!around || palette.grid_strength > 0.0f) return DrawnArea::whole(target.extent);
    return {drawn_rect(view), *around};
}

// By so many pixels on each side.
void widen(DrawnArea& area, std::int32_t pixels, VkExtent2D extent) {
    const auto width = static_cast<std::int32_t>(extent.width);
    const auto height = static_cast<std::int32_t>(extent.height);
    const VkRect2D rect = area.rect;
    const std::int32_t left = std::max(rect.offset.x - pixels, 0);
    const std::int32_t top = std::max(rect.offset.y - pixels, 0);
    const std::int32_t right =
        std::min(rect.offset.x + static_cast<std::int32_t>(rect.extent.width) + pixels, width);
    const std::int32_t bottom =
        std::min(rect.offset.y + static_cast<std::int32_t>(rect.extent.height) + pixels, height);
    area.rect = {
        {left, top},
        {static_cast<std::uint32_t>(right - left), static_cast<std::uint32_t>(bottom - top)}};
}

// The map from depths of a backdrop to those of the surfaces. Both are linear on the screen, so one is a linear
// function of the other.
BackdropMap backdrop_map(const FrameView& view, VkFormat format) {
    // A few times the rounding of another renderer's transforms and interpolation.
    constexpr double k_relative_slack = 1e-5;
    constexpr double k_steps_slack = 4.0;
    const Projection& ours = view.projection;
    const Projection& theirs = view.scene.camera.projection.value_or(ours);
    const bool is_orthographic = ours.is_orthographic();
    const double scale = is_orthographic ? ours.z[0] / theirs.z[0] : ours.z[1] / theirs.z[1];
    const double offset = is_orthographic ? ours.z[1] - theirs.z[1] * scale : theirs.z[0] * scale;
    // The steps of a float are proportional to it. So only depths that are 1 far away have steps of one size.
    const bool has_steps = format != VK_FORMAT_D32_SFLOAT && format != VK_FORMAT_D32_SFLOAT_S8_UINT;
    const bool is_short = format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_D16_UNORM_S8_UINT;
    const double step = has_steps || scale < 0.0 ? (is_short ? 0x1p-16 : 0x1p-24) : 0.0;
    const double slack = k_steps_slack * step * std::abs(scale);
    return {
        .scale = static_cast<float>(scale),
        .offset = static_cast<float>(offset),
        .far = scale > 0.0 ? 0.0f : 1.0f,
        .relative_slack = is_orthographic ? 0.0f : static_cast<float>(k_relative_slack),
        .absolute_slack = static_cast<float>(slack + (is_orthographic ? k_relative_slack : 0.0))};
}

}  // namespace

FramePasses::FramePasses(const DeviceContext& context, const RendererOptions& options,
                         VkDescriptorSetLayout draw_data)
    : context_(context),
      sampling_(sampling_of(context, options.samples, options.scale)),
      keeps_stencil_(options.keeps_stencil),
      outline_(options.outline),
      surface_pass_(context, draw_data, surface_formats(sampling_.samples)),
      shadow_pass_(context, draw_data, surface_formats(sampling_.samples), options.shadow_sides),
      shadow_color_pass_(context, surface_formats(sampling_.samples)),
      line_pass_(context, draw_data, k_surface_format, options.line_path),
      ink_pass_(context, k_surface_format),
      backdrop_pass_(context, surface_formats(sampling_.samples), options.frames_in_flight),
      composite_pass_(context) {
    if (outline_.method == OutlineMethod::sobel) {
        shape_pass_.emplace(context, draw_data,
                            AttachmentFormats{k_shape_format, k_depth_stencil_format, 1});
        sobel_pass_.emplace(context, draw_data, k_surface_format);
    }
    if (outline_.method == OutlineMethod::backs)
        back_pass_.emplace(context, draw_data, surface_formats(sampling_.samples));
}

std::uint32_t FramePasses::scale_for(const PictureTarget& target) const {
    return fitting_scale(context_, target.extent, target.backdrop ? 1 : sampling_.scale,
                         sampling_.samples, has_shadow_colors());
}

CompositeKind FramePasses::composite_kind(const Scene& scene, const PictureTarget& target) const {
    return {target.format, targets_->scale(), target.use, is_layer(scene, target)};
}

bool FramePasses::has_targets_for(const Scene& scene, const PictureTarget& target) const {
    return targets_ && targets_->size().width == target.extent.width &&
           targets_->size().height == target.extent.height &&
           targets_->scale() == scale_for(target) &&
           (targets_->has_coverage() || !is_layer(scene, target));
}

void FramePasses::make_targets(const Scene& scene, const PictureTarget& target) {
    targets_.reset();  // Frees their memory before the new ones are made.
    auto targets = std::make_unique<RenderTargets>(
        context_, target.extent, Sampling{sampling_.samples, scale_for(target)},
        RenderTargets::Parts{.keeps_stencil = keeps_stencil_,
                             .coverage = is_layer(scene, target),
                             .shapes = sobel_pass_.has_value(),
                             .shadow_colors = has_shadow_colors()});
    line_pass_.set_surface_depth(targets->depth());
    composite_pass_.set_surfaces(targets->surfaces());
    if (sobel_pass_) sobel_pass_->set_shapes(targets->shapes());
    if (targets->has_coverage()) ink_pass_.set_coverage(targets->coverage());
    if (targets->has_shadow_colors()) shadow_color_pass_.set_colors(targets->shadow_colors());
    targets_ = std::move(targets);
}

void FramePasses::prepare(const Scene& scene, const PictureTarget& target) {
    require_condition(context_, target.condition);
    if (target.use == PictureUse::over && target.initial_layout == VK_IMAGE_LAYOUT_UNDEFINED)
        throw Error(ErrorCode::bad_input,
                    "a frame is drawn over a picture whose layout is VK_IMAGE_LAYOUT_UNDEFINED");
    if (target.backdrop) backdrop_pass_.prepare(context_, *target.backdrop);
    composite_pass_.prepare(context_, composite_kind(scene, target));
    const FrameSurfaces surfaces = frame_surfaces(scene, target, sampling_.samples);
    if (surfaces.is_layer) ink_pass_.prepare_fold(context_);
    if (surfaces.lights == SurfaceLights::beside_shadow) shadow_color_pass_.prepare(context_);
    for (const SceneInstance& instance : scene.instances) {
        surface_pass_.prepare(context_, surface_kind(scene, surfaces, instance));
        if (draws_edges(scene, instance)) line_pass_.prepare_edges(context_);
        if (draws_segments(scene, instance)) line_pass_.prepare_segments(context_);
    }
}

bool FramePasses::draws_edges(const Scene& scene, const SceneInstance& instance) const {
    return outline_.method == OutlineMethod::lines && has_silhouette_lines(scene, instance);
}

bool FramePasses::draws_segments(const Scene& scene, const SceneInstance& instance) const {
    return outline_.method == OutlineMethod::lines && has_lines(scene, instance) &&
           !has_silhouette_lines(scene, instance);
}

bool FramePasses::is_prepared(const Scene& scene, const PictureTarget& target) const {
    const FrameSurfaces surfaces = frame_surfaces(scene, target, sampling_.samples);
    return composite_pass_.is_prepared(composite_kind(scene, target)) &&
           (!surfaces.is_layer || ink_pass_.is_fold_prepared()) &&
           (!target.backdrop || backdrop_pass_.is_prepared()) &&
           (surfaces.lights != SurfaceLights::beside_shadow || shadow_color_pass_.is_prepared()) &&
           std::ranges::all_of(scene.instances, [&](const SceneInstance& instance) {
               return surface_pass_.is_prepared(surface_kind(scene, surfaces, instance)) &&
                      (!draws_edges(scene, instance) || line_pass_.has_edges()) &&
                      (!draws_segments(scene, instance) || line_pass_.has_segments());
           });
}

void FramePasses::record(Commands commands, Commands picture, const FrameView& view,
                         const DrawList& list, const PictureTarget& target, std::uint32_t ring_slot,
                         PassClock& clock) const {
    Frame frame{view, list, target, drawn_area(view, target), ring_slot, clock};
    if (back_pass_) widen(frame.area, back_pass_->reach_px(view.scene), target.extent);
    if (target.backdrop) {
        backdrop_pass_.set(ring_slot, *target.backdrop);
        frame.backdrop = backdrop_map(view, target.backdrop->format);
        RenderTargets::record_before_backdrop(commands, *target.backdrop);
    }
    if (shape_pass_) record_shapes(commands, frame);
    targets_->record_before_surfaces(commands);
    if (list.surface_lights == SurfaceLights::beside_shadow)
        record_surfaces_beside_shadow(commands, frame);
    else
        record_surfaces(commands, frame);
    targets_->record_before_lines(commands);
    if (is_layer(view.scene, target))
        record_layer_lines(commands, frame);
    else
        record_lines(commands, frame);
    clock.end_pass(commands, "lines");
    clock.start_again(picture);
    targets_->record_before_picture(picture, target);
    record_picture(picture, frame);
    RenderTargets::record_after_picture(picture, target);
    clock.end_pass(picture, "picture");
}

void FramePasses::record_shapes(Commands commands, const Frame& frame) const {
    const PassLabel label(commands, "shapes");
    const ConditionalCommands conditional(commands, frame.target.condition);
    targets_->record_before_shapes(commands);
    targets_->begin_shapes(commands, frame.area);
    shape_pass_->record(commands, frame.list);
    commands->CmdEndRendering(commands);
    targets_->record_after_shapes(commands);
    frame.clock.end_pass(commands, "shapes");
}

glm::vec3 FramePasses::under_surfaces(const Frame& frame) {
    const Scene& scene = frame.view.scene;
    return is_layer(scene, frame.target) ? glm::vec3(0.0f) : scene.palette.background;
}

void FramePasses::record_surfaces(Commands commands, const Frame& frame) const {
    const PassLabel label(commands, "surfaces");
    const ConditionalCommands conditional(commands, frame.target.condition);
    const DrawList& list = frame.list;
    targets_->begin_surfaces(commands, under_surfaces(frame), frame.area);
    if (frame.target.backdrop)
        backdrop_pass_.record_depth(commands, frame.ring_slot, frame.backdrop, frame.target.corner);
    if (list.surface_lights == SurfaceLights::together) {
        surface_pass_.record_whole(commands, list);
        frame.clock.end_pass(commands, "surfaces");
    } else {
        surface_pass_.record_unlit(commands, list);
        frame.clock.end_pass(commands, "surfaces, unlit");
        for (std::size_t light = 0; light < list.light_count; ++light)
            record_light(commands, frame, light);
    }
    record_backs(commands, frame);
    commands->CmdEndRendering(commands);
    if (sampling_.samples > 1) frame.clock.end_pass(commands, "resolve");
}

void FramePasses::record_surfaces_beside_shadow(Commands commands, const Frame& frame) const {
    const PassLabel label(commands, "surfaces");
    const ConditionalCommands conditional(commands, frame.target.condition);
    const DrawList& list = frame.list;
    targets_->begin_surfaces_beside_shadow(commands, under_surfaces(frame), frame.area);
    surface_pass_.record_whole(commands, list);
    commands->CmdEndRendering(commands);
    frame.clock.end_pass(commands, "surfaces");
    targets_->record_before_shadows(commands);
    targets_->begin_shadows(commands, frame.area);
    const VkRect2D area = targets_->in_pass(frame.area.rect);
    record_volumes(commands, frame, 0);
    if (const VkRect2D counted = ShadowVolumePass::counted_rect(list, 0, area);
        counted.extent.width > 0) {
        commands->CmdSetScissor(commands, 0, 1, &counted);
        shadow_color_pass_.record(commands);
        commands->CmdSetScissor(commands, 0, 1, &area);
    }
    frame.clock.end_pass(commands, "surfaces, in shadow");
    record_backs(commands, frame);
    commands->CmdEndRendering(commands);
}

void FramePasses::record_volumes(Commands commands, const Frame& frame, std::size_t light) const {
    const PassLabel label(commands, "shadow volumes");
    shadow_pass_.record(commands, frame.list, light, targets_->in_pass(frame.area.rect));
    if (frame.target.backdrop)
        backdrop_pass_.record_shade(
            commands, frame.ring_slot, frame.backdrop, frame.target.corner,
            shadow_opacity(frame.view.scene) * shadow_share(frame.view.scene, light));
    frame.clock.end_pass(commands, "shadow volumes", light);
}

void FramePasses::record_backs(Commands commands, const Frame& frame) const {
    if (!back_pass_) return;
    back_pass_->record(commands, frame.list, is_layer(frame.view.scene, frame.target));
    frame.clock.end_pass(commands, "backs");
}

void FramePasses::record_light(Commands commands, const Frame& frame, std::size_t light) const {
    if (frame.list.shadows) record_volumes(commands, frame, light);
    surface_pass_.record_lit(commands, frame.list, light);
    frame.clock.end_pass(commands, "surfaces", light);
}

// Whether an instance has outlines, which are drawn or found between pixels.
bool FramePasses::draws_lines(const DrawList& list) const {
    return std::ranges::any_of(list.instances, [&](const DrawnInstance& instance) {
        return instance.has_lines && (sobel_pass_.has_value() || !instance.inks.empty());
    });
}

void FramePasses::record_lines(Commands commands, const Frame& frame) const {
    const bool has_grid = frame.view.scene.palette.grid_strength > 0.0f;
    if (!has_grid && !draws_lines(frame.list)) return;
    const PassLabel label(commands, "lines");
    const ConditionalCommands conditional(commands, frame.target.condition);
    const Palette& palette = frame.view.scene.palette;
    const DrawList& list = frame.list;
    targets_->begin_lines(commands, frame.area);
    if (has_grid)
        ink_pass_.record_grid(commands, glm::vec4(palette.grid, palette.grid_strength),
                              targets_->size(), targets_->scale());
    if (sobel_pass_) record_sobel(commands, frame);
    for (std::size_t ink = 0; ink < list.inks.size(); ++ink) {
        if (ink > 0) ink_pass_.record_ink(commands, list.inks[ink - 1]);
        line_pass_.record(commands, list, ink);
    }
    commands->CmdEndRendering(commands);
}

void FramePasses::record_sobel(Commands commands, const Frame& frame) const {
    const VkRect2D drawn = targets_->in_pass(frame.area.rect);
    sobel_pass_->record(commands, frame.list, outline_,
                        frame.view.scene.line_width_px * float(targets_->scale()), drawn);
}

// The surfaces' alpha is opacity here, so the coverage of each color has its own scope.
void FramePasses::record_layer_lines(Commands commands, const Frame& frame) const {
    if (!draws_lines(frame.list)) return;  // Those of backs are surfaces.
    const PassLabel label(commands, "lines");
    const ConditionalCommands conditional(commands, frame.target.condition);
    for (std::size_t ink = 0; ink < frame.list.inks.size(); ++ink) {
        targets_->record_before_coverage(commands);
        targets_->begin_coverage(commands, frame.area);
        if (sobel_pass_) record_sobel(commands, frame);
        line_pass_.record(commands, frame.list, ink);
        commands->CmdEndRendering(commands);
        targets_->record_after_coverage(commands);
        targets_->begin_lines(commands, frame.area);
        ink_pass_.record_fold(commands, frame.list.inks[ink]);
        commands->CmdEndRendering(commands);
    }
}

void FramePasses::record_picture(Commands commands, const Frame& frame) const {
    const PassLabel label(commands, "picture");
    const ConditionalCommands conditional(commands, frame.target.condition);
    const Scene& scene = frame.view.scene;
    RenderTargets::begin_picture(commands, frame.target, frame.area);
    const CompositeKind kind = composite_kind(scene, frame.target);
    composite_pass_.record(commands, kind,
                           kind.is_layer ? scene.palette.background : frame.list.inks.back(),
                           frame.target.corner);
    commands->CmdEndRendering(commands);
}

}  // namespace rimline
