#pragma once

// Other people's libraries are asked by scripts in Python, where Debian has them ready to import.

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "tools/command.h"

namespace rimline::tools {

/// What a script reads from its standard input: numbers as this machine has them, in a file without a name.
class ScriptInput {
public:
    ScriptInput() : file_(std::tmpfile()) {}

    template <typename Values>
    void add(const Values& values) {
        is_good_ = file_ && is_good_ &&
                   std::fwrite(values.data(), sizeof(*values.data()), values.size(), file_.get()) ==
                       values.size();
    }
    /// Whether all that was added is there; not where the disk had no room for it.
    bool is_complete() { return file_ && is_good_ && std::fflush(file_.get()) == 0; }
    std::FILE* file() const noexcept { return file_.get(); }

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    bool is_good_ = true;
};

/// All that the script's text prints, by the first Python in which it ends with status 0: one on the path,
/// which may lack the system's packages, then Debian's. Nothing where there is none. Throws Error{cancelled},
/// with the script ended.
std::optional<std::string> run_python(const char* script, ScriptInput& input,
                                      const Context& context);

}  // namespace rimline::tools
