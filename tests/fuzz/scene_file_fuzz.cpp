// A scene file: either it is read, or there is a message with its name.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "silhouette/error.h"
#include "tests/fuzz/fuzz_input.h"
#include "tools/options/scene_file.h"

using namespace rimline;

namespace {

// In memory where the machine has such a folder.
std::string scratch_path() {
    const bool has_memory = access("/dev/shm", W_OK) == 0;
    return std::string(has_memory ? "/dev/shm" : "/tmp") + "/rimline-fuzz-" +
           std::to_string(getpid()) + ".json";
}

struct Scratch {
    std::string path = scratch_path();
    ~Scratch() { unlink(path.c_str()); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Scratch scratch;
    std::ofstream(scratch.path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        const tools::SceneFile scene = tools::read_scene_file(scratch.path);
        fuzz::require(!scene.models.empty(), "a scene without a model");
        for (const tools::PlacedModel& model : scene.models)
            fuzz::require(model.scale >= tools::k_min_scale && model.scale <= tools::k_max_scale,
                          "a scale out of range");
        (void)tools::find_camera(scene, "");
    } catch (const Error& error) {
        fuzz::require_message(error.what(), scratch.path);
    }
    return 0;
}
