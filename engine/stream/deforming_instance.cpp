#include "engine/stream/deforming_instance.h"

#include <cstring>

#include "engine/vulkan/barrier.h"

namespace rimline {

void DeformedFrame::clear() noexcept {
    meshes_.clear();
    runs_.clear();
    uses_.clear();
}

void DeformedFrame::add(const SilhouetteRun& run, Purpose purpose, bool is_first) {
    runs_.push_back(run);
    uses_.push_back({purpose, is_first});
}

void DeformedFrame::record(const DeviceContext& context, Commands commands,
                           const DeformPasses& passes) {
    if (is_empty()) return;
    passes.deform.record(commands, meshes_);
    passes.silhouettes.record(commands, runs_);
    if (runs_.empty()) return;
    grow(counts_, context, sizeof(GpuSilhouetteCounts) * runs_.size(), BufferPlace::readback,
         "silhouette counts");
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        const VkBufferCopy region{.dstOffset = sizeof(GpuSilhouetteCounts) * i,
                                  .size = sizeof(GpuSilhouetteCounts)};
        commands->CmdCopyBuffer(commands, runs_[i].silhouette->counts().handle(), counts_.handle(),
                                1, &region);
    }
    record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                   {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
}

DeformedCounts DeformedFrame::counts(Purpose purpose) const {
    DeformedCounts sum;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (uses_[i].purpose != purpose) continue;
        GpuSilhouetteCounts run;
        std::memcpy(&run, counts_.mapped() + sizeof run * i, sizeof run);
        sum.silhouette += run.silhouette;
        sum.regular += run.regular;
        if (uses_[i].is_first) continue;
        sum.flips += run.flips;
        sum.added += run.added;
        sum.removed += run.removed;
    }
    return sum;
}

void DeformingInstance::make(Found& found, Uploads& uploads) {
    if (found.silhouette) return;
    UploadBatch batch(mesh_.context(), uploads);
    auto made = std::make_unique<GpuSilhouette>(batch, mesh_.topology(), mesh_.faces(),
                                                GpuSilhouette::Changes::counted, &budget_, model_);
    batch.send();
    found.silhouette = std::move(made);
}

const GpuSilhouette& DeformingInstance::add(Found& found, const HomogeneousPoint& point,
                                            DeformedFrame::Purpose purpose, DeformedFrame& frame) {
    frame.add({found.silhouette.get(), point}, purpose, !found.was_computed);
    found.was_computed = true;
    return *found.silhouette;
}

}  // namespace rimline
