// Tangents follow the texture coordinates that a material's normal map is looked up at (cage::MapFrame): its UV set,
// and its KHR_texture_transform. A character whose texture coordinates themselves are so has the same tangents.
#include "cage/materials.h"
#include "tests/support/crowd.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/meshes.h"
#include "tests/support/side_by_side.h"
#include "tests/support/tangent_word.h"
#include "tests/support/test_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <span>

namespace supple::test {
namespace map_frames {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

enum class Lies { transformed, onTheSecondSet, both };

cage::Texture mapThat(Lies lies) {
    cage::Texture map;
    map.image = 0;
    map.uvSet = lies == Lies::transformed ? 0 : 1;
    if (lies != Lies::onTheSecondSet) {
        map.rotation = 0.7f;
        map.scale = {-1.3f, 0.8f};
        map.offset = {0.2f, 0.4f};
    }
    return map;
}

glm::vec2 placed(const cage::Texture& map, const glm::vec2& uv) {
    const float c = std::cos(map.rotation), s = std::sin(map.rotation);
    return map.offset +
           glm::vec2(c * map.scale.x * uv.x + s * map.scale.y * uv.y, -s * map.scale.x * uv.x + c * map.scale.y * uv.y);
}

/// A biped, of which every third face has a material without a normal map.
cage::Cage roughCage(bool quads) {
    cage::Cage cage = quads ? perturbed(biped(), 0.08f, 3)
                            : perturbed(withMergedFaces(withCutQuads(biped(), 0.4, 5), 40, 7), 0.05f, 3);
    cage.faceMaterials.clear();
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        cage.faceMaterials.push_back(f % 3 == 0 ? 0 : 1);
    }
    return cage;
}

/// Texture coordinates that go on from face to face, or those of charts of one face.
std::vector<glm::vec2> uvsOf(const cage::Cage& cage, bool charts) {
    std::vector<glm::vec2> uvs;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t corner = cage.faceStarts[f]; corner < cage.faceStarts[f + 1]; ++corner) {
            const glm::vec3 p = cage.positions[cage.faceVertices[corner]];
            const float turn = charts ? 0.7f * static_cast<float>(f) : 0.0f;
            const glm::vec2 uv(p.x + 0.37f * p.z, p.y - 0.21f * p.z);
            uvs.emplace_back(std::cos(turn) * uv.x - std::sin(turn) * uv.y,
                             std::sin(turn) * uv.x + std::cos(turn) * uv.y);
        }
    }
    return uvs;
}

/// Nobody decodes it.
std::vector<std::byte> pngStart() {
    std::vector<std::byte> bytes(33);
    constexpr unsigned char kStart[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n', 0, 0, 0, 13, 'I',
                                        'H',  'D', 'R', 0,   0,    0,    1,    0,    0, 0, 1, 8,  0};
    std::memcpy(bytes.data(), kStart, sizeof(kStart));
    return bytes;
}

struct Pair {
    cage::Character told;  ///< the material says how its map lies
    cage::Character equal; ///< the texture coordinates lie so
};

/// `charts`: every face is a chart. Otherwise texture coordinates go on between faces, and all have the same material.
Pair characters(bool quads, Lies lies, bool charts) {
    cage::Cage cage = roughCage(quads);
    if (!charts) {
        std::fill(cage.faceMaterials.begin(), cage.faceMaterials.end(), 1u);
    }
    const std::vector<glm::vec2> uvs = uvsOf(cage, charts);
    const cage::Texture map = mapThat(lies);
    cage::Cage equal = cage;
    cage.cornerUvs = equal.cornerUvs = uvs;
    if (map.uvSet == 1) {
        for (glm::vec2& uv : cage.cornerUvs) {
            uv = {uv.y, uv.x * 0.5f};
        }
        equal.cornerUvs = cage.cornerUvs;
        cage.cornerUvs1 = uvs;
    }
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        for (uint32_t corner = cage.faceStarts[f]; corner < cage.faceStarts[f + 1]; ++corner) {
            if (cage.faceMaterials[f] == 1) {
                equal.cornerUvs[corner] = placed(map, uvs[corner]);
            }
        }
    }
    Pair pair{sideBySide(cage, "told", 1), sideBySide(equal, "equal", 1)};
    for (cage::Character* character : {&pair.told, &pair.equal}) {
        character->images.push_back({"map", "image/png", cage::SharedBytes(pngStart())});
        character->materials.resize(2);
        character->materials[1].normalTexture.image = 0;
    }
    pair.told.materials[1].normalTexture = map;
    return pair;
}

struct Row {
    const char* name;
    SuppleScheme scheme;
    bool quads = false;
    bool levels = true, mesh = true;
};

class MapFrames : public CrowdContexts, public testing::WithParamInterface<Row> {
protected:
    static SuppleGroupDesc descOf(SuppleAsset asset) {
        SuppleGroupDesc desc{};
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = GetParam().scheme;
        desc.rate = 5;
        desc.vertexFormat = SUPPLE_VERTEX_24;
        return desc;
    }
    static std::vector<uint32_t> tangentsOf(Crowd& crowd) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0, glm::mat4(1.0f));
        crowd.run();
        return as<uint32_t>(crowd.read(crowd.output().streams.tangents));
    }
    static std::vector<uint32_t> atRate(CrowdContext& own, SuppleAsset asset, SuppleUvInterpolation uvs,
                                        uint32_t flags) {
        SuppleGroupDesc desc = descOf(asset);
        desc.uvInterpolation = uvs;
        desc.flags = SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS | flags;
        Crowd crowd(own, desc);
        EXPECT_TRUE(crowd.valid());
        std::vector<uint32_t> tangents = tangentsOf(crowd);
        tangents.resize(crowd.output().grid.vertexCount); // then instances begin on 64 vertices
        return tangents;
    }
    /// What the samples of a view have, patch after patch: records come in any order.
    static std::vector<uint32_t> byPatches(const std::vector<uint32_t>& all, const Crowd& crowd) {
        const SuppleLevelOutput levels = crowd.output().levels;
        const auto buckets = as<std::array<uint32_t, 4>>(crowd.read(levels.buckets));
        const auto records = as<std::array<uint32_t, 16>>(crowd.read(levels.patches));
        std::map<uint32_t, std::span<const uint32_t>> patches;
        for (uint32_t d = 0; d < levels.drawCount; ++d) {
            for (uint32_t p = 0; p < buckets[d][2]; ++p) {
                const auto& record = records[buckets[d][0] + p];
                if (record[0] != 0xFFFFFFFFu) {
                    patches[record[0]] = std::span(all).subspan(record[2], levels.draws[d].samplesPerPatch);
                }
            }
        }
        std::vector<uint32_t> words;
        for (const auto& [patch, own] : patches) {
            words.insert(words.end(), own.begin(), own.end());
        }
        return words;
    }
    static std::vector<uint32_t> atLevels(CrowdContext& own, SuppleAsset asset, SuppleUvInterpolation uvs) {
        TestView view(own, 200000, SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS);
        SuppleGroupDesc desc = descOf(asset);
        desc.uvInterpolation = uvs;
        desc.rate = 0;
        desc.view = view.handle();
        Crowd crowd(own, desc);
        EXPECT_TRUE(crowd.valid());
        view.look({0.0f, 0.0f, 4.0f});
        return byPatches(tangentsOf(crowd), crowd);
    }
    static void compare(const std::string& what, const std::vector<uint32_t>& told,
                        const std::vector<uint32_t>& equal) {
        ASSERT_EQ(told.size(), equal.size()) << what;
        ASSERT_GT(told.size(), 100u) << what;
        double worst = 0.0;
        size_t signs = 0, negative = 0;
        for (size_t v = 0; v < told.size(); ++v) {
            const glm::dvec4 a = decodeTangent(told[v]), b = decodeTangent(equal[v]);
            worst =
                std::max(worst, kDegrees * std::acos(std::clamp(glm::dot(glm::dvec3(a), glm::dvec3(b)), -1.0, 1.0)));
            signs += a.w != b.w ? 1 : 0;
            negative += a.w < 0.0 ? 1 : 0;
        }
        std::printf("%s: %zu tangents, up to %.4f degrees, %zu of negative frames\n", what.c_str(), told.size(), worst,
                    negative);
        EXPECT_LT(worst, 0.05) << what;
        EXPECT_EQ(signs, 0u) << what;
    }
};

INSTANTIATE_TEST_SUITE_P(Schemes, MapFrames,
                         testing::Values(Row{"prep", SUPPLE_SCHEME_PREP, true}, Row{"pm", SUPPLE_SCHEME_PM},
                                         Row{"catmullClark", SUPPLE_SCHEME_CATMULL_CLARK},
                                         Row{"fragments", SUPPLE_SCHEME_FRAGMENTS, false, false, false},
                                         Row{"loop", SUPPLE_SCHEME_LOOP},
                                         Row{"blend", SUPPLE_SCHEME_BLEND, false, true, false},
                                         Row{"polygons", SUPPLE_SCHEME_POLYGONS, false, false, false}),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(MapFrames, AreThoseOfTheTextureCoordinatesTheMapIsLookedUpAt) {
    const ValidationGuard guard;
    const Row& row = GetParam();
    for (const SuppleMapping mapping : kMappings) {
        CrowdContext& own = context(mapping);
        ASSERT_TRUE(own.valid());
        for (const Lies lies : {Lies::transformed, Lies::onTheSecondSet, Lies::both}) {
            // Kernels of attributes do not know the scheme: one takes each way by itself, all take the one that has
            // both.
            if (lies != Lies::both && row.scheme != SUPPLE_SCHEME_PM) {
                continue;
            }
            for (const bool charts : {true, false}) {
                const Pair pair = characters(row.quads, lies, charts);
                const SuppleAsset told = own.createAsset(pair.told), equal = own.createAsset(pair.equal);
                const bool smooth = !charts && row.scheme != SUPPLE_SCHEME_POLYGONS;
                const SuppleUvInterpolation uvs = smooth ? SUPPLE_UV_LINEAR_CORNERS_PLUS1 : SUPPLE_UV_LINEAR_ALL;
                const std::string what = std::string(mappingName(mapping)) + ", map " +
                                         std::to_string(static_cast<int>(lies)) + (smooth ? ", smooth" : ", linear");
                compare(what, atRate(own, told, uvs, 0), atRate(own, equal, uvs, 0));
                if (row.mesh) {
                    compare(what + ", mesh", atRate(own, told, uvs, SUPPLE_GROUP_INDEXED_MESH),
                            atRate(own, equal, uvs, SUPPLE_GROUP_INDEXED_MESH));
                }
                if (row.levels) {
                    compare(what + ", levels", atLevels(own, told, uvs), atLevels(own, equal, uvs));
                }
            }
        }
        (void)own.takeLines();
    }
}

TEST(MapFramesOf, SayNothingOfMapsThatLieAsTheFirstTextureCoordinatesDo) {
    cage::Character character;
    character.cage.cornerUvs.resize(4);
    character.materials.resize(2);
    EXPECT_TRUE(cage::mapFramesOf(character).empty());
    cage::Texture& map = character.materials[1].normalTexture;
    map.image = 0;
    map.scale = {3.0f, 2.0f};
    map.offset = {0.1f, 0.2f};
    EXPECT_TRUE(cage::mapFramesOf(character).empty());
    map.rotation = 1.0f;
    map.scale = {1.0f, -2.0f};
    const std::vector<cage::MapFrame> frames = cage::mapFramesOf(character);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0], cage::MapFrame{});
    EXPECT_EQ(frames[1].hand, -1.0f);
    EXPECT_NEAR(glm::length(frames[1].down), 1.0f, 1e-6f);
    map.uvSet = 1; // which the cage lacks
    EXPECT_EQ(cage::mapFramesOf(character)[1], (cage::MapFrame{0, glm::vec2(0.0f), 0.0f}));
}

} // namespace
} // namespace map_frames
} // namespace supple::test
