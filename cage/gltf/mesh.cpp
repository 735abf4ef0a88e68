#include "cage/gltf/mesh.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/cage_extension.h"
#include "cage/gltf/deformers.h"
#include "cage/gltf/extras_creases.h"
#include "cage/gltf/manifold.h"
#include "cage/gltf/morphs.h"
#include "cage/gltf/normals.h"
#include "cage/gltf/polygons.h"
#include "cage/gltf/skin.h"
#include "cage/gltf/soft.h"
#include "cage/gltf/triangles.h"
#include "cage/gltf/trim.h"
#include "cage/limits.h"
#include "cage/refusal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace supple::cage::gltf {
namespace {

using file::Model;
using file::Primitive;

// Accessors may be shared; see kMaxVertices.
constexpr uint64_t kMaxAttributeFloats = 1u << 27;

// What a cage takes while it is made, beside its attributes: measured, and rounded up.
constexpr uint64_t kVertexBytes = 128;
constexpr uint64_t kCornerBytes = 160;

std::string nameOfNoTriangles(const file::Mesh& mesh) {
    const auto any = [&](int first, int last) {
        return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                           [&](const Primitive& p) { return !p.broken && p.mode >= first && p.mode <= last; });
    };
    const bool points = any(file::kPoints, file::kPoints);
    const bool lines = any(file::kLines, file::kLineStrip);
    return std::string("nothing but ") +
           (points && lines ? "points and lines"
            : points        ? "points"
                            : "lines") +
           ": no primitive of TRIANGLES, so there is no surface";
}

/// Why nothing is drawn of any primitive of a mesh; empty if a warning says it.
std::string whyNothingIsDrawn(const file::Mesh& mesh, const std::string& element) {
    if (mesh.primitives.empty()) {
        return "";
    }
    for (size_t k = 0; k < mesh.primitives.size(); ++k) {
        const Primitive& primitive = mesh.primitives[k];
        if (primitive.broken) {
            return ""; // a warning says so
        }
        if (hasTriangles(primitive.mode)) {
            return element + " " + at("primitive", k) + ": no POSITION";
        }
    }
    return element + ": " + nameOfNoTriangles(mesh);
}

class MeshReader {
public:
    MeshReader(const Document& document, const MeshBinding& binding, std::span<const Material> materials,
               Warnings& warnings)
        : document_(document), model_(document.model), binding_(binding), materials_(materials), warnings_(warnings) {}

    std::optional<Mesh> read(std::string& whyEmpty) && {
        const auto meshIndex = static_cast<size_t>(model_.nodes[binding_.node].mesh);
        const auto& mesh = model_.meshes[meshIndex];
        out_.element = at("mesh", meshIndex);
        out_.number = static_cast<uint32_t>(meshIndex);
        const std::vector<size_t> numbers = findDrawn(mesh);
        if (out_.primitives.empty()) {
            whyEmpty = whyNothingIsDrawn(mesh, out_.element);
            return std::nullopt;
        }
        findCageNumbers(mesh, numbers);
        soft_ = SoftReader(document_, meshIndex);
        const SmoothingFields smoothing = readSmoothing(document_, meshIndex);
        out_.smoothing = smoothing.numbers;
        mask_ = smoothing.mask;
        positionAccessors_.assign(numbers.size(), -1);
        std::vector<uint8_t> isRead(numbers.size(), 0);
        for (size_t i = 0; i < numbers.size(); ++i) {
            isRead[i] =
                document_.leniency->leaveOut([&] { readPrimitive(mesh.primitives[numbers[i]], out_.primitives[i]); });
        }
        keepRead(isRead);
        if (isNumberingLeftOut_) {
            leaveOutNumbers();
        }
        if (out_.primitives.empty()) {
            return std::nullopt;
        }
        if (out_.cageNumbers.empty()) {
            document_.leniency->leaveOut(
                [&] { out_.merges = readManifold(document_, meshIndex, out_, positionAccessors_, warnings_); });
        }
        document_.leniency->leaveOut(
            [&] { out_.skinning = readSkinningMode(document_.meshes[meshIndex], out_.element); });
        SoftReader::Lists soft = std::move(soft_).finish(document_);
        out_.jiggles = std::move(soft.jiggles);
        out_.cloths = std::move(soft.cloths);
        out_.painted.jiggles = std::move(soft.jiggleWeights);
        out_.painted.cloths = std::move(soft.clothWeights);
        document_.leniency->leaveOut([&] {
            if (!mask_.empty() && !isMaskThere_) {
                refuse(out_.element + " " + kDeformers + " smoothing mask", "no primitive has " + cage::quoted(mask_));
            }
        });
        readExtrasCreases(document_.meshes[meshIndex], isCounted_, out_, warnings_);
        out_.weights.report(out_.element + " WEIGHTS", warnings_);
        return std::move(out_);
    }

private:
    /// Accessors of position, cage numbers, joints, weights, morph targets, what is painted and the mask: what makes a
    /// vertex.
    using Stream = std::tuple<int, int, std::vector<int>, std::vector<int>, std::vector<int>, std::vector<int>, int>;

    /// Makes an entry of each primitive that has triangles. Returns their numbers.
    std::vector<size_t> findDrawn(const file::Mesh& mesh) {
        std::vector<size_t> numbers;
        for (size_t k = 0; k < mesh.primitives.size(); ++k) {
            const Primitive& from = mesh.primitives[k];
            const std::string element = out_.element + " " + at("primitive", k);
            if (from.broken) {
                isCounted_ = false;
                continue; // a warning says so
            }
            if (isDrawn(from)) {
                out_.primitives.emplace_back().element = element;
                out_.primitives.back().number = static_cast<uint32_t>(k);
                addExtension(from, out_.primitives.back());
                numbers.push_back(k);
                continue;
            }
            const bool polygons = hasExtension(from.json, "EXT_mesh_polygon");
            const std::string reason =
                hasTriangles(from.mode)
                    ? "no POSITION"
                    : std::string(modeName(from.mode)) + " instead of TRIANGLES" +
                          (polygons ? ", with EXT_mesh_polygon in a form of the draft that is not understood" : "");
            if (polygons && isRequired(document_, "EXT_mesh_polygon")) {
                document_.leniency->gather([&] { refuse(element, reason); });
                continue;
            }
            warn(warnings_, element, reason + "; left out");
        }
        return numbers;
    }

    /// A malformed SUPPLE_mesh_cage is left out alone: the triangles are taken.
    void addExtension(const Primitive& from, split::Primitive& primitive) {
        std::optional<CageExtension>& extension = extensions_.emplace_back();
        const bool isRead = document_.leniency->leaveOut([&] {
            if (from.isReordered && hasExtension(from.json, "SUPPLE_mesh_cage")) {
                refuse(primitive.element + " SUPPLE_mesh_cage",
                       "it counts vertices, and Draco has reordered them; let it encode the mesh sequentially");
            }
            extension = findCageExtension(document_, from.json, primitive.element, warnings_);
        });
        isExtensionLeftOut_.push_back(isRead ? 0 : 1);
        if (extension) {
            primitive.roundCorners = extension->roundCorners;
            primitive.uvMode = extension->uvMode;
            primitive.madeFor = extension->madeFor;
        }
    }

    /// Takes the primitives out that could not be read. Vertices that they have read are unused.
    void keepRead(std::span<const uint8_t> isRead) {
        size_t kept = 0;
        for (size_t i = 0; i < isRead.size(); ++i) {
            if (isRead[i] == 0) {
                isCounted_ = isCounted_ && out_.primitives[i].vertexCount > 0;
                continue;
            }
            if (kept != i) {
                out_.primitives[kept] = std::move(out_.primitives[i]);
                positionAccessors_[kept] = positionAccessors_[i];
            }
            ++kept;
        }
        out_.primitives.resize(kept);
        positionAccessors_.resize(kept);
    }

    /// Which accessors number the cage's vertices: all primitives' or none.
    void findCageNumbers(const file::Mesh& mesh, const std::vector<size_t>& numbers) {
        const auto find = [&](WeldSource source, auto accessorOf) {
            cageNumbers_.clear();
            out_.numberSource = source;
            for (size_t i = 0; i < out_.primitives.size(); ++i) {
                cageNumbers_.push_back(accessorOf(i));
            }
            return static_cast<size_t>(std::count(cageNumbers_.begin(), cageNumbers_.end(), -1));
        };
        size_t missing = find(WeldSource::cageExtension,
                              [&](size_t i) { return extensions_[i] ? extensions_[i]->cageVertices : -1; });
        if (missing == 0) {
            return;
        }
        if (missing < out_.primitives.size()) {
            const auto first = std::find(cageNumbers_.begin(), cageNumbers_.end(), -1) - cageNumbers_.begin();
            isNumberingLeftOut_ = !document_.leniency->leaveOut([&] {
                refuse(out_.primitives[static_cast<size_t>(first)].element,
                       "no cageVertices of SUPPLE_mesh_cage, which other primitives of the mesh have");
            });
            cageNumbers_.assign(out_.primitives.size(), -1);
            return;
        }
        missing = find(WeldSource::vertexAttribute, [&](size_t i) {
            const auto& attributes = mesh.primitives[numbers[i]].attributes;
            const auto found = attributes.find("_CAGE_VERTEX");
            return found == attributes.end() ? -1 : found->second;
        });
        if (missing > 0) {
            if (missing < out_.primitives.size()) {
                warn(warnings_, out_.element, "_CAGE_VERTEX is not on all primitives; not used");
            }
            cageNumbers_.assign(out_.primitives.size(), -1);
        }
    }

    /// Takes the numbers of cage vertices out, and what names vertices by them.
    void leaveOutNumbers() {
        out_.cageNumbers.clear();
        for (split::Primitive& primitive : out_.primitives) {
            if (out_.numberSource == WeldSource::cageExtension) {
                primitive.creases.reset();
                primitive.creaseSets.clear();
                primitive.corners.reset();
                primitive.scalars.reset();
            }
        }
    }

    void readPrimitive(const Primitive& from, split::Primitive& primitive) {
        const std::string& element = primitive.element;
        primitive.material = from.material;

        const auto position = from.attributes.find("POSITION");

        // Primitives over the same accessors share their vertices.
        SkinSets sets;
        if (binding_.skinned) {
            sets = findSkinSets(document_, from, element);
        }
        const std::vector<int> targets = morphReader_.targetsOf(document_, from, element);
        const auto number = static_cast<size_t>(&primitive - out_.primitives.data());
        const int cageNumbers = cageNumbers_[number];
        const std::optional<CageExtension>& extension = extensions_[number];
        const int mask = paintedAccessor(from, mask_);
        isMaskThere_ = isMaskThere_ || mask >= 0;
        const Stream stream{position->second,        cageNumbers, sets.joints, sets.weights, targets,
                            soft_.accessorsOf(from), mask};
        const auto known = streams_.find(stream);
        primitive.firstVertex = known != streams_.end() ? known->second : static_cast<uint32_t>(out_.positions.size());
        const size_t count = accessorCount(document_, position->second);
        takeCorners(from, extension, element, count);
        if (known == streams_.end()) {
            document_.memory->take(count, kVertexBytes, element);
            readVertices(stream, sets, count, element);
            streams_.emplace(stream, primitive.firstVertex);
        }
        positionAccessors_[number] = position->second;
        primitive.vertexCount = static_cast<uint32_t>(count);

        primitive.triangles = readTriangles(document_, from, primitive.vertexCount, element);
        // Draco begins triangles anywhere, so fans that it did not know would look like others.
        if (isExtensionLeftOut_[number] == 0 && !from.isReordered) {
            document_.leniency->leaveOut([&] {
                primitive.faces = readPolygons(document_, from.json, from.mode, extension, primitive.triangles,
                                               primitive.vertexCount, element, warnings_);
            });
        }
        for (std::vector<uint32_t>* vertices : {&primitive.triangles, &primitive.faces.polygons.vertices}) {
            for (uint32_t& vertex : *vertices) {
                vertex += primitive.firstVertex;
            }
        }
        cornerCount_ += primitive.triangles.size() + primitive.faces.polygons.vertices.size();
        if (cornerCount_ > kMaxCorners) {
            refuse(element, "more than " + std::to_string(kMaxCorners) + " corners", ErrorCode::limit);
        }
        readCornerAttributes(from, element, primitive);
        document_.leniency->gather([&] { readTrimTiles(document_, from, materials_, primitive); });
        if (extension) {
            readSharpness(*extension, primitive);
        }
    }

    /// A list that cannot be read is left out alone.
    void readSharpness(const CageExtension& extension, split::Primitive& primitive) const {
        Leniency& leniency = *document_.leniency;
        if (extension.creaseIndices >= 0 &&
            leniency.leaveOut([&] { primitive.creases = readCreaseList(document_, extension); })) {
            leniency.leaveOut([&] { primitive.creaseSets = readCreaseSets(document_, extension); });
        }
        if (extension.creaseScalarIndices >= 0) {
            leniency.leaveOut([&] { primitive.scalars = readScalarList(document_, extension); });
        }
        if (extension.cornerIndices >= 0) {
            leniency.leaveOut([&] { primitive.corners = readCornerList(document_, extension); });
        }
    }

    /// Triangles and polygons; strips and fans have three corners an index.
    void takeCorners(const Primitive& from, const std::optional<CageExtension>& extension, const std::string& element,
                     size_t vertexCount) {
        uint64_t corners = from.indices < 0 ? vertexCount : accessorCount(document_, from.indices);
        corners *= from.mode == file::kTriangles ? 1 : 3;
        if (extension && extension->faceVertexIndices >= 0) {
            corners += accessorCount(document_, extension->faceVertexIndices);
        }
        document_.memory->take(corners, kCornerBytes, element);
    }

    /// Blender's exporter has no integer attributes: its numbers are floats.
    std::vector<uint32_t> readCageNumbers(int accessor, size_t count, const std::string& element) {
        const bool ofExtension = out_.numberSource == WeldSource::cageExtension;
        const std::string name = element + (ofExtension ? " SUPPLE_mesh_cage cageVertices" : " _CAGE_VERTEX");
        checkVertexCount(document_, accessor, count, name);
        const bool isFloat = model_.accessors[static_cast<size_t>(accessor)].componentType == file::kFloat;
        if (ofExtension || !isFloat) {
            return readIntegers(document_, accessor, file::kScalar, kU8 | kU16 | kU32, name);
        }
        const auto values = readFloats(document_, accessor, file::kScalar, kFloat, name);
        std::vector<uint32_t> numbers;
        for (size_t v = 0; v < values.size(); ++v) {
            // Beyond 2^24 not every number is a float; written so that a NaN is refused too.
            if (!(values[v] >= 0.0f && values[v] <= 16777216.0f) || std::floor(values[v]) != values[v]) {
                refuse(item(name, v), "not a number of a vertex");
            }
            numbers.push_back(static_cast<uint32_t>(values[v]));
        }
        return numbers;
    }

    std::vector<glm::vec3> readPositions(int accessor, size_t count, const std::string& element) {
        if (out_.positions.size() + count > kMaxVertices) {
            refuse(element, "more than " + std::to_string(kMaxVertices) + " vertices", ErrorCode::limit);
        }
        const auto values = readFloats(document_, accessor, file::kVec3, kFloat, element + " POSITION", kQuantized);
        out_.gridStep = std::max(out_.gridStep, integerStep(document_, accessor));
        std::vector<glm::vec3> positions;
        positions.reserve(count);
        for (size_t v = 0; v < count; ++v) {
            if (const char* fault = faultOfCoordinates(&values[3 * v], 3)) {
                refuse(item(element + " POSITION", v), fault);
            }
            positions.emplace_back(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
        }
        return positions;
    }

    /// All of the vertices or, if it throws, none.
    void readVertices(const Stream& stream, const SkinSets& sets, size_t count, const std::string& element) {
        const auto& [position, cageNumbers, joints, weights, targets, painted, mask] = stream;
        const std::vector<glm::vec3> positions = readPositions(position, count, element);
        const Displacements displacements = morphReader_.read(document_, targets, count, element);
        std::vector<uint32_t> numbers;
        if (cageNumbers >= 0 && !document_.leniency->leaveOut([&, accessor = cageNumbers] {
                numbers = readCageNumbers(accessor, count, element);
            })) {
            isNumberingLeftOut_ = true; // some vertices have no number
        }
        if (sets.joints.empty()) {
            const size_t joint = binding_.hasFollower ? binding_.skinJoints() : 0;
            out_.weights.appendUnskinned(count, static_cast<uint32_t>(joint));
        } else {
            appendWeights(document_, sets, count, binding_.skinJoints(), element, out_.weights);
        }
        soft_.append(document_, painted, out_.positions.size(), count, element);
        appendMushMask(document_, mask, out_.positions.size(), count, element + " " + mask_, out_.painted.mushMask);
        out_.positions.insert(out_.positions.end(), positions.begin(), positions.end());
        out_.morphs.append(count, displacements);
        out_.cageNumbers.insert(out_.cageNumbers.end(), numbers.begin(), numbers.end());
    }

    void countAttributeFloats(size_t count, const std::string& name) {
        attributeFloats_ += count;
        if (attributeFloats_ > kMaxAttributeFloats) {
            refuse(name,
                   "the primitives' attributes hold more than " + std::to_string(kMaxAttributeFloats) + " numbers",
                   ErrorCode::limit);
        }
    }

    /// A texture, a color or a normal that cannot be read is left out: it does not shape anything.
    void readCornerAttributes(const Primitive& from, const std::string& element, split::Primitive& primitive) {
        constexpr uint32_t kCore = kFloat | kNormalizedU8 | kNormalizedU16;
        Leniency& leniency = *document_.leniency;
        leniency.leaveOut(
            [&] { primitive.uvs = readAttribute(from, "TEXCOORD_0", file::kVec2, kCore, kQuantized, primitive); });
        leniency.leaveOut(
            [&] { primitive.uvs1 = readAttribute(from, "TEXCOORD_1", file::kVec2, kCore, kQuantized, primitive); });
        leniency.leaveOut(
            [&] { primitive.normals = readNormals(document_, from, primitive.vertexCount, element, warnings_); });
        countAttributeFloats(3 * primitive.normals.size(), element + " NORMAL");
        leniency.leaveOut(
            [&] { primitive.tangents = readTangents(document_, from, primitive.vertexCount, element, warnings_); });
        countAttributeFloats(4 * primitive.tangents.size(), element + " TANGENT");
        if (from.attributes.count("TEXCOORD_2") != 0) {
            warn(warnings_, element, "only TEXCOORD_0 and TEXCOORD_1 are read");
        }
        leniency.leaveOut([&] { readColors(from, primitive); });
    }

    void readColors(const Primitive& from, split::Primitive& primitive) {
        constexpr uint32_t kCore = kFloat | kNormalizedU8 | kNormalizedU16;
        const auto color = from.attributes.find("COLOR_0");
        if (color == from.attributes.end()) {
            return;
        }
        if (model_.accessors[static_cast<size_t>(color->second)].type != file::kVec3) {
            primitive.colors = readAttribute(from, "COLOR_0", file::kVec4, kCore, 0, primitive);
            return;
        }
        const auto rgb = readAttribute(from, "COLOR_0", file::kVec3, kCore, 0, primitive);
        primitive.colors.resize(rgb.size() / 3 * 4, 1.0f);
        for (size_t i = 0; i < rgb.size(); ++i) {
            primitive.colors[i / 3 * 4 + i % 3] = rgb[i];
        }
    }

    /// What is not finite becomes 0: it spoils a texture, not the shape.
    std::vector<float> readAttribute(const Primitive& from, const char* attribute, int type, uint32_t allowed,
                                     uint32_t quantized, const split::Primitive& primitive) {
        const auto found = from.attributes.find(attribute);
        if (found == from.attributes.end()) {
            return {};
        }
        const std::string name = primitive.element + " " + attribute;
        std::vector<float> values = readFloats(document_, found->second, type, allowed, name, quantized);
        checkVertexCount(document_, found->second, primitive.vertexCount, name);
        countAttributeFloats(values.size(), name);
        size_t repaired = 0;
        for (float& value : values) {
            if (!std::isfinite(value)) {
                value = 0.0f;
                ++repaired;
            }
        }
        if (repaired > 0) {
            warn(warnings_, name, counted(repaired, "value is", "values are") + " not finite; 0 instead");
        }
        return values;
    }

    const Document& document_;
    const Model& model_;
    const MeshBinding& binding_;
    const std::span<const Material> materials_;
    Warnings& warnings_;

    Mesh out_;
    std::vector<std::optional<CageExtension>> extensions_; ///< by primitive
    std::vector<uint8_t> isExtensionLeftOut_;              ///< by primitive
    std::vector<int> positionAccessors_;                   ///< by primitive
    MorphReader morphReader_;
    SoftReader soft_;
    std::string mask_;                   ///< the attribute with the mask of delta mush; empty: there is none
    bool isMaskThere_ = false;           ///< a primitive has it
    std::vector<int> cageNumbers_;       ///< per primitive: the accessor that numbers its cage vertices, or -1
    bool isNumberingLeftOut_ = false;    ///< vertices that have no number are among those that should
    bool isCounted_ = true;              ///< no primitive that is drawn, or may be, was left out with its vertices
    std::map<Stream, uint32_t> streams_; ///< -> first vertex
    uint64_t cornerCount_ = 0;
    uint64_t attributeFloats_ = 0;
};

} // namespace

bool followsNode(const Document& document, uint32_t meshNode) {
    const file::Node& node = document.model.nodes[meshNode];
    const auto& primitives = document.model.meshes[static_cast<size_t>(node.mesh)].primitives;
    return node.skin >= 0 && std::any_of(primitives.begin(), primitives.end(), [](const Primitive& primitive) {
               return isDrawn(primitive) && !hasSkinSets(primitive);
           });
}

std::optional<Mesh> readMesh(const Document& document, const MeshBinding& binding, std::span<const Material> materials,
                             std::string& whyEmpty, Warnings& warnings) {
    return MeshReader(document, binding, materials, warnings).read(whyEmpty);
}

} // namespace supple::cage::gltf
