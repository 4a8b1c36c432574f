#include "silhouette/mesh/formats/gltf_nodes.h"

#include <span>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

namespace {

// Nodes to visit, one after the other, below the same parent.
struct Siblings {
    std::span<const std::uint32_t> left;
    glm::dmat4 scene_from_parent;
};

class NodeVisit {
public:
    NodeVisit(const std::string& file, const GltfScene& scene)
        : file_(file), scene_(scene), is_visited_(scene.nodes.size(), false) {}

    // The node of this number. Its number must be new.
    const GltfNode& enter(std::uint32_t number) {
        if (number >= scene_.nodes.size())
            bad_file(file_, "nodes: node " + std::to_string(number) + " does not exist");
        if (is_visited_[number])
            fail(number, ": is reached twice; nodes should form trees, without cycles");
        is_visited_[number] = true;
        const GltfNode& node = scene_.nodes[number];
        if (node.mesh && *node.mesh >= scene_.meshes.size())
            fail(number, ".mesh: mesh " + std::to_string(*node.mesh) + " does not exist");
        return node;
    }

    glm::dmat4 parent_from_node(const GltfNode& node, std::uint32_t number) const {
        if (!node.transform) return glm::dmat4(1.0);
        const GltfTransform& transform = scene_.transforms[*node.transform];
        if (transform.fault != nullptr) fail(number, std::string(": ") + transform.fault);
        return glm::dmat4(transform.parent_from_node);
    }

private:
    [[noreturn]] void fail(std::uint32_t number, const std::string& what) const {
        bad_file(file_, "nodes[" + std::to_string(number) + "]" + what);
    }

    const std::string& file_;
    const GltfScene& scene_;
    std::vector<bool> is_visited_;
};

}  // namespace

void for_each_instance(const std::string& file, const GltfScene& scene, const std::stop_token& stop,
                       const std::function<void(std::uint32_t, const glm::dmat4&)>& visit) {
    if (scene.nodes.empty()) {
        for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) visit(i, glm::dmat4(1.0));
        return;
    }
    NodeVisit nodes(file, scene);
    const std::span<const std::uint32_t> children(scene.children);
    std::vector<Siblings> stack;
    if (!scene.roots.empty()) stack.push_back({scene.roots, glm::dmat4(1.0)});
    for (std::uint64_t visits = 0; !stack.empty(); ++visits) {
        if (visits % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        Siblings& top = stack.back();
        const std::uint32_t number = top.left.front();
        const glm::dmat4 scene_from_parent = top.scene_from_parent;
        top.left = top.left.subspan(1);
        if (top.left.empty()) stack.pop_back();  // So a chain needs no stack.

        const GltfNode& node = nodes.enter(number);
        const glm::dmat4 scene_from_node = scene_from_parent * nodes.parent_from_node(node, number);
        if (node.mesh) visit(*node.mesh, scene_from_node);
        const auto [begin, end] = node.children;
        if (begin < end) stack.push_back({children.subspan(begin, end - begin), scene_from_node});
    }
}

}  // namespace rimline
