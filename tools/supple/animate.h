// supple animate: a clip as an animated picture, or as one picture a frame.
#pragma once

#include "tools/supple/render_options.h"
#include "tools/supple/session.h"

#include <cstdint>
#include <string>

namespace supple::tools {

struct AnimateOptions {
    std::string file;
    std::string output; ///< .webp, or .png with a run of # for the number of the frame
    std::string clip;   ///< name or index; empty: the first clip
    std::string size = "640x640";
    double fps = 25.0;
    double turn = 0.0;    ///< degrees that the camera goes round the figure from the first frame to the first again
    double seconds = 0.0; ///< 0: as long as the clip, or 4 without clips
    float quality = 90.0f;
    DrawOptions draw;
};

/// The file of a frame: the run of # replaced by its number, with zeros before it. Empty without such a run.
[[nodiscard]] std::string frameFile(const std::string& pattern, uint32_t frame);

/// What is wrong with the output's name, before anything is done; empty: nothing.
[[nodiscard]] std::string animateOutputFault(const std::string& output);

[[nodiscard]] Status animate(Session& session, const AnimateOptions& options);

/// Returns the exit code and says why on stderr when it is not kExitOk.
int runAnimate(const AnimateOptions& options);

} // namespace supple::tools
