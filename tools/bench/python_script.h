#pragma once

// Runs Python scripts, for libraries that Debian packages for Python, and other programs.

#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tools/command.h"

namespace rimline::tools {

/// The standard input of a script: numbers in this machine's format, in an unnamed file.
class ScriptInput {
public:
    ScriptInput() : file_(std::tmpfile()) {}

    template <typename Values>
    void add(const Values& values) {
        is_good_ = file_ && is_good_ &&
                   std::fwrite(values.data(), sizeof(*values.data()), values.size(), file_.get()) ==
                       values.size();
    }
    /// Whether everything was written. False where the disk is full.
    bool is_complete() { return file_ && is_good_ && std::fflush(file_.get()) == 0; }
    std::FILE* file() const noexcept { return file_.get(); }

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    bool is_good_ = true;
};

/// Runs the script with the first Python in which it ends with status 0: the one on the path, which may
/// lack the system's packages, then Debian's. Returns its whole output; nothing where there is no such
/// Python. Throws Error{cancelled} after ending the script.
std::optional<std::string> run_python(const char* script, ScriptInput& input,
                                      const Context& context);

/// Runs a program of the path, the first of its `arguments`, in the same way. Returns nothing where it does not end
/// with status 0 or is not there.
std::optional<std::string> run_program(std::span<const char* const> arguments, ScriptInput& input,
                                       const Context& context);

}  // namespace rimline::tools
