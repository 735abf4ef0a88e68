// supple_creature OUT.glb: makes the sample character, always to the same bytes.

#include "clips.h"
#include "glb_writer.h"
#include "paint.h"
#include "pip_model.h"
#include "skeleton.h"
#include "uv.h"
#include "weights.h"

#include <cstdio>
#include <map>

using namespace supple::creature;

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: supple_creature OUT.glb\n");
        return 2;
    }
    const Cage cage = modelPip();
    if (const char* fault = faultOf(cage)) {
        std::fprintf(stderr, "supple_creature: %s\n", fault);
        return 1;
    }
    const Skeleton skeleton = makeSkeleton();
    const std::vector<Influences> influences = skinWeights(cage, skeleton);
    const std::vector<Clip> clips = makeClips(skeleton);
    if (!writeGlb(argv[1], cage, skeleton, influences, paint(cage), unwrap(cage), clips)) {
        std::fprintf(stderr, "supple_creature: cannot write %s\n", argv[1]);
        return 1;
    }
    std::map<size_t, int> valences;
    for (const std::vector<int>& list : cage.neighbours()) {
        ++valences[list.size()];
    }
    std::printf("%zu quads, %zu points, %zu joints; valences", cage.quads.size(), cage.points.size(),
                skeleton.joints.size());
    for (const auto& [valence, count] : valences) {
        std::printf(" %zu:%d", valence, count);
    }
    std::printf("\n");
    return 0;
}
