#include "tools/bench/suite_models.h"

#include <CLI/App.hpp>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "tools/options/model_argument.h"

namespace rimline::tools {

std::vector<std::string> model_folders() {
    const char* list = std::getenv("RIMLINE_MODELS");
    std::istringstream stream(list ? list : "");
    std::vector<std::string> folders;
    for (std::string folder; std::getline(stream, folder, ':');)
        if (!folder.empty()) folders.push_back(folder);
    return folders;
}

std::vector<std::string> known_models(std::initializer_list<const char*> file_names,
                                      std::vector<std::string> shapes) {
    const std::vector<std::string> folders = model_folders();
    std::vector<std::string> models;
    for (const char* file_name : file_names)
        for (const std::string& folder : folders) {
            const std::filesystem::path path = std::filesystem::path(folder) / file_name;
            std::error_code ignored;
            if (!std::filesystem::exists(path, ignored)) continue;
            models.push_back(path.string());
            break;
        }
    return models.empty() ? shapes : models;
}

std::vector<std::string> usual_models() {
    return known_models({"stanford-bunny.obj", "igea.ply"},
                        {"shape:knot:70000", "shape:sphere:70000", "shape:knot:270000"});
}

void SuiteModels::add_to(CLI::App& app, const std::string& default_models) {
    app.add_option_function<std::vector<std::string>>(
           "MODELS",
           [this](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) check_model_name(text);
               named_ = texts;
           },
           model_description() + " (default: " + default_models + ")")
        ->type_name("");
    subdivide_option_ = add_subdivide(app, subdivide_)->group("Model");
}

void MachineHeading::print(const Context& context) {
    if (!context.json && !is_printed_) print_machine(machine_);
    is_printed_ = true;
}

Mesh load_suite_mesh(const std::string& model, std::uint32_t subdivide, MachineHeading& heading,
                     const Context& context) {
    Mesh mesh = load_mesh(model, subdivide, context);
    check_viewing_range(model, mesh);
    heading.print(context);
    return mesh;
}

CLI::Option* add_check(CLI::App& app, bool& check) {
    return app
        .add_flag("--check", check,
                  "Compare the ratios with their targets; exit with status 3 where one is missed")
        ->group("Kind");
}

ExitStatus report_difference(const std::string& difference) {
    return report_check(difference.empty() ? "" : difference + " differs from brute force");
}

}  // namespace rimline::tools
