// Poses that mirror a character or a limb of it: what is baked and drawn is seen from outside.
#include "tests/cage/gltf/builder.h"
#include "tests/tools/baked_files.h"
#include "tests/tools/command_runner.h"
#include "tests/tools/obj_file.h"

#include "host/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace supple::test {
namespace {

constexpr double kBeamVolume = 3.44;

/// A beam from x = -2 to 2, oblique so that it is not its own mirror image. Its half of x > 0 hangs on the joint
/// "limb", at x = 0 both joints have half. Normals lean to the beam's end. The clips scale a joint by 1 at 0 s and by
/// -1 at 1 s: "whole" the root along x, "limb" the limb along z.
class BeamFile {
public:
    explicit BeamFile(const std::string& rootScale = "1,1,1") {
        constexpr float kSection[4][2] = {{-0.6f, -0.3f}, {0.4f, -0.5f}, {0.6f, 0.5f}, {-0.4f, 0.4f}};
        for (int i = -2; i < 2; ++i) {
            const auto x = static_cast<float>(i);
            for (int k = 0; k < 4; ++k) {
                const float *a = kSection[k], *b = kSection[(k + 1) % 4];
                addQuad({{{x, a[0], a[1]}, {x, b[0], b[1]}, {x + 1, b[0], b[1]}, {x + 1, a[0], a[1]}}});
            }
        }
        for (const float x : {-2.0f, 2.0f}) {
            std::array<glm::vec3, 4> cap;
            for (int k = 0; k < 4; ++k) {
                cap[x > 0.0f ? k : 3 - k] = {x, kSection[k][0], kSection[k][1]};
            }
            addQuad(cap);
        }
        build(rootScale);
    }
    void write(const std::filesystem::path& path) const {
        const std::vector<std::byte> glb = builder_.glb();
        writeText(path, {reinterpret_cast<const char*>(glb.data()), glb.size()});
    }

private:
    void addQuad(const std::array<glm::vec3, 4>& corners) {
        const auto first = static_cast<uint32_t>(positions_.size() / 3);
        const glm::vec3 across = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::vec3 normal = glm::normalize(glm::normalize(across) + glm::vec3(0.3f, 0.0f, 0.0f));
        for (int k = 0; k < 4; ++k) {
            for (int c = 0; c < 3; ++c) {
                positions_.push_back(corners[k][c]);
                normals_.push_back(normal[c]);
            }
            uvs_.insert(uvs_.end(), {k == 1 || k == 2 ? 1.0f : 0.0f, k > 1 ? 1.0f : 0.0f});
            const float limb = corners[k].x < 0.0f ? 0.0f : (corners[k].x > 0.0f ? 1.0f : 0.5f);
            joints_.insert(joints_.end(), {0, 1, 0, 0});
            weights_.insert(weights_.end(), {1.0f - limb, limb, 0.0f, 0.0f});
        }
        for (const uint32_t k : {0, 1, 2, 0, 2, 3}) {
            indices_.push_back(first + k);
        }
    }
    void build(const std::string& rootScale) {
        GltfBuilder& b = builder_;
        const auto text = [](int accessor) { return std::to_string(accessor); };
        b.meshes = R"([{"primitives":[{"material":0,"attributes":{"POSITION":)" +
                   text(b.addFloats("VEC3", positions_)) + R"(,"NORMAL":)" + text(b.addFloats("VEC3", normals_)) +
                   R"(,"TEXCOORD_0":)" + text(b.addFloats("VEC2", uvs_)) + R"(,"JOINTS_0":)" +
                   text(b.addIntegers("VEC4", 5121, joints_)) + R"(,"WEIGHTS_0":)" +
                   text(b.addFloats("VEC4", weights_)) + R"(},"indices":)" +
                   text(b.addIntegers("SCALAR", 5123, indices_)) + "}]}]";
        b.nodes =
            R"([{"mesh":0,"skin":0},{"name":"root","scale":[)" + rootScale + R"(],"children":[2]},{"name":"limb"}])";
        const std::string times = text(b.addFloats("SCALAR", {0, 1}));
        const std::string whole = text(b.addFloats("VEC3", {1, 1, 1, -1, 1, 1}));
        const std::string limb = text(b.addFloats("VEC3", {1, 1, 1, 1, 1, -1}));
        const auto clip = [&](const char* name, const std::string& node, const std::string& output) {
            return R"({"name":")" + std::string(name) + R"(","samplers":[{"input":)" + times + R"(,"output":)" +
                   output + R"(}],"channels":[{"sampler":0,"target":{"node":)" + node + R"(,"path":"scale"}}]})";
        };
        b.more = R"(,"materials":[{}],"skins":[{"joints":[1,2]}],"animations":[)" + clip("whole", "1", whole) + "," +
                 clip("limb", "2", limb) + "]";
    }

    GltfBuilder builder_;
    std::vector<float> positions_, normals_, uvs_, weights_;
    std::vector<uint32_t> joints_, indices_;
};

struct Measured {
    double volume = 0.0;
    int inward = 0; ///< corners whose normal is on the other side of their triangle
};

Measured measured(const Obj& obj) {
    Measured result;
    for (size_t f = 0; f < obj.faces.size(); ++f) {
        const std::vector<uint32_t>& face = obj.faces[f];
        for (size_t k = 1; k + 1 < face.size(); ++k) {
            const glm::dvec3 a(obj.v[face[0]]), b(obj.v[face[k]]), c(obj.v[face[k + 1]]);
            result.volume += glm::dot(a, glm::cross(b, c)) / 6.0;
            const glm::dvec3 across = glm::cross(b - a, c - a);
            for (const size_t corner : {size_t{0}, k, k + 1}) {
                const bool has = corner < face.size() && !obj.vn.empty();
                result.inward += has && glm::dot(across, glm::dvec3(obj.vn[face[corner]])) < -1e-6 ? 1 : 0;
            }
        }
    }
    return result;
}

class MirrorsTest : public CommandTest {
protected:
    void SetUp() override {
        CommandTest::SetUp();
        BeamFile().write(file("beam.glb"));
    }
    Obj baked(const std::string& options) {
        const Outcome outcome = runOnDevice("bake beam.glb -o out.obj --rate 2 " + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readObj(file("out.obj"));
    }
};

TEST_F(MirrorsTest, BakesAreSeenFromOutside) {
    const Measured asMade = measured(baked("--clip whole --time 0 --scheme catmull-clark"));
    const Measured smooth = measured(baked("--clip whole --time 1 --scheme catmull-clark"));
    EXPECT_GT(asMade.volume, 0.5);
    EXPECT_NEAR(smooth.volume, asMade.volume, 1e-5);
    EXPECT_EQ(asMade.inward + smooth.inward, 0);
    const Measured flat = measured(baked("--clip whole --time 1 --scheme polygons"));
    EXPECT_NEAR(flat.volume, kBeamVolume, 1e-5);
    EXPECT_EQ(flat.inward, 0);
    // A ring of the beam narrows to a line at x = 0, on both sides.
    for (const std::string scheme : {"polygons", "cage"}) {
        SCOPED_TRACE(scheme);
        const Measured limb = measured(baked("--clip limb --time 1 --scheme " + scheme));
        EXPECT_NEAR(limb.volume, 0.75 * kBeamVolume, 1e-5);
    }
}

struct Corner {
    glm::vec3 position, normal;
    glm::vec2 uv;
    glm::vec4 tangent;
};

/// The corners of all triangles.
std::vector<Corner> cornersOf(const std::filesystem::path& path) {
    const Glb glb(path);
    const auto& primitive = glb.root["meshes"][0]["primitives"][0];
    const auto& attributes = primitive["attributes"];
    const auto positions = glb.values<glm::vec3>(attributes["POSITION"]);
    const auto normals = glb.values<glm::vec3>(attributes["NORMAL"]);
    const auto uvs = glb.values<glm::vec2>(attributes["TEXCOORD_0"]);
    const auto tangents = glb.values<glm::vec4>(attributes["TANGENT"]);
    std::vector<Corner> corners;
    for (const uint32_t v : glb.indices(primitive)) {
        corners.push_back({positions[v], normals[v], uvs[v], tangents[v]});
    }
    return corners;
}

/// How far a corner is from the mirror image of another, as glTF has it: the sign of the frame turns.
float difference(const Corner& a, const Corner& b) {
    const glm::vec3 mirror(-1.0f, 1.0f, 1.0f);
    return std::max({glm::length(a.position - mirror * b.position), glm::length(a.normal - mirror * b.normal),
                     glm::length(a.uv - b.uv), glm::length(glm::vec3(a.tangent) - mirror * glm::vec3(b.tangent)),
                     std::abs(a.tangent.w + b.tangent.w)});
}

TEST_F(MirrorsTest, NormalsAndTangentsAreThoseOfTheMirrorImage) {
    for (const std::string scheme : {"catmull-clark", "polygons"}) {
        SCOPED_TRACE(scheme);
        for (const std::string time : {"0", "1"}) {
            const Outcome outcome = runOnDevice("bake beam.glb -o " + time + ".glb --clip whole --rate 2 --time " +
                                                time + " --scheme " + scheme);
            ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        }
        const std::vector<Corner> asMade = cornersOf(file("0.glb")), mirrored = cornersOf(file("1.glb"));
        ASSERT_EQ(asMade.size(), mirrored.size());
        for (const Corner& corner : mirrored) {
            float nearest = 1.0f;
            for (const Corner& other : asMade) {
                nearest = std::min(nearest, difference(corner, other));
            }
            EXPECT_LT(nearest, 1e-3f) << corner.position.x << " " << corner.position.y << " " << corner.position.z;
        }
    }
}

TEST_F(MirrorsTest, PicturesAreThoseOfTheMirrorImage) {
    BeamFile("-1,1,1").write(file("image.glb")); // mirrored as it rests: its cage is the mirror image
    const auto drawn = [&](const std::string& options) {
        const Outcome outcome = runOnDevice("render " + options + " -o out.png --size 120x80 --rate 2");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        Result<host::Picture> picture = host::readPng(file("out.png").string());
        EXPECT_TRUE(picture.ok());
        return picture.ok() ? std::move(*picture) : host::Picture{};
    };
    for (const std::string options : {"--scheme catmull-clark", "--scheme polygons"}) {
        SCOPED_TRACE(options);
        const host::Picture image = drawn("image.glb " + options);
        const host::Picture posed = drawn("beam.glb --clip whole --time 1 " + options);
        ASSERT_EQ(image.rgba.size(), posed.rgba.size());
        double sum = 0.0;
        for (size_t i = 0; i < image.rgba.size(); ++i) {
            sum += std::abs(static_cast<int>(image.rgba[i]) - static_cast<int>(posed.rgba[i]));
        }
        EXPECT_LT(sum / static_cast<double>(image.rgba.size()), 1.0);
    }
}

} // namespace
} // namespace supple::test
