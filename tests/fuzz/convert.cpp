// What is read is written and read again: the same cage, skeleton and clips.
#include "cage/gltf/reader.h"
#include "cage/gltf/writer.h"
#include "cage/topology.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <vector>

namespace {

/// But for their numbers: a vertex that was repeated comes last in what was read, and with its part in what was
/// written.
void demandSameVertices(const supple::cage::Cage& first, const supple::cage::Cage& second) {
    using supple::fuzz::demand;
    demand(first.vertexCount() == second.vertexCount(), "other vertices");
    std::vector<uint32_t> there(first.vertexCount(), supple::cage::kNone), back(there);
    for (uint32_t c = 0; c < first.cornerCount(); ++c) {
        const uint32_t a = first.faceVertices[c], b = second.faceVertices[c];
        demand(there[a] == b || there[a] == supple::cage::kNone, "other corners");
        demand(back[b] == a || back[b] == supple::cage::kNone, "corners that share a vertex");
        demand(first.positions[a] == second.positions[b], "other positions");
        there[a] = b;
        back[b] = a;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    cage::GltfOptions options;
    options.pairing = size % 2 == 0 ? cage::Pairing::always : cage::Pairing::whereClean;
    const Result<cage::Character> first = cage::readGltf(fuzz::bytesOf(data, size), "fuzz.glb", "", options);
    if (!first) {
        return 0;
    }
    const Result<cage::GlbFile> written = cage::writeGlb(*first);
    if (!written) {
        fuzz::demand(written.error().message.starts_with("fuzz.glb: "), "a refusal without the name");
        return 0;
    }
    options.pairing = cage::Pairing::never;
    options.sewParts = false;
    options.memoryLimit = uint64_t{1} << 32;
    const Result<cage::Character> second = cage::readGltf(written->bytes, "written.glb", "", options);
    if (!second) {
        std::fprintf(stderr, "%s\n", second.error().message.c_str());
    }
    fuzz::demand(second.ok(), "what was written cannot be read");
    fuzz::demand(first->cage.faceStarts == second->cage.faceStarts, "other faces");
    demandSameVertices(first->cage, second->cage);
    fuzz::demand(first->cage.holes == second->cage.holes, "other holes");
    // glTF has no clips without channels.
    const auto moving = std::count_if(first->clips.begin(), first->clips.end(),
                                      [](const cage::Clip& clip) { return !clip.channels.empty(); });
    fuzz::demand(static_cast<size_t>(moving) == second->clips.size(), "other clips");
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateGltf, data, size, most, seed);
}
