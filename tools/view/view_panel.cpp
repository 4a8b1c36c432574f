#include "tools/view/view_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/common.hpp>

#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tools/options/picture_scene.h"
#include "tools/options/style_names.h"
#include "tools/options/view_option.h"
#include "tools/view/camera_motion.h"
#include "tools/view/light_handles.h"

namespace rimline::tools {

namespace {

// The first turns shadows off; the others are the values of ShadowMethod that can be asked for, in order.
constexpr std::array k_shadows{"off", "automatic", "depth fail"};
constexpr std::array k_axes{"x", "y", "z", "-x", "-y", "-z", "another"};

bool section(const char* name, bool open = true) {
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

// With commas between groups of three digits: 1,234,567.
std::string grouped(std::uint64_t number) {
    std::string text = std::to_string(number);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, 1, ',');
    return text;
}

void row(const char* name, const std::string& value) {
    ImGui::TextDisabled("%s", name);
    ImGui::SameLine(0.0f, 0.0f);
    const float right = ImGui::GetWindowContentRegionMax().x;
    ImGui::SetCursorPosX(right - ImGui::CalcTextSize(value.c_str()).x);
    ImGui::TextUnformatted(value.c_str());
}

template <std::size_t count>
bool choose(const char* name, const std::array<const char*, count>& names, int& chosen) {
    ImGui::SetNextItemWidth(-0.42f * ImGui::GetWindowWidth());
    return ImGui::Combo(name, &chosen, names.data(), static_cast<int>(count));
}

// The place in k_axes.
int axis_of(const glm::dvec3& up) {
    for (int axis = 0; axis < 3; ++axis)
        if (up[(axis + 1) % 3] == 0.0 && up[(axis + 2) % 3] == 0.0)
            return up[axis] > 0.0 ? axis : axis + 3;
    return 6;
}

// The new color if the user changed it, one that options and scene files can name. Both are linear.
std::optional<glm::vec3> chosen_color(const char* name, const glm::vec3& linear) {
    glm::vec3 color = srgb_from_linear(linear);
    if (!ImGui::ColorEdit3(name, &color.x, ImGuiColorEditFlags_NoInputs)) return std::nullopt;
    return linear_from_srgb(nearest_srgb(linear_from_srgb(glm::clamp(color, 0.0f, 1.0f))));
}

glm::vec3 linear_of(const PointColor& color) {
    return linear_from_srgb(Color{color[0], color[1], color[2]});
}

void draw_paint(const ViewSession& session, PlacedModel& model) {
    const ViewAppearance& appearance = session.appearance;
    const glm::vec3 surface = model.paint ? linear_from_srgb(*model.paint)
                                          : appearance.color.value_or(default_surface_color(
                                                appearance.style, appearance.background));
    if (const auto color = chosen_color("paint", surface)) model.paint = nearest_srgb(*color);
    if (!model.paint) return;
    ImGui::SameLine();
    if (ImGui::Button("Own colors")) model.paint.reset();
}

void draw_loading(const ModelLoader::Stage& loading, PanelRequests& requests) {
    ImGui::TextWrapped("%s", loading.task.c_str());
    ImGui::ProgressBar(float(loading.share), {-0.3f * ImGui::GetWindowWidth(), 0.0f});
    ImGui::SameLine();
    if (ImGui::Button("Cancel", {-1.0f, 0.0f})) requests.cancel = true;
}

void draw_cloud_counts(const PointSurface& surface) {
    const auto count = [&](PointLabel label) { return grouped(surface.count(label)); };
    ImGui::TextDisabled("%s points", grouped(surface.size()).c_str());
    ImGui::TextDisabled("%s border, %s feature, %s undecided", count(PointLabel::border).c_str(),
                        count(PointLabel::feature).c_str(), count(PointLabel::undecided).c_str());
}

// The controls between these two calls are disabled for clouds; `reason` is then shown.
void begin_model_only(const ViewSession& session, const char* reason) {
    if (session.is_cloud()) ImGui::TextDisabled("%s", reason);
    ImGui::BeginDisabled(session.is_cloud());
}
void end_model_only() { ImGui::EndDisabled(); }

// Green, amber, red. The window's lamps have a paler amber, which text cannot have on this background.
ImVec4 color_of(MessageKind kind) {
    if (kind == MessageKind::error) return {0.72f, 0.14f, 0.08f, 1.0f};
    if (kind == MessageKind::warning) return {0.62f, 0.38f, 0.0f, 1.0f};
    return {0.16f, 0.42f, 0.24f, 1.0f};
}

void same_width() { ImGui::SetNextItemWidth(-0.42f * ImGui::GetWindowWidth()); }

}  // namespace

void ViewPanel::draw_model(const ViewSession& session, const Status& status,
                           PanelRequests& requests) {
    if (!session.is_empty()) {
        const ModelDocument* const shown = session.document().model();
        const std::string name =
            shown && shown->models().size() > 1
                ? std::to_string(shown->models().size()) + " models"
                : std::filesystem::path(session.document().name()).filename().string();
        ImGui::TextUnformatted(name.c_str());
        if (session.is_cloud()) {
            draw_cloud_counts(session.cloud().surface());
        } else {
            const Mesh& mesh = session.model().mesh();
            ImGui::TextDisabled("%s faces, %s edges", grouped(mesh.face_count()).c_str(),
                                grouped(mesh.edge_count()).c_str());
        }
    }
    if (status.loading) {
        draw_loading(*status.loading, requests);
        return;
    }
    draw_choice(status, requests);
    if (session.document().model() != nullptr) {
        ImGui::Checkbox("add it to the scene", &adds_);
        draw_models(session, requests);
    }
    requests.adds = adds_ && session.document().model() != nullptr;
}

void ViewPanel::draw_choice(const Status& status, PanelRequests& requests) {
    ImGui::SetNextItemWidth(-0.3f * ImGui::GetWindowWidth());
    const bool entered =
        ImGui::InputTextWithHint("##path", "file, or drop one here", path_.data(), path_.size(),
                                 ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    if ((ImGui::Button(adds_ ? "Add" : "Open", {-1.0f, 0.0f}) || entered) && path_[0] != '\0')
        requests.open = path_.data();
    // Names of files need all of the panel's width.
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, 22.0f * ImGui::GetFrameHeight()});
    ImGui::SetNextItemWidth(-0.3f * ImGui::GetWindowWidth());
    if (ImGui::BeginCombo("##shapes", "recent and built-in")) {
        for (const std::string& name : status.recent)
            if (draw_path(name)) requests.open = name;
        if (!status.recent.empty()) ImGui::Separator();
        for (const std::string_view shape : k_built_in_shapes)
            if (ImGui::Selectable(std::string(shape).c_str()))
                requests.open = "shape:" + std::string(shape);
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    if (ImGui::Button(browses_ ? "Close" : "Browse", {-1.0f, 0.0f})) {
        browses_ = !browses_;
        browser_.refresh();
    }
    if (browses_)
        if (const auto chosen = browser_.draw(200.0f * status.scale)) {
            requests.open = *chosen;
            browses_ = false;
        }
}

void ViewPanel::draw_models(const ViewSession& session, PanelRequests& requests) {
    const std::vector<PlacedModel>& models = session.model().models();
    if (shown_ != models) {
        shown_ = placed_ = models;
        has_new_first_ = false;
    }
    const auto step = static_cast<float>(0.01 * session.bounds().radius);
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
        PlacedModel& model = placed_[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name = std::filesystem::path(model.model).filename().string();
        if (ImGui::TreeNode("model", "%s", name.c_str())) {
            ImGui::SetNextItemWidth(-0.1f * ImGui::GetWindowWidth());
            // The toolkit rounds what is dragged to the format otherwise.
            constexpr ImGuiSliderFlags k_exact = ImGuiSliderFlags_NoRoundToFormat;
            ImGui::DragFloat3("at", &model.at.x, step, 0.0f, 0.0f, "%.6g", k_exact);
            auto degrees = static_cast<float>(model.turn.degrees);
            same_width();
            if (ImGui::DragFloat(model.turn.axis ? "turn about its axis" : "turn", &degrees, 1.0f,
                                 -360.0f, 360.0f, "%.4g deg",
                                 k_exact | ImGuiSliderFlags_AlwaysClamp))
                model.turn.degrees = double{degrees};
            auto scale = static_cast<float>(model.scale);
            same_width();
            if (ImGui::DragFloat("scale", &scale, 0.01f * scale, float(k_min_scale),
                                 float(k_max_scale), "%.4g",
                                 k_exact | ImGuiSliderFlags_AlwaysClamp))
                model.scale = std::clamp(double{scale}, k_min_scale, k_max_scale);
            draw_paint(session, model);
            if (placed_.size() > 1) {
                ImGui::SameLine();
                if (ImGui::Button("Remove")) removed = i;
            }
            ImGui::TreePop();
        }
        ImGui::PopID();
    }
    if (removed) placed_.erase(placed_.begin() + static_cast<std::ptrdiff_t>(*removed));
    if (removed == 0u) has_new_first_ = true;
    // What is dragged is shown when it is let go.
    if (placed_ == models || ImGui::IsAnyItemActive()) return;
    requests.arranged = placed_;
    requests.has_new_first = has_new_first_;
}

void ViewPanel::draw_view(ViewSession& session, ViewInput& input, PanelRequests& requests) {
    int mode = input.flies ? 1 : 0;
    ImGui::RadioButton("orbit", &mode, 0);
    ImGui::SameLine();
    ImGui::RadioButton("fly", &mode, 1);
    input.flies = mode == 1;
    ImGui::SameLine();
    if (ImGui::Button("Fit (F)", {-1.0f, 0.0f})) requests.fit = true;
    if (input.flies) ImGui::TextDisabled("W A S D, Q E down and up, Shift: faster");

    draw_directions(session, requests);
    int up = axis_of(session.camera.up);
    if (choose("up", k_axes, up) && up < 6) {
        requests.up = glm::dvec3(0.0);
        (*requests.up)[up % 3] = up < 3 ? 1.0 : -1.0;
    }
    if (ImGui::Checkbox("orthographic", &session.appearance.orthographic)) {
        session.apply_lens();
        requests.lens = true;
    }
    if (!session.appearance.orthographic) {
        float fov = float(session.appearance.fov_y_deg);
        same_width();
        if (ImGui::SliderFloat("field of view", &fov, 5.0f, 110.0f, "%.0f deg")) {
            session.appearance.fov_y_deg = std::clamp(double(fov), 1.0, 170.0);
            session.apply_lens();
            requests.lens = true;
        }
    }
    if (session.frozen()) {
        if (ImGui::Button("Thaw the silhouette (Z)", {-1.0f, 0.0f})) session.thaw();
    } else if (ImGui::Button("Freeze the silhouette (Z)", {-1.0f, 0.0f})) {
        session.freeze();
    }
}

void ViewPanel::draw_directions(const ViewSession& session, PanelRequests& requests) {
    constexpr std::array<std::pair<const char*, NamedView>, 7> k_views{
        {{"front", NamedView::front},
         {"left", NamedView::left},
         {"right", NamedView::right},
         {"back", NamedView::back},
         {"top", NamedView::top},
         {"bottom", NamedView::bottom},
         {"3/4", NamedView::three_quarter}}};
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    for (std::size_t i = 0; i < k_views.size(); ++i) {
        const auto& [label, view] = k_views[i];
        const ImGuiStyle& style = ImGui::GetStyle();
        const float width = ImGui::CalcTextSize(label).x + 2.0f * style.FramePadding.x;
        // On in the line, where it has room.
        if (i > 0 && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width < end)
            ImGui::SameLine();
        if (ImGui::SmallButton(label)) {
            ViewOption option;
            option.name = view;
            requests.look_from = option.given(session.camera.up);
        }
    }
}

void ViewPanel::draw_gallery(const Status& status, PanelRequests& requests) {
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float whole = ImGui::GetContentRegionAvail().x;
    const float side = (whole - gap * (ViewGallery::k_views - 1)) / ViewGallery::k_views;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < status.gallery.size(); ++i) {
        const GalleryView& view = *status.gallery[i];
        ImGui::PushID(static_cast<int>(i));
        if (i > 0) ImGui::SameLine(0.0f, gap);
        if (ImGui::InvisibleButton("view", {side, side})) requests.look_from = view.towards_viewer;
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
        if (ImGui::IsItemHovered())
            list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_CheckMark), 3.0f, 0, 2.0f);
        // The toolkit's polylines have spikes where they turn sharply.
        const auto place = [&](const glm::vec2& p) {
            return ImVec2(low.x + side * (0.5f + 0.46f * p.x), low.y + side * (0.5f - 0.46f * p.y));
        };
        for (const std::vector<glm::vec2>& stroke : view.strokes)
            for (std::size_t p = 0; p + 1 < stroke.size(); ++p)
                list.AddLine(place(stroke[p]), place(stroke[p + 1]),
                             ImGui::GetColorU32(ImGuiCol_Text), 1.2f);
        ImGui::PopID();
    }
    if (status.finds_views) ImGui::TextDisabled("finding the best views");
    if (status.has_path &&
        ImGui::Button(status.plays_path ? "Stop (space)" : "Play a path through them (space)",
                      {-1.0f, 0.0f}))
        requests.play = true;
}

void ViewPanel::draw_camera(const ViewSession& session, PanelRequests& requests) {
    const auto vector = [](const glm::dvec3& v) {
        char text[80];
        std::snprintf(text, sizeof text, "%.4g, %.4g, %.4g", v.x, v.y, v.z);
        return std::string(text);
    };
    const auto in_file = [&](const glm::dvec3& point) {
        return session.is_cloud() ? session.cloud().umbrellas().from_index(point) : point;
    };
    row("eye", vector(in_file(session.camera.eye)));
    row("target", vector(in_file(session.camera.target)));
    if (ImGui::Button("Copy as command (C)", {-1.0f, 0.0f})) requests.copy_command = true;
}

void ViewPanel::draw_appearance(ViewSession& session) {
    ViewAppearance& appearance = session.appearance;
    ImGui::Checkbox("lines", &appearance.lines);
    same_width();
    ImGui::SliderFloat("line width", &appearance.line_width_px, 0.5f, 12.0f, "%.1f px");
    appearance.line_width_px = std::clamp(appearance.line_width_px, 0.1f, 100.0f);
    draw_colors(session);
    begin_model_only(session, "a cloud is drawn as ink on discs");
    int style = static_cast<int>(place_of(appearance.style));
    if (choose("style", k_style_names, style)) appearance.set_style(k_styles[std::size_t(style)]);
    ImGui::Checkbox("hidden lines too", &appearance.hidden);
    bool creases = appearance.crease_angle_deg > 0.0f;
    if (ImGui::Checkbox("creases", &creases)) {
        appearance.crease_angle_deg = creases ? style_defaults(Style::ink).crease_angle_deg : 0.0f;
        appearance.only_clear_creases = true;
    }
    if (creases) {
        ImGui::SameLine();
        same_width();
        if (ImGui::SliderFloat("from", &appearance.crease_angle_deg, 10.0f, 120.0f, "%.0f deg"))
            appearance.only_clear_creases = false;
        appearance.crease_angle_deg = std::clamp(appearance.crease_angle_deg, 10.0f, 180.0f);
    }
    end_model_only();
}

void ViewPanel::draw_colors(ViewSession& session) {
    ViewAppearance& appearance = session.appearance;
    if (const auto paper = chosen_color("paper", appearance.background))
        appearance.background = *paper;
    ImGui::SameLine();
    const glm::vec3 surface = session.is_cloud()
                                  ? linear_of(cloud_colors(appearance.background).clay)
                                  : default_surface_color(appearance.style, appearance.background);
    if (const auto color = chosen_color("surface", appearance.color.value_or(surface)))
        appearance.color = color;
    ImGui::SameLine();
    const glm::vec3 ink = session.is_cloud()
                              ? linear_of(cloud_colors(appearance.background).ink)
                              : default_palette(appearance.style, appearance.background).ink;
    if (const auto color = chosen_color("ink", appearance.line_color.value_or(ink)))
        appearance.line_color = color;
    const ModelDocument* const model = session.document().model();
    if (!model || model->mesh().materials().empty()) return;
    bool shows_file_colors = appearance.shows_file_colors();
    if (ImGui::Checkbox("colors of the file", &shows_file_colors)) {
        appearance.materials = shows_file_colors;
        if (shows_file_colors) appearance.color.reset();
    }
    ImGui::SameLine();
    ImGui::Checkbox("lines too", &appearance.material_lines);
}

void ViewPanel::draw_lights(ViewSession& session, PanelRequests& requests) {
    begin_model_only(session, "a cloud has no faces to cast shadows");
    draw_enabled_lights(session, requests);
    end_model_only();
}

void ViewPanel::draw_enabled_lights(ViewSession& session, PanelRequests& requests) {
    int shadows =
        session.appearance.shadows ? 1 + static_cast<int>(session.appearance.shadow_method) : 0;
    if (choose("shadows", k_shadows, shadows)) {
        session.appearance.shadows = shadows > 0;
        if (shadows > 0) session.appearance.shadow_method = static_cast<ShadowMethod>(shadows - 1);
    }
    ImGui::Checkbox("ground (G)", &session.appearance.ground);
    const SceneBounds bounds = session.bounds();
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < session.lights.size(); ++i) {
        Light& light = session.lights[i];
        ImGui::PushID(static_cast<int>(i));
        int kind = light.directional ? 0 : 1;
        ImGui::AlignTextToFramePadding();
        ImGui::Text("%zu", i + 1);
        ImGui::SameLine();
        if (ImGui::RadioButton("sun", &kind, 0)) light = as_sun(light, bounds);
        ImGui::SameLine();
        if (ImGui::RadioButton("lamp", &kind, 1)) light = as_lamp(light, bounds);
        if (session.lights.size() > 1) {
            ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize("Remove").x -
                            2.0f * ImGui::GetStyle().FramePadding.x);
            if (ImGui::SmallButton("Remove")) removed = i;
        }
        ImGui::PopID();
    }
    if (session.lights.size() == 1 && session.lights[0].directional)
        ImGui::Checkbox("fill and rim light", &session.appearance.three_point);
    if (removed) session.remove_light(*removed);
    constexpr std::size_t k_max_lights = 8;
    if (session.lights.size() < k_max_lights) {
        if (ImGui::Button("Add a light", {-0.5f * ImGui::GetWindowWidth(), 0.0f}))
            session.add_light();
        ImGui::SameLine();
    }
    if (ImGui::Button("Choose the sun", {-1.0f, 0.0f})) requests.choose_sun = true;
    ImGui::TextDisabled("drag the handles; the wheel pushes them");
}

PanelRequests::Save ViewPanel::picture_request() const {
    return {picture_path_.data(),
            {static_cast<std::uint32_t>(picture_size_[0]),
             static_cast<std::uint32_t>(picture_size_[1])}};
}

PanelRequests::Save ViewPanel::scene_request() const {
    return {scene_path_.data(), picture_request().size};
}

void ViewPanel::draw_picture(const ViewSession& session, PanelRequests& requests) {
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::InputText("##picture", picture_path_.data(), picture_path_.size());
    ImGui::SetNextItemWidth(-0.3f * ImGui::GetWindowWidth());
    ImGui::InputInt2("##size", picture_size_.data());
    for (int& side : picture_size_) side = std::clamp(side, 1, static_cast<int>(k_max_image_side));
    ImGui::SameLine();
    if (ImGui::Button("Save (P)", {-1.0f, 0.0f})) requests.save = picture_request();
    begin_model_only(session, "no scene files of clouds: use C or P");
    ImGui::SetNextItemWidth(-0.3f * ImGui::GetWindowWidth());
    ImGui::InputText("##scene", scene_path_.data(), scene_path_.size());
    ImGui::SameLine();
    if (ImGui::Button("Scene (X)", {-1.0f, 0.0f})) requests.save_scene = scene_request();
    end_model_only();
}

void draw_cloud_counters(const CloudReport& report) {
    row("silhouette points", grouped(report.silhouette_points));
    row("consensus edges", grouped(report.consensus_edges));
    row("points joined, left", grouped(report.added) + ", " + grouped(report.removed));
    row("boxes, faces checked",
        grouped(report.counters.box_checks) + ", " + grouped(report.counters.face_checks));
    char time[32];
    std::snprintf(time, sizeof time, "%.2f ms", report.move_ms);
    row("silhouette moved in", time);
}

void draw_model_counters(const FrameReport& report) {
    row("silhouette edges", grouped(report.silhouette));
    if (report.creases > 0) row("creases", grouped(report.creases));
    row("shadow edges", grouped(report.shadow_edges));
    row("faces turned", grouped(report.camera.flips));
    row("edges joined, left", grouped(report.camera.added) + ", " + grouped(report.camera.removed));
    row("boxes, faces checked", grouped(report.camera.counters.box_checks) + ", " +
                                    grouped(report.camera.counters.face_checks));
    row("bytes streamed", grouped(report.bytes_streamed));
    row("bytes of all", grouped(report.bytes_full));
    for (const PassTime& pass : report.passes) {
        char time[32];
        std::snprintf(time, sizeof time, "%.2f ms", pass.time_ms);
        row(shown_pass_name(pass.name).c_str(), time);
    }
}

void ViewPanel::draw_counters(const ViewSession& session, const Status& status) {
    if (session.is_cloud())
        draw_cloud_counters(status.counters.cloud);
    else
        draw_model_counters(status.counters.report);
    char time[32];
    std::snprintf(time, sizeof time, "%.1f ms", double(status.counters.last_ms()));
    row("frame", time);
    const auto& times = status.counters.times;
    const float longest = *std::max_element(times.begin(), times.end());
    ImGui::PlotLines("##times", times.data(), static_cast<int>(times.size()),
                     static_cast<int>(status.counters.next), nullptr, 0.0f,
                     std::max(longest * 1.1f, 1.0f),
                     {ImGui::GetContentRegionAvail().x, 46.0f * status.scale});
    ImGui::TextDisabled("%s", status.device.c_str());
}

void ViewPanel::draw(ViewSession& session, ViewInput& input, HoughPanel& hough,
                     const Status& status, PanelRequests& requests) {
    const float margin = 10.0f * status.scale;
    const float width = k_width * status.scale - 2.0f * margin;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    // Every time: it is pushed aside where the window is smaller than it is.
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::SetNextWindowSizeConstraints({width, 0.0f}, {width, display.y - 2.0f * margin});
    ImGui::Begin("Rimline", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
    is_folded_ = ImGui::IsWindowCollapsed();
    if (section("Model")) draw_model(session, status, requests);
    if (!session.is_empty()) {
        if (section("View")) {
            if (!status.gallery.empty() || status.finds_views) draw_gallery(status, requests);
            draw_view(session, input, requests);
        }
        if (section("Style")) draw_appearance(session);
        if (section("Light")) draw_lights(session, requests);
        begin_model_only(session, "a cloud has no faces for Hough space");
        ImGui::Checkbox("Hough space (I)", &hough.open);
        end_model_only();
        if (section("Camera", false)) {
            draw_camera(session, requests);
        }
        if (section("Picture", false)) draw_picture(session, requests);
        if (section("Frame", false)) draw_counters(session, status);
    }
    ImGui::TextDisabled("Tab hides this; Ctrl+Z undoes");
    ImGui::End();
}

void ViewPanel::draw_messages(const Status& status, PanelRequests& requests) {
    const bool shows_loading = status.loading && !visible;
    if (message.empty() && !shows_loading) return;
    const float margin = 10.0f * status.scale;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float left = (visible ? k_width * status.scale : 0.0f) + margin;
    const float width = std::max(display.x - left - margin, 200.0f * status.scale);
    ImGui::SetNextWindowPos({left + 0.5f * width, display.y - margin}, ImGuiCond_Always,
                            {0.5f, 1.0f});
    const float least = shows_loading ? std::min(width, k_width * status.scale) : 0.0f;
    ImGui::SetNextWindowSizeConstraints({least, 0.0f}, {width, display.y});
    ImGui::Begin("Messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoNav);
    if (shows_loading) draw_loading(*status.loading, requests);
    if (!message.empty()) {
        const float padding = 2.0f * ImGui::GetStyle().WindowPadding.x;
        ImGui::PushStyleColor(ImGuiCol_Text, color_of(message_kind));
        ImGui::PushTextWrapPos(
            std::min(width - padding, ImGui::CalcTextSize(message.c_str()).x + padding));
        ImGui::TextUnformatted(message.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        if (ImGui::SmallButton("Dismiss")) message.clear();
    }
    ImGui::End();
}

}  // namespace rimline::tools
