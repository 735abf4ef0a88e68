#include "cage/gltf/reader.h"

#include "cage/gltf/animation.h"
#include "cage/gltf/cage.h"
#include "cage/gltf/document.h"
#include "cage/gltf/material.h"
#include "cage/gltf/mesh.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/nodes.h"
#include "cage/gltf/skin.h"
#include "cage/gltf/uri.h"
#include "cage/message.h"
#include "cage/refusal.h"
#include "cage/repair.h"

#include <exception>
#include <filesystem>
#include <new>
#include <utility>

namespace supple::cage {
namespace gltf {
namespace {

Character toCharacter(const Document& document, const GltfOptions& options) {
    Character character;
    Warnings& warnings = character.warnings;
    warnings = document.warnings;
    character.copyright = document.model.asset.copyright;
    character.skeleton = readSkeleton(document);
    const uint32_t meshNode = chooseMeshNode(document, warnings);
    character.meshNode = meshNode;
    character.skin = readSkin(document, meshNode);
    character.images = document.images;
    character.materials = readMaterials(document, warnings);
    const Mesh mesh = readMesh(document, meshNode, character.skin.joints.size(), character.materials, warnings);
    character.meshNode = meshNode;
    character.morphs = readMorphs(document, meshNode, mesh.morphs.targetCount(), warnings);
    buildCage(document, mesh, options, character);
    character.clips = readClips(document, character.skeleton, meshNode, mesh.morphs.targetCount(), warnings);
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
        Character character =
            gltf::toCharacter(gltf::loadDocument(bytes, options.readFile ? options.readFile : readFolder), options);
        character.name = name;
        if (const Status sound = reportDamages(character, options.strict); !sound) {
            return sound.error();
        }
        for (std::string& warning : character.warnings) {
            warning = oneLine(std::move(warning));
        }
        return character;
    } catch (const Refusal& refusal) {
        return failure(refusal.code, name, refusal.message);
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
