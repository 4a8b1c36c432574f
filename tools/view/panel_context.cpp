#include "tools/view/panel_context.h"

#include <imgui.h>
#include <imgui_impl_glfw.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>

namespace rimline::tools {

namespace {

static_assert(sizeof(ImDrawVert) == sizeof(gpu::OverlayVertex) &&
                  offsetof(ImDrawVert, pos) == offsetof(gpu::OverlayVertex, place) &&
                  offsetof(ImDrawVert, uv) == offsetof(gpu::OverlayVertex, texture) &&
                  offsetof(ImDrawVert, col) == offsetof(gpu::OverlayVertex, color),
              "the toolkit's vertices are copied without conversion");

constexpr const char* k_font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float k_font_size = 14.0f;

// Dark text on a light warm gray, like the ink style.
void set_style(float scale) {
    ImGui::StyleColorsLight();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 5.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.WindowBorderSize = 1.0f;
    style.FrameBorderSize = 0.0f;
    style.WindowPadding = {12.0f, 10.0f};
    style.ItemSpacing = {8.0f, 4.5f};
    style.FramePadding = {7.0f, 3.0f};
    style.ScrollbarSize = 11.0f;
    const auto set = [&](ImGuiCol color, float r, float g, float b, float a) {
        style.Colors[color] = {r, g, b, a};
    };
    set(ImGuiCol_Text, 0.13f, 0.14f, 0.18f, 1.0f);
    set(ImGuiCol_TextDisabled, 0.46f, 0.46f, 0.48f, 1.0f);
    set(ImGuiCol_WindowBg, 0.985f, 0.975f, 0.955f, 0.96f);
    set(ImGuiCol_PopupBg, 0.99f, 0.985f, 0.97f, 0.99f);
    set(ImGuiCol_Border, 0.13f, 0.14f, 0.18f, 0.22f);
    set(ImGuiCol_TitleBg, 0.93f, 0.91f, 0.875f, 1.0f);
    set(ImGuiCol_TitleBgActive, 0.90f, 0.875f, 0.83f, 1.0f);
    set(ImGuiCol_TitleBgCollapsed, 0.93f, 0.91f, 0.875f, 0.9f);
    set(ImGuiCol_FrameBg, 0.90f, 0.885f, 0.85f, 1.0f);
    set(ImGuiCol_FrameBgHovered, 0.86f, 0.84f, 0.80f, 1.0f);
    set(ImGuiCol_FrameBgActive, 0.82f, 0.80f, 0.76f, 1.0f);
    set(ImGuiCol_Button, 0.87f, 0.85f, 0.81f, 1.0f);
    set(ImGuiCol_ButtonHovered, 0.80f, 0.77f, 0.72f, 1.0f);
    set(ImGuiCol_ButtonActive, 0.73f, 0.70f, 0.65f, 1.0f);
    set(ImGuiCol_Header, 0.90f, 0.875f, 0.83f, 1.0f);
    set(ImGuiCol_HeaderHovered, 0.86f, 0.83f, 0.78f, 1.0f);
    set(ImGuiCol_HeaderActive, 0.82f, 0.79f, 0.74f, 1.0f);
    set(ImGuiCol_CheckMark, 0.77f, 0.33f, 0.10f, 1.0f);
    set(ImGuiCol_SliderGrab, 0.77f, 0.33f, 0.10f, 0.85f);
    set(ImGuiCol_SliderGrabActive, 0.77f, 0.33f, 0.10f, 1.0f);
    set(ImGuiCol_PlotLines, 0.20f, 0.34f, 0.55f, 1.0f);
    set(ImGuiCol_PlotHistogram, 0.77f, 0.33f, 0.10f, 0.9f);
    set(ImGuiCol_ResizeGrip, 0.13f, 0.14f, 0.18f, 0.12f);
    set(ImGuiCol_Separator, 0.13f, 0.14f, 0.18f, 0.16f);
    style.ScaleAllSizes(scale);
}

void add_font(ImGuiIO& io, float scale) {
    std::error_code missing;
    const float size = std::round(k_font_size * scale);
    if (std::filesystem::exists(k_font, missing) &&
        io.Fonts->AddFontFromFileTTF(k_font, size) != nullptr)
        return;
    ImFontConfig config;
    config.SizePixels = std::round(13.0f * scale);
    io.Fonts->AddFontDefault(&config);
}

}  // namespace

PanelContext::PanelContext(const Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // Write no settings file.
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    const float scale = window.content_scale();
    set_style(scale);
    add_font(io, scale);
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
}

PanelContext::~PanelContext() {
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

FontTexture PanelContext::font_texture() const {
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    FontTexture font{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    font.opacity.assign(pixels, pixels + std::size_t{font.width} * font.height);
    return font;
}

void PanelContext::begin_frame() {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

float PanelContext::pixels_per_unit() const {
    return std::max(ImGui::GetIO().DisplayFramebufferScale.x, 1e-3f);
}

void PanelContext::end_frame() {
    ImGui::Render();
    const ImDrawData& data = *ImGui::GetDrawData();
    drawing_.clear();
    drawing_.origin = {data.DisplayPos.x, data.DisplayPos.y};
    drawing_.unit_size = {std::max(data.DisplaySize.x, 1.0f), std::max(data.DisplaySize.y, 1.0f)};
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto first_vertex = static_cast<std::uint32_t>(drawing_.vertices.size());
        const auto* vertices = reinterpret_cast<const gpu::OverlayVertex*>(list.VtxBuffer.Data);
        drawing_.vertices.insert(drawing_.vertices.end(), vertices, vertices + list.VtxBuffer.Size);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.ElemCount == 0 || command.UserCallback != nullptr) continue;
            const auto first_index = static_cast<std::uint32_t>(drawing_.indices.size());
            for (unsigned k = 0; k < command.ElemCount; ++k)
                drawing_.indices.push_back(first_vertex + command.VtxOffset +
                                           list.IdxBuffer[static_cast<int>(command.IdxOffset + k)]);
            const ImVec2 scale = data.FramebufferScale;
            const auto pixel = [](float value, float origin, float factor) {
                return static_cast<std::int32_t>(std::lround((value - origin) * factor));
            };
            const std::int32_t x0 = pixel(command.ClipRect.x, data.DisplayPos.x, scale.x);
            const std::int32_t y0 = pixel(command.ClipRect.y, data.DisplayPos.y, scale.y);
            const std::int32_t x1 = pixel(command.ClipRect.z, data.DisplayPos.x, scale.x);
            const std::int32_t y1 = pixel(command.ClipRect.w, data.DisplayPos.y, scale.y);
            if (x1 <= x0 || y1 <= y0) continue;
            drawing_.parts.push_back(
                {first_index,
                 command.ElemCount,
                 {{x0, y0},
                  {static_cast<std::uint32_t>(x1 - x0), static_cast<std::uint32_t>(y1 - y0)}}});
        }
    }
}

}  // namespace rimline::tools
