#include "cage/gltf/reader.h"

#include "cage/bind_space.h"
#include "cage/clip_set.h"
#include "cage/finish.h"
#include "cage/gltf/animation.h"
#include "cage/gltf/document.h"
#include "cage/gltf/material.h"
#include "cage/gltf/mesh.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/nodes.h"
#include "cage/gltf/skin.h"
#include "cage/gltf/uri.h"
#include "cage/message.h"
#include "cage/part_amount.h"
#include "cage/parts.h"
#include "cage/refusal.h"
#include "cage/split/cage.h"

#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <utility>

namespace supple::cage {
namespace gltf {
namespace {

/// A part without vertices and faces: measured, and rounded up.
constexpr uint64_t kPartBytes = 2048;

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
    const std::optional<split::Mesh> mesh = readMesh(document, node, skin.joints.size(), character.materials, warnings);
    if (!mesh) {
        const auto index = static_cast<size_t>(from.mesh);
        part.whyEmpty = at("mesh", index) + ": " + nameOfNoTriangles(document.model.meshes[index]);
        return part;
    }
    part.element = mesh->element;
    part.morphs = readMorphs(document, node, targetCountOf(document, node), warnings);
    split::buildCage(*mesh, options.pairing, part, warnings);
    if (part.cage.faceCount() == 0) {
        part.whyEmpty = mesh->element + ": no triangle is left";
    }
    return part;
}

std::vector<PartCage> readParts(const Document& document, const GltfOptions& options, Character& character,
                                Refusals& refusals) {
    const std::vector<uint32_t> nodes = findMeshNodes(document, options.scene, character.warnings);
    std::vector<MeshBinding> meshes;
    for (const uint32_t node : nodes) {
        refusals.gather([&] {
            meshes.push_back({node, document.model.nodes[node].skin >= 0, readSkin(document, node)});
        });
    }
    refusals.raise();
    const BindSpace bindSpace(character.skeleton, meshes);
    PaletteBuilder palette(character.skin);
    PartAmount amount;
    std::vector<PartCage> parts;
    std::set<std::string> said; // nodes may share a mesh
    std::set<std::string> whyEmpty;
    for (size_t i = 0; i < nodes.size(); ++i) {
        Warnings warnings;
        PartCage part;
        if (!refusals.gather([&] {
                part = readPart(document, nodes[i], meshes[i].skin, options, character, warnings);
                amount.add(part, at("node", nodes[i]));
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
        if (!bindSpace.place(part, meshes[i])) {
            warn(character.warnings, at("node", nodes[i]),
                 "its place in the bind pose is beyond 1e+09; its mesh stays in the node's own space");
        }
        part.part.joints = palette.add(meshes[i].skin);
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

/// All of a character but what is done to every one at last, and its parts.
std::vector<PartCage> readInto(const Document& document, const GltfOptions& options, Character& character) {
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
    return parts;
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
        const gltf::Document document =
            gltf::loadDocument(bytes, options.readFile ? options.readFile : readFolder, options.memoryLimit);
        Character character;
        character.name = name;
        std::vector<PartCage> parts = gltf::readInto(document, options, character);
        finishCharacter(std::move(parts), {options.sewParts, options.creasesFromNormals, options.strict}, character);
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
