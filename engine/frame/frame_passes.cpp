#include "engine/frame/frame_passes.h"

#include <algorithm>
#include <glm/vec4.hpp>
#include <string>
#include <utility>

#include "engine/frame/drawn_rect.h"
#include "engine/frame/scene_data.h"
#include "engine/vulkan/debug_names.h"

namespace rimline {

namespace {

AttachmentFormats surface_formats(std::uint32_t samples) {
    return {k_surface_format, k_depth_stencil_format, samples};
}

// The part of the picture to draw: without the background around the scene, unless a grid is drawn on it.
DrawnArea drawn_area(const FrameView& view, const PictureTarget& target) {
    const Palette& palette = view.scene.palette;
    const auto around = composite_of(palette.background, target.format);
    if (!around || palette.grid_strength > 0.0f) return DrawnArea::whole(target.extent);
    return {drawn_rect(view), *around};
}

}  // namespace

FramePasses::FramePasses(const DeviceContext& context, const RendererOptions& options,
                         VkDescriptorSetLayout draw_data)
    : context_(context),
      sampling_(sampling_of(context, options.samples, options.scale)),
      keeps_stencil_(options.keeps_stencil),
      surface_pass_(context, draw_data, surface_formats(sampling_.samples)),
      shadow_pass_(context, draw_data, surface_formats(sampling_.samples), options.shadow_sides),
      line_pass_(context, draw_data, k_surface_format, options.line_path),
      ink_pass_(context, k_surface_format),
      composite_pass_(context) {}

std::uint32_t FramePasses::scale_for(VkExtent2D size) const {
    return fitting_scale(context_, size, sampling_.scale, sampling_.samples);
}

bool FramePasses::has_targets_for(VkExtent2D size) const {
    return targets_ && targets_->size().width == size.width &&
           targets_->size().height == size.height && targets_->scale() == scale_for(size);
}

void FramePasses::make_targets(VkExtent2D size) {
    targets_.reset();  // Frees their memory before the new ones are made.
    auto targets = std::make_unique<RenderTargets>(
        context_, size, Sampling{sampling_.samples, scale_for(size)}, keeps_stencil_);
    line_pass_.set_surface_depth(targets->depth());
    composite_pass_.set_surfaces(targets->surfaces());
    targets_ = std::move(targets);
}

void FramePasses::prepare(const Scene& scene, VkFormat format) {
    composite_pass_.prepare(context_, {format, targets_->scale()});
    for (const SceneInstance& instance : scene.instances)
        surface_pass_.prepare(context_, {scene.style, has_mesh_colors(scene, instance)});
}

bool FramePasses::is_prepared(const Scene& scene, VkFormat format) const {
    return composite_pass_.is_prepared({format, targets_->scale()}) &&
           std::ranges::all_of(scene.instances, [&](const SceneInstance& instance) {
               return surface_pass_.is_prepared({scene.style, has_mesh_colors(scene, instance)});
           });
}

void FramePasses::record(Commands commands, Commands picture, const FrameView& view,
                         const DrawList& list, const PictureTarget& target,
                         PassClock& clock) const {
    const DrawnArea area = drawn_area(view, target);
    targets_->record_before_surfaces(commands);
    record_surfaces(commands, view.scene, list, area, clock);
    targets_->record_before_lines(commands);
    record_lines(commands, view.scene, list, area);
    clock.end_pass(commands, "lines");
    clock.start_again(picture);
    targets_->record_before_picture(picture, target);
    record_picture(picture, list, target, area);
    RenderTargets::record_after_picture(picture, target);
    clock.end_pass(picture, "picture");
}

void FramePasses::record_surfaces(Commands commands, const Scene& scene, const DrawList& list,
                                  const DrawnArea& area, PassClock& clock) const {
    const PassLabel label(commands, "surfaces");
    targets_->begin_surfaces(commands, scene.palette.background, area);
    if (!list.shadows && list.light_count == 1) {
        surface_pass_.record_shadowless(commands, list);
        clock.end_pass(commands, "surfaces");
    } else {
        surface_pass_.record_unlit(commands, list);
        clock.end_pass(commands, "surfaces, unlit");
        for (std::size_t light = 0; light < list.light_count; ++light) {
            const std::string of_light = ", light " + std::to_string(light);
            if (list.shadows) {
                const PassLabel shadows(commands, "shadow volumes");
                shadow_pass_.record(commands, list, light, targets_->in_pass(area.rect));
                clock.end_pass(commands, "shadow volumes" + of_light);
            }
            surface_pass_.record_lit(commands, list, light);
            clock.end_pass(commands, "surfaces" + of_light);
        }
    }
    commands->CmdEndRendering(commands);
    if (sampling_.samples > 1) clock.end_pass(commands, "resolve");
}

void FramePasses::record_lines(Commands commands, const Scene& scene, const DrawList& list,
                               const DrawnArea& area) const {
    const PassLabel label(commands, "lines");
    const Palette& palette = scene.palette;
    targets_->begin_lines(commands, area);
    if (palette.grid_strength > 0.0f)
        ink_pass_.record_grid(commands, glm::vec4(palette.grid, palette.grid_strength),
                              targets_->size(), targets_->scale());
    for (std::size_t ink = 0; ink < list.inks.size(); ++ink) {
        if (ink > 0) ink_pass_.record_ink(commands, list.inks[ink - 1]);
        line_pass_.record(commands, list, ink);
    }
    commands->CmdEndRendering(commands);
}

void FramePasses::record_picture(Commands commands, const DrawList& list,
                                 const PictureTarget& target, const DrawnArea& area) const {
    const PassLabel label(commands, "picture");
    RenderTargets::begin_picture(commands, target, area);
    composite_pass_.record(commands, {target.format, targets_->scale()}, list.inks.back());
    commands->CmdEndRendering(commands);
}

}  // namespace rimline
