// All that is Supple's: the context, the character that is chosen, its group and who stands where. Lives on the render
// thread.
#pragma once

#include "device.h"
#include "settings.h"

#include <QFile>
#include <QVector3D>

#include <array>
#include <vector>

namespace qt_quick {

struct Surface {
    SuppleVertexStreams streams{};
    SuppleGridOutput grid{};
};

class Characters {
public:
    /// `recording`: a file for a recording of all calls (supple replay), or empty.
    Characters(const Device& device, uint32_t framesInFlight, const QString& recording);

    /// Loads what has changed: the file, the surface, the number of instances. True if there is a new group.
    bool choose(const Settings& settings);
    /// Poses everybody and records Supple's passes. frame and completed: suppleBeginFrame.
    void record(VkCommandBuffer commands, const Settings& settings, uint64_t frame, uint64_t completed);

    const supple::Asset& asset() const { return asset_; }
    const SuppleGroupInfo& info() const { return info_; }
    const std::vector<Surface>& surfaces() const { return surfaces_; }
    uint32_t materialCount() const { return assetInfo_.materialCount; }
    /// x, y, z and the radius of the foot, per instance.
    const std::vector<std::array<float, 4>>& feet() const { return feet_; }
    void report(Report& out) const;

    /// How the draws use what Supple writes: both `before` and `after` of suppleRecord.
    static constexpr SuppleSyncScope kDraws{
        VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT |
            VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
        VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};

    /// Errors in Supple's log so far.
    static int errors();

private:
    void load(const QString& path);
    bool makeGroup(SuppleScheme scheme, uint32_t rate);
    void stand(uint32_t count);
    void startRecording();
    static void onLog(SuppleSeverity severity, SuppleMessage message, const char* text, void* user);

    QString lastError_;
    QString refusal_;
    Settings shown_;
    QFile recording_; ///< the context writes it
    supple::Context context_;
    supple::Asset asset_;
    SuppleAssetInfo assetInfo_{};
    SuppleBounds box_{}; ///< a character's, in the rest pose
    QStringList clips_;
    supple::Group group_;
    SuppleGroupInfo info_{};
    std::vector<Surface> surfaces_;
    std::vector<supple::Instance> instances_;
    std::vector<std::array<float, 4>> feet_;
    mutable std::vector<SuppleTiming> timings_;
};

} // namespace qt_quick
