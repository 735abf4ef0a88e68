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
/// -1 at 1 s: "whole" the root along x, "limb" the limb along z. `trim`: a PNG on each face, whose alpha cuts holes.
class BeamFile {
public:
    explicit BeamFile(const std::string& rootScale = "1,1,1", const std::string& trim = {}) {
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
        build(rootScale, trim);
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
    void build(const std::string& rootScale, const std::string& trim) {
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
        const std::string material =
            trim.empty() ? "[{}]"
                         : R"([{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
                           R"("textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" +
                               base64(toBytes(trim)) + R"("}])";
        b.more = R"(,"materials":)" + material + R"(,"skins":[{"joints":[1,2]}],"animations":[)" +
                 clip("whole", "1", whole) + "," + clip("limb", "2", limb) + "]";
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
    Obj baked(const std::string& options, const std::string& input = "beam.glb") {
        const Outcome outcome = runOnDevice("bake " + input + " -o out.obj --rate 2 " + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return readObj(file("out.obj"));
    }
    host::Picture drawn(const std::string& options) {
        const Outcome outcome = runOnDevice("render " + options + " -o out.png --size 120x80 --rate 2");
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        Result<host::Picture> picture = host::readPng(file("out.png").string());
        EXPECT_TRUE(picture.ok());
        return picture.ok() ? std::move(*picture) : host::Picture{};
    }
    void expectMirrorImages(const std::string& scheme);
    /// Which pixels show the figure, from straight ahead.
    std::vector<bool> shown(const std::string& options) {
        const host::Picture picture = drawn(options + " --alpha --yaw 0 --pitch 0");
        std::vector<bool> pixels(size_t{picture.width} * picture.height);
        for (size_t i = 0; i < pixels.size(); ++i) {
            pixels[i] = picture.rgba[4 * i + 3] > 127;
        }
        return pixels;
    }
};

/// Of all channels.
double pixelDifference(const host::Picture& a, const host::Picture& b) {
    EXPECT_EQ(a.rgba.size(), b.rgba.size());
    double sum = 0.0;
    for (size_t i = 0; i < std::min(a.rgba.size(), b.rgba.size()); ++i) {
        sum += std::abs(static_cast<int>(a.rgba[i]) - static_cast<int>(b.rgba[i]));
    }
    return sum / static_cast<double>(a.rgba.size());
}

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

/// Bakes beam.glb as it is made and mirrored, as 0.glb and 1.glb, and compares them.
void MirrorsTest::expectMirrorImages(const std::string& scheme) {
    for (const std::string time : {"0", "1"}) {
        const Outcome outcome = runOnDevice("bake beam.glb -o " + time + ".glb --clip whole --rate 2 --time " + time +
                                            " --scheme " + scheme);
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

TEST_F(MirrorsTest, NormalsAndTangentsAreThoseOfTheMirrorImage) {
    for (const std::string scheme : {"catmull-clark", "polygons"}) {
        SCOPED_TRACE(scheme);
        expectMirrorImages(scheme);
    }
}

TEST_F(MirrorsTest, PicturesAreThoseOfTheMirrorImage) {
    BeamFile("-1,1,1").write(file("image.glb")); // mirrored as it rests: its cage is the mirror image
    for (const std::string options : {"--scheme catmull-clark", "--scheme polygons"}) {
        SCOPED_TRACE(options);
        const host::Picture image = drawn("image.glb " + options);
        const host::Picture posed = drawn("beam.glb --clip whole --time 1 " + options);
        EXPECT_LT(pixelDifference(image, posed), 1.0);
    }
}

TEST_F(MirrorsTest, TrimsAreThoseOfTheMirrorImage) {
    // A hole in each face, nearer to the side of smaller x.
    host::Picture trim = host::Picture::blank(32, 32);
    for (uint32_t y = 0; y < 32; ++y) {
        for (uint32_t x = 0; x < 32; ++x) {
            const bool hole = x >= 8 && x < 24 && y >= 2 && y < 14;
            const uint8_t color[] = {200, 180, 160, static_cast<uint8_t>(hole ? 0 : 255)};
            std::copy(color, color + 4, trim.pixel(x, y));
        }
    }
    ASSERT_TRUE(host::writePng(trim, file("trim.png").string()).ok());
    const std::string png = readText(file("trim.png"));
    BeamFile("1,1,1", png).write(file("beam.glb"));
    BeamFile("-1,1,1", png).write(file("image.glb"));
    for (const std::string scheme : {"catmull-clark", "polygons", "cage"}) {
        SCOPED_TRACE(scheme);
        const std::string asMade = "beam.glb --clip whole --time 0 --scheme " + scheme;
        const std::string mirrored = "beam.glb --clip whole --time 1 --scheme " + scheme;
        EXPECT_LT(pixelDifference(drawn("image.glb --scheme " + scheme), drawn(mirrored)), 1.0);
        const std::vector<bool> made = shown(asMade), image = shown(mirrored);
        int unlike = 0, unlikeMade = 0;
        for (size_t i = 0; i < made.size(); ++i) {
            const size_t flipped = i / 120 * 120 + 119 - i % 120;
            unlike += image[i] != made[flipped] ? 1 : 0;
            unlikeMade += image[i] != made[i] ? 1 : 0;
        }
        EXPECT_GT(unlikeMade, 400) << "the holes are elsewhere";
        EXPECT_LT(unlike, unlikeMade / 4) << "pixels of contours";
    }
    for (const std::string scheme : {"catmull-clark", "polygons"}) {
        SCOPED_TRACE(scheme);
        expectMirrorImages(scheme);
        const Glb glb(file("1.glb"));
        ASSERT_EQ(glb.root["materials"].size(), 1u);
        EXPECT_EQ(glb.root["materials"][0]["alphaMode"], "MASK");
        EXPECT_EQ(glb.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    }
}

/// A hexagon in the plane z = 0, whose outside is +z. Those of its vertices that `onLimb` lists hang on a joint that
/// the clip scales by -1 along z at 1 s. That moves none of them.
std::string hexagon(const std::vector<uint32_t>& onLimb) {
    GltfBuilder b;
    std::vector<float> positions;
    std::vector<uint32_t> joints;
    for (uint32_t k = 0; k < 6; ++k) {
        const float angle = static_cast<float>(k) * 1.0471976f;
        positions.insert(positions.end(), {std::cos(angle), std::sin(angle), 0.0f});
        const bool limb = std::find(onLimb.begin(), onLimb.end(), k) != onLimb.end();
        joints.insert(joints.end(), {limb ? 1u : 0u, 0, 0, 0});
    }
    std::vector<float> weights;
    for (uint32_t k = 0; k < 6; ++k) {
        weights.insert(weights.end(), {1, 0, 0, 0});
    }
    b.addFloats("VEC3", positions);
    b.addIntegers("VEC4", 5121, joints);
    b.addFloats("VEC4", weights);
    b.addIntegers("SCALAR", 5123, {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5});
    b.addFloats("SCALAR", {0, 1});
    b.addFloats("VEC3", {1, 1, 1, 1, 1, -1});
    b.meshes = R"([{"primitives":[{"material":0,"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,)"
               R"("extensions":{"FB_ngon_encoding":{}}}]}])";
    b.nodes = R"([{"mesh":0,"skin":0},{"name":"root","children":[2]},{"name":"limb"}])";
    b.more = R"(,"extensionsUsed":["FB_ngon_encoding"],"materials":[{}],"skins":[{"joints":[1,2]}],)"
             R"("animations":[{"name":"limb","samplers":[{"input":4,"output":5}],)"
             R"("channels":[{"sampler":0,"target":{"node":2,"path":"scale"}}]}])";
    const std::vector<std::byte> glb = b.glb();
    return {reinterpret_cast<const char*>(glb.data()), glb.size()};
}

TEST_F(MirrorsTest, AFaceOnASeamIsJudgedByAllItsVertices) {
    const struct {
        std::vector<uint32_t> onLimb;
        bool mirrored;
    } hexagons[] = {{{0, 3}, false}, {{0, 2, 4}, true}};
    for (const auto& [onLimb, mirrored] : hexagons) {
        writeText(file("hexagon.glb"), hexagon(onLimb));
        for (const std::string scheme : {"catmull-clark", "cage"}) {
            SCOPED_TRACE(scheme + ", " + std::to_string(onLimb.size()) + " of 6");
            const std::string options = "--clip limb --time 1 --scheme " + scheme;
            const Obj obj = baked(options, "hexagon.glb");
            double area = 0.0;
            for (const std::vector<uint32_t>& face : obj.faces) {
                for (size_t k = 1; k + 1 < face.size(); ++k) {
                    area += glm::cross(obj.v[face[k]] - obj.v[face[0]], obj.v[face[k + 1]] - obj.v[face[0]]).z / 2.0;
                }
            }
            EXPECT_GT(mirrored ? -area : area, 1.0);
            for (const auto& normal : obj.vn) {
                EXPECT_GT(mirrored ? -normal.z : normal.z, 0.99f);
            }
            // Its material has one side.
            const std::vector<bool> pixels = shown("hexagon.glb " + options);
            const auto count = std::count(pixels.begin(), pixels.end(), true);
            EXPECT_TRUE(mirrored ? count < 100 : count > 1000)
                << count << " pixels, of which some are edges of the cage";
        }
    }
}

} // namespace
} // namespace supple::test
