// Any OBJ: read, or refused with a message; then the tables of all schemes. The file is its own MTL file, and whatever
// is called .png begins as a picture does.
#include "cage/formats/reader.h"
#include "surface/schemes.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace supple;
    cage::GltfOptions options;
    options.normalCreases = static_cast<cage::NormalCreases>(size % 3);
    options.weldObj = size % 5 != 0;
    options.sewParts = size % 7 != 0;
    options.readFile = [&](const std::string& path) -> Result<std::vector<std::byte>> {
        constexpr uint8_t kPng[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
        const auto bytes = path.ends_with(".png") ? fuzz::bytesOf(kPng, sizeof kPng) : fuzz::bytesOf(data, size);
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    const Result<cage::Character> character = cage::readCharacter(fuzz::bytesOf(data, size), "fuzz.obj", "", options);
    if (!character) {
        fuzz::demand(character.error().message.starts_with("fuzz.obj: "), "a refusal without the name");
        return 0;
    }
    if (character->cage.cornerCount() > 256) { // else the tables of a few take most of the time
        return 0;
    }
    for (const surface::Scheme& scheme : surface::schemes()) {
        surface::Recipe recipe;
        recipe.scheme = scheme.id;
        recipe.rate = scheme.tableRate(size % 4 + 1, false);
        recipe.wide = size % 3 == 0;
        const Result<surface::Tables> tables = surface::buildTables(recipe, character->cage);
        fuzz::demand(tables.ok() || !tables.error().message.empty(), "a refusal without a reason");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    return supple::fuzz::mutateWith(supple::fuzz::mutateLines, data, size, most, seed);
}
