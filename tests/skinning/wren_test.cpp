// The second sample character is one that a studio would accept: closed, in quads, with weights that meet the runtime's
// limits, and feet that neither slide nor sink.
#include "cage/gltf/reader.h"
#include "skinning/pose.h"
#include "tests/support/sample_assets.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace supple::skinning {
namespace {

using namespace cage;

class Wren : public ::testing::Test {
protected:
    void SetUp() override {
        const Result<Character> read = readGltfFile(test::kWren);
        ASSERT_TRUE(read.ok()) << read.error().message;
        wren = *read;
    }

    size_t part(const std::string& name) const {
        const auto found =
            std::find_if(wren.parts.begin(), wren.parts.end(), [&](const Part& p) { return p.name == name; });
        EXPECT_NE(found, wren.parts.end()) << name;
        return static_cast<size_t>(found - wren.parts.begin());
    }

    const Clip& clip(const std::string& name) const {
        const auto found =
            std::find_if(wren.clips.begin(), wren.clips.end(), [&](const Clip& c) { return c.name == name; });
        EXPECT_NE(found, wren.clips.end()) << name;
        return *found;
    }

    std::set<uint32_t> verticesOf(size_t index) const {
        std::set<uint32_t> vertices;
        const uint32_t first = wren.cage.faceStarts[wren.parts[index].firstFace];
        const uint32_t end = wren.cage.faceStarts[endFace(wren, index)];
        vertices.insert(wren.cage.faceVertices.begin() + first, wren.cage.faceVertices.begin() + end);
        return vertices;
    }

    std::vector<Affine> palette(const Clip& of, double time) const {
        std::vector<glm::mat4> matrices(wren.skeleton.nodes.size());
        sampleClip(wren.skeleton, of, time, matrices);
        globalTransforms(wren.skeleton, matrices, matrices);
        std::vector<Affine> made(wren.skin.joints.size());
        jointPalette(wren.skin, matrices, glm::mat4(1.0f), made);
        return made;
    }

    glm::vec3 skinned(const std::vector<Affine>& joints, uint32_t vertex) const {
        const glm::vec4 p(wren.cage.positions[vertex], 1.0f);
        glm::vec3 sum(0.0f);
        for (uint32_t i = wren.weights.starts[vertex]; i < wren.weights.starts[vertex + 1]; ++i) {
            const Influence& influence = wren.weights.influences[i];
            for (int row = 0; row < 3; ++row) {
                sum[row] += influence.weight * glm::dot(joints[influence.joint].rows[row], p);
            }
        }
        return sum;
    }

    /// The points under the toes of a foot: what has to stand still while it is on the ground.
    std::vector<uint32_t> soleOf(float side) const {
        std::vector<uint32_t> found;
        for (const uint32_t v : verticesOf(part("boots"))) {
            const glm::vec3& p = wren.cage.positions[v];
            if (p.x * side > 0.0f && p.y < 0.005f && p.z > 0.12f && p.z < 0.16f) {
                found.push_back(v);
            }
        }
        return found;
    }

    Character wren;
};

TEST_F(Wren, IsClosedInQuadsWithSaneValences) {
    std::map<std::pair<uint32_t, uint32_t>, int> edges;
    std::map<uint32_t, int> valences;
    for (uint32_t f = 0; f < wren.cage.faceCount(); ++f) {
        ASSERT_EQ(wren.cage.sides(f), 4u) << "face " << f;
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t a = wren.cage.faceVertices[wren.cage.faceStarts[f] + i];
            const uint32_t b = wren.cage.faceVertices[wren.cage.faceStarts[f] + (i + 1) % 4];
            ++edges[{a, b}];
            ++valences[a];
        }
    }
    for (const auto& [edge, count] : edges) {
        ASSERT_EQ(count, 1) << edge.first << " " << edge.second;
        ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << "an open edge " << edge.first << " " << edge.second;
    }
    for (const auto& [vertex, valence] : valences) {
        EXPECT_GE(valence, 3) << vertex;
        EXPECT_LE(valence, 6) << vertex;
    }
    EXPECT_TRUE(wren.damages.empty());
    EXPECT_TRUE(wren.warnings.empty());
}

TEST_F(Wren, HasPartsShapesClipsAndMaps) {
    for (const char* name :
         {"head", "eyes", "hair", "hands", "jacket", "trousers", "boots", "gear", "scarf", "sword"}) {
        part(name);
    }
    std::set<std::string> shapes;
    for (const MorphTarget& target : wren.morphs.targets) {
        shapes.insert(target.name);
        EXPECT_FALSE(target.vertices.empty()) << target.name;
    }
    EXPECT_EQ(shapes, (std::set<std::string>{"blink", "brows", "frown", "open", "round", "smile"}));
    for (const char* name : {"idle", "walk", "run", "attack", "wave", "jump"}) {
        EXPECT_GT(clip(name).duration, 0.5) << name;
    }
    size_t normalMaps = 0;
    for (const Material& material : wren.materials) {
        normalMaps += material.normalTexture.exists();
    }
    EXPECT_GE(normalMaps, 6u);
    for (uint32_t v = 0; v < wren.cage.vertexCount(); ++v) {
        EXPECT_LE(wren.weights.starts[v + 1] - wren.weights.starts[v], 4u);
    }
}

TEST_F(Wren, HerFaceMovesInWalkAndRun) {
    for (const char* name : {"walk", "run"}) {
        std::map<std::string, std::pair<float, float>> range;
        for (const Channel& channel : clip(name).channels) {
            if (channel.path != ChannelPath::weights) {
                continue;
            }
            for (size_t i = 0; i < channel.values.size(); ++i) {
                const std::string& shape = wren.morphs.targets[channel.firstTarget + i % channel.width()].name;
                auto& [low, high] = range.try_emplace(shape, 1.0f, 0.0f).first->second;
                low = std::min(low, channel.values[i]);
                high = std::max(high, channel.values[i]);
            }
        }
        EXPECT_LT(range["blink"].first, 0.1f) << name;
        EXPECT_GT(range["blink"].second, 0.95f) << name;
        EXPECT_GT(range["open"].second, range["open"].first + 0.05f) << name << ": she breathes";
    }
}

TEST_F(Wren, TheSwordPassesThePouchInRun) {
    constexpr float kClear = 0.01f;
    const Clip& run = clip("run");
    std::vector<uint32_t> grip, pouch;
    for (const uint32_t v : verticesOf(part("sword"))) {
        if (wren.cage.positions[v].x < 0.0f && wren.cage.positions[v].z < 0.08f) { // behind the blade; not the scabbard
            grip.push_back(v);
        }
    }
    for (const uint32_t v : verticesOf(part("gear"))) {
        const glm::vec3& p = wren.cage.positions[v];
        if (p.x < -0.05f && p.y > 0.86f && p.y < 0.94f && p.z > 0.05f) {
            pouch.push_back(v);
        }
    }
    ASSERT_GE(grip.size(), 40u);
    ASSERT_GE(pouch.size(), 40u);
    float nearest = 1.0f;
    for (int frame = 0; frame <= static_cast<int>(run.duration * 60); ++frame) {
        const std::vector<Affine> joints = palette(run, frame / 60.0);
        std::vector<glm::vec3> hanging;
        for (const uint32_t v : pouch) {
            hanging.push_back(skinned(joints, v));
        }
        for (const uint32_t v : grip) {
            const glm::vec3 at = skinned(joints, v);
            for (const glm::vec3& other : hanging) {
                nearest = std::min(nearest, glm::length(at - other));
            }
        }
    }
    EXPECT_GT(nearest, kClear);
}

TEST_F(Wren, FeetStayAboveTheGround) {
    const std::set<uint32_t> boots = verticesOf(part("boots"));
    for (const Clip& of : wren.clips) {
        float lowest = 1.0f, lift = 0.0f;
        for (int frame = 0; frame <= static_cast<int>(of.duration * 60); ++frame) {
            const std::vector<Affine> joints = palette(of, frame / 60.0);
            float low = 1.0f;
            for (const uint32_t v : boots) {
                low = std::min(low, skinned(joints, v).y);
            }
            lowest = std::min(lowest, low);
            lift = std::max(lift, low);
        }
        EXPECT_GT(lowest, -0.004f) << of.name;
        // Something is always on the ground, but in leaps.
        if (of.name != "run" && of.name != "jump") {
            EXPECT_LT(lift, 0.004f) << of.name;
        }
    }
}

TEST_F(Wren, FeetDoNotSlide) {
    // Speed of the ground under walk and run (samples/assets/README.md); elsewhere it stands still.
    const std::map<std::string, float> ground{{"walk", 0.6719f}, {"run", 1.9583f}};
    for (const Clip& of : wren.clips) {
        const float back = ground.count(of.name) ? ground.at(of.name) : 0.0f;
        for (const float side : {1.0f, -1.0f}) {
            const std::vector<uint32_t> sole = soleOf(side);
            ASSERT_GE(sole.size(), 2u);
            float worst = 0.0f;
            const int frames = static_cast<int>(std::lround(of.duration * 30));
            size_t held = 0;
            for (int frame = 0; frame < frames; ++frame) {
                const std::vector<Affine> now = palette(of, frame / 30.0), then = palette(of, (frame + 1) / 30.0);
                for (const uint32_t v : sole) {
                    const glm::vec3 a = skinned(now, v), b = skinned(then, v);
                    if (std::max(a.y, b.y) < 0.001f) {
                        ++held;
                        worst = std::max(worst, glm::length(b - a + glm::vec3(0.0f, 0.0f, back / 30.0f)));
                    }
                }
            }
            EXPECT_GT(held, 0u) << of.name;
            EXPECT_LT(worst, 0.0005f) << of.name << (side > 0 ? " left" : " right");
        }
    }
}

} // namespace
} // namespace supple::skinning
