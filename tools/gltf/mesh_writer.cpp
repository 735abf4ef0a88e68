#include "tools/gltf/mesh_writer.h"

#include "cage/limits.h"
#include "cage/materials.h"
#include "cage/message.h"
#include "cage/ngon_fans.h"
#include "cage/refusal.h"
#include "tools/gltf/smoothing_writer.h"
#include "tools/gltf/soft_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/vector_float1.hpp>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage::gltf {
namespace {

using Target = Packer::Target;
using Component = Packer::Component;

/// What a corner has besides its cage vertex, and cannot share a glTF vertex without.
struct CornerValues {
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; ///< zero for none; empty where not written
    std::vector<glm::vec2> uvs[2];   ///< TEXCOORD_0 and TEXCOORD_1; empty where not written
    std::vector<glm::vec4> colors;
    std::vector<glm::vec1> tiles; ///< _TRIM_TILE: -1 for none; empty where no material's trim has tiles
};

bool hasFaceTrim(const Material& material) {
    return material.trim && material.trim->domain == TrimDomain::face;
}

/// glTF counts texture coordinates from 0 without gaps, and a texture needs those it names: zeros where there are none.
CornerValues cornerValues(const Character& character, std::span<const glm::vec3> normals) {
    const Cage& cage = character.cage;
    CornerValues values;
    values.normals.assign(normals.begin(), normals.end());
    values.tangents = cage.cornerTangents;
    values.uvs[0] = cage.cornerUvs;
    values.uvs[1] = cage.cornerUvs1;
    values.colors = cage.cornerColors;
    size_t sets = !cage.cornerUvs1.empty() ? 2 : !cage.cornerUvs.empty() ? 1 : 0;
    for (const uint32_t material : cage.faceMaterials) {
        if (material != kNone) {
            sets = std::max<size_t>(sets, uvSetsOf(character.materials[material]));
        }
    }
    for (size_t set = 0; set < sets; ++set) {
        values.uvs[set].resize(cage.cornerCount(), glm::vec2(0.0f));
    }
    if (std::any_of(character.materials.begin(), character.materials.end(), hasFaceTrim)) {
        for (uint32_t face = 0; face < cage.faceCount(); ++face) {
            const uint32_t material = cage.faceMaterials.empty() ? kNone : cage.faceMaterials[face];
            const bool tiled =
                !cage.faceTrimTiles.empty() && material != kNone && hasFaceTrim(character.materials[material]);
            const uint32_t tile = tiled ? cage.faceTrimTiles[face] : kNone;
            values.tiles.insert(values.tiles.end(), cage.sides(face),
                                glm::vec1(tile == kNone ? -1.0f : static_cast<float>(tile)));
        }
    }
    return values;
}

/// One primitive's faces and vertices.
struct WrittenPrimitive {
    uint32_t material = kNone;
    std::vector<uint32_t> faces;        ///< of the cage
    Polygons polygons;                  ///< in glTF vertices
    std::vector<uint32_t> corners;      ///< per glTF vertex: a corner of the cage that it stands for
    std::vector<uint32_t> cageVertices; ///< per glTF vertex; rising
};

/// By material, in the order of their first faces.
std::vector<WrittenPrimitive> primitivesOf(const Cage& cage) {
    std::vector<WrittenPrimitive> parts;
    std::map<uint32_t, size_t> known;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t material = cage.faceMaterials.empty() ? kNone : cage.faceMaterials[face];
        const auto [part, isNew] = known.try_emplace(material, parts.size());
        if (isNew) {
            parts.emplace_back().material = material;
        }
        parts[part->second].faces.push_back(face);
    }
    return parts;
}

void splitVertices(const Cage& cage, const CornerValues& values, WrittenPrimitive& part) {
    std::vector<uint32_t> corners;
    for (const uint32_t face : part.faces) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            corners.push_back(corner);
        }
    }
    const auto compare = [](const auto& list, uint32_t a, uint32_t b) {
        for (int k = 0; !list.empty() && k < list[a].length(); ++k) {
            if (list[a][k] != list[b][k]) {
                return list[a][k] < list[b][k] ? -1 : 1;
            }
        }
        return 0;
    };
    const auto compareCorners = [&](uint32_t a, uint32_t b) {
        if (cage.faceVertices[a] != cage.faceVertices[b]) {
            return cage.faceVertices[a] < cage.faceVertices[b] ? -1 : 1;
        }
        for (const int order :
             {compare(values.uvs[0], a, b), compare(values.uvs[1], a, b), compare(values.colors, a, b),
              compare(values.normals, a, b), compare(values.tangents, a, b), compare(values.tiles, a, b)}) {
            if (order != 0) {
                return order;
            }
        }
        return 0;
    };
    std::vector<uint32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        const int byValues = compareCorners(corners[a], corners[b]);
        return byValues != 0 ? byValues < 0 : a < b;
    });
    part.polygons.vertices.resize(corners.size());
    for (size_t i = 0; i < order.size(); ++i) {
        const uint32_t corner = corners[order[i]];
        if (i == 0 || compareCorners(corners[order[i - 1]], corner) != 0) {
            part.corners.push_back(corner);
            part.cageVertices.push_back(cage.faceVertices[corner]);
        }
        part.polygons.vertices[order[i]] = static_cast<uint32_t>(part.corners.size() - 1);
    }
    uint32_t end = 0;
    for (const uint32_t face : part.faces) {
        end += cage.sides(face);
        part.polygons.starts.push_back(end);
    }
}

class MeshWriter {
public:
    MeshWriter(const Character& character, bool skinned, std::span<const glm::vec3> normals, Packer& packer)
        : character_(character), cage_(character.cage), packer_(packer), values_(cornerValues(character, normals)),
          creaseWritten_(cage_.creases.size(), 0), sharpWritten_(cage_.sharpVertices.size(), 0),
          scalarWritten_(cage_.creaseScalars.size(), 0) {
        const Part& part = character.parts[0];
        jointCount_ = part.joints.empty() ? character.skin.joints.size() : part.joints.size();
        jointPlaces_.resize(character.skin.joints.size());
        std::iota(jointPlaces_.begin(), jointPlaces_.end(), 0u);
        for (uint32_t j = 0; j < part.joints.size(); ++j) {
            jointPlaces_[part.joints[j]] = j;
        }
        if (skinned) {
            const auto& starts = character.weights.starts;
            for (size_t v = 0; v + 1 < starts.size(); ++v) {
                skinSets_ = std::max(skinSets_, (starts[v + 1] - starts[v] + 3) / 4);
            }
        }
    }

    json write(GlbFile& file) {
        json mesh;
        json primitives = json::array();
        for (WrittenPrimitive& part : primitivesOf(cage_)) {
            splitVertices(cage_, values_, part);
            primitives.push_back(writePrimitive(part, file));
            file.vertexCount += static_cast<uint32_t>(part.corners.size());
        }
        mesh["primitives"] = std::move(primitives);
        const Morphs& morphs = character_.morphs;
        if (!morphs.targets.empty()) {
            mesh["weights"] = morphs.weights;
            json names = json::array();
            bool named = false;
            for (const MorphTarget& target : morphs.targets) {
                names.push_back(target.name);
                named = named || !target.name.empty();
            }
            if (named) {
                mesh["extras"]["targetNames"] = std::move(names);
            }
        }
        return mesh;
    }

private:
    template <class Vec>
    std::vector<Vec> gathered(const std::vector<Vec>& perCorner, const WrittenPrimitive& part) const {
        std::vector<Vec> values;
        values.reserve(part.corners.size());
        for (const uint32_t corner : part.corners) {
            values.push_back(perCorner[corner]);
        }
        return values;
    }

    json writePrimitive(const WrittenPrimitive& part, GlbFile& file) {
        std::vector<glm::vec3> positions;
        for (const uint32_t v : part.cageVertices) {
            positions.push_back(cage_.positions[v]);
            if (const char* const fault = faultOfCoordinates(&positions.back().x, 3)) {
                refuse(at("vertex", v), std::string(fault) + " in the space of its node");
            }
        }
        json attributes;
        attributes["POSITION"] = packer_.addFloats("VEC3", floatsOf(positions), Target::vertices, true);
        attributes["NORMAL"] = packer_.addFloats("VEC3", floatsOf(gathered(values_.normals, part)), Target::vertices);
        writeTangents(part, attributes, file);
        for (size_t set = 0; set < 2; ++set) {
            if (!values_.uvs[set].empty()) {
                attributes["TEXCOORD_" + std::to_string(set)] =
                    packer_.addFloats("VEC2", floatsOf(gathered(values_.uvs[set], part)), Target::vertices);
            }
        }
        if (!values_.colors.empty()) {
            attributes["COLOR_0"] = writeColors(gathered(values_.colors, part));
        }
        if (!values_.tiles.empty()) {
            attributes["_TRIM_TILE"] =
                packer_.addFloats("SCALAR", floatsOf(gathered(values_.tiles, part)), Target::vertices);
        }
        writeSkin(part, attributes);
        writePainted(part, character_.weights.jiggles, character_.jiggles.size(), jiggleAttribute, attributes);
        writePainted(part, character_.weights.cloths, character_.cloths.size(), clothAttribute, attributes);
        writeMushMask(part, attributes);

        const auto vertexCount = static_cast<uint32_t>(part.corners.size());
        json primitive = {{"attributes", std::move(attributes)}, {"mode", 4}};
        primitive["indices"] = packer_.addIntegers("SCALAR", encodeNgons(part.polygons, positions),
                                                   Packer::indexComponent(vertexCount - 1), Target::indices);
        if (part.material != kNone) {
            primitive["material"] = part.material;
        }
        if (!character_.morphs.targets.empty()) {
            primitive["targets"] = writeTargets(part);
        }
        primitive["extensions"] = {{"FB_ngon_encoding", json::object()}, {"SUPPLE_mesh_cage", writeExtension(part)}};
        return primitive;
    }

    /// glTF knows no vertex without a tangent among others that have one: then the primitive has none.
    void writeTangents(const WrittenPrimitive& part, json& attributes, GlbFile& file) {
        if (values_.tangents.empty()) {
            return;
        }
        const std::vector<glm::vec4> tangents = gathered(values_.tangents, part);
        const auto none = std::count(tangents.begin(), tangents.end(), glm::vec4(0.0f));
        if (none == 0) {
            attributes["TANGENT"] = packer_.addFloats("VEC4", floatsOf(tangents), Target::vertices);
        } else if (static_cast<size_t>(none) < tangents.size()) {
            warn(file.warnings, "tangents",
                 "those of a primitive left out: " + counted(static_cast<size_t>(none), "vertex has", "vertices have") +
                     " none");
        }
    }

    /// As 16-bit integers where these are what a file had, else as floats.
    size_t writeColors(const std::vector<glm::vec4>& colors) {
        std::vector<uint32_t> integers;
        for (const float value : floatsOf(colors)) {
            const float scaled = std::round(value * 65535.0f);
            if (!(scaled >= 0.0f && scaled <= 65535.0f) || scaled / 65535.0f != value) {
                return packer_.addFloats("VEC4", floatsOf(colors), Target::vertices);
            }
            integers.push_back(static_cast<uint32_t>(scaled));
        }
        return packer_.addIntegers("VEC4", integers, Component::u16, Target::vertices, true);
    }

    void writeSkin(const WrittenPrimitive& part, json& attributes) {
        const Component component = jointCount_ <= 256 ? Component::u8 : Component::u16;
        for (uint32_t set = 0; set < skinSets_; ++set) {
            std::vector<uint32_t> joints;
            std::vector<float> weights;
            for (const uint32_t v : part.cageVertices) {
                const auto own = std::span(character_.weights.influences)
                                     .subspan(character_.weights.starts[v],
                                              character_.weights.starts[v + 1] - character_.weights.starts[v]);
                for (size_t k = 4 * size_t{set}; k < 4 * size_t{set} + 4; ++k) {
                    joints.push_back(k < own.size() ? jointPlaces_[own[k].joint] : 0);
                    weights.push_back(k < own.size() ? own[k].weight : 0.0f);
                }
            }
            attributes["JOINTS_" + std::to_string(set)] =
                packer_.addIntegers("VEC4", joints, component, Target::vertices);
            attributes["WEIGHTS_" + std::to_string(set)] = packer_.addFloats("VEC4", weights, Target::vertices);
        }
    }

    void writePainted(const WrittenPrimitive& part, const std::vector<PaintedWeight>& all, size_t count,
                      std::string (*nameOf)(size_t), json& attributes) {
        for (size_t k = 0; k < count; ++k) {
            std::vector<float> weights;
            for (const uint32_t v : part.cageVertices) {
                weights.push_back(all[v].index == k ? all[v].weight : 0.0f);
            }
            attributes[nameOf(k)] = packer_.addFloats("SCALAR", weights, Target::vertices);
        }
    }

    void writeMushMask(const WrittenPrimitive& part, json& attributes) {
        std::vector<float> mask;
        for (const uint32_t v : part.cageVertices) {
            if (!character_.weights.mushMask.empty()) {
                mask.push_back(character_.weights.mushMask[v]);
            }
        }
        if (!mask.empty()) {
            attributes[kMushMaskAttribute] = packer_.addFloats("SCALAR", mask, Target::vertices);
        }
    }

    json writeTargets(const WrittenPrimitive& part) {
        json targets = json::array();
        std::vector<glm::vec3> deltas(cage_.vertexCount(), glm::vec3(0.0f));
        for (const MorphTarget& target : character_.morphs.targets) {
            for (size_t i = 0; i < target.vertices.size(); ++i) {
                deltas[target.vertices[i]] = target.deltas[i];
            }
            std::vector<uint32_t> moved;
            std::vector<glm::vec3> movedBy;
            std::vector<glm::vec3> all;
            for (uint32_t v = 0; v < part.cageVertices.size(); ++v) {
                all.push_back(deltas[part.cageVertices[v]]);
                if (all.back() != glm::vec3(0.0f)) {
                    moved.push_back(v);
                    movedBy.push_back(all.back());
                }
            }
            // An entry of a sparse accessor costs a four-byte index at most.
            const bool sparse = moved.size() * (sizeof(glm::vec3) + 4) < all.size() * sizeof(glm::vec3);
            targets.push_back(
                {{"POSITION", sparse ? packer_.addSparseFloats("VEC3", all.size(), moved, floatsOf(movedBy))
                                     : packer_.addFloats("VEC3", floatsOf(all), Target::vertices, true)}});
            for (const uint32_t v : target.vertices) {
                deltas[v] = glm::vec3(0.0f);
            }
        }
        return targets;
    }

    /// SCALAR integers without a target: nothing for a GPU.
    size_t addList(const std::vector<uint32_t>& values) {
        const uint32_t largest = *std::max_element(values.begin(), values.end());
        return packer_.addIntegers("SCALAR", values, Packer::indexComponent(largest), Target::none);
    }

    void writeRules(json& extension) const {
        if (const auto& scheme = character_.parts[0].madeFor) {
            extension["scheme"] = madeForName(*scheme);
        }
        if (!cage_.roundCorners.empty()) {
            extension["interpolateBoundary"] = "edgeOnly";
        }
        if (const auto& mode = character_.parts[0].uvMode) {
            extension["faceVaryingLinearInterpolation"] = uvModeName(*mode);
        }
    }

    static bool has(const WrittenPrimitive& part, uint32_t vertex) {
        return std::binary_search(part.cageVertices.begin(), part.cageVertices.end(), vertex);
    }

    void writeCreases(const WrittenPrimitive& part, json& extension) {
        std::vector<uint32_t> vertices;
        std::vector<float> sharpnesses;
        std::map<uint32_t, std::vector<uint32_t>> sets;
        for (size_t i = 0; i < cage_.creases.size(); ++i) {
            const Crease& crease = cage_.creases[i];
            if (creaseWritten_[i] != 0 || !has(part, crease.a) || !has(part, crease.b)) {
                continue;
            }
            creaseWritten_[i] = 1;
            if (crease.set != kNone) {
                sets[crease.set].push_back(static_cast<uint32_t>(sharpnesses.size()));
            }
            vertices.insert(vertices.end(), {crease.a, crease.b});
            sharpnesses.push_back(crease.sharpness);
        }
        if (sharpnesses.empty()) {
            return;
        }
        extension["creaseIndices"] = addList(vertices);
        extension["creaseSharpnesses"] = packer_.addFloats("SCALAR", sharpnesses, Target::none);
        for (const auto& [set, creases] : sets) {
            extension["creaseSets"].push_back({{"name", cage_.creaseSets[set]}, {"creases", addList(creases)}});
        }
    }

    void writeScalars(const WrittenPrimitive& part, json& extension) {
        std::vector<uint32_t> vertices;
        std::vector<float> alphas;
        for (size_t i = 0; i < cage_.creaseScalars.size(); ++i) {
            const CreaseScalar& scalar = cage_.creaseScalars[i];
            if (scalarWritten_[i] == 0 && has(part, scalar.vertex) && has(part, scalar.toward)) {
                scalarWritten_[i] = 1;
                vertices.insert(vertices.end(), {scalar.vertex, scalar.toward});
                alphas.push_back(scalar.alpha);
            }
        }
        if (!alphas.empty()) {
            extension["creaseScalarIndices"] = addList(vertices);
            extension["creaseScalars"] = packer_.addFloats("SCALAR", alphas, Target::none);
        }
    }

    json writeExtension(const WrittenPrimitive& part) {
        std::vector<uint32_t> counts;
        for (const uint32_t face : part.faces) {
            counts.push_back(cage_.sides(face));
        }
        json extension;
        extension["faceVertexCounts"] = addList(counts);
        extension["faceVertexIndices"] = addList(part.polygons.vertices);
        extension["cageVertices"] = addList(part.cageVertices);
        writeRules(extension);

        writeCreases(part, extension);
        writeScalars(part, extension);
        std::vector<uint32_t> vertices;
        std::vector<float> sharpnesses;
        for (size_t i = 0; i < cage_.sharpVertices.size(); ++i) {
            const SharpVertex& sharp = cage_.sharpVertices[i];
            if (sharpWritten_[i] == 0 && has(part, sharp.vertex)) {
                sharpWritten_[i] = 1;
                vertices.push_back(sharp.vertex);
                sharpnesses.push_back(sharp.sharpness);
            }
        }
        if (!sharpnesses.empty()) {
            extension["cornerIndices"] = addList(vertices);
            extension["cornerSharpnesses"] = packer_.addFloats("SCALAR", sharpnesses, Target::none);
        }
        std::vector<uint32_t> holes;
        for (uint32_t f = 0; f < part.faces.size(); ++f) {
            if (std::binary_search(cage_.holes.begin(), cage_.holes.end(), part.faces[f])) {
                holes.push_back(f);
            }
        }
        if (!holes.empty()) {
            extension["holeIndices"] = addList(holes);
        }
        return extension;
    }

    const Character& character_;
    const Cage& cage_;
    Packer& packer_;
    const CornerValues values_;
    uint32_t skinSets_ = 0;             ///< of four influences each
    size_t jointCount_ = 0;             ///< of the part's skin
    std::vector<uint32_t> jointPlaces_; ///< per entry of the palette: its place in the part's skin
    std::vector<uint8_t> creaseWritten_;
    std::vector<uint8_t> sharpWritten_;
    std::vector<uint8_t> scalarWritten_;
};

} // namespace

json writeMesh(const Character& character, bool skinned, std::span<const glm::vec3> normals, Packer& packer,
               GlbFile& file) {
    return MeshWriter(character, skinned, normals, packer).write(file);
}

} // namespace supple::cage::gltf
