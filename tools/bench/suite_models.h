#pragma once

// The models that a suite of `rimline bench` measures.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/machine.h"
#include "tools/cli_classes.h"
#include "tools/command.h"

namespace rimline::tools {

/// The folders of RIMLINE_MODELS, none of them empty.
std::vector<std::string> model_folders();

/// The files of the folders of RIMLINE_MODELS that have one of these names; `shapes` where there is none.
std::vector<std::string> known_models(std::initializer_list<const char*> file_names,
                                      std::vector<std::string> shapes);

/// The Stanford bunny and igea where they are installed, else built-in shapes of their sizes.
std::vector<std::string> usual_models();

/// The options MODELS and --subdivide.
class SuiteModels {
public:
    /// `default_models` completes the help: "(default: ...)".
    void add_to(CLI::App& app, const std::string& default_models);

    /// The models that the command line names; empty where it names none.
    const std::vector<std::string>& named() const noexcept { return named_; }
    std::uint32_t subdivide() const noexcept { return subdivide_; }
    const CLI::Option* subdivide_option() const noexcept { return subdivide_option_; }

private:
    std::vector<std::string> named_;
    std::uint32_t subdivide_ = 0;
    const CLI::Option* subdivide_option_ = nullptr;
};

/// The machine of a run, printed once before the first table. It is printed after the first model is loaded,
/// so that nothing is on standard output where that model cannot be read.
class MachineHeading {
public:
    const BenchMachine& machine() const noexcept { return machine_; }
    /// Prints nothing with --json and at the second call.
    void print(const Context& context);

private:
    BenchMachine machine_ = this_machine();
    bool is_printed_ = false;
};

/// The model as a mesh that can be seen from all sides (check_viewing_range). Prints `heading`.
Mesh load_suite_mesh(const std::string& model, std::uint32_t subdivide, MachineHeading& heading,
                     const Context& context);

/// Adds --check.
CLI::Option* add_check(CLI::App& app, bool& check);

/// Prints that `difference` differs from brute force and returns check_failed. Returns success where it is
/// empty.
ExitStatus report_difference(const std::string& difference);

}  // namespace rimline::tools
