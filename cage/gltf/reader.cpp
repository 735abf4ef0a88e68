#include "cage/gltf/reader.h"

#include "base/utf8_path.h"
#include "cage/bind_space.h"
#include "cage/clip_set.h"
#include "cage/finish.h"
#include "cage/gltf/animation.h"
#include "cage/gltf/document.h"
#include "cage/gltf/drivers.h"
#include "cage/gltf/material.h"
#include "cage/gltf/mesh.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/nodes.h"
#include "cage/gltf/skin.h"
#include "cage/gltf/uri.h"
#include "cage/gltf/variants.h"
#include "cage/gltf/vrm_expressions.h"
#include "cage/gltf/vrm_springs.h"
#include "cage/message.h"
#include "cage/part_amount.h"
#include "cage/parts.h"
#include "cage/refusal.h"
#include "cage/skeleton.h"
#include "cage/split/cage.h"

#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace supple::cage {
namespace gltf {
namespace {

/// A part without vertices and faces: measured, and rounded up.
constexpr uint64_t kPartBytes = 2048;

/// The mesh that a node carries, as it is before it joins the other parts. Its cage is empty if it has no faces: then a
/// warning says why, or part.whyEmpty does.
PartCage readPart(const Document& document, const MeshBinding& binding, const GltfOptions& options,
                  const Character& character, Warnings& warnings) {
    const uint32_t node = binding.node;
    const auto& from = document.model.nodes[node];
    const auto& fromMesh = document.model.meshes[static_cast<size_t>(from.mesh)];
    PartCage part;
    document.memory->take(kPartBytes + 4 * (from.name.size() + fromMesh.name.size()), at("node", node));
    part.part.name = from.name.empty() ? fromMesh.name : from.name;
    part.part.node = node;
    const std::optional<Mesh> mesh = readMesh(document, binding, character.materials, part.whyEmpty, warnings);
    if (!mesh) {
        return part;
    }
    part.element = mesh->element;
    part.gridStep = mesh->gridStep;
    part.morphs = readMorphs(document, node, targetCountOf(fromMesh), warnings);
    part.drivers =
        readDrivers(document, static_cast<size_t>(from.mesh), part.morphs.targets.size(), character.skeleton);
    split::buildCage(*mesh, options.pairing, part, *document.leniency, warnings);
    if (part.cage.faceCount() == 0) {
        part.whyEmpty = mesh->element + ": no triangle is left";
    }
    return part;
}

/// From the numbers of the file to those of the character's spring bones: `places`.
void placeColliders(std::span<const uint32_t> places, std::vector<PartCage>& parts, Leniency& leniency) {
    for (PartCage& part : parts) {
        for (Cloth& cloth : part.cloths) {
            std::vector<uint32_t> placed;
            for (const uint32_t number : cloth.colliders) {
                leniency.leaveOut([&] {
                    if (number >= places.size()) {
                        refuse(part.element + " SUPPLE_deformers cloth colliders",
                               std::to_string(number) + " is no collider of the file's spring bones");
                    }
                    if (places[number] != kNone) { // else it is left out, and a warning says so
                        placed.push_back(places[number]);
                    }
                });
            }
            cloth.colliders = std::move(placed);
        }
    }
}

/// What the meshes of nodes are bound to. One whose skin cannot be read is bound to its node, as one without a skin.
std::vector<MeshBinding> readBindings(const Document& document, std::span<const uint32_t> nodes,
                                      std::span<const glm::dmat4> restPlaces) {
    std::vector<MeshBinding> bindings;
    for (const uint32_t node : nodes) {
        MeshBinding binding = bindToNode(node);
        document.leniency->leaveOut([&] {
            binding.skin = readSkin(document, restPlaces, node);
            binding.skinned = document.model.nodes[node].skin >= 0;
        });
        if (binding.skinned && followsNode(document, node)) {
            binding.addFollower();
        }
        bindings.push_back(std::move(binding));
    }
    return bindings;
}

/// Warnings and damages of meshes, which nodes may share.
class SaidOnce {
public:
    void take(Warnings& warnings, PartCage& part, Character& character) {
        for (std::string& warning : warnings) {
            if (said_.insert(warning).second) {
                character.warnings.push_back(std::move(warning));
            }
        }
        for (Damage& damage : part.damages) {
            if (said_.insert(damage.found).second) {
                character.damages.push_back(std::move(damage));
            }
        }
    }

private:
    std::set<std::string> said_;
};

/// The meshes that have faces, with what they are bound to, in the space of their own.
std::vector<PartCage> readUnplaced(const Document& document, const GltfOptions& options,
                                   std::vector<MeshBinding>& meshes, Character& character) {
    Leniency& leniency = *document.leniency;
    PartAmount amount;
    std::vector<PartCage> parts;
    std::vector<MeshBinding> withFaces;
    SaidOnce said;
    std::set<std::string> whyEmpty;
    for (MeshBinding& mesh : meshes) {
        Warnings warnings;
        PartCage part;
        if (!leniency.leaveOut([&] {
                part = readPart(document, mesh, options, character, warnings);
                amount.add(part, at("node", mesh.node));
            })) {
            continue;
        }
        said.take(warnings, part, character);
        if (part.cage.faceCount() > 0) {
            parts.push_back(std::move(part));
            withFaces.push_back(std::move(mesh));
        } else if (!part.whyEmpty.empty()) {
            whyEmpty.insert(part.whyEmpty);
        }
    }
    if (parts.empty() && !leniency.mustRefuse()) {
        leniency.refuseAll(whyEmpty);
    }
    for (const std::string& reason : whyEmpty) {
        character.warnings.push_back(reason + "; left out");
    }
    meshes = std::move(withFaces);
    return parts;
}

std::vector<PartCage> readParts(const Document& document, const GltfOptions& options, Character& character) {
    const std::vector<uint32_t> nodes = findMeshNodes(document, options.scene, character.warnings);
    const std::vector<glm::dmat4> rest = restPlaces(character.skeleton);
    std::vector<MeshBinding> meshes = readBindings(document, nodes, rest);
    document.leniency->raise();
    const bool isAlone = meshes.size() == 1;
    std::vector<PartCage> parts = readUnplaced(document, options, meshes, character);
    const BindSpace bindSpace(character.skeleton, meshes, parts, isAlone);
    PaletteBuilder palette(character.skin);
    for (size_t i = 0; i < parts.size(); ++i) {
        if (!bindSpace.place(i, parts[i], meshes[i])) {
            warn(character.warnings, at("node", meshes[i].node),
                 "float numbers do not reach its place in the bind pose; its mesh stays in the node's own space");
        }
        parts[i].part.joints = palette.add(meshes[i].skin);
    }
    return parts;
}

/// Clips of a file take the file's name if they have none.
ClipSet readClipSet(const ClipFile& file, const GltfOptions& options) {
    try {
        const FileReader readFolder = [&](const std::string& path) { return readBelow(file.baseDirectory, path); };
        const Document document = loadDocument(file.bytes, file.readFile ? file.readFile : readFolder,
                                               options.memoryLimit, options.strict, Content::motion);
        return readMotion(document, file.name);
    } catch (const Refusal& refusal) {
        Refusal named{refusal.code, {}};
        for (const std::string& fault : refusal.faults) {
            named.faults.push_back(file.name + ": " + fault);
        }
        throw named;
    }
}

/// What is done to every character at last comes behind.
struct ReadParts {
    std::vector<PartCage> parts;
    std::vector<UnplacedExpression> expressions;
};

/// All of a character but that.
ReadParts readInto(const Document& document, const GltfOptions& options, Character& character) {
    Warnings& warnings = character.warnings;
    warnings = document.warnings;
    character.copyright = document.model.copyright;
    character.skeleton = readSkeleton(document);
    character.images = document.images;
    Leniency& leniency = *document.leniency;
    character.materials = readMaterials(document, warnings);
    std::vector<PartCage> parts = readParts(document, options, character);
    if (options.pairing == Pairing::whereClean) {
        warnOfPairs(parts, warnings);
    }
    std::vector<size_t> targetCounts(character.skeleton.nodes.size(), 0);
    for (const PartCage& part : parts) {
        targetCounts[part.part.node] = part.morphs.targets.size();
    }
    std::vector<UnplacedExpression> expressions = readExpressions(document, targetCounts, warnings);
    ReadSprings springs = readSpringBones(document, character.skeleton, warnings);
    character.springBones = std::move(springs.bones);
    placeColliders(springs.colliders, parts, leniency);
    character.clips = readClips(document, character.skeleton, targetCounts, warnings);
    for (const ClipFile& file : options.clipFiles) {
        leniency.gather([&] {
            ClipSet set = readClipSet(file, options);
            if (options.fitClips) {
                options.fitClips(set, character.skeleton);
            }
            takeClips(std::move(set), parts, character);
        });
    }
    checkDrivers(document, character, parts, warnings);
    leniency.raise();
    for (Damage& damage : leniency.takeDamages()) {
        character.damages.push_back(std::move(damage));
    }
    return {std::move(parts), std::move(expressions)};
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
        gltf::Document document = gltf::loadDocument(bytes, options.readFile ? options.readFile : readFolder,
                                                     options.memoryLimit, options.strict);
        Character character;
        character.name = name;
        character.materialVariants = gltf::chooseVariant(document, options.variant);
        gltf::ReadParts read = gltf::readInto(document, options, character);
        finishCharacter(std::move(read.parts), {options.sewParts, options.normalCreases, options.strict}, character);
        placeExpressions(read.expressions, character);
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
        const std::filesystem::path file = utf8Path(path);
        if (file.has_filename()) {
            name = utf8Text(file.filename());
        }
        const Result<std::vector<std::byte>> bytes = gltf::readRegularFile(file);
        if (!bytes) {
            return failure(ErrorCode::io, name, "file: " + bytes.error().message + ": " + quoted(path));
        }
        const std::string folder = file.has_parent_path() ? utf8Text(file.parent_path()) : ".";
        return readGltf(*bytes, name, folder, options);
    } catch (const std::bad_alloc&) {
        return failure(ErrorCode::hostMemory, name, "file: out of memory");
    } catch (const std::exception& error) {
        return failure(ErrorCode::io, name, std::string("file: ") + error.what());
    }
}

} // namespace supple::cage
