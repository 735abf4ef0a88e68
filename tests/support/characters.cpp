#include "tests/support/characters.h"

#include "cage/materials.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <utility>

namespace supple::test {
namespace {

using cage::AlphaMode, cage::Cage, cage::Channel, cage::Character, cage::Crease, cage::Material, cage::Node;
using cage::SharpVertex, cage::Texture, cage::Trim;

/// Where each face of the cage goes when the faces of each part are grouped by material.
std::vector<uint32_t> groupedFaces(const Character& character) {
    const Cage& cage = character.cage;
    const auto materialOf = [&](uint32_t f) {
        return cage.faceMaterials.empty() ? cage::kNone : cage.faceMaterials[f];
    };
    std::vector<uint32_t> faces(cage.faceCount());
    std::iota(faces.begin(), faces.end(), 0u);
    for (size_t p = 0; p < character.parts.size(); ++p) {
        const uint32_t begin = character.parts[p].firstFace, end = cage::endFace(character, p);
        std::vector<uint32_t> firsts;
        for (uint32_t f = begin; f < end; ++f) {
            if (std::find(firsts.begin(), firsts.end(), materialOf(f)) == firsts.end()) {
                firsts.push_back(materialOf(f));
            }
        }
        const auto rank = [&](uint32_t f) { return std::find(firsts.begin(), firsts.end(), materialOf(f)); };
        std::stable_sort(faces.begin() + begin, faces.begin() + end,
                         [&](uint32_t x, uint32_t y) { return rank(x) < rank(y); });
    }
    return faces;
}

void expectSameParts(const Character& a, const Character& b) {
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (size_t p = 0; p < a.parts.size(); ++p) {
        SCOPED_TRACE("part " + std::to_string(p));
        EXPECT_EQ(a.parts[p].name, b.parts[p].name);
        EXPECT_EQ(a.parts[p].node, b.parts[p].node);
        EXPECT_EQ(a.parts[p].rigid, b.parts[p].rigid);
        EXPECT_EQ(a.parts[p].firstFace, b.parts[p].firstFace);
        EXPECT_EQ(a.parts[p].firstTarget, b.parts[p].firstTarget);
        EXPECT_EQ(a.parts[p].targetCount, b.parts[p].targetCount);
        EXPECT_EQ(a.parts[p].madeFor, b.parts[p].madeFor);
    }
}

void expectSameCage(const Character& of, const Character& ofOther) {
    const Cage &a = of.cage, &b = ofOther.cage;
    EXPECT_TRUE(a.positions == b.positions);
    ASSERT_EQ(a.faceCount(), b.faceCount());
    ASSERT_EQ(a.cornerCount(), b.cornerCount());
    ASSERT_EQ(a.cornerUvs.empty(), b.cornerUvs.empty());
    ASSERT_EQ(a.cornerUvs1.empty(), b.cornerUvs1.empty());
    ASSERT_EQ(a.cornerColors.empty(), b.cornerColors.empty());
    const std::vector<uint32_t> order = groupedFaces(of);
    std::vector<uint32_t> holes;
    for (uint32_t f = 0; f < b.faceCount(); ++f) {
        const uint32_t from = order[f];
        ASSERT_EQ(a.sides(from), b.sides(f)) << "face " << from;
        EXPECT_EQ(a.faceMaterials.empty() ? cage::kNone : a.faceMaterials[from],
                  b.faceMaterials.empty() ? cage::kNone : b.faceMaterials[f]);
        EXPECT_EQ(a.faceTrimTiles.empty() ? cage::kNone : a.faceTrimTiles[from],
                  b.faceTrimTiles.empty() ? cage::kNone : b.faceTrimTiles[f]);
        for (uint32_t k = 0; k < b.sides(f); ++k) {
            const uint32_t x = a.faceStarts[from] + k;
            const uint32_t y = b.faceStarts[f] + k;
            ASSERT_EQ(a.faceVertices[x], b.faceVertices[y]) << "face " << from << " corner " << k;
            if (!a.cornerUvs.empty()) {
                ASSERT_EQ(a.cornerUvs[x], b.cornerUvs[y]) << "face " << from << " corner " << k;
            }
            if (!a.cornerUvs1.empty()) {
                ASSERT_EQ(a.cornerUvs1[x], b.cornerUvs1[y]) << "face " << from << " corner " << k;
            }
            if (!a.cornerColors.empty()) {
                ASSERT_EQ(a.cornerColors[x], b.cornerColors[y]) << "face " << from << " corner " << k;
            }
        }
        if (std::binary_search(a.holes.begin(), a.holes.end(), from)) {
            holes.push_back(f);
        }
    }
    EXPECT_EQ(holes, b.holes);
    EXPECT_EQ(a.roundCorners, b.roundCorners);

    const auto edges = [](const Cage& cage) {
        std::vector<std::tuple<uint32_t, uint32_t, float>> list;
        for (const Crease& crease : cage.creases) {
            list.emplace_back(std::min(crease.a, crease.b), std::max(crease.a, crease.b), crease.sharpness);
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    EXPECT_EQ(edges(a), edges(b));
    const auto vertices = [](const Cage& cage) {
        std::vector<std::pair<uint32_t, float>> list;
        for (const SharpVertex& sharp : cage.sharpVertices) {
            list.emplace_back(sharp.vertex, sharp.sharpness);
        }
        std::sort(list.begin(), list.end());
        return list;
    };
    EXPECT_EQ(vertices(a), vertices(b));
}

void expectSameSkin(const Character& a, const Character& b) {
    ASSERT_EQ(a.skeleton.nodes.size(), b.skeleton.nodes.size());
    for (size_t i = 0; i < a.skeleton.nodes.size(); ++i) {
        SCOPED_TRACE("node " + std::to_string(i));
        const Node& x = a.skeleton.nodes[i];
        const Node& y = b.skeleton.nodes[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.parent, y.parent);
        EXPECT_EQ(x.translation, y.translation);
        EXPECT_EQ(x.rotation, y.rotation);
        EXPECT_EQ(x.scale, y.scale);
        EXPECT_EQ(x.hasMatrix, y.hasMatrix);
        EXPECT_EQ(x.matrix, y.matrix);
    }
    EXPECT_EQ(a.skin.joints, b.skin.joints);
    EXPECT_EQ(a.skin.inverseBinds, b.skin.inverseBinds);
    ASSERT_EQ(a.weights.starts, b.weights.starts);
    for (size_t i = 0; i < a.weights.influences.size(); ++i) {
        ASSERT_EQ(a.weights.influences[i].joint, b.weights.influences[i].joint) << "influence " << i;
        ASSERT_NEAR(a.weights.influences[i].weight, b.weights.influences[i].weight, 1e-6f) << "influence " << i;
    }
}

void expectSameMotion(const Character& a, const Character& b) {
    ASSERT_EQ(a.morphs.targets.size(), b.morphs.targets.size());
    EXPECT_EQ(a.morphs.weights, b.morphs.weights);
    for (size_t t = 0; t < a.morphs.targets.size(); ++t) {
        EXPECT_EQ(a.morphs.targets[t].name, b.morphs.targets[t].name);
        EXPECT_EQ(a.morphs.targets[t].vertices, b.morphs.targets[t].vertices);
        EXPECT_EQ(a.morphs.targets[t].deltas, b.morphs.targets[t].deltas);
    }
    ASSERT_EQ(a.clips.size(), b.clips.size());
    for (size_t i = 0; i < a.clips.size(); ++i) {
        SCOPED_TRACE("clip " + a.clips[i].name);
        EXPECT_EQ(a.clips[i].name, b.clips[i].name);
        EXPECT_EQ(a.clips[i].duration, b.clips[i].duration);
        ASSERT_EQ(a.clips[i].markers.size(), b.clips[i].markers.size());
        for (size_t m = 0; m < a.clips[i].markers.size(); ++m) {
            EXPECT_EQ(a.clips[i].markers[m].name, b.clips[i].markers[m].name);
            EXPECT_EQ(a.clips[i].markers[m].time, b.clips[i].markers[m].time);
        }
        ASSERT_EQ(a.clips[i].channels.size(), b.clips[i].channels.size());
        for (size_t k = 0; k < a.clips[i].channels.size(); ++k) {
            const Channel& x = a.clips[i].channels[k];
            const Channel& y = b.clips[i].channels[k];
            EXPECT_EQ(x.node, y.node);
            EXPECT_EQ(x.path, y.path);
            EXPECT_EQ(x.interpolation, y.interpolation);
            EXPECT_EQ(x.times, y.times);
            EXPECT_EQ(x.values, y.values);
        }
    }
}

/// But for the numbers of their images, which writers give anew.
void expectSameTexture(const Character& a, const Texture& x, const Character& b, const Texture& y) {
    Texture numbered = y;
    numbered.image = x.image;
    numbered.alternateImage = x.alternateImage;
    EXPECT_TRUE(x == numbered);
    for (const auto& [from, to] : {std::pair(x.image, y.image), {x.alternateImage, y.alternateImage}}) {
        ASSERT_EQ(from == cage::kNone, to == cage::kNone);
        if (from != cage::kNone) {
            EXPECT_EQ(a.images[from].name, b.images[to].name);
            EXPECT_EQ(a.images[from].bytes, b.images[to].bytes);
        }
    }
}

void expectSameMaterials(const Character& a, const Character& b) {
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (size_t i = 0; i < a.materials.size(); ++i) {
        SCOPED_TRACE("material " + std::to_string(i));
        const Material& x = a.materials[i];
        const Material& y = b.materials[i];
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.baseColorFactor, y.baseColorFactor);
        EXPECT_EQ(x.metallicFactor, y.metallicFactor);
        EXPECT_EQ(x.roughnessFactor, y.roughnessFactor);
        EXPECT_EQ(x.normalScale, y.normalScale);
        EXPECT_EQ(x.occlusionStrength, y.occlusionStrength);
        EXPECT_EQ(x.emissiveFactor, y.emissiveFactor);
        EXPECT_EQ(x.emissiveStrength, y.emissiveStrength);
        EXPECT_EQ(x.unlit, y.unlit);
        EXPECT_EQ(x.alphaMode, y.alphaMode);
        if (x.alphaMode == AlphaMode::mask) {
            EXPECT_EQ(x.alphaCutoff, y.alphaCutoff);
        }
        EXPECT_EQ(x.doubleSided, y.doubleSided);
        for (size_t k = 0; k < cage::texturesOf(x).size(); ++k) {
            SCOPED_TRACE("texture " + std::to_string(k));
            expectSameTexture(a, *cage::texturesOf(x)[k], b, *cage::texturesOf(y)[k]);
        }
        cage::MaterialLayers numbered = y.layers;
        for (const cage::LayerTexture& row : cage::kLayerTextures) {
            numbered.*row.member = x.layers.*row.member;
        }
        EXPECT_TRUE(x.layers == numbered);
        ASSERT_EQ(x.trim.has_value(), y.trim.has_value());
        if (x.trim) {
            expectSameTexture(a, x.trim->texture, b, y.trim->texture);
            Trim trim = *y.trim;
            trim.texture = x.trim->texture;
            EXPECT_TRUE(*x.trim == trim);
        }
    }
}

} // namespace

void expectSame(const Character& a, const Character& b) {
    EXPECT_EQ(a.copyright, b.copyright);
    expectSameCage(a, b);
    expectSameParts(a, b);
    expectSameSkin(a, b);
    expectSameMotion(a, b);
    expectSameMaterials(a, b);
}

} // namespace supple::test
