// Any cooked file: read, or refused with a message. Seeds are glTF files, which the mutator cooks first.
#include "cage/gltf/reader.h"
#include "runtime/cooked/file.h"
#include "runtime/prepare.h"
#include "skinning/clip_bounds.h"
#include "skinning/pose.h"
#include "surface/schemes.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace supple::fuzz {
namespace {

constexpr size_t kHeaderBytes = 32, kSizeAt = 16, kHashAt = 24;

std::vector<std::byte> signedCopy(const uint8_t* data, size_t size) {
    const std::span<const std::byte> bytes = bytesOf(data, size);
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    if (size >= kHeaderBytes) {
        const uint64_t byteCount = size, hash = XXH3_64bits(file.data() + kHeaderBytes, size - kHeaderBytes);
        std::memcpy(file.data() + kSizeAt, &byteCount, sizeof(byteCount));
        std::memcpy(file.data() + kHashAt, &hash, sizeof(hash));
    }
    return file;
}

std::vector<uint8_t> fileOf(const runtime::Prepared& prepared) {
    const std::vector<std::byte> file = runtime::writeCooked(prepared, "fuzz");
    std::vector<uint8_t> bytes(file.size());
    std::memcpy(bytes.data(), file.data(), file.size());
    return bytes;
}

/// A glTF file with the tables of a scheme at random.
std::vector<uint8_t> cook(const uint8_t* data, size_t size, Random& random) {
    const Result<cage::Character> character = cage::readGltf(bytesOf(data, size), "fuzz.glb", "");
    if (!character) {
        return {};
    }
    const std::shared_ptr<runtime::Prepared> prepared = runtime::Prepared::of(*character);
    if (random() % 2 == 0) {
        prepared->packClips(1e-3);
    }
    SuppleGroupDesc desc{};
    desc.structSize = sizeof(desc);
    desc.scheme = static_cast<SuppleScheme>(random() % 8);
    desc.rate = 1 + random() % 4;
    desc.poseSource = random() % 2 == 0 ? SUPPLE_POSES_PLAYBACK : SUPPLE_POSES_SET;
    const bool inView = random() % 2 == 0;
    if (!inView) {
        desc.flags = (random() % 2 == 0 ? SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS : 0u) |
                     (random() % 2 == 0 ? uint32_t{SUPPLE_GROUP_INDEXED_MESH} : 0u);
    }
    (void)runtime::prepareFor(*prepared, {desc, inView ? std::optional(0u) : std::nullopt}, random() % 2 == 0);
    return fileOf(*prepared);
}

/// A word that leads somewhere, or nowhere.
uint32_t wordLike(uint32_t word, Random& random) {
    switch (random() % 6) {
    case 0:
        return word + 1;
    case 1:
        return word - 1;
    case 2:
        return word ^ 1u << random() % 32;
    case 3:
        return 0;
    case 4:
        return 0xFFFFFFFFu;
    default:
        return static_cast<uint32_t>(random());
    }
}

/// A member of the fragments, if there are any.
void spoilFragments(surface::Fragments& fragments, Random& random) {
    if (fragments.classes.empty()) {
        return;
    }
    surface::Fragments::Class& own = fragments.classes[random() % fragments.classes.size()];
    surface::Section& blocks = own.blocks.empty() ? own.fragments : own.blocks[random() % own.blocks.size()];
    uint32_t* const members[] = {&fragments.steps,     &fragments.scratchStride, &own.sharedPoints,
                                 &own.fragments.table, &own.fragments.count,     &blocks.table,
                                 &blocks.count};
    uint32_t& member = *members[random() % std::size(members)];
    member = wordLike(member, random);
}

/// Spoils words of the tables, or of the lists of the character, in a file that is sound otherwise.
std::vector<uint8_t> spoilMembers(runtime::Prepared& prepared, Random& random) {
    cage::Character& character = prepared.character;
    std::vector<std::vector<uint32_t>*> lists = {
        &character.cage.faceStarts,    &character.cage.faceVertices, &character.cage.faceTriangles,
        &character.cage.faceMaterials, &character.cage.faceParts,    &character.cage.holes,
        &character.skin.joints,        &character.weights.starts,    &character.skeleton.parentsFirst};
    for (cage::Clip& clip : character.clips) {
        lists.push_back(&clip.packed.words);
    }
    std::vector<std::shared_ptr<runtime::PreparedTables>> copies;
    for (auto& own : prepared.tables) {
        copies.push_back(std::make_shared<runtime::PreparedTables>(*own));
        own = copies.back();
        lists.insert(lists.end(), 6, &copies.back()->tables.words);
        lists.push_back(&copies.back()->tables.triangles.indices);
    }
    for (uint32_t changes = 1 + random() % 3; changes > 0; --changes) {
        std::vector<uint32_t>& list = *lists[random() % lists.size()];
        if (!list.empty()) {
            uint32_t& word = list[random() % list.size()];
            word = wordLike(word, random);
        }
    }
    for (cage::Clip& clip : character.clips) {
        for (cage::SharpnessCurve& curve : clip.sharpness) {
            curve.keys.firstTarget = random() % 4 == 0 ? wordLike(curve.keys.firstTarget, random) : 0;
        }
    }
    if (!copies.empty() && random() % 3 == 0) {
        surface::Tables& tables = copies[random() % copies.size()]->tables;
        uint32_t* const members[] = {&tables.ring,         &tables.poolStride,     &tables.tangents,
                                     &tables.faces,        &tables.inner,          &tables.edgeClasses,
                                     &tables.meshVertices, &tables.frames,         &tables.coordinates,
                                     &tables.attributes,   &tables.uvSets,         &tables.isolationSteps,
                                     &tables.lod.depth,    &tables.lod.depthLanes, &tables.mesh.edgeCount};
        uint32_t& member = *members[random() % std::size(members)];
        member = wordLike(member, random);
        if (random() % 2 == 0) {
            spoilFragments(tables.fragments, random);
        }
    }
    return fileOf(prepared);
}

std::vector<uint8_t> mutateCooked(const uint8_t* data, size_t size, Random& random) {
    const std::vector<std::byte> file = signedCopy(data, size);
    if (!runtime::isCooked(file)) {
        const std::vector<uint8_t> cooked = cook(data, size, random);
        return cooked.empty() || random() % 8 == 0 ? cooked : mutateCooked(cooked.data(), cooked.size(), random);
    }
    if (random() % 2 == 0) {
        if (Result<std::shared_ptr<runtime::Prepared>> read = runtime::readCooked(file, "fuzz.supple")) {
            return spoilMembers(**read, random);
        }
    }
    // A word anywhere.
    std::vector<uint8_t> bytes(data, data + size);
    for (uint32_t changes = 1 + random() % 4; changes > 0 && size > kHeaderBytes + 4; --changes) {
        const size_t at = kHeaderBytes + random() % (size - kHeaderBytes - 4);
        uint32_t word = 0;
        std::memcpy(&word, bytes.data() + at, sizeof(word));
        word = wordLike(word, random);
        std::memcpy(bytes.data() + at, &word, sizeof(word));
    }
    return bytes;
}

/// What assets and groups do on the CPU with what was read.
void use(runtime::Prepared& prepared) {
    const cage::Character& character = prepared.character;
    demand(prepared.parts.size() == character.parts.size(), "a part without a summary");
    skinning::Pose pose;
    for (const cage::Clip& clip : character.clips) {
        skinning::sampleClip(character, clip, 0.5 * clip.duration, pose);
        for (const cage::SharpnessCurve& curve : clip.sharpness) {
            (void)skinning::sampleSharpness(curve, 0.5 * clip.duration);
        }
    }
    (void)skinning::buildClipTable(character);
    for (const surface::SchemeId scheme : {surface::SchemeId::pm, surface::SchemeId::polygons}) {
        surface::Recipe recipe;
        recipe.scheme = scheme;
        recipe.rate = surface::schemeOf(scheme).tableRate(1, false);
        (void)prepared.build(recipe, nullptr);
    }
    const std::vector<std::byte> again = runtime::writeCooked(prepared, prepared.madeBy);
    demand(runtime::readCooked(again, character.name).ok(), "what was read cannot be written and read");
}

} // namespace
} // namespace supple::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    const std::vector<std::byte> file = fuzz::signedCopy(data, size);
    if (!runtime::isCooked(file)) {
        return 0;
    }
    const Result<std::shared_ptr<runtime::Prepared>> read = runtime::readCooked(file, "fuzz.supple");
    if (read) {
        fuzz::use(**read);
    } else {
        fuzz::demand(read.error().message.starts_with("fuzz.supple: "), "a refusal without the name");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateCooked, data, size, most, seed);
}
