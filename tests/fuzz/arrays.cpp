// Any numbers in a host's arrays: a character, or refused with a message; then what is built of it without a device.
#include "runtime/arrays/character_arrays.h"
#include "runtime/prepared.h"
#include "tests/fuzz/target.h"

#include <deque>
#include <limits>
#include <string>
#include <supple/supple.hpp>
#include <vector>

namespace {

using namespace supple;

/// Numbers out of the input, zeros behind its end.
class Source {
public:
    Source(const uint8_t* data, size_t size) : data_(data), size_(size) {}

    uint32_t byte() { return at_ < size_ ? data_[at_++] : 0; }
    bool flag() { return byte() % 4 == 1; }
    /// Mostly below `count`.
    uint32_t index(uint32_t count) {
        const uint32_t value = byte();
        return value < 250 && count > 0 ? value % count : value == 255 ? 0xFFFFFFFFu : count;
    }
    float number() {
        const uint32_t value = byte();
        return value == 255   ? std::numeric_limits<float>::quiet_NaN()
               : value == 254 ? 2e9f
                              : (static_cast<float>(value) - 64.0f) / 16.0f;
    }
    const float* numbers(size_t count) {
        std::vector<float>& list = floats_.emplace_back(count + 1);
        for (float& value : list) {
            value = number();
        }
        return list.data();
    }
    const uint32_t* indices(size_t count, uint32_t below) {
        std::vector<uint32_t>& list = integers_.emplace_back(count + 1);
        for (uint32_t& value : list) {
            value = index(below);
        }
        return list.data();
    }
    /// How many sides faces have, and how many corners that makes.
    const uint32_t* sides(uint32_t faceCount, uint32_t& corners) {
        std::vector<uint32_t>& list = integers_.emplace_back(faceCount + size_t{1}, 0);
        corners = 0;
        for (uint32_t f = 0; f < faceCount; ++f) {
            corners += list[f] = byte() % 7;
        }
        return list.data();
    }
    const float* optionalNumbers(size_t count) { return flag() ? numbers(count) : nullptr; }
    const uint32_t* optionalIndices(size_t count, uint32_t below) { return flag() ? indices(count, below) : nullptr; }

private:
    const uint8_t* data_;
    size_t size_, at_ = 0;
    std::deque<std::vector<float>> floats_;
    std::deque<std::vector<uint32_t>> integers_;
};

/// A character of a few small parts.
struct Arrays {
    Source in;
    std::vector<SuppleNodeDesc> nodes;
    std::deque<SuppleCageDesc> cages;
    std::deque<SuppleSkinDesc> skins;
    std::deque<SuppleCreaseScalar> scalars;
    std::deque<std::vector<SuppleMorphTargetDesc>> targets;
    std::deque<std::vector<SuppleDisplacements>> displacements;
    std::deque<std::vector<SupplePrimitiveDesc>> primitives;
    std::vector<SupplePartDesc> parts;
    std::vector<SuppleChannelDesc> channels;
    SuppleClipDesc clip = sized<SuppleClipDesc>();
    std::vector<SuppleMaterialInfo> materials;
    SuppleCharacterDesc desc = sized<SuppleCharacterDesc>();

    Arrays(const uint8_t* data, size_t size) : in(data, size) {
        const uint32_t nodeCount = 1 + in.byte() % 4;
        for (uint32_t n = 0; n < nodeCount; ++n) {
            auto node = sized<SuppleNodeDesc>();
            node.parent = n == 0 || in.flag() ? SUPPLE_NO_NODE : in.index(n);
            node.translation = in.optionalNumbers(3);
            node.rotation = in.optionalNumbers(4);
            node.scale = in.optionalNumbers(3);
            nodes.push_back(node);
        }
        materials.assign(in.byte() % 3, defaultMaterial());
        const uint32_t partCount = 1 + in.byte() % 3;
        for (uint32_t p = 0; p < partCount; ++p) {
            addPart(p % nodeCount, nodeCount);
        }
        addClip(nodeCount);
        desc.nodeCount = nodeCount;
        desc.nodes = nodes.data();
        desc.materialCount = static_cast<uint32_t>(materials.size());
        desc.materials = materials.data();
        desc.partCount = partCount;
        desc.parts = parts.data();
        desc.clipCount = 1;
        desc.clips = &clip;
    }

    void addPart(uint32_t node, uint32_t nodeCount) {
        auto part = sized<SupplePartDesc>();
        part.node = in.flag() ? in.index(nodeCount) : node;
        if (in.flag()) {
            auto& skin = skins.emplace_back(sized<SuppleSkinDesc>());
            skin.jointCount = 1 + in.byte() % 3;
            skin.joints = in.indices(skin.jointCount, nodeCount);
            skin.inverseBinds = in.optionalNumbers(size_t{16} * skin.jointCount);
            part.skin = &skin;
        }
        auto& own = targets.emplace_back(in.byte() % 3, sized<SuppleMorphTargetDesc>());
        part.targetCount = static_cast<uint32_t>(own.size());
        part.targets = own.data();
        part.uvInterpolation = static_cast<SuppleUvInterpolation>(in.byte() % 7);
        if (in.flag()) {
            addPrimitives(part);
        } else {
            addCage(part);
        }
        parts.push_back(part);
    }

    SuppleInfluences influences(const SupplePartDesc& part, uint32_t vertexCount) {
        if (part.skin == nullptr) {
            return {};
        }
        const uint32_t per = 1 + in.byte() % 3;
        return {nullptr, per, in.indices(size_t{per} * vertexCount, part.skin->jointCount),
                in.numbers(size_t{per} * vertexCount)};
    }

    const SuppleDisplacements* displacementsOf(const SupplePartDesc& part, uint32_t vertexCount) {
        auto& list = displacements.emplace_back();
        for (uint32_t t = 0; t < part.targetCount; ++t) {
            const uint32_t count = in.byte() % 4;
            const bool sparse = in.flag();
            list.push_back({count, sparse ? in.indices(count, vertexCount) : nullptr,
                            in.optionalNumbers(size_t{3} * (sparse ? count : vertexCount))});
        }
        return list.data();
    }

    void addCage(SupplePartDesc& part) {
        auto& cage = cages.emplace_back(sized<SuppleCageDesc>());
        uint32_t corners = 0;
        cage.vertexCount = in.byte() % 16;
        cage.faceCount = in.byte() % 12;
        cage.positions = in.numbers(size_t{3} * cage.vertexCount);
        cage.faceVertexCounts = in.sides(cage.faceCount, corners);
        cage.faceVertexIndices = in.indices(corners, cage.vertexCount);
        cage.cornerUvs = in.optionalNumbers(size_t{2} * corners);
        cage.cornerNormals = in.optionalNumbers(size_t{3} * corners);
        cage.cornerTangents = in.optionalNumbers(size_t{4} * corners);
        cage.cornerColors = in.optionalNumbers(size_t{4} * corners);
        cage.faceMaterials = in.optionalIndices(cage.faceCount, static_cast<uint32_t>(materials.size()));
        cage.faceTrimTiles = in.optionalIndices(cage.faceCount, 4);
        cage.faceTriangles = in.optionalIndices(size_t{3} * corners, corners);
        cage.creaseCount = in.byte() % 3;
        cage.creaseVertices = in.indices(size_t{2} * cage.creaseCount, cage.vertexCount);
        cage.creaseSharpnesses = in.numbers(cage.creaseCount);
        cage.cornerCount = in.byte() % 2;
        cage.cornerVertices = in.indices(cage.cornerCount, cage.vertexCount);
        cage.cornerSharpnesses = in.numbers(cage.cornerCount);
        cage.holeCount = in.byte() % 2;
        cage.holes = in.indices(cage.holeCount, cage.faceCount);
        cage.roundCornerCount = in.byte() % 2;
        cage.roundCorners = in.indices(cage.roundCornerCount, cage.vertexCount);
        static const char* const kSets[] = {"a", "b", ""};
        cage.creaseSetCount = in.byte() % 4;
        cage.creaseSetNames = kSets;
        cage.creaseSets = in.optionalIndices(cage.creaseCount, cage.creaseSetCount);
        cage.creaseScalarCount = in.byte() % 2;
        auto& scalar = scalars.emplace_back();
        scalar = {in.index(cage.vertexCount), in.index(cage.vertexCount), static_cast<float>(in.byte()) / 128.0f};
        cage.creaseScalars = &scalar;
        part.cage = &cage;
        part.influences = influences(part, cage.vertexCount);
        part.displacements = displacementsOf(part, cage.vertexCount);
    }

    void addPrimitives(SupplePartDesc& part) {
        auto& list = primitives.emplace_back();
        part.primitiveCount = 1 + in.byte() % 2;
        for (uint32_t p = 0; p < part.primitiveCount; ++p) {
            auto primitive = sized<SupplePrimitiveDesc>();
            uint32_t corners = 0;
            primitive.vertexCount = in.byte() % 16;
            primitive.positions = in.numbers(size_t{3} * primitive.vertexCount);
            primitive.influences = influences(part, primitive.vertexCount);
            primitive.displacements = displacementsOf(part, primitive.vertexCount);
            primitive.uvs = in.optionalNumbers(size_t{2} * primitive.vertexCount);
            primitive.normals = in.optionalNumbers(size_t{3} * primitive.vertexCount);
            primitive.tangents = in.optionalNumbers(size_t{4} * primitive.vertexCount);
            primitive.trimTiles = in.optionalIndices(primitive.vertexCount, 4);
            primitive.material = in.flag() ? in.index(static_cast<uint32_t>(materials.size())) : SUPPLE_NO_MATERIAL;
            primitive.triangleCount = in.byte() % 12;
            primitive.triangles = in.indices(size_t{3} * primitive.triangleCount, primitive.vertexCount);
            primitive.polygons = static_cast<SupplePrimitivePolygons>(in.byte() % 4);
            primitive.faceCount = in.byte() % 6;
            primitive.faceVertexCounts = in.sides(primitive.faceCount, corners);
            primitive.faceVertexIndices = in.indices(corners, primitive.vertexCount);
            static const std::vector<uint8_t> kHidden{0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1,
                                                      1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1};
            primitive.hiddenEdges = kHidden.data();
            primitive.cageVertices = in.optionalIndices(primitive.vertexCount, primitive.vertexCount);
            primitive.creaseCount = in.byte() % 2;
            primitive.creaseVertices = in.indices(size_t{2} * primitive.creaseCount, primitive.vertexCount);
            primitive.creaseSharpnesses = in.numbers(primitive.creaseCount);
            primitive.creaseScalarCount = in.byte() % 2;
            auto& scalar = scalars.emplace_back();
            scalar = {in.index(primitive.vertexCount), in.index(primitive.vertexCount), 0.25f};
            primitive.creaseScalars = &scalar;
            static const char* const kSet[] = {"a"};
            primitive.creaseSetCount = in.byte() % 2;
            primitive.creaseSetNames = kSet;
            primitive.creaseSets = in.optionalIndices(primitive.creaseCount, primitive.creaseSetCount);
            list.push_back(primitive);
        }
        part.primitives = list.data();
        part.roundCorners = in.byte() % 2;
    }

    void addClip(uint32_t nodeCount) {
        const uint32_t count = in.byte() % 4;
        for (uint32_t c = 0; c < count; ++c) {
            auto channel = sized<SuppleChannelDesc>();
            channel.node = in.index(nodeCount);
            channel.path = static_cast<SuppleChannelPath>(in.byte() % 4);
            channel.interpolation = static_cast<SuppleKeyInterpolation>(in.byte() % 3);
            channel.keyCount = in.byte() % 4;
            const uint32_t width = channel.path == SUPPLE_PATH_ROTATION ? 4 : 3;
            channel.valueCount = channel.keyCount * width * (channel.interpolation == SUPPLE_KEYS_CUBICSPLINE ? 3 : 1);
            channel.times = in.numbers(channel.keyCount);
            channel.values = in.numbers(channel.valueCount);
            channels.push_back(channel);
        }
        clip.channelCount = count;
        clip.channels = channels.data();
    }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const Arrays arrays(data, size);
    const cage::FinishOptions options{size % 2 == 0, static_cast<cage::NormalCreases>(size % 3), size % 5 == 0};
    const Result<cage::Character> character = runtime::characterFromArrays(
        arrays.desc, "fuzz", options, size % 7 == 0 ? cage::Pairing::always : cage::Pairing::whereClean);
    if (!character) {
        fuzz::demand(character.error().message.starts_with("fuzz: "), "a refusal without the name");
        return 0;
    }
    fuzz::demand(character->cage.faceCount() > 0 && character->parts.size() == arrays.parts.size(), "no surface");
    const std::shared_ptr<runtime::Prepared> prepared = runtime::Prepared::of(*character);
    const surface::SchemeId schemes[] = {surface::SchemeId::catmullClark, surface::SchemeId::polygons};
    for (const surface::SchemeId scheme : schemes) {
        surface::Recipe recipe;
        recipe.scheme = scheme;
        recipe.rate = surface::schemeOf(scheme).tableRate(2, false);
        const auto tables = prepared->build(recipe, nullptr);
        fuzz::demand(tables.ok() || !tables.error().message.empty(), "a refusal without a reason");
    }
    return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    (void)seed;
    return LLVMFuzzerMutate(data, size, most);
}
