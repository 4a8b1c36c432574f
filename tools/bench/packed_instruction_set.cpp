#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/brute_force_packed.h"
#include "tools/bench/machine.h"

namespace rimline::tools {

std::string packed_instruction_set() {
    const Mesh empty{MeshSource{}};
    return std::string(PackedBruteForce(empty).instruction_set());
}

}  // namespace rimline::tools
