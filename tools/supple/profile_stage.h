// What supple profile runs frames of: a group, or a crowd of several in a view; made, posed and destroyed.
#pragma once

#include "tools/common/character_file.h"
#include "tools/supple/options.h"
#include "tools/supple/profile_report.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace supple::tools {

struct ProfileOptions {
    std::vector<std::string> files;
    std::string clip; ///< name or index; empty: the first, or the bind pose of a file without clips
    std::vector<host::MorphSetting> morphs;
    SurfaceFlags surface;
    DeviceFlags device;
    uint32_t instances = 1;
    uint32_t frames = 60;
    bool motion = false;
    bool tangents = false;
    bool playback = false;
    bool view = false;
    uint32_t budget = 1000000; ///< of the view
    uint32_t coefficients = 0; ///< of the view, MiB that its instances share; 0: each has its own
    uint32_t keepUnseen = 0;   ///< in a view, frames: groups that nobody sees for so long give memory back; 0: none
    std::string json, csv, trace, html;
    std::vector<std::string> sweeps;    ///< "instances=1,10", "rate=4,8": as typed
    std::string compare;                ///< an earlier result
    std::string against;                ///< another build's command
    uint32_t rounds = 16;               ///< with it
    uint32_t timeout = 600;             ///< with `against`: seconds that one measurement may take
    double failAbove = 0.0;             ///< percent; 0: no gate
    double budgetMs = 0.0;              ///< of the frame; 0: no gate
    std::vector<std::string> arguments; ///< of the command line
    std::string hashes;                 ///< of what the view drew last

    [[nodiscard]] bool plays() const { return playback || view; }
};

class ProfileStage {
public:
    ProfileStage(host::Context& context, const ProfileOptions& options) : context_(context), options_(options) {}

    /// A group a file, in a view where the options say so, and all instances, dealt to the groups in turn. Fills in
    /// what `run` says of them.
    [[nodiscard]] Status create(std::span<const host::CharacterFile> files, const std::string& scheme, ProfileRun& run);
    [[nodiscard]] Status destroy();

    [[nodiscard]] std::span<const SuppleGroup> groups() const { return groups_; }
    /// Of a frame a sixtieth of a second after the one before: all instances play their file's clip in a loop, spread
    /// evenly over its length.
    [[nodiscard]] Status setPoses(uint32_t frame);
    /// Index of ProfileRun::surfaces.
    [[nodiscard]] size_t surfaceOf(SuppleGroup group, uint32_t surface) const;
    /// What assets, groups and the view hold now.
    [[nodiscard]] Result<std::vector<MemoryHolder>> holders() const;
    /// The view's camera no longer sees any instance.
    [[nodiscard]] Status lookAway() const;
    /// Of the newest completed frame, if there is one and a view.
    [[nodiscard]] std::optional<SuppleViewStatistics> statistics() const;

private:
    struct Subject {
        std::string name; ///< of the file
        SuppleAsset asset{};
        std::vector<SuppleInstance> instances;
        uint32_t clip = SUPPLE_BIND_POSE;
        double clipDuration = 0.0;
    };
    [[nodiscard]] Status createView(std::span<const host::CharacterFile> files);
    [[nodiscard]] Status setCamera(bool away) const;
    /// What the group is, for the run's report.
    [[nodiscard]] Status report(SuppleGroup group, const host::CharacterFile& file, ProfileRun& run);
    [[nodiscard]] Result<ProfiledSurface> reportSurface(SuppleGroup group, uint32_t index,
                                                        const SuppleSurfaceInfo& info,
                                                        const host::CharacterFile& file) const;
    [[nodiscard]] Status createGroup(const host::CharacterFile& file, const std::string& scheme, uint32_t instances,
                                     ProfileRun& run);
    [[nodiscard]] Status setMorphs(const host::CharacterFile& file, const Subject& subject);
    [[nodiscard]] Status startPlayback(const Subject& subject);
    [[nodiscard]] Status place();
    [[nodiscard]] static double phase(const Subject& subject, size_t instance);
    [[nodiscard]] Status check(SuppleResult result, const char* call) const { return context_.check(result, call); }
    [[nodiscard]] SuppleContext handle() const { return context_.handle(); }

    host::Context& context_;
    const ProfileOptions& options_;
    SuppleView view_{};
    float spacing_ = 1.0f; ///< of the crowd, and the radius of a character
    std::vector<Subject> subjects_;
    std::vector<SuppleGroup> groups_;   ///< in their order
    std::vector<size_t> firstSurfaces_; ///< of each in ProfileRun::surfaces: the group as a whole, then its surfaces
};

} // namespace supple::tools
