#include "tools/supple/posed_file.h"

#include "tools/supple/progress.h"

#include <utility>

namespace supple::tools {

Result<PosedFile> readPosed(const std::string& file, const host::ReadOptions& reading, const std::string& clip,
                            double time, const std::vector<host::MorphSetting>& morphs) {
    showProgress("reading " + file);
    Result<host::CharacterFile> read = host::readCharacterFile(file, reading);
    if (!read) {
        return read.error();
    }
    const Result<uint32_t> found = host::findClip(read->character, clip);
    if (!found) {
        return found.error();
    }
    Result<std::vector<float>> weights = host::morphWeights(read->character, morphs);
    if (!weights) {
        return weights.error();
    }
    Pose pose;
    pose.clip = *found;
    pose.time = time;
    pose.morphWeights = std::move(*weights);
    return PosedFile{std::move(*read), std::move(pose)};
}

} // namespace supple::tools
