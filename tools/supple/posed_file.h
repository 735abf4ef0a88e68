// A character's file, and one of its poses, as a command line names them.
#pragma once

#include "tools/common/character_file.h"
#include "tools/common/morph_weights.h"
#include "tools/supple/evaluation.h"
#include "tools/supple/options.h"

#include <string>
#include <vector>

namespace supple::tools {

struct PosedFile {
    host::CharacterFile file;
    Pose pose; ///< a clip at a time, with morph weights
};

/// `clip`: name or index; empty: the bind pose. Says on a terminal that it reads. Errors: the file, or what it lacks.
[[nodiscard]] Result<PosedFile> readPosed(const std::string& file, const host::ReadOptions& reading,
                                          const std::string& clip, double time,
                                          const std::vector<host::MorphSetting>& morphs);

} // namespace supple::tools
