#pragma once

// Values as the words of a command line that are parsed to the same values.

#include <glm/vec3.hpp>
#include <string>

namespace rimline::tools {

/// A number that parses to the same value. A float is parsed as options are: as a double that is rounded.
std::string exact_text(float value);
std::string exact_text(double value);
/// Three such numbers with commas between them.
std::string vector_text(const glm::vec3& v);

/// `text` as one word of a POSIX shell. Printable: where `text` is not (printable_text.h), its bytes are in octal.
std::string quoted_for_shell(const std::string& text);

}  // namespace rimline::tools
