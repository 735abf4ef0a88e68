#include "tools/bench/sample_files.h"

#include "bench_characters.h"

namespace supple::bench {

const std::array<SampleFile, 4>& sampleFiles() {
    static const std::array<SampleFile, 4> files{
        {{"pip", kPip}, {"pip_quads", kPipQuads}, {"helmet", kHelmet}, {"wren", kWren}}};
    return files;
}

} // namespace supple::bench
