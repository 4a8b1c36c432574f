#pragma once

// Names of files in messages, drawings and JSON.
//
// A name of a file is any sequence of bytes. Some move the cursor of a terminal, are no UTF-8, or are forbidden in
// XML.

#include <string>
#include <string_view>

namespace rimline {

/// `text` with every control character, and every byte that is not part of a character in UTF-8, as \xNN. Other
/// characters stay as they are.
std::string printable_text(std::string_view text);

/// The numbers of 16 bits that stand for `text` in UTF-16. It must be UTF-8, as printable_text() makes it.
std::u16string utf16_of(std::string_view text);

}  // namespace rimline
