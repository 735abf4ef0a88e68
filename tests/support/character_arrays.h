// A cage::Character in the shape the public interface takes: as a host would hand it over that has an importer.
#pragma once

#include "cage/character.h"

#include <deque>
#include <supple/supple.h>
#include <vector>

namespace supple::test {

/// `desc` points into the character and into this object; both must outlive its use. The parts of the character must
/// not be sewn together: they have vertices of their own.
struct CharacterArrays {
    explicit CharacterArrays(const cage::Character& character);
    CharacterArrays(const CharacterArrays&) = delete;
    CharacterArrays& operator=(const CharacterArrays&) = delete;

    /// What one part has. Lists whose addresses are taken are not resized afterwards.
    struct Part {
        std::vector<float> positions;
        std::vector<uint32_t> faceVertexCounts, faceVertexIndices, faceTriangles;
        std::vector<uint32_t> creaseVertices, cornerVertices, roundCorners, holes;
        std::vector<float> creaseSharpnesses, cornerSharpnesses;
        std::vector<SuppleCreaseScalar> creaseScalars;
        std::vector<const char*> creaseSetNames;
        std::vector<uint32_t> creaseSets;
        std::vector<uint32_t> joints, starts, influenceJoints;
        std::vector<float> inverseBinds, influenceWeights;
        std::vector<SuppleMorphTargetDesc> targets;
        std::vector<SuppleDisplacements> displacements;
        std::deque<std::vector<uint32_t>> movedVertices;
        SuppleCageDesc cage{};
        SuppleSkinDesc skin{};
    };
    struct Clip {
        std::vector<SuppleChannelDesc> channels;
        std::vector<SuppleMarkerDesc> markers;
        std::vector<SuppleSharpnessCurveDesc> curves;
    };

    std::vector<SuppleNodeDesc> nodes;
    std::vector<float> rotations; ///< four per node
    std::deque<Part> partArrays;
    std::vector<SupplePartDesc> parts;
    std::deque<Clip> clipArrays;
    std::vector<SuppleClipDesc> clips;
    std::vector<SuppleMaterialInfo> materials;
    std::vector<SuppleMaterialLayers> layers;
    std::vector<SuppleImageInfo> images;
    SuppleCharacterDesc desc{};

private:
    void addNodes(const cage::Character& character);
    void addPart(const cage::Character& character, size_t index);
    void addClips(const cage::Character& character);
    void addMaterials(const cage::Character& character);
};

} // namespace supple::test
