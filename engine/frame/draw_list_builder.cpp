#include "engine/frame/draw_list_builder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/frame/front_corners.h"
#include "engine/frame/line_segments.h"
#include "engine/frame/near_count.h"
#include "engine/frame/scene_data.h"
#include "engine/frame/segment_crossings.h"
#include "engine/frame/shadow_bounds.h"
#include "engine/frame/silhouette_points.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

// The index of `color` in `inks`. Appends it if it is new.
std::size_t ink_index(std::vector<glm::vec3>& inks, const glm::vec3& color) {
    const auto place = std::ranges::find(inks, color);
    const auto number = static_cast<std::size_t>(place - inks.begin());
    if (place == inks.end()) inks.push_back(color);
    return number;
}

// Of the light's distance from the mesh, in radii of it, for rounding (shadow_choice.cpp).
constexpr double k_winding_margin = 0x1p-15;

// DrawList::corners takes at most 64 MiB, in scenes of many instances too: those beyond it draw all faces.
constexpr std::size_t k_max_corners = std::size_t{1} << 24;

// The bytes of all face bits of a mesh.
std::uint64_t face_bits_bytes(std::uint32_t face_count) { return 4 * face_word_count(face_count); }

class DrawListBuilder {
public:
    DrawListBuilder(const FrameView& view, std::uint32_t ring_slot, const DrawListParts& parts,
                    RecordedFrame& frame)
        : view_(view),
          scene_(view.scene),
          ring_slot_(ring_slot),
          parts_(parts),
          frame_(frame),
          surfaces_(frame_surfaces(scene_, parts.target, parts.targets.samples())) {}

    DrawList build(const gpu::FrameData& frame_data) {
        const std::size_t light_count = scene_.lights.size();
        parts_.draw_data.begin_frame(ring_slot_, frame_data, scene_.instances.size(),
                                     scene_.instances.size() * light_count);
        list_ = {.data = parts_.draw_data.set(ring_slot_),
                 .light_count = light_count,
                 .shadows = scene_.shadows,
                 .surface_lights = surfaces_.lights,
                 .instances = {},
                 .inks = {},
                 .shadow_batches = {}};
        put_segments(frame_data);
        if (scene_.shadows && parts_.limits_shadows)
            shadow_bounds_.emplace(view_, parts_.target.backdrop.has_value());
        make_corner_list();
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) add_instance(i);
        if (list_.inks.empty()) list_.inks.push_back(scene_.palette.ink);
        list_.shadow_batches.resize(light_count);
        for (std::size_t l = 0; l < light_count; ++l) plan_shadows(l);
        put_parts();
        put_lights();
        return std::move(list_);
    }

private:
    // An instance as the shadow choice sees it.
    struct Caster {
        ShadowView view;
        CasterBox box;
    };

    // The lines that the caller gave an instance: ranges of one color each.
    struct Segments {
        struct Range {
            std::uint32_t color;  // As PictureLine::color.
            std::uint32_t first, count;
        };
        VkDeviceAddress address = 0;
        std::vector<Range> ranges;
    };

    InstanceState& state_of(std::size_t i) { return parts_.instances.all()[i]; }

    void put_segments(const gpu::FrameData& frame_data) {
        std::vector<gpu::LineSegment> all;
        for (const SceneInstance& instance : scene_.instances) {
            const std::size_t begin = all.size();
            segments_.push_back({begin * sizeof(gpu::LineSegment), {}});
            if (!has_lines(scene_, instance) || !instance.picture_lines ||
                parts_.outline != OutlineMethod::lines)
                continue;
            const PictureLines& lines = *instance.picture_lines;
            const auto add_color = [&](std::uint32_t color) {
                const std::size_t first = all.size();
                add_line_segments(lines, color, frame_data, all);
                segments_.back().ranges.push_back({color, static_cast<std::uint32_t>(first - begin),
                                                   static_cast<std::uint32_t>(all.size() - first)});
            };
            add_color(k_own_line_color);
            for (std::uint32_t color = 0; color < lines.colors.size(); ++color) add_color(color);
        }
        const VkDeviceAddress begin = parts_.draw_data.put_segments(all);
        for (Segments& segments : segments_) segments.address += begin;
    }

    // Of all faces of an instance whose fronts can be listed.
    static std::size_t corner_count_of(const SceneInstance& instance) {
        return instance.is_solid && instance.octree != nullptr
                   ? 3 * std::size_t{instance.mesh().face_count()}
                   : 0;
    }

    void make_corner_list() {
        if (!parts_.lists_fronts) return;
        std::size_t count = 0;
        for (const SceneInstance& instance : scene_.instances)
            if (const std::size_t own = corner_count_of(instance); count + own <= k_max_corners)
                count += own;
        const DrawData::CornerList list = parts_.draw_data.make_corner_list(count);
        corners_ = list.corners;
        list_.corners = list.buffer;
    }

    void add_instance(std::size_t i) {
        const SceneInstance& instance = scene_.instances[i];
        InstanceState& state = state_of(i);
        DrawnInstance drawn{.data = 0,
                            .indices = state.mesh->indices(),
                            .face_count = state.mesh->face_count(),
                            .border_count = state.mesh->border_count(),
                            .crease_count = 0,
                            .loose_count = state.mesh->loose_count(),
                            .has_lines = has_lines(scene_, instance),
                            .surface = surface_kind(scene_, surfaces_, instance),
                            .textured_faces = {},
                            .inks = {},
                            .silhouette = {},
                            .every_edge = {},
                            .lights = {}};
        if (state.deforming) deform(i);
        const VkDeviceAddress slots = drawn.has_lines ? add_lines(i, drawn) : 0;
        drawn.data = put_instance(i, slots);
        if (drawn.surface.colors == SurfaceColors::textures)
            drawn.textured_faces = state.mesh->materials()->textures()->ranges();
        const Caster caster{shadow_view(view_, instance), caster_box(instance)};
        // A ground seen from below would show nothing but its back.
        drawn.shows_backs =
            !drawn.surface.fades && (!instance.is_solid || state.deforming ||
                                     !is_outside(caster.view, caster.box.low, caster.box.high));
        const std::size_t corners = corner_count_of(instance);
        if (corners > 0 && corners_.size() - corner_count_ >= corners && !drawn.shows_backs &&
            drawn.surface.colors != SurfaceColors::textures) {
            drawn.first_corner = corner_count_;
            drawn.corner_count = put_front_corners(*state.source, view_.instances[i].camera,
                                                   corners_.subspan(corner_count_));
            corner_count_ += drawn.corner_count;
        }
        for (std::size_t l = 0; l < scene_.lights.size(); ++l)
            drawn.lights.push_back(add_light(i, l, caster, drawn));
        list_.instances.push_back(std::move(drawn));
    }

    void deform(std::size_t i) {
        const SceneInstance& instance = scene_.instances[i];
        InstanceState& state = state_of(i);
        if (!instance.has_deep_shadows || !casts_shadows(scene_, instance)) {
            state.moved.reset();
            state.deforming->begin_frame(instance.deformation, ring_slot_, frame_.deformed);
            return;
        }
        if (!state.moved) state.moved = std::make_unique<MovedCaster>(*state.source);
        state.deforming->begin_frame(state.moved->move(instance.deformation), ring_slot_,
                                     frame_.deformed);
    }

    // Returns the address of the silhouette's slots; 0 for what has none: some line paths, lines of the caller,
    // outlines of pixels.
    VkDeviceAddress add_lines(std::size_t i, DrawnInstance& drawn) {
        InstanceState& state = state_of(i);
        FrameReport& report = frame_.report;
        const SceneInstance& instance = scene_.instances[i];
        if (parts_.outline != OutlineMethod::lines) {
            // The color of the first one is that of all.
            if (list_.inks.empty()) ink_index(list_.inks, line_color(scene_, instance));
            return 0;
        }
        if (instance.picture_lines) {
            add_segments(i, drawn);
            return 0;
        }
        const std::size_t own_ink = ink_index(list_.inks, line_color(scene_, instance));
        if (has_material_inks(scene_, instance, *state.mesh))
            add_material_inks(state.mesh->materials()->inks(), own_ink, drawn);
        else
            drawn.inks.push_back({.ink = own_ink});
        drawn.crease_count = crease_count(scene_, *state.mesh);
        report.silhouette += drawn.border_count;
        report.creases += drawn.crease_count;
        if (state.mesh->comparator()) drawn.every_edge = state.mesh->comparator()->draw();
        const HomogeneousPoint& point = *view_.instances[i].lines;
        if (state.deforming) {
            RIMLINE_CHECK(draws_slots(parts_.line_path));
            const GpuSilhouette& silhouette = state.deforming->camera(point, frame_.deformed);
            drawn.silhouette = {silhouette.arguments().handle()};
            report.bytes_full += face_bits_bytes(drawn.face_count);
            frame_.add_buffers({i, std::nullopt}, point, silhouette);
            return silhouette.slots().address();
        }
        if (!draws_slots(parts_.line_path)) return 0;
        const ChangeStream& stream = follow(*state.camera, point);
        frame_.add_buffers({i, std::nullopt}, point, stream);
        drawn.silhouette = {stream.arguments().handle()};
        report.camera += state.camera->changes();
        report.silhouette += stream.silhouette_size();
        return stream.slots().address();
    }

    void add_segments(std::size_t i, DrawnInstance& drawn) {
        const SceneInstance& instance = scene_.instances[i];
        drawn.has_segments = true;
        for (const Segments::Range& range : segments_[i].ranges) {
            if (range.count == 0) continue;
            const glm::vec3& color = range.color == k_own_line_color
                                         ? line_color(scene_, instance)
                                         : instance.picture_lines->colors[range.color];
            drawn.inks.push_back({.ink = ink_index(list_.inks, color),
                                  .first_segment = range.first,
                                  .segment_count = range.count});
            frame_.report.segments += range.count;
        }
    }

    void add_material_inks(const MaterialInks& inks, std::size_t own_ink, DrawnInstance& drawn) {
        drawn.inks.push_back({.ink = own_ink, .material_ink = RIMLINE_OWN_INK});
        for (std::uint32_t ink = 0; ink < inks.colors.size(); ++ink) {
            const glm::vec3 shade = line_shade(inks.colors[ink], scene_.palette.has_light_ink());
            drawn.inks.push_back({.ink = ink_index(list_.inks, shade), .material_ink = ink});
        }
    }

    const ChangeStream& follow(TrackedSilhouette& silhouette, const HomogeneousPoint& point) {
        silhouette.follow(point, ring_slot_);
        const ChangeStream& stream = silhouette.stream();
        frame_.silhouettes.push_back(&silhouette);
        frame_.report.follow_ms += 1e-3 * silhouette.changes().update_us;
        frame_.report.bytes_streamed += stream.bytes_streamed();
        frame_.report.bytes_full += stream.bytes_full();
        return stream;
    }

    std::uint32_t put_instance(std::size_t i, VkDeviceAddress slots) {
        const InstanceState& state = state_of(i);
        gpu::InstanceData data = instance_data(view_, i, *state.mesh, slots);
        data.segments = segments_[i].address;
        if (state.deforming) {
            data.positions = state.deforming->mesh().positions();
            data.corner_normals = state.deforming->mesh().corner_normals();
            // Those of the hull do not move: it is open at creases.
            if (data.hull_normals != 0) data.hull_normals = data.corner_normals;
        }
        return parts_.draw_data.put(data);
    }

    // Its data is put by put_lights().
    DrawnLight add_light(std::size_t i, std::size_t l, const Caster& caster,
                         const DrawnInstance& drawn) {
        const SceneInstance& instance = scene_.instances[i];
        const HomogeneousPoint& point = view_.instances[i].lights[l].point;
        gpu::LightData data{.slots = 0,
                            .face_words = 0,
                            .part_sides = 0,
                            .part_faces = 0,
                            .point = {point.x, point.y, point.z, point.w},
                            .color = glm::vec3(light_share(scene_, instance, l)),
                            .extrusion = 0.0f};
        if (scene_.camera.is_orthographic())
            data.extrusion = finite_extrusion(scene_.lights[l], instance, view_.bounds);
        DrawnLight light{.casts_shadow = casts_shadows(scene_, instance, scene_.lights[l]),
                         .fills = scene_.lights[l].fills};
        if (light.casts_shadow) {
            choose_volume(i, l, caster, data, light);
            add_volume(i, l, drawn, data, light);
            if (light.ends_in_one_point) data.extrusion = RIMLINE_EXTRUDED_TO_ONE_POINT;
        }
        lights_.push_back(data);
        return light;
    }

    void choose_volume(std::size_t i, std::size_t l, const Caster& caster,
                       const gpu::LightData& data, DrawnLight& light) {
        const LightView& seen = view_.instances[i].lights[l];
        // Depth pass and the single form need all faces of the mesh in the depth buffer.
        const bool fades = scene_.instances[i].fade_radius > 0.0;
        ShadowChoice choice =
            choose_shadow(fades ? ShadowMethod::fail : scene_.shadow_method,
                          fades ? ShadowForm::general : scene_.shadow_form, caster.view,
                          {.low = caster.box.low,
                           .high = caster.box.high,
                           .is_closed_chain = state_of(i).is_closed_chain,
                           .light = seen.point,
                           .extrusion = data.extrusion,
                           .reaches_far_enough = seen.point.is_direction() ||
                                                 data.extrusion < k_max_extrusion_times});
        if (fades)
            choice.method_reason = choice.form_reason = "backs of faces that fade are not drawn";
        if (!fades && choice.form == ShadowForm::general && may_know_winding(i, caster, seen.point))
            choose_by_winding(i, seen.point, choice, light);
        light.method = choice.method;
        light.form = choice.form;
        light.ends_in_one_point = choice.ends_in_one_point;
        light.clamps_depth = scene_.camera.is_orthographic() ||
                             (choice.ends_in_one_point && !seen.point.is_direction());
        const ShadowReach reach =
            shadow_bounds_ ? shadow_bounds_->reach_of(i, l, data.extrusion)
                           : ShadowReach{.width = view_.size.width, .height = view_.size.height};
        light.rect = parts_.targets.in_pass({{reach.x, reach.y}, {reach.width, reach.height}});
        light.min_depth = reach.min_depth;
        light.max_depth = reach.max_depth;
        frame_.report.shadows.push_back({.instance = static_cast<std::uint32_t>(i),
                                         .light = static_cast<std::uint32_t>(l),
                                         .choice = choice,
                                         .reach = reach,
                                         .shades_all = light.shades_all,
                                         .light_moved = seen.is_moved});
    }

    // Only of lights within the bounds of a mesh that the camera sees from outside. There the tree of the faces is
    // needed for the bound of the count too (VolumeCounter).
    bool may_know_winding(std::size_t i, const Caster& caster, const HomogeneousPoint& point) {
        const InstanceState& state = state_of(i);
        return scene_.shadow_form != ShadowForm::general && !scene_.camera.is_orthographic() &&
               !state.deforming && state.is_closed_chain && !point.is_direction() &&
               !outer_axis(state.caster->mesh().bounds(), point) &&
               is_outside(caster.view, caster.box.low, caster.box.high);
    }

    // The difference of front and back triangles between a light and a visible point is the winding number around
    // the light, as in shadow_choice.h. If it is 0, the single form is right. Else there is always a triangle.
    void choose_by_winding(std::size_t i, const HomogeneousPoint& point, ShadowChoice& choice,
                           DrawnLight& light) {
        CasterMesh& caster = *state_of(i).caster;
        const std::optional<int> winding =
            winding_number(caster.faces(), caster.mesh(), glm::dvec3(point.xyz()),
                           k_winding_margin * caster.mesh().radius());
        if (!winding || (*winding != 0 && scene_.shadow_method == ShadowMethod::fail)) return;
        choice.form = ShadowForm::single;
        choice.form_reason =
            "closed, with the camera out of its bounds and the light outside of it";
        if (*winding == 0) return;
        light.shades_all = true;
        choice.form_reason = "closed, with the light inside: all is in shadow";
        choice.method = ShadowMethod::pass;
        choice.method_reason = "nothing is to be counted";
    }

    // The silhouette and face bits that the volume is drawn from.
    void add_volume(std::size_t i, std::size_t l, const DrawnInstance& drawn, gpu::LightData& data,
                    DrawnLight& light) {
        InstanceState& state = state_of(i);
        const HomogeneousPoint& point = view_.instances[i].lights[l].point;
        frame_.report.shadow_edges += drawn.loose_count;
        if (state.deforming) {
            const GpuSilhouette& silhouette = state.deforming->light(l, point, frame_.deformed);
            data.slots = silhouette.slots().address();
            data.face_words = silhouette.face_words().address();
            light.sides = {silhouette.arguments().handle()};
            frame_.add_buffers({i, l}, point, silhouette);
            frame_.report.bytes_full += face_bits_bytes(drawn.face_count);
            return;
        }
        const ChangeStream& stream = follow(*state.lights[l], point);
        frame_.add_buffers({i, l}, point, stream);
        data.slots = stream.slots().address();
        data.face_words = stream.face_words().address();
        light.sides = {stream.arguments().handle()};
        frame_.report.shadow_edges += state.lights[l]->regular_count();
    }

    // Divides the casters of light `l` into batches that the stencil can count.
    void plan_shadows(std::size_t l) {
        ShadowBatches& batches = parts_.shadow_batches;
        std::vector<ShadowReport>& shadows = frame_.report.shadows;
        batches.begin();
        for (ShadowReport& shadow : shadows) {
            if (shadow.light != l) continue;
            InstanceState& state = state_of(shadow.instance);
            if (state.moved) {
                VolumeCount& count = state.volumes[l];
                count.light.reset();  // It was counted where the vertices were in another frame.
                shadow.bound = batches.add(
                    shadow.instance,
                    state.moved->volume(view_.instances[shadow.instance].lights[l].point,
                                        shadow.choice.form),
                    count);
                continue;
            }
            if (state.deforming) {
                shadow.bound = batches.add_unseen(shadow.instance, state.mesh->face_count());
                continue;
            }
            if (list_.instances[shadow.instance].lights[l].shades_all) {
                shadow.bound = batches.add_darkness(shadow.instance);
                continue;
            }
            shadow.bound = batches.add(shadow.instance, counted_volume(shadow), state.volumes[l]);
        }
        list_.shadow_batches[l] = batches.end();
        for (ShadowReport& shadow : shadows)
            if (shadow.light == l && may_count_from_near(shadow)) count_from_near(shadow);
        for (const ShadowBatch& batch : list_.shadow_batches[l])
            for (const ShadowDraw& draw : batch.draws) {
                if (!draw.part) continue;
                ++std::ranges::find_if(shadows, [&](const ShadowReport& shadow) {
                      return shadow.light == l && shadow.instance == draw.instance;
                  })->runs;
            }
    }

    CountedVolume counted_volume(const ShadowReport& shadow) {
        InstanceState& state = state_of(shadow.instance);
        const TrackedSilhouette& volume = *state.lights[shadow.light];
        return {.caster = state.caster,
                .silhouette = volume.silhouette(),
                .face_words = volume.face_words(),
                .light = volume.point(),
                .form = shadow.choice.form};
    }

    bool may_count_from_near(const ShadowReport& shadow) {
        return shadow.choice.method == ShadowMethod::fail &&
               scene_.shadow_method != ShadowMethod::fail && !scene_.camera.is_orthographic() &&
               !state_of(shadow.instance).deforming && !shadow.reach.is_empty() &&
               !(scene_.instances[shadow.instance].fade_radius > 0.0);
    }

    // Takes depth pass, where it is known what lies before the near plane.
    void count_from_near(ShadowReport& shadow) {
        InstanceState& state = state_of(shadow.instance);
        const auto& counts = state.near_counters[shadow.light].counts(
            counted_volume(shadow), state.volumes[shadow.light],
            shadow_view(view_, scene_.instances[shadow.instance]));
        if (!counts) return;
        list_.instances[shadow.instance].lights[shadow.light].method = ShadowMethod::pass;
        shadow.choice.method = ShadowMethod::pass;
        shadow.choice.method_reason = "the count is the same at all of the near plane";
        auto next = counts->begin();
        for (ShadowBatch& batch : list_.shadow_batches[shadow.light])
            for (ShadowDraw& draw : batch.draws)
                if (draw.instance == shadow.instance) draw.near_count = *next++;
    }

    // Copies the lists of all volumes that are drawn in parts.
    void put_parts() {
        const auto count_of = [&](const ShadowReport& shadow) -> const VolumeCount& {
            return state_of(shadow.instance).volumes[shadow.light];
        };
        std::size_t sides = 0, faces = 0;
        for (const ShadowReport& shadow : frame_.report.shadows) {
            if (shadow.runs == 0) continue;
            sides += count_of(shadow).sides.size();
            faces += count_of(shadow).faces.size();
        }
        const DrawData::PartLists lists = parts_.draw_data.make_part_lists(sides, faces);
        sides = faces = 0;
        for (const ShadowReport& shadow : frame_.report.shadows) {
            if (shadow.runs == 0) continue;
            const VolumeCount& count = count_of(shadow);
            std::ranges::copy(count.sides, lists.sides.subspan(sides).begin());
            std::ranges::copy(count.faces, lists.faces.subspan(faces).begin());
            gpu::LightData& light = lights_[shadow.instance * scene_.lights.size() + shadow.light];
            light.part_sides = lists.sides_address + sides * sizeof(gpu::EdgeRecord);
            light.part_faces = lists.faces_address + faces * sizeof(std::uint32_t);
            sides += count.sides.size();
            faces += count.faces.size();
        }
    }

    void put_lights() {
        auto data = lights_.begin();
        for (DrawnInstance& instance : list_.instances)
            for (DrawnLight& light : instance.lights) light.data = parts_.draw_data.put(*data++);
    }

    const FrameView& view_;
    const Scene& scene_;
    std::uint32_t ring_slot_;
    const DrawListParts& parts_;
    RecordedFrame& frame_;
    FrameSurfaces surfaces_;
    std::optional<ShadowBounds> shadow_bounds_;  // Empty: shadows are not limited.
    std::vector<Segments> segments_;             // Of each instance.
    std::span<std::uint32_t> corners_;           // DrawList::corners.
    std::uint32_t corner_count_ = 0;             // So many are there.
    std::vector<gpu::LightData> lights_;         // Of each instance, and of each of its lights.
    DrawList list_;
};

}  // namespace

DrawList build_draw_list(const FrameView& view, const gpu::FrameData& frame_data,
                         std::uint32_t ring_slot, const DrawListParts& parts,
                         RecordedFrame& frame) {
    return DrawListBuilder(view, ring_slot, parts, frame).build(frame_data);
}

}  // namespace rimline
