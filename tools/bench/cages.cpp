#include "tools/bench/cages.h"

#include "base/utf8_path.h"
#include "cage/formats/reader.h"
#include "runtime/arrays/character_arrays.h"
#include "surface/schemes.h"
#include "tools/bench/sample_files.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/character_file.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <filesystem>
#include <span>

namespace supple::bench {

namespace {

constexpr const char* kManCasualQuads = "man_casual_quads";
constexpr uint32_t kSphereSide = 15;
constexpr uint32_t kTorusAround = 18, kTorusAcross = 12;

/// Every quad cut along a diagonal.
cage::Cage triangulated(const cage::Cage& quads) {
    cage::Cage cage;
    cage.positions = quads.positions;
    cage.faceStarts.push_back(0);
    for (uint32_t f = 0; f < quads.faceCount(); ++f) {
        const uint32_t* v = &quads.faceVertices[quads.faceStarts[f]];
        for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) {
            cage.faceVertices.push_back(v[corner]);
        }
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
        cage.faceStarts.push_back(cage.faceStarts.back() + 3);
    }
    return cage;
}

/// All schemes that take it and mean it: p-rep wants quads, Loop cuts them.
std::vector<SuppleScheme> schemesFor(const cage::Cage& cage) {
    uint32_t quads = 0, triangles = 0;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        quads += cage.sides(f) == 4 ? 1 : 0;
        triangles += cage.sides(f) == 3 ? 1 : 0;
    }
    std::vector<SuppleScheme> schemes;
    if (quads == cage.faceCount()) {
        schemes.push_back(SUPPLE_SCHEME_PREP);
    }
    schemes.insert(schemes.end(), {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_CATMULL_CLARK, SUPPLE_SCHEME_FRAGMENTS});
    if (triangles > 0) {
        schemes.push_back(SUPPLE_SCHEME_LOOP);
    }
    schemes.push_back(SUPPLE_SCHEME_BLEND);
    return schemes;
}

BenchCage benchCage(const std::string& name, cage::Character character) {
    BenchCage made{name, std::move(character), {}, {PeerRules::catmullClark}, false};
    made.schemes = schemesFor(made.character.cage);
    if (std::find(made.schemes.begin(), made.schemes.end(), SUPPLE_SCHEME_LOOP) != made.schemes.end()) {
        made.peers.push_back(PeerRules::loop);
    }
    return made;
}

Result<BenchCage> fromCage(const std::string& name, const cage::Cage& cage) {
    const host::CageArrays arrays(cage);
    Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, name);
    if (!character) {
        return character.error();
    }
    BenchCage made = benchCage(name, std::move(*character));
    made.bothFormats = made.schemes.front() == SUPPLE_SCHEME_PREP;
    return made;
}

Result<BenchCage> embedded(const SampleFile& file) {
    const std::string name = file.name;
    Result<cage::Character> character = cage::readCharacter(std::as_bytes(file.bytes), name, "");
    if (!character) {
        return character.error();
    }
    return benchCage(name, std::move(*character));
}

} // namespace

bool sharesSamples(SuppleScheme scheme) {
    return surface::schemeOf(static_cast<surface::SchemeId>(scheme)).hasIndexedMesh;
}

const std::vector<std::string>& builtInCages() {
    static const std::vector<std::string> names{"sphere",        "irregular", "triangles",
                                                kManCasualQuads, "pip_quads", "pip"};
    return names;
}

Result<BenchCage> makeCage(const std::string& name) {
    if (name == "sphere") {
        return fromCage(name, cage::makeCubeSphere(kSphereSide));
    }
    if (name == "irregular") {
        return fromCage(name, cage::makeSplitTorus(kTorusAround, kTorusAcross));
    }
    if (name == "triangles") {
        return fromCage(name, triangulated(cage::makeCubeSphere(kSphereSide)));
    }
    for (const SampleFile& file : sampleFiles()) {
        if (name == file.name) {
            return embedded(file);
        }
    }
    if (name == kManCasualQuads) {
#ifdef SUPPLE_MAN_CASUAL_QUADS
        if (std::filesystem::exists(SUPPLE_MAN_CASUAL_QUADS)) {
            return readCage(SUPPLE_MAN_CASUAL_QUADS);
        }
#endif
        return Error{ErrorCode::io, "not there"};
    }
    return Error{ErrorCode::argument, "no cage is called " + name};
}

Result<BenchCage> readCage(const std::string& path) {
    Result<host::CharacterFile> file = host::readCharacterFile(path);
    if (!file) {
        return file.error();
    }
    return benchCage(utf8Text(utf8Path(path).stem()), std::move(file->character));
}

} // namespace supple::bench
