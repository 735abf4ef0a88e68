// What is read is written and read again: the same cage, skeleton and clips.
#include "cage/gltf/reader.h"
#include "cage/topology.h"
#include "tests/fuzz/target.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace {

uint32_t materialOf(const supple::cage::Cage& cage, uint32_t face) {
    return cage.faceMaterials.empty() ? supple::cage::kNone : cage.faceMaterials[face];
}

/// The faces of a cage as its file gets them: part by part, and in a part by materials, in the order of their first
/// faces.
std::vector<uint32_t> orderInFile(const supple::cage::Cage& cage) {
    using Key = std::pair<uint32_t, uint32_t>; // part, material
    const auto key = [&](uint32_t face) {
        return Key(cage.faceParts.empty() ? 0 : cage.faceParts[face], materialOf(cage, face));
    };
    std::map<Key, uint32_t> first;
    std::vector<uint32_t> order(cage.faceCount());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        order[face] = face;
        first.try_emplace(key(face), face);
    }
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return Key(key(a).first, first.at(key(a))) < Key(key(b).first, first.at(key(b)));
    });
    return order;
}

/// How far positions may come to stand from where they were: not at all, but for what inverse bind matrices of large
/// numbers lose of a place.
float tolerance(const supple::cage::Character& character) {
    constexpr float kLarge = 1e4f, kMost = 0.02f; // of the cage's extent
    float largest = 0.0f;
    for (const glm::mat4& bind : character.skin.inverseBinds) {
        for (int k = 0; k < 16; ++k) {
            largest = std::max(largest, std::abs(bind[k / 4][k % 4]));
        }
    }
    if (largest < kLarge) {
        return 0.0f;
    }
    glm::vec3 low = character.cage.positions.front(), high = low;
    for (const glm::vec3& p : character.cage.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return kMost * glm::length(high - low);
}

/// But for the numbers of vertices: one that was repeated comes last in what was read, and with its part in what was
/// written.
void demandSameFaces(const supple::cage::Cage& first, const supple::cage::Cage& second, float tolerance) {
    using supple::fuzz::demand;
    demand(first.vertexCount() == second.vertexCount(), "other vertices");
    demand(first.faceCount() == second.faceCount(), "other faces");
    const std::vector<uint32_t> order = orderInFile(first);
    std::vector<uint32_t> there(first.vertexCount(), supple::cage::kNone), back(there);
    for (uint32_t f = 0; f < order.size(); ++f) {
        demand(first.sides(order[f]) == second.sides(f), "other sides");
        demand(materialOf(first, order[f]) == materialOf(second, f), "other materials");
        demand(std::binary_search(first.holes.begin(), first.holes.end(), order[f]) ==
                   std::binary_search(second.holes.begin(), second.holes.end(), f),
               "other holes");
        for (uint32_t k = 0; k < second.sides(f); ++k) {
            const uint32_t a = first.faceVertices[first.faceStarts[order[f]] + k];
            const uint32_t b = second.faceVertices[second.faceStarts[f] + k];
            demand(there[a] == b || there[a] == supple::cage::kNone, "other corners");
            demand(back[b] == a || back[b] == supple::cage::kNone, "corners that share a vertex");
            demand(glm::length(first.positions[a] - second.positions[b]) <= tolerance, "other positions");
            there[a] = b;
            back[b] = a;
        }
    }
}

/// An error if it cannot be written. What is written can be read.
supple::Result<supple::cage::Character> writtenAndRead(const supple::cage::Character& character,
                                                       const supple::cage::GltfOptions& options) {
    using namespace supple;
    const Result<cage::GlbFile> written = cage::writeGlb(character);
    if (!written) {
        fuzz::demand(written.error().message.starts_with(character.name + ": "), "a refusal without the name");
        return written.error();
    }
    Result<cage::Character> read = cage::readGltf(written->bytes, "written.glb", "", options);
    if (!read) {
        std::fprintf(stderr, "%s\n", read.error().message.c_str());
    }
    fuzz::demand(read.ok(), "what was written cannot be read");
    return read;
}

bool isWarned(const supple::cage::Character& character, std::string_view of) {
    return std::any_of(character.warnings.begin(), character.warnings.end(),
                       [&](const std::string& warning) { return warning.find(of) != std::string::npos; });
}

/// Whether the second reading may differ from the first. Where repairs cut faces apart, their new borders may have
/// T-corners, which it mends. A file with faults may name joints that are not written, or a place too far away: then
/// parts may stand elsewhere beside the joints that are written.
bool mayDiffer(const supple::cage::Character& first, const supple::cage::Character& second) {
    return isWarned(second, "T-corner") || !first.damages.empty() ||
           isWarned(first, "do not reach its place in the bind pose");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    cage::GltfOptions options;
    options.pairing = size % 2 == 0 ? cage::Pairing::always : cage::Pairing::whereClean;
    Result<cage::Character> first = cage::readGltf(fuzz::bytesOf(data, size), "fuzz.glb", "", options);
    if (!first) {
        return 0;
    }
    options.pairing = cage::Pairing::never;
    options.sewParts = false;
    options.memoryLimit = uint64_t{1} << 32;
    Result<cage::Character> second = writtenAndRead(*first, options);
    for (uint32_t again = 0; again < 3 && second && mayDiffer(*first, *second); ++again) {
        first = std::move(second);
        second = writtenAndRead(*first, options);
    }
    if (!second) {
        return 0;
    }
    demandSameFaces(first->cage, second->cage, tolerance(*first));
    // glTF has no clips without channels.
    const auto moving = std::count_if(first->clips.begin(), first->clips.end(),
                                      [](const cage::Clip& clip) { return !clip.channels.empty(); });
    fuzz::demand(static_cast<size_t>(moving) == second->clips.size(), "other clips");
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateGltf, data, size, most, seed);
}
