#include "tools/options/replaced_settings.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

#include "tools/options/color.h"

namespace rimline::tools {

namespace {

using Setting = SceneFile::Setting;

// What the user has given an option, or nothing.
std::string given(const CLI::App& app, const char* name) {
    const CLI::Option* option = app.get_option_no_throw(name);
    return option && option->count() > 0 ? option->results().back() : std::string();
}

void drop(std::vector<Setting>& settings, std::initializer_list<std::string_view> options) {
    std::erase_if(settings, [&](const Setting& setting) {
        return std::ranges::find(options, setting.option) != options.end();
    });
}

// Whether the user has replaced a setting by another value.
bool is_replaced(const CLI::App& app, const std::vector<Setting>& settings, const char* name) {
    const std::string own = given(app, name);
    const auto of_file = std::ranges::find(settings, name, &Setting::option);
    return !own.empty() && (of_file == settings.end() || of_file->value != own);
}

bool is_black_or_white(const std::string& text) {
    const std::optional<Color> color = color_of(text);
    return color == Color{0, 0, 0} || color == Color{255, 255, 255};
}

}  // namespace

void drop_replaced(const CLI::App& app, std::vector<Setting>& settings) {
    if (is_replaced(app, settings, "--style")) drop(settings, {"--palette"});
    if (given(app, "--style") == "mask")
        std::erase_if(settings, [](const Setting& setting) {
            return (setting.option == "--color" || setting.option == "--line-color" ||
                    (setting.option == "--background" && setting.value != "none")) &&
                   !is_black_or_white(setting.value);
        });
    if (is_replaced(app, settings, "--outline")) drop(settings, {"--depth-step", "--normal-step"});
    if (!given(app, "--silhouette-from").empty() || !given(app, "--silhouette-direction").empty())
        drop(settings,
             {"--silhouette-from", "--silhouette-direction", "--intersections", "--min-length"});
    if (given(app, "--line-visibility") == "depth" || !given(app, "--deform").empty())
        drop(settings, {"--intersections", "--min-length"});
    // Lighting has a sun as key light, which lamps of the user replace.
    if (!given(app, "--light").empty()) drop(settings, {"--lighting"});
    if (given(app, "--lighting") != "three-point") return;
    drop(settings, {"--light"});
    const auto is_sun = [](const Setting& setting) { return setting.option == "--sun"; };
    if (std::ranges::count_if(settings, is_sun) > 1) std::erase_if(settings, is_sun);
}

}  // namespace rimline::tools
