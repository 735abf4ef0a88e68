#include "host/figure.h"

#include "host/shaders/draw.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace supple::host {

namespace {

constexpr size_t kCornerWords = sizeof(shared::CageCorner) / sizeof(uint32_t);

/// The corner after `corner` round its face.
uint32_t nextCorner(const CageMesh& cage, uint32_t face, uint32_t corner) {
    return corner + 1 < cage.faceStarts[face + 1] ? corner + 1 : cage.faceStarts[face];
}

uint32_t partOf(const CageMesh& cage, uint32_t face) {
    return cage.parts.empty() ? 0 : cage.parts[face];
}

/// A part and the ends of an edge.
using PartEdge = std::array<uint32_t, 3>;

/// Each edge once, part by part.
std::vector<PartEdge> edgesOf(const CageMesh& cage) {
    std::vector<PartEdge> edges;
    edges.reserve(cage.corners.size());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const auto [from, to] = std::minmax(cage.corners[corner], cage.corners[nextCorner(cage, face, corner)]);
            edges.push_back({partOf(cage, face), from, to});
        }
    }
    const auto ends = [](const PartEdge& edge) { return std::pair(edge[1], edge[2]); };
    std::sort(edges.begin(), edges.end(), [&](const PartEdge& a, const PartEdge& b) {
        return std::pair(ends(a), a[0]) < std::pair(ends(b), b[0]);
    });
    const auto same = [&](const PartEdge& a, const PartEdge& b) { return ends(a) == ends(b); };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    std::stable_sort(edges.begin(), edges.end(), [](const PartEdge& a, const PartEdge& b) { return a[0] < b[0]; });
    return edges;
}

uint32_t materialOf(const CageMesh& cage, uint32_t face) {
    return cage.materials.empty() ? SUPPLE_NO_MATERIAL : cage.materials[face];
}

} // namespace

Result<std::unique_ptr<Figure>> Figure::create(Context& context, SuppleAsset asset, CageMesh cage,
                                               const std::string& path) {
    std::unique_ptr<Figure> figure(new Figure(context));
    figure->asset_ = asset;
    figure->cage_ = std::move(cage);
    figure->path_ = path;
    if (const Status status = figure->readLists(); !status)
        return status.error();
    if (const Status status = figure->materials_.load(context, asset, path); !status)
        return status.error();
    if (const Status status = figure->uploadCage(); !status)
        return status.error();
    figure->averageAlbedo_ = figure->averageLuminance();
    return figure;
}

Figure::~Figure() {
    if (asset_.id != 0)
        suppleDestroyAsset(context_.handle(), asset_);
}

double Figure::clipDuration(uint32_t clip) const {
    return clip < clips_.size() ? clips_[clip].duration : 0.0;
}

Status Figure::readLists() {
    SuppleAssetInfo asset{};
    asset.structSize = sizeof asset;
    Status status = context_.check(suppleGetAssetInfo(context_.handle(), asset_, &asset), "suppleGetAssetInfo");
    const auto readEach = [&]<class T>(uint32_t count, SuppleResult (*get)(SuppleContext, SuppleAsset, uint32_t, T*),
                                       const char* name, auto&& take) {
        for (uint32_t i = 0; i < count && status; ++i) {
            T info{};
            info.structSize = sizeof info;
            status = context_.check(get(context_.handle(), asset_, i, &info), name);
            if (status)
                take(info);
        }
    };
    readEach(asset.clipCount, suppleGetClipInfo, "suppleGetClipInfo", [&](const SuppleClipInfo& clip) {
        clips_.push_back({clip.name, clip.duration});
    });
    readEach(asset.morphTargetCount, suppleGetMorphTargetInfo, "suppleGetMorphTargetInfo",
             [&](const SuppleMorphTargetInfo& target) {
                 morphTargets_.push_back({target.name, target.weight});
             });
    readEach(asset.expressionCount, suppleGetExpressionInfo, "suppleGetExpressionInfo",
             [&](const SuppleExpressionInfo& expression) { expressions_.emplace_back(expression.name); });
    readEach(asset.partCount, suppleGetPartInfo, "suppleGetPartInfo", [&](const SupplePartInfo& part) {
        partNames_.emplace_back(part.name);
        parts_.push_back(part);
    });
    readEach(asset.jointCount, suppleGetJointInfo, "suppleGetJointInfo", [&](const SuppleJointInfo& joint) {
        jointNames_.emplace_back(joint.name);
        jointParents_.push_back(joint.parent);
    });
    return status;
}

Result<std::vector<float>> Figure::expressionWeights(const std::vector<float>& weights) const {
    std::vector<float> all(morphTargets_.size());
    const SuppleResult result =
        suppleFillExpressionWeights(context_.handle(), asset_, weights.data(), static_cast<uint32_t>(weights.size()),
                                    all.data(), static_cast<uint32_t>(all.size()));
    if (const Status status = context_.check(result, "suppleFillExpressionWeights"); !status)
        return status.error();
    return all;
}

float Figure::averageLuminance() const {
    float sum = 0.0f;
    float area = 0.0f;
    for (uint32_t face = 0; face < cage_.faceCount(); ++face) {
        const glm::vec3 origin = cage_.positions[cage_.corners[cage_.faceStarts[face]]];
        glm::vec3 normal(0.0f);
        glm::vec3 vertexColor(0.0f);
        for (uint32_t corner = cage_.faceStarts[face]; corner < cage_.faceStarts[face + 1]; ++corner) {
            const uint32_t next = nextCorner(cage_, face, corner);
            normal += glm::cross(cage_.positions[cage_.corners[corner]] - origin,
                                 cage_.positions[cage_.corners[next]] - origin);
            vertexColor += cage_.colors.empty() ? glm::vec3(1.0f) : glm::vec3(cage_.colors[corner]);
        }
        const glm::vec3 color = materials_.averageColor(materials_.indexOf(materialOf(cage_, face))) * vertexColor /
                                static_cast<float>(cage_.sides(face));
        const float faceArea = glm::length(normal);
        sum += faceArea * glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
        area += faceArea;
    }
    return area > 0.0f ? sum / area : 0.5f;
}

std::vector<uint32_t> Figure::cageCornerWords() {
    const CageMesh& cage = cage_;
    std::vector<uint32_t> faces(cage.faceCount());
    for (uint32_t face = 0; face < faces.size(); ++face)
        faces[face] = face;
    const auto keyOf = [&](uint32_t face) { return std::pair(materialOf(cage, face), partOf(cage, face)); };
    std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return keyOf(a) < keyOf(b); });

    // The corners first, then each face's vertices: faceStart counts words from the beginning of the buffer.
    size_t cornerCount = 0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face)
        cornerCount += size_t{3} * (cage.sides(face) - 2);
    std::vector<shared::CageCorner> corners;
    corners.reserve(cornerCount);
    cageFaceLists_ = static_cast<uint32_t>(cornerCount * kCornerWords);
    for (const uint32_t face : faces) {
        const auto [material, part] = keyOf(face);
        if (cageRanges_.empty() || std::pair(cageRanges_.back().material, cageRanges_.back().part) != keyOf(face))
            cageRanges_.push_back({static_cast<uint32_t>(corners.size()), 0, material, part, glm::vec3(0.0f)});
        const uint32_t start = cage.faceStarts[face];
        const auto uvOf = [&](size_t set, uint32_t corner) {
            return cage.uvSets[set].empty() ? glm::vec2(0.0f) : cage.uvSets[set][corner];
        };
        for (uint32_t i = 1; i + 1 < cage.sides(face); ++i) {
            for (const uint32_t corner : {start, start + i, start + i + 1}) {
                const glm::vec4 color = cage.colors.empty() ? glm::vec4(1.0f) : cage.colors[corner];
                cageRanges_.back().center += cage.positions[cage.corners[corner]];
                const glm::vec2 uv0 = uvOf(0, corner);
                const glm::vec2 uv1 = uvOf(1, corner);
                corners.push_back({cage.corners[corner], cageFaceStart(face), cage.sides(face),
                                   glm::packUnorm4x8(color), uv0.x, uv0.y, uv1.x, uv1.y});
            }
        }
        cageRanges_.back().cornerCount = static_cast<uint32_t>(corners.size()) - cageRanges_.back().firstCorner;
    }
    for (CageRange& range : cageRanges_)
        range.center /= static_cast<float>(range.cornerCount);
    std::vector<uint32_t> words(cageFaceLists_ + cage.corners.size());
    std::memcpy(words.data(), corners.data(), corners.size() * sizeof(shared::CageCorner));
    std::copy(cage.corners.begin(), cage.corners.end(), words.begin() + cageFaceLists_);
    return words;
}

glm::vec3 Figure::centerOf(uint32_t part, uint32_t material) const {
    const auto own = std::find_if(cageRanges_.begin(), cageRanges_.end(), [&](const CageRange& range) {
        return (part == kManyParts || range.part == part) && range.material == material;
    });
    return own != cageRanges_.end() ? own->center : glm::vec3(0.0f);
}

std::vector<std::array<uint32_t, 2>> Figure::cageEdgeVertices() {
    std::vector<std::array<uint32_t, 2>> vertices;
    for (const auto& [part, from, to] : edgesOf(cage_)) {
        if (cageEdgeRanges_.empty() || cageEdgeRanges_.back().part != part)
            cageEdgeRanges_.push_back({static_cast<uint32_t>(vertices.size()), 0, part});
        ++cageEdgeRanges_.back().edgeCount;
        vertices.push_back({from, to});
    }
    return vertices;
}

Status Figure::uploadCage() {
    const std::vector<uint32_t> corners = cageCornerWords();
    const std::vector<std::array<uint32_t, 2>> edges = cageEdgeVertices();
    Device& device = context_.device();
    const auto upload = [&](const void* bytes, size_t size, Buffer& into) -> Status {
        Result<Buffer> buffer = device.uploadBuffer(bytes, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        if (!buffer)
            return buffer.error();
        into = std::move(*buffer);
        return success();
    };
    if (const Status status = upload(corners.data(), corners.size() * sizeof corners[0], cageCorners_); !status)
        return status.error();
    return upload(edges.data(), edges.size() * sizeof edges[0], cageEdges_);
}

} // namespace supple::host
