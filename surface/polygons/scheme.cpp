#include "cage/features.h"
#include "cage/tangents.h"
#include "cage/triangulation.h"
#include "shaders/shared/polygons.h"
#include "surface/build.h"
#include "surface/polygons/frames.h"
#include "surface/polygons/kernels.h"
#include "surface/table_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace supple::surface::polygons {

namespace {

constexpr uint32_t kMostShortSides = 4;

/// The triangles that are drawn, in device order: by material, then as the cage has them.
std::vector<DraftPatch> draftTriangles(const cage::Cage& cage) {
    const std::vector<uint32_t> corners = cage::triangulate(cage);
    std::vector<DraftPatch> patches;
    patches.reserve(corners.size() / 3);
    auto hole = cage.holes.begin();
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        if (hole != cage.holes.end() && *hole == face) {
            ++hole;
            continue;
        }
        const size_t first = size_t{3} * (cage.faceStarts[face] - size_t{2} * face);
        for (size_t t = first; t < first + size_t{3} * (cage.sides(face) - 2); t += 3) {
            DraftPatch& patch = patches.emplace_back();
            patch.facet = patch.info.face = face;
            patch.info.patchClass = PatchClass::triangle;
            patch.info.cornerCount = 3;
            patch.info.part = cage.faceParts.empty() ? 0 : cage.faceParts[face];
            patch.info.material = cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[face];
            for (size_t k = 0; k < 3; ++k) {
                patch.cageCorners[k] = corners[t + k];
                patch.info.corners[k] = cage.faceVertices[corners[t + k]];
            }
        }
    }
    std::stable_sort(patches.begin(), patches.end(), [](const DraftPatch& a, const DraftPatch& b) {
        return std::tie(a.info.material, a.info.part) < std::tie(b.info.material, b.info.part);
    });
    return patches;
}

/// What tells surface vertices apart.
struct Vertex {
    uint32_t frame = 0;
    std::array<uint32_t, 3> normal{}; ///< its coordinates in the frame, as bits
    CornerWords attributes{};
    uint32_t direction = 0; ///< with tangents: the word of docs/tangents.md

    bool operator==(const Vertex&) const = default;
};

/// Numbers surface vertices in the order in which triangles come to them.
class VertexNumbers {
public:
    explicit VertexNumbers(size_t frames) : last_(frames, cage::kNone) {}

    uint32_t of(const Vertex& vertex) {
        uint32_t number = last_[vertex.frame];
        for (uint32_t tries = 0; number != cage::kNone && tries < kTries; ++tries, number = before_[number]) {
            if (vertices[number] == vertex) {
                return number;
            }
        }
        before_.push_back(last_[vertex.frame]);
        vertices.push_back(vertex);
        return last_[vertex.frame] = static_cast<uint32_t>(vertices.size() - 1);
    }

    std::vector<Vertex> vertices;

private:
    static constexpr uint32_t kTries = 8; ///< a frame of many thousand corners may not cost their square
    std::vector<uint32_t> last_;          ///< by frame
    std::vector<uint32_t> before_;        ///< of the same frame
};

/// Two axes across a unit normal: Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017). The device has
/// the same (shaders/polygons/vertex.comp).
std::array<glm::dvec3, 2> axesAcross(const glm::dvec3& n) {
    const double s = n.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + n.z), b = n.x * n.y * a;
    return {glm::dvec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), glm::dvec3(b, s + n.y * n.y * a, -n.y)};
}

/// Where a tangent points, in a frame in which the vertex has a normal.
uint32_t directionWord(const glm::dmat3& axes, const glm::dvec3& normal, const glm::vec4& tangent) {
    const glm::dvec3 own = glm::transpose(axes) * glm::dvec3(tangent);
    const std::array<glm::dvec3, 2> basis = axesAcross(normal);
    glm::dvec2 d(glm::dot(own, basis[0]), glm::dot(own, basis[1]));
    const double longest = std::max(std::abs(d.x), std::abs(d.y));
    d = longest > 0.0 ? d / longest : glm::dvec2(1.0, 0.0);
    const auto x = static_cast<int32_t>(std::lround(d.x * 32767.0)),
               y = static_cast<int32_t>(std::lround(d.y * 16383.0));
    return (static_cast<uint32_t>(x) & 0xFFFFu) | (static_cast<uint32_t>(y) & 0x7FFFu) << 16 |
           (tangent.w < 0.0f ? shared::kNegativeFrame : 0);
}

class Builder {
public:
    /// Corners that differ in attributes or tangents are different vertices, if the recipe has these.
    Builder(const cage::Cage& cage, Frames frames, const Recipe& recipe)
        : cage_(cage), frames_(std::move(frames)), attributes_(recipe.attributes),
          tangents_(recipe.tangents && recipe.attributes), mapFrames_(recipe.mapFrames), writer_(tables_.words) {}

    Tables build() {
        tables_.rate = 1;
        tables_.frames = cage_.faceCount();
        tables_.poolStride = poolStrideFor(firstElement(frames_.frames.size()));
        writeFaces();
        writeFrames();
        writeVertices(draftTriangles(cage_));
        return std::move(tables_);
    }

private:
    /// In the pool.
    [[nodiscard]] uint32_t firstElement(size_t frame) const {
        return static_cast<uint32_t>(cage_.faceCount() + shared::kFrameElements * frame);
    }
    [[nodiscard]] const uint32_t* verticesOf(uint32_t face) const {
        return cage_.faceVertices.data() + cage_.faceStarts[face];
    }

    /// Short faces first: their areas lie in the pool in the order of their records, those of others where these say.
    void writeFaces() {
        std::vector<uint32_t> longFaces;
        faceNumbers_.resize(cage_.faceCount());
        uint32_t number = 0;
        Construction shortFaces{Stage::vertex, kFaceKernels[0], {writer_.element(), 0}, 0};
        for (uint32_t face = 0; face < cage_.faceCount(); ++face) {
            const uint32_t sides = cage_.sides(face);
            if (sides > kMostShortSides) {
                longFaces.push_back(face);
                continue;
            }
            const uint32_t* v = verticesOf(face);
            faceNumbers_[face] = number++;
            if (sides == 3) {
                writer_.put({v[0], v[1], v[0], v[2]});
            } else {
                writer_.put({v[0], v[2], v[1], v[3]});
            }
        }
        shortFaces.section.count = shortFaces.coefficients = number;
        tables_.constructions.push_back(shortFaces);

        std::vector<uint32_t> firstWords;
        for (const uint32_t face : longFaces) {
            firstWords.push_back(static_cast<uint32_t>(tables_.words.size()));
            writer_.put(std::span(verticesOf(face), cage_.sides(face)));
        }
        const auto count = static_cast<uint32_t>(longFaces.size());
        tables_.constructions.push_back({Stage::vertex, kFaceKernels[1], {writer_.element(), count}, count});
        for (size_t i = 0; i < longFaces.size(); ++i) {
            faceNumbers_[longFaces[i]] = number++;
            writer_.put({firstWords[i], cage_.sides(longFaces[i]), faceNumbers_[longFaces[i]], 0});
        }
    }

    void writeFrames() {
        const uint32_t firstWord = 4 * writer_.element();
        for (const uint32_t face : frames_.faces) {
            writer_.put({faceNumbers_[face]});
        }
        const auto count = static_cast<uint32_t>(frames_.frames.size());
        tables_.constructions.push_back(
            {Stage::assemble, kFrameKernel, {writer_.element(), count}, shared::kFrameElements * count});
        for (const Frame& frame : frames_.frames) {
            writer_.put({frame.vertex, frame.toward, firstWord + frame.firstFace, frame.faceCount});
        }
    }

    [[nodiscard]] bool hasNormal(uint32_t corner) const {
        return !cage_.cornerNormals.empty() && cage_.cornerNormals[corner] != glm::vec3(0.0f);
    }

    [[nodiscard]] Vertex vertexOf(uint32_t corner, const glm::vec4* tangent) const {
        Vertex vertex{frames_.cornerFrames[corner], {}, attributes_ ? cornerWords(cage_, corner) : CornerWords{}};
        const glm::dmat3& axes = frames_.frames[vertex.frame].axes;
        glm::dvec3 normal(0.0, 0.0, 1.0);
        if (hasNormal(corner)) {
            normal = glm::transpose(axes) * glm::dvec3(cage_.cornerNormals[corner]);
        }
        for (int k = 0; k < 3; ++k) {
            vertex.normal[static_cast<size_t>(k)] = floatBits(normal[k]);
        }
        if (tangent != nullptr) {
            vertex.direction = directionWord(axes, normal, *tangent);
        }
        return vertex;
    }

    /// Of the corners of the triangles that are drawn, in their order.
    [[nodiscard]] std::vector<glm::vec4> tangentsOf(const std::vector<DraftPatch>& patches) const {
        std::vector<uint32_t> corners;
        for (const DraftPatch& patch : patches) {
            corners.insert(corners.end(), patch.cageCorners.begin(), patch.cageCorners.begin() + 3);
        }
        std::vector<glm::vec3> normals;
        for (uint32_t corner = 0; corner < cage_.cornerCount(); ++corner) {
            normals.push_back(hasNormal(corner) ? cage_.cornerNormals[corner]
                                                : glm::vec3(frames_.frames[frames_.cornerFrames[corner]].axes[2]));
        }
        return cage::triangleTangents(cage_, corners, normals, cage::mapUvs(cage_, mapFrames_));
    }

    void writeDirections(const std::vector<Vertex>& vertices) {
        tables_.triangles.directions = 4 * writer_.element();
        for (const Vertex& vertex : vertices) {
            writer_.put({vertex.direction});
        }
    }

    void writeVertices(const std::vector<DraftPatch>& patches) {
        VertexNumbers numbers(frames_.frames.size());
        const std::vector<glm::vec4> tangents = tangents_ ? tangentsOf(patches) : std::vector<glm::vec4>();
        for (size_t p = 0; p < patches.size(); ++p) {
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec4* tangent = tangents_ ? &tangents[3 * p + k] : nullptr;
                tables_.triangles.indices.push_back(numbers.of(vertexOf(patches[p].cageCorners[k], tangent)));
            }
        }
        tables_.triangles.vertices = {writer_.element(), static_cast<uint32_t>(numbers.vertices.size())};
        for (const Vertex& vertex : numbers.vertices) {
            writer_.put({firstElement(vertex.frame), vertex.normal[0], vertex.normal[1], vertex.normal[2]});
        }
        if (tangents_) {
            writeDirections(numbers.vertices);
        }
        tables_.attributes = writer_.element();
        const uint32_t words = noteAttributes(cage_, tables_);
        for (const Vertex& vertex : numbers.vertices) {
            writer_.put(std::span(vertex.attributes).first(attributes_ ? words : 0));
        }
        listPatches(patches, tables_);
    }

    const cage::Cage& cage_;
    const Frames frames_;
    const bool attributes_, tangents_;
    const std::span<const cage::MapFrame> mapFrames_;
    std::vector<uint32_t> faceNumbers_; ///< per face: its place in the pool
    Tables tables_;
    TableWriter writer_;
};

} // namespace

Result<Tables> build(const Recipe& recipe, const cage::Cage& cage, PatchEdges* /*edges*/) {
    // Every corner may have a frame, and a record with attributes.
    if (cage.cornerCount() > std::numeric_limits<uint32_t>::max() / 32) {
        return Error{ErrorCode::limit, std::to_string(cage.cornerCount()) + " corners: polygons takes " +
                                           std::to_string(std::numeric_limits<uint32_t>::max() / 32)};
    }
    Result<Tables> tables = Builder(cage, makeFrames(cage), recipe).build();
    if (tables) {
        tables->notes = cage::notesOnAlphas(cage);
    }
    return tables;
}

} // namespace supple::surface::polygons
