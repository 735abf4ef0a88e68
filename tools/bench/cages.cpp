#include "tools/bench/cages.h"

#include "base/utf8_path.h"
#include "cage/formats/reader.h"
#include "runtime/arrays/character_arrays.h"
#include "surface/schemes.h"
#include "tools/bench/plain_cages.h"
#include "tools/bench/sample_files.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/character_file.h"
#include "tools/common/gallery_cages.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <filesystem>
#include <span>

namespace supple::bench {

namespace {

constexpr const char* kManCasualQuads = "man_casual_quads";

/// Cages that are made on the spot. Those behind `triangles` have patches of one class, or nearly, for kernels.h.
constexpr struct {
    const char* name;
    cage::Cage (*make)();
} kMadeCages[] = {
    {"sphere", [] { return cage::makeCubeSphere(15); }},
    {"irregular", [] { return cage::makeSplitTorus(18, 12); }},
    {"triangles", [] { return triangulated(cage::makeCubeSphere(15)); }},
    {"regular", [] { return quadTorus(48, 27); }},
    {"regular triangles", [] { return triangulated(quadTorus(36, 18)); }},
    {"irregular triangles", [] { return triangulated(cage::makeSplitTorus(12, 9)); }},
    {"polar", [] { return cage::makeRow(cage::makePolarCage(12, cage::GalleryShape::elliptic), 36); }},
    {"pentagons", [] { return cage::makeRow(dodecahedron(), 108); }},
};

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
    for (const auto& made : kMadeCages) {
        if (name == made.name) {
            return fromCage(name, made.make());
        }
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
