#pragma once

#include <string_view>

namespace rimline {

/// What bytes are that hold a model or a picture in another form, or in its place, and what to do: gzip, ZIP, a pointer
/// of Git LFS, UTF-16. Empty if they are none of these. Binary formats whose first bytes may be any must be known
/// before.
std::string_view wrapped_content(std::string_view bytes) noexcept;

}  // namespace rimline
