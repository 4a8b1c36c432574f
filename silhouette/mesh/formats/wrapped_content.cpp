#include "silhouette/mesh/formats/wrapped_content.h"

#include <array>

namespace rimline {

std::string_view wrapped_content(std::string_view bytes) noexcept {
    struct Form {
        std::string_view begin, what;
    };
    constexpr std::array<Form, 5> k_forms{
        {{"\x1f\x8b", "it is compressed by gzip; unpack it"},
         {"PK\x03\x04",
          "it is a ZIP archive, as 3MF and USDZ files are; unpack it, or save it as glTF"},
         {"version https://git-lfs", "it is a pointer of Git LFS; 'git lfs pull' fetches the file"},
         {"\xff\xfe", "it is text in UTF-16; save it as UTF-8"},
         {"\xfe\xff", "it is text in UTF-16; save it as UTF-8"}}};
    for (const Form& form : k_forms)
        if (bytes.starts_with(form.begin)) return form.what;
    return {};
}

}  // namespace rimline
