#include "tools/supple/baked_mesh.h"

#include "cage/corner_normals.h"
#include "cage/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace supple::tools {
namespace {

bool isFinite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The sum of the area vectors of the faces round each vertex takes the place of a normal that vanishes.
void mendNormals(BakedMesh& mesh) {
    const auto vanishes = [](const BakedVertex& vertex) { return vertex.normal == glm::vec3(0.0f); };
    if (std::none_of(mesh.vertices.begin(), mesh.vertices.end(), vanishes)) {
        return;
    }
    std::vector<glm::dvec3> areas(mesh.vertices.size(), glm::dvec3(0.0));
    for (size_t face = 0; face < mesh.faces.faceCount(); ++face) {
        const std::span corners =
            std::span(mesh.faces.vertices)
                .subspan(mesh.faces.starts[face], mesh.faces.starts[face + 1] - mesh.faces.starts[face]);
        const auto position = [&](size_t corner) { return glm::dvec3(mesh.vertices[corners[corner]].position); };
        glm::dvec3 area(0.0);
        for (size_t corner = 1; corner + 1 < corners.size(); ++corner) {
            area += glm::cross(position(corner) - position(0), position(corner + 1) - position(0));
        }
        for (const uint32_t vertex : corners) {
            areas[vertex] += area;
        }
    }
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (vanishes(mesh.vertices[v])) {
            const glm::vec3 normal = cage::unitNormal(areas[v]);
            mesh.vertices[v].normal = normal == glm::vec3(0.0f) ? glm::vec3(0.0f, 1.0f, 0.0f) : normal;
        }
    }
}

/// Gathers faces by part and material.
class MeshGatherer {
public:
    explicit MeshGatherer(const cage::Character& character) : character_(character) {}

    struct Mesh {
        BakedMesh baked;
        VertexPool pool;
    };
    [[nodiscard]] Mesh& of(uint32_t part, uint32_t material);
    [[nodiscard]] uint32_t addVertex(Mesh& mesh, BakedVertex vertex);
    /// `corners`: vertices of the mesh.
    static void addFace(Mesh& mesh, std::vector<uint32_t>& corners);
    [[nodiscard]] Result<std::vector<BakedMesh>> take() &&;

private:
    const cage::Character& character_;
    std::map<std::pair<uint32_t, size_t>, Mesh> meshes_; ///< by part, then as materials came first
    std::map<std::pair<uint32_t, uint32_t>, size_t> order_;
    uint32_t notFinite_ = cage::kNone; ///< part
};

MeshGatherer::Mesh& MeshGatherer::of(uint32_t part, uint32_t material) {
    const size_t place = order_.try_emplace({part, material}, order_.size()).first->second;
    Mesh& mesh = meshes_[{part, place}];
    mesh.baked.part = part;
    mesh.baked.material = material;
    return mesh;
}

uint32_t MeshGatherer::addVertex(Mesh& mesh, BakedVertex vertex) {
    if (!isFinite(vertex.position)) {
        notFinite_ = mesh.baked.part;
    }
    vertex.normal = cage::unitNormal(glm::dvec3(vertex.normal));
    return mesh.pool.add(vertex);
}

void MeshGatherer::addFace(Mesh& mesh, std::vector<uint32_t>& corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) {
        corners.pop_back();
    }
    std::vector<uint32_t> sorted(corners);
    std::sort(sorted.begin(), sorted.end());
    if (corners.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        return;
    }
    cage::Polygons& faces = mesh.baked.faces;
    faces.vertices.insert(faces.vertices.end(), corners.begin(), corners.end());
    faces.close();
}

Result<std::vector<BakedMesh>> MeshGatherer::take() && {
    if (notFinite_ != cage::kNone) {
        return Error{ErrorCode::asset, character_.name + ": part " + std::to_string(notFinite_) + " " +
                                           character_.parts[notFinite_].name + ": a position is not finite"};
    }
    std::vector<BakedMesh> meshes;
    for (auto& [key, mesh] : meshes_) {
        if (mesh.baked.faces.faceCount() > 0) {
            mesh.baked.vertices = std::move(mesh.pool).take();
            mendNormals(mesh.baked);
            meshes.push_back(std::move(mesh.baked));
        }
    }
    return meshes;
}

/// Takes a surface apart, vertex by vertex.
class SurfaceReader {
public:
    SurfaceReader(const EvaluatedSurface& surface, const cage::Character& character, const BakedContent& content)
        : surface_(surface), streams_(surface.output.streams), content_(content),
          uvs_(!surface.attributes.empty() && !character.cage.cornerUvs.empty()),
          colors_(!surface.attributes.empty() && !character.cage.cornerColors.empty()) {}

    void read(MeshGatherer& gatherer) const {
        const SuppleGridOutput& grid = surface_.output.grid;
        for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
            readRange(range, gatherer);
        }
    }

private:
    void readRange(const SuppleDrawRange& range, MeshGatherer& gatherer) const {
        MeshGatherer::Mesh& mesh = gatherer.of(range.part, range.material);
        mesh.baked.uvs[0] = uvs_;
        mesh.baked.uvs[1] = content_.uvs1 && !surface_.uvs1.empty();
        mesh.baked.colors = colors_;
        mesh.baked.tangents = !surface_.tangents.empty();
        const cage::Polygons faces = gridFaces(surface_, range, content_.polygons);
        std::array<std::vector<uint32_t>, 2> numbers; // by whether the pose mirrors the face: normals differ
        std::vector<uint32_t> corners;
        for (uint64_t patch = 0; patch < range.patchCount; ++patch) {
            const uint64_t first = range.firstVertex + patch * range.samplesPerPatch;
            for (std::vector<uint32_t>& own : numbers) {
                own.assign(range.samplesPerPatch, cage::kNone);
            }
            for (size_t face = 0; face < faces.faceCount(); ++face) {
                const bool mirrored = surface_.isMirrored(range, patch, face);
                corners.clear();
                for (uint32_t corner = faces.starts[face]; corner < faces.starts[face + 1]; ++corner) {
                    const uint32_t sample = faces.vertices[corner];
                    uint32_t& number = numbers[mirrored ? 1 : 0][sample];
                    if (number == cage::kNone) {
                        number = gatherer.addVertex(mesh, vertex(mesh.baked, first + sample, mirrored));
                    }
                    corners.push_back(number);
                }
                if (mirrored) {
                    turnRound(corners);
                }
                MeshGatherer::addFace(mesh, corners);
            }
        }
    }

    /// `mirrored`: normal and tangent of a face that the pose mirrors, as it is seen from outside.
    [[nodiscard]] BakedVertex vertex(const BakedMesh& mesh, uint64_t index, bool mirrored) const {
        constexpr uint32_t kTangentSign = 0x80000000u;
        BakedVertex vertex;
        vertex.position = element<glm::vec3>(surface_.vertices, streams_.vertices, index);
        vertex.normal = element<glm::vec3>(surface_.vertices, streams_.vertices, index, sizeof(glm::vec3));
        vertex.normal = mirrored ? -vertex.normal : vertex.normal;
        if (mesh.uvs[0]) {
            vertex.uvs[0] = element<glm::vec2>(surface_.attributes, streams_.attributes, index);
        }
        if (mesh.uvs[1]) {
            vertex.uvs[1] = element<glm::vec2>(surface_.uvs1, streams_.uvs1, index);
        }
        if (mesh.colors) {
            const auto color = element<glm::uvec2>(surface_.attributes, streams_.attributes, index, sizeof(glm::vec2));
            vertex.color[0] = color.x;
            vertex.color[1] = color.y;
        }
        if (mesh.tangents) {
            vertex.tangent =
                element<uint32_t>(surface_.tangents, streams_.tangents, index) ^ (mirrored ? kTangentSign : 0);
        }
        return vertex;
    }

    const EvaluatedSurface& surface_;
    const SuppleVertexStreams& streams_;
    const BakedContent& content_;
    bool uvs_, colors_;
};

/// Of a cage that `evaluate` has deformed.
std::vector<glm::vec3> deformedPositions(const Evaluation& baked, const cage::Cage& cage) {
    std::vector<glm::vec3> positions;
    for (uint32_t v = 0; v < cage.vertexCount(); ++v) {
        positions.push_back(element<glm::vec3>(baked.deformedCage, baked.surfaces.front().output.info.deformedCage, v));
    }
    return positions;
}

uint32_t unorm16Pair(float low, float high) {
    const auto unorm = [](float value) {
        return static_cast<uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 65535.0f));
    };
    return unorm(low) | unorm(high) << 16;
}

/// As suppleDecodeTangent of shaders/supple_surface.glsl.
glm::vec4 decodedTangent(uint32_t word) {
    const double x = static_cast<int16_t>(word & 0xFFFFu) / 32767.0;
    const double y = (static_cast<int32_t>(word << 1) >> 17) / 16383.0;
    glm::dvec3 tangent(x, y, 1.0 - std::abs(x) - std::abs(y));
    if (tangent.z < 0.0) {
        tangent.x = (1.0 - std::abs(y)) * (x >= 0.0 ? 1.0 : -1.0);
        tangent.y = (1.0 - std::abs(x)) * (y >= 0.0 ? 1.0 : -1.0);
    }
    return {glm::normalize(tangent), (word & 0x80000000u) != 0 ? -1.0f : 1.0f};
}

cage::StillFaces stillFaces(BakedMesh mesh) {
    cage::StillFaces faces;
    faces.material = mesh.material;
    for (const BakedVertex& vertex : mesh.vertices) {
        faces.positions.push_back(vertex.position);
        faces.normals.push_back(vertex.normal);
        if (mesh.tangents) {
            faces.tangents.push_back(decodedTangent(vertex.tangent));
        }
        for (size_t set = 0; set < 2; ++set) {
            if (mesh.uvs[set]) {
                faces.uvs[set].push_back(vertex.uvs[set]);
            }
        }
        if (mesh.colors) {
            faces.colors.push_back(bakedColor(vertex));
        }
    }
    faces.triangles = std::move(mesh.faces.vertices);
    return faces;
}

} // namespace

cage::Polygons gridFaces(const EvaluatedSurface& surface, const SuppleDrawRange& range, bool quads) {
    cage::Polygons faces;
    if (quads && range.domain == SUPPLE_DOMAIN_QUAD) {
        const uint32_t rate = surface.output.grid.rate, row = rate + 1;
        for (uint32_t v = 0; v < rate; ++v) {
            for (uint32_t u = 0; u < rate; ++u) {
                const uint32_t first = v * row + u;
                faces.vertices.insert(faces.vertices.end(), {first, first + 1, first + row + 1, first + row});
                faces.close();
            }
        }
        return faces;
    }
    const size_t bytes = surface.output.indices().stride;
    for (size_t i = range.firstIndex; i < size_t{range.firstIndex} + range.indexCount; ++i) {
        uint32_t sample = 0; // the low half, if indices have 16 bits
        std::memcpy(&sample, surface.gridIndices.data() + i * bytes, bytes);
        faces.vertices.push_back(sample);
        if (faces.vertices.size() % 3 == 0) {
            faces.close();
        }
    }
    return faces;
}

void turnRound(std::span<uint32_t> corners) {
    std::reverse(corners.begin() + 1, corners.end());
}

std::array<uint16_t, 4> bakedColor(const BakedVertex& vertex) {
    const auto half = [&](size_t word, uint32_t shift) { return static_cast<uint16_t>(vertex.color[word] >> shift); };
    return {half(0, 0), half(0, 16), half(1, 0), half(1, 16)};
}

Result<std::vector<BakedMesh>> bakedSurfaces(const Evaluation& baked, const cage::Character& character,
                                             const BakedContent& content) {
    MeshGatherer gatherer(character);
    for (const EvaluatedSurface& surface : baked.surfaces) {
        SurfaceReader(surface, character, content).read(gatherer);
    }
    return std::move(gatherer).take();
}

Result<std::vector<BakedMesh>> bakedCage(const Evaluation& baked, const cage::Character& character,
                                         const BakedContent& content) {
    const cage::Cage& cage = character.cage;
    const std::vector<glm::vec3> positions = deformedPositions(baked, cage);
    const std::vector<glm::vec3> normals =
        positions == cage.positions ? cage::cornerNormals(cage) : cage::deformedCornerNormals(cage, positions);
    const std::vector<uint32_t> triangles = content.polygons ? std::vector<uint32_t>{} : cage::triangulate(cage);
    MeshGatherer gatherer(character);
    const auto addFace = [&](MeshGatherer::Mesh& mesh, bool mirrored, auto&& cornerOf, uint32_t count) {
        std::vector<uint32_t> vertices;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t corner = cornerOf(i);
            BakedVertex vertex;
            vertex.cageVertex = cage.faceVertices[corner];
            vertex.position = positions[vertex.cageVertex];
            vertex.normal = mirrored ? -normals[corner] : normals[corner];
            vertex.uvs[0] = mesh.baked.uvs[0] ? cage.cornerUvs[corner] : glm::vec2(0.0f);
            vertex.uvs[1] = mesh.baked.uvs[1] ? cage.cornerUvs1[corner] : glm::vec2(0.0f);
            if (mesh.baked.colors) {
                const glm::vec4& color = cage.cornerColors[corner];
                vertex.color[0] = unorm16Pair(color.r, color.g);
                vertex.color[1] = unorm16Pair(color.b, color.a);
            }
            vertices.push_back(gatherer.addVertex(mesh, vertex));
        }
        if (mirrored) {
            turnRound(vertices);
        }
        MeshGatherer::addFace(mesh, vertices);
    };
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const uint32_t first = cage.faceStarts[face], sides = cage.sides(face);
        MeshGatherer::Mesh& mesh = gatherer.of(cage.faceParts.empty() ? 0 : cage.faceParts[face],
                                               cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[face]);
        mesh.baked.uvs[0] = !cage.cornerUvs.empty();
        mesh.baked.uvs[1] = content.uvs1 && !cage.cornerUvs1.empty();
        mesh.baked.colors = !cage.cornerColors.empty();
        const bool mirrored = baked.mirroredFaces[face] != 0;
        if (content.polygons) {
            addFace(
                mesh, mirrored, [&](uint32_t i) { return first + i; }, sides);
            continue;
        }
        const size_t firstTriangle = size_t{first} - size_t{2} * face;
        for (size_t triangle = firstTriangle; triangle < firstTriangle + sides - 2; ++triangle) {
            addFace(
                mesh, mirrored, [&](uint32_t i) { return triangles[3 * triangle + i]; }, 3);
        }
    }
    return std::move(gatherer).take();
}

std::vector<cage::StillMesh> stillMeshes(std::vector<BakedMesh> meshes, const cage::Character& character) {
    std::vector<cage::StillMesh> written;
    uint32_t part = cage::kNone;
    for (BakedMesh& mesh : meshes) {
        if (mesh.part != part) {
            part = mesh.part;
            written.emplace_back().name = character.parts[part].name;
        }
        written.back().faces.push_back(stillFaces(std::move(mesh)));
    }
    return written;
}

} // namespace supple::tools
