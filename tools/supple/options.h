// Flags that several subcommands share, and what their values mean.
#pragma once

#include "base/result.h"
#include "tools/common/character_file.h"
#include "tools/common/modifier_settings.h"
#include "tools/common/morph_weights.h"
#include "tools/common/part_settings.h"
#include "tools/common/schemes.h"
#include "tools/common/transition_setting.h"

#include <cstdint>
#include <span>
#include <string>
#include <supple/supple.h>
#include <vector>

namespace CLI {
class App;
}

namespace supple::tools {

/// While one lives, what is added to a command stands under its heading in --help.
class HelpGroup {
public:
    HelpGroup(CLI::App& command, const char* heading);
    ~HelpGroup();
    HelpGroup(const HelpGroup&) = delete;
    HelpGroup& operator=(const HelpGroup&) = delete;

private:
    CLI::App& command_;
    std::string before_;
};

/// --device, --mapping, --validate: wherever a device is used.
struct DeviceFlags {
    std::string device; ///< name or index; empty: the best
    std::string mapping = "auto";
    bool validate = false;
    std::string record; ///< file for a recording; empty: none
    bool rayTracing = false;
};
void bindDevice(CLI::App& command, std::string& device, std::string& mapping, bool& validate);
void bindDevice(CLI::App& command, DeviceFlags& flags);
/// --record: what makes one context.
void bindRecord(CLI::App& command, std::string& record);
[[nodiscard]] SuppleMapping mappingOf(const DeviceFlags& flags);

/// --clips, --pair-quads, --keep-triangles, --creases-from-normals, --scene, --parts-apart, --vertices-apart,
/// --memory-limit and
/// --strict.
void bindReading(CLI::App& command, host::ReadOptions& reading);

/// --size and --cell: "WxH" in pixels, each 1 to 16384. bindSize() checks it while the command line is read.
[[nodiscard]] Result<VkExtent2D> parseSize(const std::string& text);
void bindSize(CLI::App& command, const char* name, std::string& size, const char* description);

/// --scheme, --part-scheme, --rate and how the surface is built.
struct SurfaceFlags {
    std::string scheme = "auto";
    std::vector<host::PartScheme> partSchemes;
    uint32_t rate = 8;
    std::string tangents = "default";
    std::string corners = "sharp";
    std::string creases = "cut";
    float sharpThreshold = 1.0f;
    std::string rules = "catmull-clark"; ///< of fragments
    std::string uvMode = "file";
    std::string skinning = "file";
    host::ReadOptions reading;
};
/// `extraSchemes`: what --scheme also takes here, such as "cage".
void bindScheme(CLI::App& command, std::string& scheme, std::vector<host::PartScheme>& partSchemes, uint32_t& rate,
                std::string& skinning, host::ReadOptions& reading, const std::vector<std::string>& extraSchemes = {});
void bindSurface(CLI::App& command, SurfaceFlags& flags, const std::vector<std::string>& extraSchemes = {});
/// --skinning alone.
void bindSkinning(CLI::App& command, std::string& skinning);
/// --creases and --sharp.
void bindSharpEdges(CLI::App& command, std::string& creases, float& sharpThreshold);
/// --rules.
void bindRules(CLI::App& command, std::string& rules);
/// --uv-mode.
void bindUvMode(CLI::App& command, std::string& uvMode);
/// What a description of a group points to.
struct SchemeOptions {
    SupplePrepOptions prep{};
    SuppleBlendOptions blend{};
    SuppleFragmentsOptions fragments{};
    std::vector<SuppleScheme> partSchemes;
};
/// The description's fields that the flags set. It then points to `options`. The error names a part that is not there.
[[nodiscard]] Status describeSurface(const SurfaceFlags& flags, const cage::Character& character,
                                     SchemeOptions& options, SuppleGroupDesc& desc);

/// --creases: "cut" or "curve".
[[nodiscard]] SuppleCreaseMode creaseModeOf(const std::string& name);
/// --rules: "catmull-clark" or "loop".
[[nodiscard]] SuppleFragmentRules rulesOf(const std::string& name);
/// --uv-mode: "file", or a name of OpenSubdiv's.
[[nodiscard]] SuppleUvInterpolation uvInterpolationOf(const std::string& name);
/// --skinning: "linear", "dual-quaternion", "centers", "mush", "mush-light" or "file".
[[nodiscard]] SuppleSkinning skinningOf(const std::string& name);
[[nodiscard]] const char* skinningName(SuppleSkinning skinning);

/// --rate alone.
void bindRate(CLI::App& command, uint32_t& rate);

/// --clip, a name or index; --time in seconds. `without`: the pose without a clip.
void bindPose(CLI::App& command, std::string& clip, double& time, const std::string& without = "the bind pose");

/// --morph, as often as it is given.
void bindMorphs(CLI::App& command, std::vector<host::MorphSetting>& morphs);

/// How closely clips are packed, and their coarse twins.
struct ClipPacking {
    double error = 0.0, coarseError = 0.0; ///< 0: clips are not packed; there are no twins
};
/// --clip-error, --coarse-clip-error.
void bindClipPacking(CLI::App& command, ClipPacking& packing);

/// --set, --aim, --two-bone, each as often as it is given, and --weight.
struct ModifierFlags {
    std::vector<host::ModifierSetting> settings;
    float weight = 1.0f;
};
void bindModifiers(CLI::App& command, ModifierFlags& flags);

/// --transition, --transition-seconds and --transition-kind. The command has --clip.
void bindTransition(CLI::App& command, host::TransitionSetting& setting);
/// `seconds` stays 0 without it.
void bindSimulate(CLI::App& command, double& seconds);

/// Whether the rate counts segments along an edge of the cage, in powers of two.
[[nodiscard]] constexpr bool subdivides(SuppleScheme scheme) {
    return scheme == SUPPLE_SCHEME_FRAGMENTS;
}
/// Whether the patches of a scheme have coefficients to read; a cage has no patches, and so none.
[[nodiscard]] bool hasCoefficients(SuppleScheme scheme);

} // namespace supple::tools
