#include "cage/obj/materials.h"

#include "cage/image_header.h"
#include "cage/materials.h"
#include "cage/obj/mtl.h"
#include "cage/obj/text.h"
#include "cage/path_name.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace supple::cage::obj {
namespace {

/// MTL files that one OBJ file names, found or not, and the size of one: larger ones are no lists of materials.
constexpr size_t kMaxLibraries = 64;
constexpr size_t kMaxLibraryBytes = 64u << 20;
constexpr size_t kMaxImages = 4096;

Error notFound(const std::string& reason) {
    return Error{ErrorCode::io, reason};
}

/// Names in quotes, and with the slashes of Windows, are as many programs write them.
std::string plainName(std::string_view name) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
        name = name.substr(1, name.size() - 2);
    }
    std::string plain(name);
    std::replace(plain.begin(), plain.end(), '\\', '/');
    return plain;
}

/// The path of a file that another one in `folder` names. Absolute paths are of the machine that wrote the file: of
/// those, the last name counts.
Result<std::string> pathBeside(const std::string& folder, std::string_view given) {
    std::string name = plainName(given);
    const size_t colon = name.find(':');
    const bool hasDrive = colon == 1 && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
    if (colon != std::string::npos && !hasDrive) {
        return notFound("only files of the asset's folder are read");
    }
    if (hasDrive || name.starts_with("/")) {
        name = name.substr(name.find_last_of("/:") + 1);
    }
    std::vector<std::string> names;
    for (const std::string& path : {folder, name}) {
        for (size_t begin = 0; begin < path.size();) {
            const size_t end = std::min(path.find('/', begin), path.size());
            const std::string part = path.substr(begin, end - begin);
            begin = end + 1;
            if (const std::string why = whyRefusedName(part); !why.empty()) {
                return notFound(why);
            }
            if (part == ".." && names.empty()) {
                return notFound("path leaves the asset's folder");
            }
            if (part == "..") {
                names.pop_back();
            } else if (!part.empty() && part != ".") {
                names.push_back(part);
            }
        }
    }
    std::string plain;
    for (const std::string& part : names) {
        plain += (plain.empty() ? "" : "/") + part;
    }
    return plain.empty() ? Result<std::string>(notFound("empty path")) : Result<std::string>(std::move(plain));
}

/// A material and the file that it is from.
struct Known {
    MtlMaterial material;
    std::string folder; ///< of the MTL file, below the OBJ file's
    std::string element;
};

class Libraries {
public:
    /// `names`: of the materials that are looked for.
    Libraries(const std::vector<std::string>& names, const FileReader& readFile, Warnings& warnings)
        : names_(names.begin(), names.end()), readFile_(readFile), warnings_(warnings) {}

    void read(const File::Library& library) {
        const std::string element = lineName(library.line) + ": mtllib " + shortened(library.text);
        const Status whole = tryRead(library.text, element);
        if (whole) {
            return;
        }
        // One statement may name several files.
        const bool isOne = library.text.find_first_of(" \t") == std::string::npos;
        if (isOne) {
            warn(warnings_, element, whole.error().message + "; left out");
            return;
        }
        Words words(library.text);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::string one = lineName(library.line) + ": mtllib " + shortened(word);
            if (const Status status = tryRead(word, one); !status) {
                warn(warnings_, one, status.error().message + "; left out");
            }
        }
    }

    [[nodiscard]] const Known* find(const std::string& name) const {
        const auto found = known_.find(name);
        return found == known_.end() ? nullptr : &found->second;
    }
    [[nodiscard]] bool any() const { return readOne_; }

private:
    Status tryRead(std::string_view name, const std::string& element) {
        const Result<std::string> path = pathBeside("", name);
        if (!path) {
            return path.error();
        }
        if (tried_.count(*path) != 0) {
            return success();
        }
        if (tried_.size() == kMaxLibraries) {
            return notFound("more than " + std::to_string(kMaxLibraries) + " MTL files");
        }
        tried_.insert(*path);
        const Result<std::vector<std::byte>> bytes = readFile_(*path);
        if (!bytes) {
            return bytes.error();
        }
        if (bytes->size() > kMaxLibraryBytes) {
            return notFound("larger than 64 MiB");
        }
        readOne_ = true;
        const size_t slash = path->find_last_of('/');
        const std::string folder = slash == std::string::npos ? "" : path->substr(0, slash);
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        const auto isWanted = [&](const std::string& name) { return names_.count(name) != 0; };
        for (MtlMaterial& material : parseMtl(text, isWanted, element, warnings_)) {
            const std::string key = material.name;
            known_.try_emplace(key, Known{std::move(material), folder, element});
        }
        return success();
    }

    std::set<std::string> names_;
    const FileReader& readFile_;
    Warnings& warnings_;
    std::set<std::string> tried_;
    std::unordered_map<std::string, Known> known_;
    bool readOne_ = false;
};

/// Reads each image once, and warns of each that is missing once.
class Images {
public:
    Images(const FileReader& readFile, Character& character) : readFile_(readFile), character_(character) {}

    /// kNone if it cannot be read.
    uint32_t find(const Known& from, const MtlMap& map, const char* statement) {
        const Result<std::string> path = pathBeside(from.folder, map.file);
        const std::string key = path ? *path : map.file;
        const auto [known, isNew] = places_.try_emplace(key, kNone);
        if (!isNew) {
            return known->second;
        }
        const auto leaveOut = [&](const std::string& why) {
            warn(character_.warnings, within(from.element, statement) + " " + cage::quoted(map.file.substr(0, 100)),
                 why + "; left out");
            return kNone;
        };
        if (!path) {
            return leaveOut(path.error().message);
        }
        if (places_.size() > kMaxImages) {
            return leaveOut("more than " + std::to_string(kMaxImages) + " images");
        }
        Result<std::vector<std::byte>> bytes = readFile_(*path);
        if (!bytes) {
            return leaveOut(bytes.error().message);
        }
        const char* type = imageType(*bytes);
        if (type == nullptr) {
            return leaveOut("not PNG, JPEG, WebP or KTX2");
        }
        known->second = static_cast<uint32_t>(character_.images.size());
        character_.images.push_back({*path, type, SharedBytes(std::move(*bytes))});
        return known->second;
    }

private:
    const FileReader& readFile_;
    Character& character_;
    std::unordered_map<std::string, uint32_t> places_;
};

/// What materials say that has no place in a Material, one kind each.
struct LeftOut {
    std::set<std::string> statements;
    Found bumps;
    Found alphas;
};

class Converter {
public:
    Converter(const FileReader& readFile, Character& character) : images_(readFile, character), character_(character) {}

    Material convert(const Known& from) {
        const MtlMaterial& mtl = from.material;
        Material material = namedMaterial(mtl.name);
        material.baseColorTexture = texture(from, mtl.diffuseMap, "map_Kd");
        glm::vec3 color = mtl.diffuse ? glm::clamp(*mtl.diffuse, 0.0f, 1.0f) : glm::vec3(1.0f);
        color = material.baseColorTexture.exists() ? glm::vec3(1.0f) : color; // Kd is for programs without the image
        material.baseColorFactor = glm::vec4(color, glm::clamp(mtl.dissolve.value_or(1.0f), 0.0f, 1.0f));
        convertAlpha(from, material);
        if (mtl.shininess) {
            material.roughnessFactor = 1.0f - std::sqrt(glm::clamp(*mtl.shininess, 0.0f, 1000.0f) / 1000.0f);
        }
        material.roughnessFactor = glm::clamp(mtl.roughness.value_or(material.roughnessFactor), 0.0f, 1.0f);
        material.metallicFactor = glm::clamp(mtl.metallic.value_or(material.metallicFactor), 0.0f, 1.0f);
        convertEmission(from, material);
        if (mtl.normalMap.exists()) {
            material.normalTexture = texture(from, mtl.normalMap, "norm");
            material.normalScale = mtl.normalMap.multiplier;
        }
        if (mtl.bumpMap.exists() && mtl.bumpMap.file != mtl.normalMap.file) {
            leftOut_.bumps.add([&] { return shortened(mtl.name); });
        }
        leftOut_.statements.insert(mtl.unused.begin(), mtl.unused.end());
        return material;
    }

    void reportLeftOut() {
        const auto told = [&](const Found& found, const char* one, const char* many) {
            if (found.count > 0) {
                warn(character_.warnings, "materials", found.told(one, many) + "; left out");
            }
        };
        told(leftOut_.bumps, "material has a bump map, which is no normal map",
             "materials have bump maps, which are no normal maps");
        told(leftOut_.alphas, "material has a map_d that is not its map_Kd",
             "materials have a map_d that is not their map_Kd");
        std::string list;
        for (const std::string& statement : leftOut_.statements) {
            list += (list.empty() ? "" : ", ") + statement;
        }
        if (!list.empty()) {
            warn(character_.warnings, "materials",
                 "statements that a material has no place for: " + list + "; left out");
        }
    }

private:
    void convertAlpha(const Known& from, Material& material) {
        const MtlMap& map = from.material.alphaMap;
        if (map.exists() && map.file == from.material.diffuseMap.file && material.baseColorTexture.exists()) {
            material.baseColorFactor.a = 1.0f; // the image has it
            material.alphaMode = AlphaMode::blend;
            return;
        }
        if (map.exists()) {
            leftOut_.alphas.add([&] { return shortened(material.name); });
        }
        material.alphaMode = material.baseColorFactor.a < 1.0f ? AlphaMode::blend : AlphaMode::opaque;
    }

    void convertEmission(const Known& from, Material& material) {
        material.emissiveTexture = texture(from, from.material.emissionMap, "map_Ke");
        glm::vec3 light = glm::max(from.material.emission.value_or(glm::vec3(0.0f)), glm::vec3(0.0f));
        if (material.emissiveTexture.exists()) {
            light = glm::vec3(1.0f);
        }
        material.emissiveStrength = std::max({1.0f, light.x, light.y, light.z});
        material.emissiveFactor = light / material.emissiveStrength;
    }

    Texture texture(const Known& from, const MtlMap& map, const char* statement) {
        Texture texture;
        texture.image = map.exists() ? images_.find(from, map, statement) : kNone;
        if (!texture.exists()) {
            return {};
        }
        texture.wrapU = texture.wrapV = map.clamp ? Wrap::clampToEdge : Wrap::repeat;
        // MTL scales, then moves coordinates that count upwards.
        texture.scale = map.scale;
        texture.offset = {map.offset.x, 1.0f - map.scale.y - map.offset.y};
        return texture;
    }

    Images images_;
    Character& character_;
    LeftOut leftOut_;
};

} // namespace

void readMaterials(const File& file, const FileReader& readFile, Character& character) {
    Libraries libraries(file.materials, readFile, character.warnings);
    for (const File::Library& library : file.libraries) {
        libraries.read(library);
    }
    Converter converter(readFile, character);
    Found missing;
    character.materials.reserve(file.materials.size());
    for (const std::string& name : file.materials) {
        if (const Known* known = libraries.find(name)) {
            character.materials.push_back(converter.convert(*known));
            continue;
        }
        character.materials.push_back(namedMaterial(name));
        if (!name.empty()) {
            missing.add([&] { return shortened(name); });
        }
    }
    if (missing.count > 0 && libraries.any()) {
        warn(character.warnings, "materials",
             missing.told("material is in no MTL file", "materials are in no MTL file") + "; white");
    }
    converter.reportLeftOut();
}

std::vector<glm::vec3> giveWayToColors(const File& file, Character& character) {
    std::vector<glm::vec3> colors(character.materials.size(), glm::vec3(1.0f));
    std::vector<uint8_t> isColored(character.materials.size(), 0);
    for (size_t f = 0; f < file.faceCount() && !file.colors.empty(); ++f) {
        for (uint32_t c = file.faceStarts[f]; c < file.faceStarts[f + 1] && file.faceIsWhole[f] != 0; ++c) {
            if (file.faceMaterials[f] != kNone && file.colors[file.corners[c].vertex] != kNoColor) {
                isColored[file.faceMaterials[f]] = 1;
            }
        }
    }
    Found replaced;
    for (size_t m = 0; m < colors.size(); ++m) {
        glm::vec4& factor = character.materials[m].baseColorFactor;
        if (isColored[m] != 0 && glm::vec3(factor) != glm::vec3(1.0f)) {
            colors[m] = glm::vec3(factor);
            factor = glm::vec4(1.0f, 1.0f, 1.0f, factor.a);
            replaced.add([&] { return shortened(character.materials[m].name); });
        }
    }
    if (replaced.count > 0) {
        warn(character.warnings, "materials",
             replaced.told("material's faces have colors of their own", "materials' faces have colors of their own") +
                 "; they take the place of Kd");
    }
    return colors;
}

} // namespace supple::cage::obj
