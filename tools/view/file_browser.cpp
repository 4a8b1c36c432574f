#include "tools/view/file_browser.h"

#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "tools/options/model_argument.h"
#include "tools/options/scene_mark.h"
#include "tools/output/output_file.h"

namespace rimline::tools {

namespace {

// Texts may be clouds.
bool can_be_opened(const std::filesystem::path& path) {
    return is_model_file_name(path) || is_scene_file(path.string()) || path.extension() == ".txt";
}

// In as many lines as the window needs.
void draw_tooltip(const std::string& text) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(0.8f * ImGui::GetIO().DisplaySize.x);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// A line to be clicked, with text that is clear and text that is less so; `whole` in a tooltip where it is too long.
bool draw_line(const std::string& whole, const std::string& clear, const std::string& faint) {
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 place = ImGui::GetCursorScreenPos();
    ImGui::PushID(whole.c_str());
    const bool is_clicked = ImGui::Selectable("##name");
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(place, ImGui::GetColorU32(ImGuiCol_Text), clear.c_str());
    const float end = ImGui::CalcTextSize(clear.c_str()).x;
    list.AddText({place.x + end, place.y}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                 faint.c_str());
    if (ImGui::IsItemHovered() && end + ImGui::CalcTextSize(faint.c_str()).x > width)
        draw_tooltip(whole);
    return is_clicked;
}

}  // namespace

std::filesystem::path recent_files_path() {
    const auto folder = [](const char* name) -> std::filesystem::path {
        const char* const value = std::getenv(name);
        return value && *value == '/' ? value : "";
    };
    if (const std::filesystem::path state = folder("XDG_STATE_HOME"); !state.empty())
        return state / "rimline" / "recent";
    if (const std::filesystem::path home = folder("HOME"); !home.empty())
        return home / ".local" / "state" / "rimline" / "recent";
    return {};
}

RecentFiles::RecentFiles(std::filesystem::path file) : file_(std::move(file)) {
    std::ifstream in(file_);
    for (std::string line; names_.size() < k_most && std::getline(in, line);)
        if (!line.empty()) names_.push_back(line);
}

void RecentFiles::add(const std::string& name) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(name, error);
    if (error || !std::filesystem::is_regular_file(path, error)) return;  // A built-in shape.
    const std::string text = path.lexically_normal().string();
    if (text.find('\n') != std::string::npos) return;
    std::erase(names_, text);
    names_.insert(names_.begin(), text);
    if (names_.size() > k_most) names_.resize(k_most);
    if (file_.empty()) return;
    std::filesystem::create_directories(file_.parent_path(), error);
    std::string text_of_names;
    for (const std::string& recent : names_) text_of_names += recent + '\n';
    try {
        OutputFile out(file_);
        out.write(text_of_names);
        out.commit();
    } catch (const std::runtime_error&) {
        // Then they are forgotten.
    }
}

FolderListing list_folder(const std::filesystem::path& folder) {
    FolderListing listing;
    std::error_code error;
    std::filesystem::directory_iterator entry(folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code unreadable;
        if (entry->is_directory(unreadable))
            listing.folders.push_back(name);
        else if (can_be_opened(entry->path()))
            listing.files.push_back(name);
    }
    std::ranges::sort(listing.folders);
    std::ranges::sort(listing.files);
    return listing;
}

void FileBrowser::enter(const std::filesystem::path& folder) {
    folder_ = folder;
    if (!folder_.empty()) listing_ = list_folder(folder_);
}

bool draw_name(const std::string& name) { return draw_line(name, name, ""); }

bool draw_path(const std::string& path) {
    const std::filesystem::path parts(path);
    return draw_line(path, parts.filename().string(), "  " + parts.parent_path().string());
}

std::optional<std::string> FileBrowser::draw(float height) {
    if (folder_.empty()) {
        std::error_code error;
        enter(std::filesystem::current_path(error));
    }
    std::optional<std::string> chosen;
    std::optional<std::filesystem::path> entered;
    ImGui::TextDisabled("%s", folder_.string().c_str());
    ImGui::BeginChild("files", {0.0f, height}, true);
    if (folder_.has_parent_path() && draw_name("..")) entered = folder_.parent_path();
    for (const std::string& name : listing_.folders)
        if (draw_name(name + "/")) entered = folder_ / name;
    for (const std::string& name : listing_.files)
        if (draw_name(name)) chosen = (folder_ / name).string();
    ImGui::EndChild();
    if (entered) enter(*entered);
    return chosen;
}

}  // namespace rimline::tools
