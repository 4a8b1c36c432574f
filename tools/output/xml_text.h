#pragma once

// Plain text in XML and HTML.

#include <string>
#include <string_view>

namespace rimline::tools {

/// As the content of an element, or of an attribute in double quotes.
inline std::string escaped_for_xml(std::string_view plain) {
    std::string text;
    for (const char c : plain) {
        if (c == '<')
            text += "&lt;";
        else if (c == '>')
            text += "&gt;";
        else if (c == '&')
            text += "&amp;";
        else if (c == '"')
            text += "&quot;";
        else
            text += c;
    }
    return text;
}

}  // namespace rimline::tools
