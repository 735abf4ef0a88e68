// Compares characters field by field and bit by bit.
#pragma once

#include "cage/character.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace supple::test {

/// What a comparison is to pass over: what tells of the source instead of the character.
struct Overlooked {
    bool source = false;   ///< polygonSource, weldSource, sourceVertices and the counts of vertices of the source
    bool messages = false; ///< warnings and damages
    bool extras = false;   ///< what arrays do not hand over: all that moves and chooses beside skin, targets and clips
};

/// The names of the fields that differ, with the first place: "clips[2].channels[0].times[7]".
class CharacterDifferences {
public:
    CharacterDifferences(const cage::Character& a, const cage::Character& b, Overlooked overlooked = {})
        : overlooked_(overlooked) {
        compare("name", a.name, b.name);
        compare("copyright", a.copyright, b.copyright);
        compareCages(a.cage, b.cage);
        compareAll("parts", a.parts, b.parts, &CharacterDifferences::compareParts);
        compareAll("skeleton.nodes", a.skeleton.nodes, b.skeleton.nodes, &CharacterDifferences::compareNodes);
        compare("skeleton.parentsFirst", a.skeleton.parentsFirst, b.skeleton.parentsFirst);
        compare("skin.joints", a.skin.joints, b.skin.joints);
        compare("skin.inverseBinds", a.skin.inverseBinds, b.skin.inverseBinds);
        compare("weights.starts", a.weights.starts, b.weights.starts);
        compare("weights.influences", a.weights.influences, b.weights.influences);
        compare("weights.mushMask", a.weights.mushMask, b.weights.mushMask);
        compareAll("morphs.targets", a.morphs.targets, b.morphs.targets, &CharacterDifferences::compareTargets);
        compare("morphs.weights", a.morphs.weights, b.morphs.weights);
        compareAll("clips", a.clips, b.clips, &CharacterDifferences::compareClips);
        compare("clipRoot", a.clipRoot, b.clipRoot);
        compareAll("materials", a.materials, b.materials, &CharacterDifferences::compareMaterials);
        compareAll("images", a.images, b.images, &CharacterDifferences::compareImages);
        if (!overlooked.extras) {
            compareExtras(a, b);
        }
        if (!overlooked.messages) {
            compareAll("warnings", a.warnings, b.warnings, &CharacterDifferences::compareTexts);
            compareAll("damages", a.damages, b.damages, &CharacterDifferences::compareDamages);
        }
        if (!overlooked.source) {
            compare("sourceVertexCount", a.sourceVertexCount, b.sourceVertexCount);
            compare("seamVertexCount", a.seamVertexCount, b.seamVertexCount);
        }
    }
    [[nodiscard]] const std::vector<std::string>& found() const { return found_; }

private:
    void compareCages(const cage::Cage& a, const cage::Cage& b) {
        compare("cage.positions", a.positions, b.positions);
        compare("cage.faceStarts", a.faceStarts, b.faceStarts);
        compare("cage.faceVertices", a.faceVertices, b.faceVertices);
        compare("cage.cornerUvs", a.cornerUvs, b.cornerUvs);
        compare("cage.cornerUvs1", a.cornerUvs1, b.cornerUvs1);
        compare("cage.cornerColors", a.cornerColors, b.cornerColors);
        compare("cage.cornerNormals", a.cornerNormals, b.cornerNormals);
        compare("cage.cornerTangents", a.cornerTangents, b.cornerTangents);
        compare("cage.faceTriangles", a.faceTriangles, b.faceTriangles);
        compare("cage.faceMaterials", a.faceMaterials, b.faceMaterials);
        compare("cage.faceParts", a.faceParts, b.faceParts);
        compare("cage.faceTrimTiles", a.faceTrimTiles, b.faceTrimTiles);
        compare("cage.cornerFaceUvs", a.cornerFaceUvs, b.cornerFaceUvs);
        compare("cage.creases", a.creases, b.creases);
        compareAll("cage.creaseSets", a.creaseSets, b.creaseSets, &CharacterDifferences::compareTexts);
        compare("cage.sharpVertices", a.sharpVertices, b.sharpVertices);
        compare("cage.creaseScalars", a.creaseScalars, b.creaseScalars);
        compare("cage.roundCorners", a.roundCorners, b.roundCorners);
        compare("cage.holes", a.holes, b.holes);
        if (!overlooked_.source) {
            compare("cage.sourceVertices", a.sourceVertices, b.sourceVertices);
        }
    }
    void compareExtras(const cage::Character& a, const cage::Character& b) {
        compare("weights.jiggles", a.weights.jiggles, b.weights.jiggles);
        compare("weights.cloths", a.weights.cloths, b.weights.cloths);
        compare("jiggles", a.jiggles, b.jiggles);
        compareAll("cloths", a.cloths, b.cloths, &CharacterDifferences::compareEqual<cage::Cloth>);
        compareAll("expressions", a.expressions, b.expressions, &CharacterDifferences::compareExpressions);
        compareAll("drivers", a.drivers, b.drivers, &CharacterDifferences::compareEqual<cage::PoseDriver>);
        const cage::SpringBones &ownSprings = a.springBones, &otherSprings = b.springBones;
        compareAll("springBones.springs", ownSprings.springs, otherSprings.springs,
                   &CharacterDifferences::compareSprings);
        check("springBones.colliderGroups", ownSprings.colliderGroups == otherSprings.colliderGroups);
        compareAll("springBones.colliders", ownSprings.colliders, otherSprings.colliders,
                   &CharacterDifferences::compareColliders);
        compareAll("materialVariants", a.materialVariants, b.materialVariants, &CharacterDifferences::compareTexts);
    }
    void compareExpressions(const std::string& at, const cage::Expression& a, const cage::Expression& b) {
        compare(at + ".name", a.name, b.name);
        check(at + ".kind", a.kind == b.kind);
        check(at + ".isBinary", a.isBinary == b.isBinary);
        compare(at + ".targets", a.targets, b.targets);
        compare(at + ".weights", a.weights, b.weights);
        check(at + ".holds", a.holds == b.holds);
    }
    void compareSprings(const std::string& at, const cage::Spring& a, const cage::Spring& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".center", a.center, b.center);
        check(at + ".isTree", a.isTree == b.isTree);
        compare(at + ".joints", a.joints, b.joints);
        compare(at + ".colliderGroups", a.colliderGroups, b.colliderGroups);
    }
    void compareColliders(const std::string& at, const cage::SpringCollider& a, const cage::SpringCollider& b) {
        compare(at + ".node", a.node, b.node);
        check(at + ".shape", a.shape == b.shape);
        check(at + ".inside", a.inside == b.inside);
        compare(at + ".offset", a.offset, b.offset);
        compare(at + ".tail", a.tail, b.tail);
        compare(at + ".radius", a.radius, b.radius);
    }
    void compareParts(const std::string& at, const cage::Part& a, const cage::Part& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".node", a.node, b.node);
        compare(at + ".rigid", a.rigid, b.rigid);
        compare(at + ".joints", a.joints, b.joints);
        compare(at + ".firstFace", a.firstFace, b.firstFace);
        compare(at + ".firstTarget", a.firstTarget, b.firstTarget);
        compare(at + ".targetCount", a.targetCount, b.targetCount);
        check(at + ".uvMode", a.uvMode == b.uvMode);
        check(at + ".skinning", a.skinning == b.skinning);
        check(at + ".smoothing", a.smoothing == b.smoothing);
        check(at + ".madeFor", a.madeFor == b.madeFor);
        if (!overlooked_.source) {
            compare(at + ".polygonSource", a.polygonSource, b.polygonSource);
            compare(at + ".weldSource", a.weldSource, b.weldSource);
        }
    }
    void compareNodes(const std::string& at, const cage::Node& a, const cage::Node& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".parent", a.parent, b.parent);
        compare(at + ".translation", a.translation, b.translation);
        compare(at + ".rotation", a.rotation, b.rotation);
        compare(at + ".scale", a.scale, b.scale);
        compare(at + ".hasMatrix", a.hasMatrix, b.hasMatrix);
        compare(at + ".matrix", a.matrix, b.matrix);
    }
    void compareTargets(const std::string& at, const cage::MorphTarget& a, const cage::MorphTarget& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".vertices", a.vertices, b.vertices);
        compare(at + ".deltas", a.deltas, b.deltas);
    }
    void compareChannels(const std::string& at, const cage::Channel& a, const cage::Channel& b) {
        compare(at + ".node", a.node, b.node);
        compare(at + ".path", a.path, b.path);
        compare(at + ".interpolation", a.interpolation, b.interpolation);
        compare(at + ".times", a.times, b.times);
        compare(at + ".values", a.values, b.values);
        compare(at + ".firstTarget", a.firstTarget, b.firstTarget);
    }
    void compareMarkers(const std::string& at, const cage::Marker& a, const cage::Marker& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".time", a.time, b.time);
    }
    void compareCurves(const std::string& at, const cage::SharpnessCurve& a, const cage::SharpnessCurve& b) {
        compare(at + ".set", a.set, b.set);
        compare(at + ".times", a.keys.times, b.keys.times);
        compare(at + ".values", a.keys.values, b.keys.values);
        check(at + ".interpolation", a.keys.interpolation == b.keys.interpolation);
    }
    void compareClips(const std::string& at, const cage::Clip& a, const cage::Clip& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".duration", a.duration, b.duration);
        compareAll(at + ".channels", a.channels, b.channels, &CharacterDifferences::compareChannels);
        compareAll(at + ".markers", a.markers, b.markers, &CharacterDifferences::compareMarkers);
        compareAll(at + ".sharpness", a.sharpness, b.sharpness, &CharacterDifferences::compareCurves);
        compare(at + ".packed.words", a.packed.words, b.packed.words);
        compare(at + ".packed.coarseWords", a.packed.coarseWords, b.packed.coarseWords);
        compare(at + ".packed.channelCount", a.packed.channelCount, b.packed.channelCount);
    }
    void compareTextures(const std::string& at, const cage::Texture& a, const cage::Texture& b) {
        compare(at + ".image", a.image, b.image);
        compare(at + ".alternateImage", a.alternateImage, b.alternateImage);
        compare(at + ".uvSet", a.uvSet, b.uvSet);
        compare(at + ".wrapU", a.wrapU, b.wrapU);
        compare(at + ".wrapV", a.wrapV, b.wrapV);
        compare(at + ".magFilter", a.magFilter, b.magFilter);
        compare(at + ".minFilter", a.minFilter, b.minFilter);
        compare(at + ".offset", a.offset, b.offset);
        compare(at + ".rotation", a.rotation, b.rotation);
        compare(at + ".scale", a.scale, b.scale);
    }
    void compareMaterials(const std::string& at, const cage::Material& a, const cage::Material& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".baseColorFactor", a.baseColorFactor, b.baseColorFactor);
        compareTextures(at + ".baseColorTexture", a.baseColorTexture, b.baseColorTexture);
        compare(at + ".metallicFactor", a.metallicFactor, b.metallicFactor);
        compare(at + ".roughnessFactor", a.roughnessFactor, b.roughnessFactor);
        compareTextures(at + ".metallicRoughnessTexture", a.metallicRoughnessTexture, b.metallicRoughnessTexture);
        compareTextures(at + ".normalTexture", a.normalTexture, b.normalTexture);
        compare(at + ".normalScale", a.normalScale, b.normalScale);
        compareTextures(at + ".occlusionTexture", a.occlusionTexture, b.occlusionTexture);
        compare(at + ".occlusionStrength", a.occlusionStrength, b.occlusionStrength);
        compareTextures(at + ".emissiveTexture", a.emissiveTexture, b.emissiveTexture);
        compare(at + ".emissiveFactor", a.emissiveFactor, b.emissiveFactor);
        compare(at + ".emissiveStrength", a.emissiveStrength, b.emissiveStrength);
        compare(at + ".unlit", a.unlit, b.unlit);
        compare(at + ".alphaMode", a.alphaMode, b.alphaMode);
        compare(at + ".alphaCutoff", a.alphaCutoff, b.alphaCutoff);
        compare(at + ".doubleSided", a.doubleSided, b.doubleSided);
        check(at + ".layers", a.layers == b.layers);
        check(at + ".trim", a.trim == b.trim);
    }
    void compareImages(const std::string& at, const cage::Image& a, const cage::Image& b) {
        compare(at + ".name", a.name, b.name);
        compare(at + ".mimeType", a.mimeType, b.mimeType);
        check(at + ".bytes", a.bytes == b.bytes);
    }
    template <class T>
    void compareEqual(const std::string& at, const T& a, const T& b) {
        check(at, a == b);
    }
    void compareTexts(const std::string& at, const std::string& a, const std::string& b) { compare(at, a, b); }
    void compareDamages(const std::string& at, const cage::Damage& a, const cage::Damage& b) {
        compare(at + ".found", a.found, b.found);
        compare(at + ".repair", a.repair, b.repair);
    }

    void check(const std::string& at, bool same) {
        if (!same) {
            found_.push_back(at);
        }
    }
    void compare(const std::string& at, const std::string& a, const std::string& b) { check(at, a == b); }
    /// What has no padding: bit by bit, so that -0 and 0 differ.
    template <class T>
    void compare(const std::string& at, const T& a, const T& b) {
        static_assert(std::is_trivially_copyable_v<T>);
        check(at, std::memcmp(&a, &b, sizeof(T)) == 0);
    }
    template <class T>
    void compare(const std::string& at, const std::vector<T>& a, const std::vector<T>& b) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (a.size() != b.size()) {
            found_.push_back(at + ".size()");
            return;
        }
        for (size_t i = 0; i < a.size(); ++i) {
            if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0) {
                found_.push_back(at + "[" + std::to_string(i) + "]");
                return;
            }
        }
    }
    template <class T>
    void compareAll(const std::string& at, const std::vector<T>& a, const std::vector<T>& b,
                    void (CharacterDifferences::*compareOne)(const std::string&, const T&, const T&)) {
        check(at + ".size()", a.size() == b.size());
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
            (this->*compareOne)(at + "[" + std::to_string(i) + "]", a[i], b[i]);
        }
    }

    Overlooked overlooked_;
    std::vector<std::string> found_;
};

} // namespace supple::test
