#pragma once

// Parts of rimline that a build may lack, and the commands that need them.

#include <string>

#include "silhouette/error.h"
#include "tools/command.h"

namespace rimline::tools {

enum class BuildPart { engine, window, methods };

/// The error of `what`, a command or option that needs a part which this build lacks. The message tells how
/// to configure a build that has the part.
Error absent_part_error(const std::string& what, BuildPart part);

/// In a build without the other silhouette methods, throws absent_part_error(). `what` needs them.
void require_methods(const std::string& what);

/// Stands in for a command that needs a part which this build lacks. Takes any arguments; run() throws
/// absent_part_error().
class AbsentCommand final : public Command {
public:
    /// `parent` is the command that this one belongs to; empty for a command of the program itself.
    AbsentCommand(BuildPart part, std::string name, std::string summary, std::string parent = {});

    std::string name() const override { return name_; }
    std::string summary() const override;
    void add_options(CLI::App& app) override;
    ExitStatus run(const Context& context) override;

private:
    BuildPart part_;
    std::string name_, summary_, parent_;
};

}  // namespace rimline::tools
