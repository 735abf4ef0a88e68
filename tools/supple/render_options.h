// What render, view and the contact sheet share of their command lines. Values are kept as typed; the run functions
// check them and answer kExitUsage.
#pragma once

#include "tools/common/character_file.h"
#include "tools/common/morph_weights.h"
#include "tools/common/part_settings.h"
#include "tools/common/transition_setting.h"

#include <cstdint>
#include <string>
#include <vector>

namespace supple::tools {

/// Pixels between an edge's curve and its segments, as SuppleCameraDesc has it.
inline constexpr float kChordError = 0.25f;

/// What is drawn over a picture of what makes the character soft.
struct SoftShown {
    bool springs = false;   ///< chains of joints, and how far their tails stay from colliders
    bool colliders = false; ///< that springs or cloths meet
    bool painted = false;   ///< vertices of the cage that jiggle or are cloth

    [[nodiscard]] bool any() const { return springs || colliders || painted; }
    bool operator==(const SoftShown&) const = default;
};

struct DrawOptions {
    std::string scheme = "auto"; ///< auto, a scheme's, or cage (the deformed cage itself)
    std::vector<host::PartScheme> partSchemes;
    std::string skinning = "file";       ///< linear | dual-quaternion | centers | mush | mush-light | file
    std::string creases = "cut";         ///< cut | curve
    float sharpThreshold = 1.0f;         ///< see SuppleGroupDesc
    std::string rules = "catmull-clark"; ///< of fragments: catmull-clark | loop
    std::string uvMode = "file";         ///< file | one of OpenSubdiv's modes
    uint32_t rate = 8;                   ///< 1..64: see SuppleGroupDesc
    std::vector<std::string> parts;      ///< names or indices: draw these alone; none: all
    bool sharedSamples = false;          ///< SUPPLE_GROUP_INDEXED_MESH; patches then show no borders and classes
    std::string view = "shaded";         ///< of kViews (views.h)
    std::string joint = "0";             ///< whose weights the view "weights" shows: name or index
    bool levels = false;                 ///< of detail, as the camera needs them, instead of `rate`
    float chordError = kChordError;      ///< with `levels`: pixels
    bool cageOverlay = false;            ///< the cage's edges drawn over the surface
    SoftShown soft;                      ///< drawn over the surface; not with `alpha`
    bool split = false;                  ///< the cage beside the surface
    bool ground = true;                  ///< a floor that takes shadows
    bool legend = true;                  ///< what the view's colors stand for, in the picture's corner
    bool alpha = false;                  ///< nothing behind the figure: render, animate
    bool trace = false;                  ///< rays find what the light sees: render
    double yaw = 35.0;   ///< degrees; 0 looks at the front (the asset's +Z), positive goes round to its left side
    double pitch = 12.0; ///< degrees; positive looks down
    host::ReadOptions reading;
    std::vector<host::MorphSetting> morphs;
    host::TransitionSetting transition; ///< animate
    double simulate = 0.0;              ///< seconds that springs have swung for; 0: nothing swings
    std::string device;                 ///< name part or index; empty takes the best
    std::string mapping = "auto";       ///< auto | narrow | wide
    bool validate = false;              ///< run under the validation layer; its messages make the command fail
    std::string record;                 ///< a file for a recording; empty: none
};

} // namespace supple::tools
