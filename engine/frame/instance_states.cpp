#include "engine/frame/instance_states.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "engine/frame/silhouette_points.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

namespace {

// What a state is of: its mesh, and its octree, where the mesh does not deform.
using Content = std::pair<const Mesh*, const HoughOctree*>;

Content content_of(const SceneInstance& instance) {
    return {&instance.mesh(), instance.deforming ? nullptr : instance.octree};
}

Content content_of(const InstanceState& state) { return {state.source, state.octree}; }

bool is_of(const InstanceState& state, const SceneInstance& instance) {
    return content_of(state) == content_of(instance);
}

}  // namespace

InstanceStates::InstanceStates(const DeviceContext& context, SilhouetteService& service,
                               const Options& options)
    : context_(context),
      service_(service),
      options_(options),
      stream_budget_(options.stream_memory_bytes,
                     "the budget for silhouettes (RendererOptions::stream_memory_bytes)"),
      tracker_budget_(options.tracker_memory_bytes,
                      "the budget for trackers (RendererOptions::tracker_memory_bytes)"),
      uploads_(context) {}

// Allocates the entry before anything is moved into it: if the allocation fails, nothing is freed that a
// frame may still read.
InstanceStates::Retired& InstanceStates::next_retired() {
    return retired_.emplace_back(Retired{recorded_, std::nullopt, nullptr, nullptr, nullptr});
}

void InstanceStates::retire(std::unique_ptr<TrackedSilhouette>& silhouette) {
    if (!silhouette) return;
    next_retired().stream.emplace(silhouette->take_stream());
    silhouette.reset();
}

void InstanceStates::retire(InstanceState& state) {
    retire(state.camera);
    for (std::unique_ptr<TrackedSilhouette>& light : state.lights) retire(light);
    if (state.deforming) next_retired().deforming = std::move(state.deforming);
    state = {};
}

void InstanceStates::retire_unused_meshes(const Scene& scene) {
    std::set<const Mesh*> used;
    for (const SceneInstance& instance : scene.instances) used.insert(&instance.mesh());
    for (const HoughOctree* octree : scene.kept) used.insert(&octree->mesh());
    for (auto& [mesh, uploaded] : meshes_)
        if (!used.contains(mesh)) next_retired().mesh = std::move(uploaded);
    std::erase_if(meshes_, [](const auto& entry) { return !entry.second; });
    std::erase_if(casters_, [&](const auto& entry) { return !used.contains(entry.first); });
}

void InstanceStates::free_retired(const Frames& frames) {
    if (!retired_.empty() && uploads_.is_done())
        std::erase_if(retired_, [&](const Retired& retired) {
            return retired.last_frame < frames.first_running;
        });
}

// Each state to the index of its instance; those of instances that the scene has no more come after all others.
// Instances of one octree keep their order where others of it are removed.
void InstanceStates::place(const Scene& scene) {
    const std::size_t size = scene.instances.size();
    constexpr std::size_t k_none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> places(instances_.size(), k_none);
    std::vector<bool> is_taken(size);
    for (std::size_t i = 0; i < std::min(size, instances_.size()); ++i)
        if (is_of(instances_[i], scene.instances[i])) {
            places[i] = i;
            is_taken[i] = true;
        }
    std::multimap<Content, std::size_t> others;
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (places[i] == k_none) others.emplace(content_of(instances_[i]), i);
    for (std::size_t i = 0; i < size && !others.empty(); ++i) {
        if (is_taken[i]) continue;
        const Content content = content_of(scene.instances[i]);
        const auto found = others.lower_bound(content);
        if (found == others.end() || found->first != content) continue;
        places[found->second] = i;
        others.erase(found);
    }
    std::vector<InstanceState> placed(size + others.size());
    std::size_t next = size;
    for (std::size_t i = 0; i < instances_.size(); ++i)
        placed[places[i] == k_none ? next++ : places[i]] = std::move(instances_[i]);
    instances_.swap(placed);
}

// The mesh on the GPU; its upload may be in progress.
const GpuMesh& InstanceStates::upload(const Mesh& mesh, Uploaded& uploaded) {
    std::unique_ptr<GpuMesh>& known = meshes_[&mesh];
    if (!known) {
        UploadBatch batch(context_, uploads_);
        auto made =
            std::make_unique<GpuMesh>(batch, samplers_, mesh, options_.crease_angle_rad,
                                      options_.line_path, options_.outline == OutlineMethod::backs);
        batch.send();
        known = std::move(made);
        ++uploaded.meshes;
        uploaded.bytes += known->size_bytes();
    }
    return *known;
}

void InstanceStates::make(InstanceState& state, const SceneInstance& instance, Uploaded& uploaded) {
    const Mesh& source = instance.mesh();
    const GpuMesh& mesh = upload(source, uploaded);
    if (instance.deforming) {
        if (!deform_passes_) deform_passes_ = std::make_unique<DeformPasses>(context_);
        UploadBatch batch(context_, uploads_);
        auto made =
            std::make_unique<DeformingInstance>(batch, source, mesh, options_.crease_angle_rad,
                                                options_.ring_slots, stream_budget_, instance.name);
        batch.send();
        state.deforming = std::move(made);
    }
    state.mesh = &mesh;
    state.is_closed_chain = is_closed_chain(source);
    if (!instance.deforming) state.caster = &casters_.try_emplace(&source, source).first->second;
    // Last, because it says that all of the above has been made.
    state.source = &source;
    state.octree = instance.deforming ? nullptr : instance.octree;
}

void InstanceStates::prepare(const Scene& scene, const Frames& frames, Uploaded& uploaded) {
    recorded_ = frames.recorded;
    if (!has_instances(scene)) {
        place(scene);
        for (std::size_t i = scene.instances.size(); i < instances_.size(); ++i)
            retire(instances_[i]);
        instances_.resize(scene.instances.size());
        retire_unused_meshes(scene);
    } else if (scene.kept != kept_) {
        retire_unused_meshes(scene);
    }
    kept_ = scene.kept;
    for (InstanceState& state : instances_) {
        for (std::size_t l = scene.lights.size(); l < state.lights.size(); ++l)
            retire(state.lights[l]);
        state.lights.resize(scene.lights.size());
        state.volumes.resize(scene.lights.size());
        state.near_counters.resize(scene.lights.size());
        while (state.deforming && state.deforming->light_count() > scene.lights.size())
            next_retired().gpu_silhouette = state.deforming->take_last_light();
    }
    free_retired(frames);
    for (std::size_t i = 0; i < instances_.size(); ++i)
        if (!is_of(instances_[i], scene.instances[i]))
            make(instances_[i], scene.instances[i], uploaded);
}

void InstanceStates::prepare_silhouettes(const FrameView& view) {
    const auto prepare = [&](std::unique_ptr<TrackedSilhouette>& silhouette,
                             const SceneInstance& instance, const HomogeneousPoint& point) {
        if (silhouette)
            silhouette->announce(point);
        else
            silhouette = std::make_unique<TrackedSilhouette>(
                context_, service_, *instance.octree, point, options_.ring_slots, stream_budget_,
                tracker_budget_, instance.name);
    };
    for (std::size_t i = 0; i < view.instances.size(); ++i) {
        const SceneInstance& instance = view.scene.instances[i];
        const InstanceView& seen = view.instances[i];
        InstanceState& state = instances_[i];
        if (seen.lines && follows_camera()) {
            if (state.deforming)
                state.deforming->prepare_camera(uploads_);
            else
                prepare(state.camera, instance, *seen.lines);
        }
        for (std::size_t l = 0; l < seen.lights.size(); ++l) {
            if (!casts_shadows(view.scene, instance, view.scene.lights[l])) continue;
            if (state.deforming)
                state.deforming->prepare_light(l, uploads_);
            else
                prepare(state.lights[l], instance, seen.lights[l].point);
        }
    }
}

bool InstanceStates::has_instances(const Scene& scene) const {
    return std::ranges::equal(instances_, scene.instances, is_of);
}

bool InstanceStates::is_prepared(const Scene& scene) const {
    return has_instances(scene) && std::ranges::all_of(instances_, [&](const InstanceState& state) {
               return state.lights.size() == scene.lights.size();
           });
}

bool InstanceStates::has_silhouettes(const FrameView& view) const {
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const InstanceState& state = instances_[i];
        if (view.instances[i].lines && follows_camera() &&
            !(state.deforming ? state.deforming->has_camera() : state.camera != nullptr))
            return false;
        for (std::size_t l = 0; l < state.lights.size(); ++l) {
            if (!casts_shadows(view.scene, view.scene.instances[i], view.scene.lights[l])) continue;
            if (!(state.deforming ? state.deforming->has_light(l) : state.lights[l] != nullptr))
                return false;
        }
    }
    return true;
}

// The points of an announced scene are those of another frame: no FrameView has them. Allocates nothing.
void InstanceStates::announce(const Scene& scene) noexcept {
    for (std::size_t i = 0; i < std::min(scene.instances.size(), instances_.size()); ++i) {
        const SceneInstance& instance = scene.instances[i];
        InstanceState& state = instances_[i];
        if (instance.deforming || state.octree != instance.octree) continue;
        if (state.camera && has_silhouette_lines(scene, instance))
            state.camera->announce(camera_point(instance, lines_camera(scene)));
        if (!casts_shadows(scene, instance)) continue;
        for (std::size_t l = 0; l < std::min(scene.lights.size(), state.lights.size()); ++l)
            if (state.lights[l])
                state.lights[l]->announce(
                    casting_point(scene, instance, scene.lights[l], casters_));
    }
}

void InstanceStates::invalidate() noexcept {
    for (InstanceState& state : instances_) {
        if (state.deforming) state.deforming->invalidate();
        if (state.camera) state.camera->invalidate();
        for (const auto& light : state.lights)
            if (light) light->invalidate();
    }
}

}  // namespace rimline
