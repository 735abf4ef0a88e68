#include "cage/gltf/reader.h"

#include "cage/clip_set.h"
#include "cage/gltf/animation.h"
#include "cage/gltf/bind_space.h"
#include "cage/gltf/cage.h"
#include "cage/gltf/document.h"
#include "cage/gltf/material.h"
#include "cage/gltf/mesh.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/nodes.h"
#include "cage/gltf/skin.h"
#include "cage/gltf/uri.h"
#include "cage/limits.h"
#include "cage/message.h"
#include "cage/normal_creases.h"
#include "cage/parts.h"
#include "cage/refusal.h"
#include "cage/repair.h"
#include "cage/sew.h"

#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <utility>

namespace supple::cage {
namespace gltf {
namespace {

// Bounds for all parts together, as kMaxVertices.
constexpr uint64_t kMaxParts = 1u << 14;
constexpr uint64_t kMaxDisplacements = 1u << 26;

/// A part without vertices and faces: measured, and rounded up.
constexpr uint64_t kPartBytes = 2048;

/// What has been read so far; refuses too much.
class Amount {
public:
    void add(const PartCage& part) {
        const std::string element = at("node", part.part.node);
        add(parts_, 1, kMaxParts, "meshes", element);
        add(vertices_, part.sourceVertexCount, kMaxVertices, "vertices", element);
        add(corners_, part.cage.cornerCount(), kMaxCorners, "corners", element);
        for (const MorphTarget& target : part.morphs.targets) {
            add(displacements_, target.vertices.size(), kMaxDisplacements, "displacements of morph targets", element);
        }
    }

private:
    static void add(uint64_t& sum, uint64_t more, uint64_t most, const char* what, const std::string& element) {
        sum += more;
        if (sum > most) {
            refuse(element, "with its mesh, there are more than " + std::to_string(most) + " " + what,
                   ErrorCode::limit);
        }
    }
    uint64_t parts_ = 0, vertices_ = 0, corners_ = 0, displacements_ = 0;
};

/// The mesh that a node carries, as it is before it joins the other parts. Its cage is empty if it has no faces: then a
/// warning says why.
PartCage readPart(const Document& document, uint32_t node, const Skin& skin, const GltfOptions& options,
                  const Character& character, Warnings& warnings) {
    const auto& from = document.model.nodes[node];
    PartCage part;
    const size_t nameBytes = from.name.size() + document.model.meshes[static_cast<size_t>(from.mesh)].name.size();
    document.memory->take(kPartBytes + 4 * nameBytes, at("node", node));
    part.part.name = from.name.empty() ? document.model.meshes[static_cast<size_t>(from.mesh)].name : from.name;
    part.part.node = node;
    const std::optional<Mesh> mesh = readMesh(document, node, skin.joints.size(), character.materials, warnings);
    if (!mesh) {
        const auto index = static_cast<size_t>(from.mesh);
        part.whyEmpty = at("mesh", index) + ": " + nameOfNoTriangles(document.model.meshes[index]);
        return part;
    }
    part.element = mesh->element;
    part.morphs = readMorphs(document, node, mesh->morphs.targetCount(), warnings);
    buildCage(document, *mesh, options, part, warnings);
    if (part.cage.faceCount() == 0) {
        part.whyEmpty = mesh->element + ": no triangle is left";
    }
    return part;
}

std::vector<PartCage> readParts(const Document& document, const GltfOptions& options, Character& character,
                                Refusals& refusals) {
    const std::vector<uint32_t> nodes = findMeshNodes(document, options.scene, character.warnings);
    std::vector<Skin> skins;
    for (const uint32_t node : nodes) {
        refusals.gather([&] { skins.push_back(readSkin(document, node)); });
    }
    refusals.raise();
    const BindSpace bindSpace(document, character.skeleton, nodes, skins);
    PaletteBuilder palette(character.skin);
    Amount amount;
    std::vector<PartCage> parts;
    std::set<std::string> said; // nodes may share a mesh
    std::set<std::string> whyEmpty;
    for (size_t i = 0; i < nodes.size(); ++i) {
        Warnings warnings;
        PartCage part;
        if (!refusals.gather([&] {
                part = readPart(document, nodes[i], skins[i], options, character, warnings);
                amount.add(part);
            })) {
            continue;
        }
        for (std::string& warning : warnings) {
            if (said.insert(warning).second) {
                character.warnings.push_back(std::move(warning));
            }
        }
        for (Damage& damage : part.damages) {
            if (said.insert(damage.found).second) {
                character.damages.push_back(std::move(damage));
            }
        }
        if (part.cage.faceCount() == 0) {
            whyEmpty.insert(part.whyEmpty);
            continue;
        }
        if (!bindSpace.place(part, skins[i])) {
            warn(character.warnings, at("node", nodes[i]),
                 "its place in the bind pose is beyond 1e+09; its mesh stays in the node's own space");
        }
        part.part.joints = palette.add(skins[i]);
        parts.push_back(std::move(part));
    }
    if (parts.empty() && refusals.none()) {
        throw Refusal{ErrorCode::asset, {whyEmpty.begin(), whyEmpty.end()}};
    }
    for (const std::string& reason : whyEmpty) {
        character.warnings.push_back(reason + "; left out");
    }
    return parts;
}

/// Says what was paired without being asked.
void warnOfPairs(const std::vector<PartCage>& parts, Warnings& warnings) {
    size_t paired = 0;
    size_t quads = 0;
    size_t triangles = 0;
    for (const PartCage& part : parts) {
        if (part.part.polygonSource == PolygonSource::pairedTriangles) {
            ++paired;
            for (uint32_t face = 0; face < part.cage.faceCount(); ++face) {
                ++(part.cage.sides(face) == 3 ? triangles : quads);
            }
        }
    }
    if (paired > 0) {
        warn(warnings, "file",
             "triangles of " + std::to_string(paired) + " of " + counted(parts.size(), "part", "parts") +
                 " paired into " + counted(quads, "quad", "quads") + ", " + std::to_string(triangles) + " left");
    }
}

/// Clips of a file take the file's name if they have none.
ClipSet readClipSet(const ClipFile& file, uint64_t memoryLimit) {
    try {
        const FileReader readFolder = [&](const std::string& path) { return readBelow(file.baseDirectory, path); };
        const Document document =
            loadDocument(file.bytes, file.readFile ? file.readFile : readFolder, memoryLimit, Content::motion);
        return readMotion(document, file.name);
    } catch (const Refusal& refusal) {
        Refusal named{refusal.code, {}};
        for (const std::string& fault : refusal.faults) {
            named.faults.push_back(file.name + ": " + fault);
        }
        throw named;
    }
}

Character toCharacter(const Document& document, const GltfOptions& options) {
    Character character;
    Warnings& warnings = character.warnings;
    warnings = document.warnings;
    character.copyright = document.model.copyright;
    character.skeleton = readSkeleton(document);
    character.images = document.images;
    Refusals refusals;
    character.materials = readMaterials(document, refusals, warnings);
    std::vector<PartCage> parts = readParts(document, options, character, refusals);
    if (options.pairing == Pairing::whereClean) {
        warnOfPairs(parts, warnings);
    }
    std::vector<size_t> targetCounts(character.skeleton.nodes.size(), 0);
    for (const PartCage& part : parts) {
        targetCounts[part.part.node] = part.morphs.targets.size();
    }
    character.clips = readClips(document, character.skeleton, targetCounts, refusals, warnings);
    for (const ClipFile& file : options.clipFiles) {
        refusals.gather([&] { takeClips(readClipSet(file, options.memoryLimit), parts, character); });
    }
    refusals.raise();
    const CageNames names = joinParts(std::move(parts), character);
    if (options.sewParts) {
        sewParts(character);
    }
    if (const Status repaired =
            repairCage(character.cage, character.weights, character.morphs, names, character.damages);
        !repaired) {
        throw Refusal{repaired.error().code, {repaired.error().message}};
    }
    findFirstFaces(character);
    if (options.creasesFromNormals) {
        creaseSplitNormals(character.cage);
    }
    return character;
}

} // namespace
} // namespace gltf

namespace {

Error failure(ErrorCode code, const std::string& name, const std::string& message) {
    return Error{code, oneLine(name + ": " + message)};
}

} // namespace

Result<Character> readGltf(std::span<const std::byte> bytes, const std::string& name, const std::string& baseDirectory,
                           const GltfOptions& options) {
    try {
        const FileReader readFolder = [&](const std::string& path) { return gltf::readBelow(baseDirectory, path); };
        Character character = gltf::toCharacter(
            gltf::loadDocument(bytes, options.readFile ? options.readFile : readFolder, options.memoryLimit), options);
        character.name = name;
        if (const Status sound = reportDamages(character, options.strict); !sound) {
            return sound.error();
        }
        character.warnings = readableLines(character.warnings);
        return character;
    } catch (const Refusal& refusal) {
        return asError(refusal, name);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, name, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::asset, name, std::string("file: ") + error.what());
    }
}

Result<Character> readGltfFile(const std::string& path, const GltfOptions& options) {
    std::string name = path;
    try {
        const std::filesystem::path file(path);
        if (file.has_filename()) {
            name = file.filename().string();
        }
        const Result<std::vector<std::byte>> bytes = gltf::readRegularFile(path);
        if (!bytes) {
            return failure(ErrorCode::io, name, "file: " + bytes.error().message + ": " + quoted(path));
        }
        const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
        return readGltf(*bytes, name, folder, options);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, name, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::io, name, std::string("file: ") + error.what());
    }
}

} // namespace supple::cage
