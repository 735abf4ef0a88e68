#include "tests/support/character_arrays.h"

#include <algorithm>
#include <utility>

namespace supple::test {
namespace {

using cage::kNone;

template <class T>
T sizedStruct() {
    T made{};
    made.structSize = sizeof(T);
    return made;
}

template <class T>
const float* floatsOf(const std::vector<T>& values, size_t first = 0) {
    return values.empty() ? nullptr : &values[first][0];
}

template <class T>
uint32_t countOf(const std::vector<T>& values) {
    return static_cast<uint32_t>(values.size());
}

SuppleTextureInfo textureInfo(const cage::Texture& from) {
    return {from.image,
            from.alternateImage,
            from.uvSet,
            {static_cast<SuppleWrap>(from.wrapU), static_cast<SuppleWrap>(from.wrapV)},
            static_cast<SuppleFilter>(from.magFilter),
            static_cast<SuppleFilter>(from.minFilter),
            {from.offset.x, from.offset.y},
            from.rotation,
            {from.scale.x, from.scale.y}};
}

SuppleMaterialLayers layersOf(const cage::MaterialLayers& from) {
    auto to = sizedStruct<SuppleMaterialLayers>();
    to.clearcoatFactor = from.clearcoatFactor;
    to.clearcoatRoughnessFactor = from.clearcoatRoughnessFactor;
    to.clearcoatNormalScale = from.clearcoatNormalScale;
    std::copy_n(&from.sheenColorFactor.x, 3, to.sheenColorFactor);
    to.sheenRoughnessFactor = from.sheenRoughnessFactor;
    to.transmissionFactor = from.transmissionFactor;
    to.ior = from.ior;
    to.specularFactor = from.specularFactor;
    std::copy_n(&from.specularColorFactor.x, 3, to.specularColorFactor);
    to.iridescenceFactor = from.iridescenceFactor;
    to.iridescenceIor = from.iridescenceIor;
    to.iridescenceThicknessMinimum = from.iridescenceThicknessMinimum;
    to.iridescenceThicknessMaximum = from.iridescenceThicknessMaximum;
    to.anisotropyStrength = from.anisotropyStrength;
    to.anisotropyRotation = from.anisotropyRotation;
    to.diffuseTransmissionFactor = from.diffuseTransmissionFactor;
    std::copy_n(&from.diffuseTransmissionColorFactor.x, 3, to.diffuseTransmissionColorFactor);
    to.thicknessFactor = from.thicknessFactor;
    to.attenuationDistance = from.attenuationDistance;
    std::copy_n(&from.attenuationColor.x, 3, to.attenuationColor);
    to.clearcoat = textureInfo(from.clearcoatTexture);
    to.clearcoatRoughness = textureInfo(from.clearcoatRoughnessTexture);
    to.clearcoatNormal = textureInfo(from.clearcoatNormalTexture);
    to.sheenColor = textureInfo(from.sheenColorTexture);
    to.sheenRoughness = textureInfo(from.sheenRoughnessTexture);
    to.transmission = textureInfo(from.transmissionTexture);
    to.specular = textureInfo(from.specularTexture);
    to.specularColor = textureInfo(from.specularColorTexture);
    to.iridescence = textureInfo(from.iridescenceTexture);
    to.iridescenceThickness = textureInfo(from.iridescenceThicknessTexture);
    to.anisotropy = textureInfo(from.anisotropyTexture);
    to.diffuseTransmission = textureInfo(from.diffuseTransmissionTexture);
    to.diffuseTransmissionColor = textureInfo(from.diffuseTransmissionColorTexture);
    to.thickness = textureInfo(from.thicknessTexture);
    return to;
}

/// What a part has of a character.
class PartTaker {
public:
    PartTaker(const cage::Character& character, size_t index, CharacterArrays::Part& out)
        : character_(character), cage_(character.cage), part_(character.parts[index]),
          endFace_(cage::endFace(character, index)), out_(out), places_(cage_.vertexCount(), kNone) {}

    void take() {
        takeFaces();
        takeSharpness();
        takeSkin();
        takeTargets();
        fillCage();
    }

private:
    void takeFaces() {
        firstCorner_ = cage_.faceStarts[part_.firstFace];
        const uint32_t endCorner = cage_.faceStarts[endFace_];
        for (uint32_t c = firstCorner_; c < endCorner; ++c) {
            places_[cage_.faceVertices[c]] = 0;
        }
        for (uint32_t v = 0; v < places_.size(); ++v) {
            if (places_[v] != kNone) {
                places_[v] = countOf(vertices_);
                vertices_.push_back(v);
                out_.positions.insert(out_.positions.end(),
                                      {cage_.positions[v].x, cage_.positions[v].y, cage_.positions[v].z});
            }
        }
        for (uint32_t f = part_.firstFace; f < endFace_; ++f) {
            out_.faceVertexCounts.push_back(cage_.sides(f));
        }
        for (uint32_t c = firstCorner_; c < endCorner; ++c) {
            out_.faceVertexIndices.push_back(places_[cage_.faceVertices[c]]);
        }
        for (const uint32_t corner : cage_.faceTriangles) {
            if (corner >= firstCorner_ && corner < endCorner) {
                out_.faceTriangles.push_back(corner - firstCorner_);
            }
        }
        for (const uint32_t hole : cage_.holes) {
            if (hole >= part_.firstFace && hole < endFace_) {
                out_.holes.push_back(hole - part_.firstFace);
            }
        }
    }

    void takeSharpness() {
        for (const cage::Crease& crease : cage_.creases) {
            if (places_[crease.a] != kNone && places_[crease.b] != kNone) {
                out_.creaseVertices.insert(out_.creaseVertices.end(), {places_[crease.a], places_[crease.b]});
                out_.creaseSharpnesses.push_back(crease.sharpness);
                out_.creaseSets.push_back(crease.set);
            }
        }
        for (const std::string& name : cage_.creaseSets) {
            out_.creaseSetNames.push_back(name.c_str());
        }
        for (const cage::SharpVertex& sharp : cage_.sharpVertices) {
            if (places_[sharp.vertex] != kNone) {
                out_.cornerVertices.push_back(places_[sharp.vertex]);
                out_.cornerSharpnesses.push_back(sharp.sharpness);
            }
        }
        for (const cage::CreaseScalar& scalar : cage_.creaseScalars) {
            if (places_[scalar.vertex] != kNone && places_[scalar.toward] != kNone) {
                out_.creaseScalars.push_back({places_[scalar.vertex], places_[scalar.toward], scalar.alpha});
            }
        }
        for (const uint32_t v : cage_.roundCorners) {
            if (places_[v] != kNone) {
                out_.roundCorners.push_back(places_[v]);
            }
        }
    }

    void takeSkin() {
        std::vector<uint32_t> ofPalette(character_.skin.joints.size(), kNone);
        std::vector<uint32_t> joints = part_.joints;
        for (uint32_t j = 0; part_.joints.empty() && j < ofPalette.size(); ++j) {
            joints.push_back(j);
        }
        for (const uint32_t joint : joints) {
            ofPalette[joint] = countOf(out_.joints);
            out_.joints.push_back(character_.skin.joints[joint]);
            const float* bind = &character_.skin.inverseBinds[joint][0][0];
            out_.inverseBinds.insert(out_.inverseBinds.end(), bind, bind + 16);
        }
        out_.starts.push_back(0);
        for (const uint32_t v : vertices_) {
            for (uint32_t i = character_.weights.starts[v]; i < character_.weights.starts[v + 1]; ++i) {
                out_.influenceJoints.push_back(ofPalette[character_.weights.influences[i].joint]);
                out_.influenceWeights.push_back(character_.weights.influences[i].weight);
            }
            out_.starts.push_back(countOf(out_.influenceJoints));
        }
        out_.skin = sizedStruct<SuppleSkinDesc>();
        out_.skin.jointCount = countOf(out_.joints);
        out_.skin.joints = out_.joints.data();
        out_.skin.inverseBinds = out_.inverseBinds.data();
    }

    /// Sparse; a vertex of another part that shares the target is not this one's.
    void takeTargets() {
        for (uint32_t t = part_.firstTarget; t < part_.firstTarget + part_.targetCount; ++t) {
            const cage::MorphTarget& from = character_.morphs.targets[t];
            auto target = sizedStruct<SuppleMorphTargetDesc>();
            target.name = from.name.c_str();
            target.weight = character_.morphs.weights[t];
            out_.targets.push_back(target);
            std::vector<uint32_t>& moved = out_.movedVertices.emplace_back();
            size_t first = 0; // the vertices of one part are a run
            for (size_t i = 0; i < from.vertices.size(); ++i) {
                if (places_[from.vertices[i]] != kNone) {
                    first = moved.empty() ? i : first;
                    moved.push_back(places_[from.vertices[i]]);
                }
            }
            out_.displacements.push_back(
                {countOf(moved), moved.data(), moved.empty() ? nullptr : &from.deltas[first].x});
        }
    }

    void fillCage() {
        SuppleCageDesc& desc = out_.cage = sizedStruct<SuppleCageDesc>();
        desc.vertexCount = countOf(vertices_);
        desc.faceCount = countOf(out_.faceVertexCounts);
        desc.positions = out_.positions.data();
        desc.faceVertexCounts = out_.faceVertexCounts.data();
        desc.faceVertexIndices = out_.faceVertexIndices.data();
        desc.cornerUvs = floatsOf(cage_.cornerUvs, firstCorner_);
        desc.cornerUvs1 = floatsOf(cage_.cornerUvs1, firstCorner_);
        desc.cornerColors = floatsOf(cage_.cornerColors, firstCorner_);
        desc.cornerNormals = floatsOf(cage_.cornerNormals, firstCorner_);
        desc.cornerTangents = floatsOf(cage_.cornerTangents, firstCorner_);
        desc.faceTriangles = cage_.faceTriangles.empty() ? nullptr : out_.faceTriangles.data();
        desc.faceMaterials = cage_.faceMaterials.empty() ? nullptr : &cage_.faceMaterials[part_.firstFace];
        desc.faceTrimTiles = cage_.faceTrimTiles.empty() ? nullptr : &cage_.faceTrimTiles[part_.firstFace];
        desc.creaseCount = countOf(out_.creaseSharpnesses);
        desc.creaseVertices = out_.creaseVertices.data();
        desc.creaseSharpnesses = out_.creaseSharpnesses.data();
        desc.cornerCount = countOf(out_.cornerVertices);
        desc.cornerVertices = out_.cornerVertices.data();
        desc.cornerSharpnesses = out_.cornerSharpnesses.data();
        desc.creaseScalarCount = countOf(out_.creaseScalars);
        desc.creaseScalars = out_.creaseScalars.data();
        desc.holeCount = countOf(out_.holes);
        desc.holes = out_.holes.data();
        desc.roundCornerCount = countOf(out_.roundCorners);
        desc.roundCorners = out_.roundCorners.data();
        desc.creaseSetCount = countOf(out_.creaseSetNames);
        desc.creaseSetNames = out_.creaseSetNames.data();
        desc.creaseSets = out_.creaseSets.data();
    }

    const cage::Character& character_;
    const cage::Cage& cage_;
    const cage::Part& part_;
    const uint32_t endFace_;
    CharacterArrays::Part& out_;
    std::vector<uint32_t> places_;   ///< of the character's vertices in the part, or kNone
    std::vector<uint32_t> vertices_; ///< of the character, by place
    uint32_t firstCorner_ = 0;
};

SuppleKeyInterpolation interpolationOf(cage::Interpolation from) {
    return from == cage::Interpolation::step          ? SUPPLE_KEYS_STEP
           : from == cage::Interpolation::cubicSpline ? SUPPLE_KEYS_CUBICSPLINE
                                                      : SUPPLE_KEYS_LINEAR;
}

} // namespace

CharacterArrays::CharacterArrays(const cage::Character& character) {
    addNodes(character);
    for (size_t p = 0; p < character.parts.size(); ++p) {
        addPart(character, p);
    }
    addClips(character);
    addMaterials(character);
    desc = sizedStruct<SuppleCharacterDesc>();
    desc.nodeCount = countOf(nodes);
    desc.nodes = nodes.data();
    desc.partCount = countOf(parts);
    desc.parts = parts.data();
    desc.clipCount = countOf(clips);
    desc.clips = clips.data();
    desc.materialCount = countOf(materials);
    desc.materials = materials.data();
    desc.materialLayers = layers.empty() ? nullptr : layers.data();
    desc.imageCount = countOf(images);
    desc.images = images.data();
    desc.copyright = character.copyright.c_str();
}

void CharacterArrays::addNodes(const cage::Character& character) {
    for (const cage::Node& node : character.skeleton.nodes) {
        rotations.insert(rotations.end(), {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w});
    }
    for (const cage::Node& node : character.skeleton.nodes) {
        auto to = sizedStruct<SuppleNodeDesc>();
        to.parent = node.parent;
        to.name = node.name.c_str();
        if (node.hasMatrix) {
            to.matrix = &node.matrix[0][0];
        } else {
            to.translation = &node.translation.x;
            to.rotation = &rotations[4 * nodes.size()];
            to.scale = &node.scale.x;
        }
        nodes.push_back(to);
    }
}

void CharacterArrays::addPart(const cage::Character& character, size_t index) {
    const cage::Part& from = character.parts[index];
    Part& arrays = partArrays.emplace_back();
    PartTaker(character, index, arrays).take();
    auto to = sizedStruct<SupplePartDesc>();
    to.node = from.node;
    to.name = from.name.c_str();
    to.cage = &arrays.cage;
    to.skin = &arrays.skin;
    to.influences.starts = arrays.starts.data();
    to.influences.joints = arrays.influenceJoints.data();
    to.influences.weights = arrays.influenceWeights.data();
    to.targetCount = countOf(arrays.targets);
    to.targets = arrays.targets.data();
    to.displacements = arrays.displacements.data();
    to.uvInterpolation =
        from.uvMode ? static_cast<SuppleUvInterpolation>(static_cast<int>(*from.uvMode) + 1) : SUPPLE_UV_FROM_FILE;
    to.madeFor =
        from.madeFor ? static_cast<SuppleMadeFor>(static_cast<int>(*from.madeFor) + 1) : SUPPLE_MADE_FOR_UNKNOWN;
    parts.push_back(to);
}

/// Targets that parts share have one channel in the character; here each of the parts has its own.
void CharacterArrays::addClips(const cage::Character& character) {
    constexpr SuppleChannelPath kPaths[] = {SUPPLE_PATH_TRANSLATION, SUPPLE_PATH_ROTATION, SUPPLE_PATH_SCALE,
                                            SUPPLE_PATH_WEIGHTS};
    for (const cage::Clip& clip : character.clips) {
        Clip& arrays = clipArrays.emplace_back();
        for (const cage::Channel& channel : clip.channels) {
            auto to = sizedStruct<SuppleChannelDesc>();
            to.node = channel.node;
            to.path = kPaths[static_cast<int>(channel.path)];
            to.interpolation = interpolationOf(channel.interpolation);
            to.keyCount = countOf(channel.times);
            to.valueCount = countOf(channel.values);
            to.times = channel.times.data();
            to.values = channel.values.data();
            arrays.channels.push_back(to);
            for (const cage::Part& part : character.parts) {
                if (channel.path == cage::ChannelPath::weights && part.targetCount > 0 &&
                    part.firstTarget == channel.firstTarget && part.node != channel.node) {
                    to.node = part.node;
                    arrays.channels.push_back(to);
                }
            }
        }
        for (const cage::Marker& marker : clip.markers) {
            arrays.markers.push_back({marker.name.c_str(), marker.time});
        }
        for (const cage::SharpnessCurve& curve : clip.sharpness) {
            arrays.curves.push_back({curve.set.c_str(), interpolationOf(curve.keys.interpolation),
                                     countOf(curve.keys.times), curve.keys.times.data(), curve.keys.values.data()});
        }
        auto to = sizedStruct<SuppleClipDesc>();
        to.sharpnessCurveCount = countOf(arrays.curves);
        to.sharpnessCurves = arrays.curves.data();
        to.name = clip.name.c_str();
        to.channelCount = countOf(arrays.channels);
        to.channels = arrays.channels.data();
        to.markerCount = countOf(arrays.markers);
        to.markers = arrays.markers.data();
        to.duration = clip.duration;
        clips.push_back(to);
    }
}

void CharacterArrays::addMaterials(const cage::Character& character) {
    for (const cage::Material& from : character.materials) {
        auto to = sizedStruct<SuppleMaterialInfo>();
        to.name = from.name.c_str();
        to.alphaMode = static_cast<SuppleAlphaMode>(from.alphaMode);
        to.alphaCutoff = from.alphaCutoff;
        to.doubleSided = from.doubleSided ? 1 : 0;
        to.unlit = from.unlit ? 1 : 0;
        std::copy_n(&from.baseColorFactor.x, 4, to.baseColorFactor);
        std::copy_n(&from.emissiveFactor.x, 3, to.emissiveFactor);
        to.metallicFactor = from.metallicFactor;
        to.roughnessFactor = from.roughnessFactor;
        to.normalScale = from.normalScale;
        to.occlusionStrength = from.occlusionStrength;
        to.emissiveStrength = from.emissiveStrength;
        to.baseColor = textureInfo(from.baseColorTexture);
        to.metallicRoughness = textureInfo(from.metallicRoughnessTexture);
        to.normal = textureInfo(from.normalTexture);
        to.occlusion = textureInfo(from.occlusionTexture);
        to.emissive = textureInfo(from.emissiveTexture);
        if (from.trim) {
            to.trimDomain = from.trim->domain == cage::TrimDomain::face ? SUPPLE_TRIM_FACE : SUPPLE_TRIM_UV;
            to.trimChannel = from.trim->channel;
            to.trimCutoff = from.trim->cutoff;
            to.trimTiles = from.trim->tiles;
            to.trim = textureInfo(from.trim->texture);
        }
        materials.push_back(to);
        layers.push_back(layersOf(from.layers));
    }
    for (const cage::Image& from : character.images) {
        auto to = sizedStruct<SuppleImageInfo>();
        to.name = from.name.c_str();
        to.mimeType = from.mimeType.c_str();
        to.bytes = from.bytes.empty() ? nullptr : from.bytes.data();
        to.byteCount = from.bytes.size();
        images.push_back(to);
    }
}

} // namespace supple::test
