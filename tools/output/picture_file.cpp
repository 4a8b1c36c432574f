#include "tools/output/picture_file.h"

#include <cstddef>
#include <vector>

namespace rimline::tools {

void write_png(OutputFile& file, const Picture& picture, const LongCall& call) {
    const std::vector<std::byte> png = encode_png(picture, call);
    file.write({reinterpret_cast<const char*>(png.data()), png.size()});
    file.commit();
}

}  // namespace rimline::tools
