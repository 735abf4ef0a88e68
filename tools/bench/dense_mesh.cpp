#include "tools/bench/dense_mesh.h"

#include "cage/single_joint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace supple::bench {

namespace {

/// Normals of a vertex that agree to a degree are one: the surface's differ in their last bits from patch to patch.
const float kSameNormal = std::cos(0.0174533f);

using BilinearWeights = std::array<float, 4>;

/// A surface vertex of the 24-byte format.
struct Sample {
    glm::vec3 position, normal;
};

/// The surface of the cage without its skin.
struct Surface {
    std::vector<Sample> samples;
    std::vector<uint32_t> firstSamples; ///< per patch
    std::vector<QuadPatch> patches;
};

Result<Surface> unposedSurface(host::Device& device, Workbench& workbench, const cage::Character& character,
                               SuppleScheme scheme, uint32_t rate) {
    cage::Character still;
    still.name = character.name;
    still.cage = character.cage;
    still.cage.faceParts.clear();
    cage::bindToOneJoint(still, "mesh");
    Result<SuppleAsset> asset = workbench.createAsset(std::move(still));
    if (!asset) {
        return asset.error();
    }
    SuppleGroupDesc desc{};
    desc.asset = *asset;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.vertexFormat = SUPPLE_VERTEX_24;
    const Result<SuppleGroup> group = workbench.createGroup(desc);
    workbench.destroy(*asset);
    if (!group) {
        return group.error();
    }
    Status recorded = success();
    const Status submitted =
        device.submitAndWait([&](VkCommandBuffer commands) { recorded = workbench.recordFrame(*group, commands); });
    const host::GroupOutput output = workbench.output(*group);
    const Result<std::vector<std::byte>> bytes = device.readBuffer(output.streams.vertices);
    Surface surface;
    surface.patches = workbench.quadPatches(*group);
    for (uint32_t r = 0; r < output.grid.drawRangeCount; ++r) {
        const SuppleDrawRange& range = output.grid.drawRanges[r];
        for (uint32_t p = 0; p < range.patchCount; ++p) {
            surface.firstSamples.push_back(range.firstVertex + p * range.samplesPerPatch);
        }
    }
    workbench.destroy(*group);
    if (!recorded || !submitted || !bytes) {
        return !recorded ? recorded.error() : !submitted ? submitted.error() : bytes.error();
    }
    surface.samples.resize(bytes->size() / sizeof(Sample));
    std::memcpy(surface.samples.data(), bytes->data(), surface.samples.size() * sizeof(Sample));
    return surface;
}

class Builder {
public:
    Builder(const cage::Character& source, const Surface& surface, uint32_t rate)
        : source_(source), surface_(surface), rate_(rate) {
        mesh_.character.name = source.name;
        mesh_.character.parts = source.parts;
        mesh_.character.skeleton = source.skeleton;
        mesh_.character.skin = source.skin;
        mesh_.character.clips = source.clips;
        mesh_.character.materials = source.materials;
        mesh_.character.images = source.images;
        for (const cage::MorphTarget& target : source.morphs.targets) {
            mesh_.character.morphs.targets.push_back({target.name, {}, {}});
            std::vector<glm::vec3>& deltas = targets_.emplace_back(source.cage.vertexCount(), glm::vec3(0.0f));
            for (size_t i = 0; i < target.vertices.size(); ++i) {
                deltas[target.vertices[i]] = target.deltas[i];
            }
        }
        mesh_.character.morphs.weights = source.morphs.weights;
        mesh_.character.weights.starts = {0};
        mesh_.character.cage.faceStarts = {0};
    }

    DenseMesh build() {
        std::vector<uint32_t> patchOfFace(source_.cage.faceCount());
        for (uint32_t p = 0; p < surface_.patches.size(); ++p) {
            patchOfFace[surface_.patches[p].face] = p;
        }
        for (const uint32_t patch : patchOfFace) { // parts are runs of faces
            addPatch(patch);
        }
        for (cage::Part& part : mesh_.character.parts) {
            part.firstFace *= 2 * rate_ * rate_;
            part.polygonSource = cage::PolygonSource::triangles;
        }
        mesh_.normalCount = static_cast<uint32_t>(normals_.size());
        mesh_.character.sourceVertexCount = mesh_.character.cage.vertexCount();
        return std::move(mesh_);
    }

private:
    /// What samples of different patches have in common: a cage vertex, or an edge and the place on it.
    using Place = std::array<uint32_t, 3>;

    [[nodiscard]] Place placeOf(uint32_t patch, uint32_t i, uint32_t j) const {
        const std::array<uint32_t, 4>& v = surface_.patches[patch].corners;
        const auto onEdge = [&](uint32_t from, uint32_t to, uint32_t k) -> Place {
            if (k == 0 || k == rate_) {
                const uint32_t vertex = k == 0 ? from : to;
                return {vertex, vertex, 0};
            }
            return from < to ? Place{from, to, k} : Place{to, from, rate_ - k};
        };
        if (j == 0 || j == rate_) {
            return j == 0 ? onEdge(v[0], v[1], i) : onEdge(v[3], v[2], i);
        }
        if (i == 0 || i == rate_) {
            return i == 0 ? onEdge(v[0], v[3], j) : onEdge(v[1], v[2], j);
        }
        return {cage::kNone, patch, j * (rate_ + 1) + i};
    }

    void addPatch(uint32_t patch) {
        const QuadPatch& quad = surface_.patches[patch];
        const uint32_t side = rate_ + 1;
        std::vector<uint32_t> vertices, normals;
        std::vector<BilinearWeights> weights;
        for (uint32_t j = 0; j < side; ++j) {
            for (uint32_t i = 0; i < side; ++i) {
                const float u = static_cast<float>(i) / static_cast<float>(rate_);
                const float v = static_cast<float>(j) / static_cast<float>(rate_);
                weights.push_back({(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
                const uint32_t sample = surface_.firstSamples[patch] + j * side + i;
                const auto [entry, isNew] =
                    known_.try_emplace(placeOf(patch, i, j), mesh_.character.cage.vertexCount());
                if (isNew) {
                    addVertex(sample, quad.corners, weights.back());
                }
                vertices.push_back(entry->second);
                normals.push_back(normalOf(entry->second, surface_.samples[sample].normal));
            }
        }
        const std::array<uint32_t, 4> corners = cageCorners(quad);
        for (uint32_t j = 0; j < rate_; ++j) {
            for (uint32_t i = 0; i < rate_; ++i) {
                const uint32_t at = j * side + i;
                for (const std::array<uint32_t, 3>& triangle :
                     {std::array{at, at + 1, at + side + 1}, std::array{at, at + side + 1, at + side}}) {
                    for (const uint32_t s : triangle) {
                        addCorner(vertices[s], normals[s], corners, weights[s]);
                    }
                    addFace(quad.face);
                }
            }
        }
    }

    void addVertex(uint32_t sample, const std::array<uint32_t, 4>& corners, const BilinearWeights& weights) {
        cage::Character& dense = mesh_.character;
        const uint32_t vertex = dense.cage.vertexCount();
        dense.cage.positions.push_back(surface_.samples[sample].position);
        dense.cage.sourceVertices.push_back(vertex);
        mesh_.surfaceVertices.push_back(sample);
        std::map<uint32_t, float> byJoint;
        for (size_t k = 0; k < corners.size(); ++k) {
            const std::vector<uint32_t>& starts = source_.weights.starts;
            for (uint32_t i = starts[corners[k]]; i < starts[corners[k] + 1]; ++i) {
                byJoint[source_.weights.influences[i].joint] += weights[k] * source_.weights.influences[i].weight;
            }
        }
        std::vector<cage::Influence> influences;
        for (const auto& [joint, weight] : byJoint) {
            influences.push_back({joint, weight});
        }
        std::stable_sort(influences.begin(), influences.end(),
                         [](const cage::Influence& a, const cage::Influence& b) { return a.weight > b.weight; });
        influences.resize(std::min(influences.size(), kDenseInfluences));
        float sum = 0.0f;
        for (const cage::Influence& influence : influences) {
            sum += influence.weight;
        }
        for (const cage::Influence& influence : influences) {
            if (influence.weight > 0.0f) {
                dense.weights.influences.push_back({influence.joint, influence.weight / sum});
            }
        }
        dense.weights.starts.push_back(static_cast<uint32_t>(dense.weights.influences.size()));
        for (size_t t = 0; t < targets_.size(); ++t) {
            glm::vec3 delta(0.0f);
            for (size_t k = 0; k < corners.size(); ++k) {
                delta += weights[k] * targets_[t][corners[k]];
            }
            if (delta != glm::vec3(0.0f)) {
                dense.morphs.targets[t].vertices.push_back(vertex);
                dense.morphs.targets[t].deltas.push_back(delta);
            }
        }
    }

    /// The place in normals_.
    uint32_t normalOf(uint32_t vertex, const glm::vec3& normal) {
        normalsOfVertices_.resize(mesh_.character.cage.vertexCount());
        for (const uint32_t n : normalsOfVertices_[vertex]) {
            if (glm::dot(normals_[n], normal) > kSameNormal) {
                return n;
            }
        }
        normalsOfVertices_[vertex].push_back(static_cast<uint32_t>(normals_.size()));
        normals_.push_back(normal);
        return normalsOfVertices_[vertex].back();
    }

    /// The corners of the cage at the corners of the patch.
    [[nodiscard]] std::array<uint32_t, 4> cageCorners(const QuadPatch& quad) const {
        const uint32_t first = source_.cage.faceStarts[quad.face];
        uint32_t turn = 0;
        while (turn < 3 && source_.cage.faceVertices[first + turn] != quad.corners[0]) {
            ++turn;
        }
        return {first + turn, first + (turn + 1) % 4, first + (turn + 2) % 4, first + (turn + 3) % 4};
    }

    void addCorner(uint32_t vertex, uint32_t normal, const std::array<uint32_t, 4>& corners,
                   const BilinearWeights& weights) {
        cage::Cage& dense = mesh_.character.cage;
        dense.faceVertices.push_back(vertex);
        dense.cornerNormals.push_back(normals_[normal]);
        const auto interpolate = [&](const std::vector<glm::vec2>& from, std::vector<glm::vec2>& to) {
            glm::vec2 uv(0.0f);
            for (size_t k = 0; k < corners.size() && !from.empty(); ++k) {
                uv += weights[k] * from[corners[k]];
            }
            if (!from.empty()) {
                to.push_back(uv);
            }
        };
        interpolate(source_.cage.cornerUvs, dense.cornerUvs);
        interpolate(source_.cage.cornerUvs1, dense.cornerUvs1);
    }

    void addFace(uint32_t cageFace) {
        cage::Cage& dense = mesh_.character.cage;
        dense.faceStarts.push_back(dense.cornerCount());
        if (!source_.cage.faceMaterials.empty()) {
            dense.faceMaterials.push_back(source_.cage.faceMaterials[cageFace]);
        }
        if (!source_.cage.faceParts.empty()) {
            dense.faceParts.push_back(source_.cage.faceParts[cageFace]);
        }
    }

    const cage::Character& source_;
    const Surface& surface_;
    uint32_t rate_;
    DenseMesh mesh_;
    std::vector<std::vector<glm::vec3>> targets_; ///< deltas of all cage vertices
    std::map<Place, uint32_t> known_;
    std::vector<glm::vec3> normals_;
    std::vector<std::vector<uint32_t>> normalsOfVertices_;
};

} // namespace

uint64_t DenseMesh::fileBytes() const {
    constexpr uint64_t kVector = 12, kUv = 8, kSkin = 8;
    const cage::Cage& cage = character.cage;
    const uint64_t uvSets = (cage.cornerUvs.empty() ? 0 : 1) + (cage.cornerUvs1.empty() ? 0 : 1);
    const uint64_t index = normalCount < 65536 ? 2 : 4;
    uint64_t moved = 0;
    for (const cage::MorphTarget& target : character.morphs.targets) {
        moved += target.vertices.size();
    }
    return normalCount * (2 * kVector + uvSets * kUv + kSkin) + cage.cornerCount() * index + moved * (kVector + index);
}

Result<DenseMesh> makeDenseMesh(host::Device& device, Workbench& workbench, const cage::Character& character,
                                SuppleScheme scheme, uint32_t rate) {
    const Result<Surface> surface = unposedSurface(device, workbench, character, scheme, rate);
    if (!surface) {
        return surface.error();
    }
    if (surface->patches.size() != character.cage.faceCount()) {
        return Error{ErrorCode::asset, character.name + ": a dense mesh is made of cages of quads without holes only"};
    }
    return Builder(character, *surface, rate).build();
}

} // namespace supple::bench
