#include "host/figure.h"

#include "host/shaders/draw.h"
#include "host/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/gtc/packing.hpp>

namespace supple::host {

namespace {

constexpr size_t kCornerWords = sizeof(shared::CageCorner) / sizeof(uint32_t);

float linearFromSrgb(float x) {
    return x < 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

/// In linear light, from every few pixels.
glm::vec4 averageColor(const Picture& picture) {
    glm::vec4 sum(0.0f);
    float count = 0.0f;
    const size_t pixels = picture.rgba.size() / 4;
    const size_t step = std::max<size_t>(pixels / 4096, 1);
    for (size_t i = 0; i < pixels; i += step) {
        for (int channel = 0; channel < 3; ++channel)
            sum[channel] +=
                linearFromSrgb(static_cast<float>(picture.rgba[i * 4 + static_cast<size_t>(channel)]) / 255.0f);
        count += 1.0f;
    }
    return glm::vec4(glm::vec3(sum) / std::max(count, 1.0f), 1.0f);
}

/// Over the faces by their rest area; `materials` ends with what a face without material has.
float averageLuminance(const cage::Cage& cage, const std::vector<glm::vec4>& materials) {
    float sum = 0.0f;
    float area = 0.0f;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        const size_t material = cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[face];
        const glm::vec3 base = materials[std::min(material, materials.size() - 1)];
        const glm::vec3 origin = cage.positions[cage.faceVertices[cage.faceStarts[face]]];
        glm::vec3 normal(0.0f);
        glm::vec3 vertexColor(0.0f);
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const uint32_t next = corner + 1 < cage.faceStarts[face + 1] ? corner + 1 : cage.faceStarts[face];
            normal += glm::cross(cage.positions[cage.faceVertices[corner]] - origin,
                                 cage.positions[cage.faceVertices[next]] - origin);
            vertexColor += cage.cornerColors.empty() ? glm::vec3(1.0f) : glm::vec3(cage.cornerColors[corner]);
        }
        const glm::vec3 color = base * vertexColor / static_cast<float>(cage.sides(face));
        const float faceArea = glm::length(normal);
        sum += faceArea * glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f));
        area += faceArea;
    }
    return area > 0.0f ? sum / area : 0.5f;
}

/// Each edge once.
std::vector<std::array<uint32_t, 2>> edgesOf(const cage::Cage& cage) {
    std::vector<std::array<uint32_t, 2>> edges;
    edges.reserve(cage.faceVertices.size());
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        for (uint32_t corner = cage.faceStarts[face]; corner < cage.faceStarts[face + 1]; ++corner) {
            const uint32_t next = corner + 1 < cage.faceStarts[face + 1] ? corner + 1 : cage.faceStarts[face];
            const auto [from, to] = std::minmax(cage.faceVertices[corner], cage.faceVertices[next]);
            edges.push_back({from, to});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

} // namespace

Result<std::unique_ptr<Figure>> Figure::create(Context& context, SuppleAsset asset, cage::Character character,
                                               const std::string& path) {
    std::unique_ptr<Figure> figure(new Figure(context));
    figure->asset_ = asset;
    figure->character_ = std::move(character);
    figure->path_ = path;
    if (const Status status = figure->uploadCage(); !status)
        return status.error();
    if (const Status status = figure->uploadBaseColors(); !status)
        return status.error();
    if (const Status status = figure->uploadTrims(); !status)
        return status.error();
    return figure;
}

Figure::~Figure() {
    if (asset_.id != 0)
        suppleDestroyAsset(context_.handle(), asset_);
}

double Figure::clipDuration(uint32_t clip) const {
    return clip < character_.clips.size() ? character_.clips[clip].duration : 0.0;
}

std::vector<uint32_t> Figure::cageCornerWords() {
    const cage::Cage& cage = character_.cage;
    const auto materialOf = [&](uint32_t face) {
        return cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[face];
    };
    std::vector<uint32_t> faces(cage.faceCount());
    for (uint32_t face = 0; face < faces.size(); ++face)
        faces[face] = face;
    std::stable_sort(faces.begin(), faces.end(), [&](uint32_t a, uint32_t b) { return materialOf(a) < materialOf(b); });

    // The corners first, then each face's vertices: faceStart counts words from the beginning of the buffer.
    size_t cornerCount = 0;
    for (uint32_t face = 0; face < cage.faceCount(); ++face)
        cornerCount += size_t{3} * (cage.sides(face) - 2);
    std::vector<shared::CageCorner> corners;
    corners.reserve(cornerCount);
    const auto lists = static_cast<uint32_t>(cornerCount * kCornerWords);
    for (const uint32_t face : faces) {
        if (cageRanges_.empty() || cageRanges_.back().material != materialOf(face))
            cageRanges_.push_back({static_cast<uint32_t>(corners.size()), 0, materialOf(face)});
        const uint32_t start = cage.faceStarts[face];
        const uint32_t material = materialOf(face);
        const bool second =
            material < character_.materials.size() && character_.materials[material].baseColorUvSet == 1;
        const std::vector<glm::vec2>& uvs = second ? cage.cornerUvs1 : cage.cornerUvs;
        for (uint32_t i = 1; i + 1 < cage.sides(face); ++i) {
            for (const uint32_t corner : {start, start + i, start + i + 1}) {
                const glm::vec4 color = cage.cornerColors.empty() ? glm::vec4(1.0f) : cage.cornerColors[corner];
                const glm::vec2 uv = uvs.empty() ? glm::vec2(0.0f) : uvs[corner];
                corners.push_back(
                    {cage.faceVertices[corner], lists + start, cage.sides(face), glm::packUnorm4x8(color), uv.x, uv.y});
            }
        }
        cageRanges_.back().cornerCount = static_cast<uint32_t>(corners.size()) - cageRanges_.back().firstCorner;
    }
    std::vector<uint32_t> words(lists + cage.faceVertices.size());
    std::memcpy(words.data(), corners.data(), corners.size() * sizeof(shared::CageCorner));
    std::copy(cage.faceVertices.begin(), cage.faceVertices.end(), words.begin() + lists);
    return words;
}

Status Figure::uploadCage() {
    const std::vector<uint32_t> corners = cageCornerWords();
    const std::vector<std::array<uint32_t, 2>> edges = edgesOf(character_.cage);
    cageEdgeCount_ = static_cast<uint32_t>(edges.size());
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

Status Figure::uploadBaseColors() {
    std::vector<glm::vec4> averages;
    Picture white = Picture::blank(1, 1);
    std::fill(white.rgba.begin(), white.rgba.end(), uint8_t{255});
    for (size_t i = 0; i <= character_.materials.size(); ++i) {
        Result<Picture> picture = white;
        if (i < character_.materials.size() && character_.materials[i].baseColorImage < character_.images.size()) {
            const cage::Image& image = character_.images[character_.materials[i].baseColorImage];
            picture = decodePicture(image.bytes, path_ + ": image " + image.name);
            if (!picture) {
                // A picture that cannot be read takes nothing from the shape: draw without it, but say so.
                std::fprintf(stderr, "warning: %s\n", picture.error().message.c_str());
                picture = white;
            }
        }
        Result<Image> texture = uploadTexture(context_.device(), *picture);
        if (!texture)
            return texture.error();
        baseColors_.push_back(std::move(*texture));
        averages.push_back(averageColor(*picture));
        if (i < character_.materials.size())
            averages.back() *= character_.materials[i].baseColorFactor;
    }
    averageAlbedo_ = averageLuminance(character_.cage, averages);
    return success();
}

Status Figure::uploadTrims() {
    trims_.resize(baseColors_.size());
    for (size_t i = 0; i < character_.materials.size(); ++i) {
        const std::optional<cage::Trim>& trim = character_.materials[i].trim;
        if (!trim)
            continue;
        // Unlike a base color it is part of the shape: no drawing without it.
        const cage::Image& image = character_.images[trim->image];
        const Result<Picture> picture = decodePicture(image.bytes, path_ + ": trim image " + image.name);
        if (!picture)
            return picture.error();
        Result<Image> texture =
            uploadTexture(context_.device(), *picture,
                          trim->domain == cage::TrimDomain::face ? TextureKind::tiles : TextureKind::data);
        if (!texture)
            return texture.error();
        trims_[i] = std::move(*texture);
    }
    return success();
}

} // namespace supple::host
