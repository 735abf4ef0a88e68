// Materials in pictures: what a file says of its surfaces is what is drawn. Drawn under the validation layer; beauty is
// for people to judge (supple_material_scenes).
#include "host/environment.h"
#include "host/surface_renderer.h"
#include "tests/tools/material_scenes.h"
#include "tests/tools/two_renderers.h"
#include "tools/common/figure_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <span>
#include <unistd.h>

namespace supple::host {
namespace {

using test::SceneFile;
using test::SceneMesh;

constexpr float kSquareHalf = 0.75f;

std::string flatColor(const std::string& color, const std::string& more = {}) {
    return R"({"pbrMetallicRoughness":{"baseColorFactor":)" + color + R"(,"metallicFactor":0,"roughnessFactor":0.6})" +
           more + "}";
}
std::string unlitColor(const std::string& color, const std::string& more = {}) {
    return flatColor(color, R"(,"extensions":{"KHR_materials_unlit":{}})" + more);
}

int byteOf(float linear) {
    const float x = linear < 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(x * 255.0f));
}

/// A picture of 8 by 8 texels.
Picture texels(const std::function<glm::u8vec4(uint32_t, uint32_t)>& color) {
    Picture picture = Picture::blank(8, 8);
    for (uint32_t y = 0; y < 8; ++y) {
        for (uint32_t x = 0; x < 8; ++x) {
            const glm::u8vec4 texel = color(x, y);
            std::copy(&texel[0], &texel[0] + 4, picture.pixel(x, y));
        }
    }
    return picture;
}

glm::ivec3 colorAt(const Picture& picture, uint32_t x, uint32_t y) {
    const uint8_t* pixel = picture.pixel(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}
glm::ivec3 middleOf(const Picture& picture) {
    return colorAt(picture, kStageSize.width / 2, kStageSize.height / 2);
}
int furthest(glm::ivec3 a, glm::ivec3 b) {
    const glm::ivec3 away = glm::abs(a - b);
    return std::max({away.x, away.y, away.z});
}
int furthest(const Picture& a, const Picture& b) {
    int most = 0;
    for (size_t i = 0; i < a.rgba.size(); ++i)
        most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
    return most;
}

class MaterialPictureTest : public TwoRenderers {
protected:
    static std::unique_ptr<Figure> open(const SceneFile& file) {
        const std::string path =
            (std::filesystem::path(testing::TempDir()) / ("supple_material_" + std::to_string(getpid()) + ".gltf"))
                .string();
        EXPECT_TRUE(test::writeScene(file, path));
        Result<std::unique_ptr<Figure>> figure = openFigure(*context_, path);
        std::filesystem::remove(path);
        EXPECT_TRUE(figure.ok()) << (figure.ok() ? "" : figure.error().message);
        return std::move(*figure);
    }

    /// From +Z; the picture is `height` high at z 0, about `center`.
    static Scene facing(glm::vec2 center = glm::vec2(0.0f), float height = 2.0f, float yaw = 0.0f) {
        Scene scene;
        scene.camera.target = glm::vec3(center, 0.0f);
        scene.camera.yaw = yaw;
        scene.camera.pitch = 0.0f;
        scene.camera.distance = 40.0f;
        scene.camera.fieldOfView = 2.0f * std::atan(0.5f * height / scene.camera.distance);
        scene.lightYaw = yaw;
        scene.bounds.add(glm::vec3(center - height, -height));
        scene.bounds.add(glm::vec3(center + height, height));
        return scene;
    }

    struct Drawn {
        Picture picture;
        bool tangents; ///< the surface had them
    };
    static Drawn drawWith(const SceneFile& file, const GroupOptions& options, Scene scene, bool multisample = false) {
        SurfaceRenderer& renderer = *renderers_[multisample];
        const DrawTarget& target = targets_[multisample];
        const std::unique_ptr<Figure> figure = open(file);
        Result<std::unique_ptr<FigureGroup>> group = FigureGroup::create(*figure, options);
        EXPECT_TRUE(group.ok()) << (group.ok() ? "" : group.error().message);
        const SuppleGroup groups[] = {(*group)->handle()};
        EXPECT_TRUE(context_->evaluate(groups).ok());
        Result<FigureBinding> binding = renderer.bind(**group);
        EXPECT_TRUE(binding.ok());
        scene.group = group->get();
        scene.binding = &*binding;
        EXPECT_TRUE(renderer.prepare(scene).ok());
        const Status status =
            device_->submitAndWait([&](VkCommandBuffer commands) { renderer.record(commands, 0, target, scene); });
        EXPECT_TRUE(status.ok());
        Result<Picture> picture = readPicture(*device_, target.color().handle(), kStageSize, kPictureFormat);
        EXPECT_TRUE(picture.ok());
        return {*picture, (*group)->surfaces()[0].output.streams.tangents.buffer != VK_NULL_HANDLE};
    }
    static Picture draw(const SceneFile& file, const Scene& scene, bool cage = false, bool multisample = false) {
        Scene shown = scene;
        shown.cageFaces = cage;
        return drawWith(file, {.rate = 4}, shown, multisample).picture;
    }

    /// One square that faces the viewer, larger than the picture is high.
    static SceneFile square(const std::string& material, std::vector<Picture> images = {}) {
        SceneFile file;
        file.meshes = {test::squareMesh(glm::vec3(0.0f), kSquareHalf, 3, 0)};
        file.materials = {material};
        file.images = std::move(images);
        return file;
    }
};

/// Green of a place on a tile of the bumps, in the middle of a few pixels; `at`: from the tile's middle.
float bumpLight(const Picture& picture, uint32_t tileColumn, uint32_t tileRow, glm::vec2 at) {
    const float perUnit = float{kStageSize.height} / 4.2f;
    const glm::vec2 place = glm::vec2(tileColumn, -static_cast<float>(tileRow)) + at - glm::vec2(1.0f, -1.5f);
    const auto x = static_cast<uint32_t>(float{kStageSize.width} * 0.5f + place.x * perUnit);
    const auto y = static_cast<uint32_t>(float{kStageSize.height} * 0.5f - place.y * perUnit);
    uint32_t sum = 0;
    for (uint32_t row = y - 1; row <= y + 1; ++row) {
        for (uint32_t column = x - 1; column <= x + 1; ++column)
            sum += picture.pixel(column, row)[1];
    }
    return static_cast<float>(sum) / 9.0f;
}

void expectBumpsAlike(const Picture& picture) {
    const glm::vec2 flanks[] = {{-0.16f, 0.16f}, {0.16f, 0.16f}, {-0.16f, -0.16f}, {0.16f, -0.16f}};
    for (uint32_t row = 0; row < test::kBumpRows; ++row) {
        SCOPED_TRACE("row " + std::to_string(row));
        // The key is up and to the left: the sides differ by far more than the columns may, of which the first has
        // shadows.
        const auto shapedLight = [&](size_t flank) {
            return bumpLight(picture, test::kShapedBump, row, flanks[flank]);
        };
        EXPECT_GT(shapedLight(0), shapedLight(1) + 30.0f);
        EXPECT_GT(shapedLight(0), shapedLight(2) + 40.0f);
        EXPECT_GT(shapedLight(1), shapedLight(3) + 20.0f);
        for (size_t flank = 0; flank < std::size(flanks); ++flank) {
            const float mapped = bumpLight(picture, test::kMappedBump, row, flanks[flank]);
            EXPECT_NEAR(mapped, shapedLight(flank), 15.0f) << flank;
            EXPECT_NEAR(bumpLight(picture, test::kMirroredBump, row, flanks[flank]), mapped, 4.0f) << flank;
        }
    }
}

TEST_F(MaterialPictureTest, NormalMapsTurnLightAsBumpsDoMirroredOrNot) {
    const SceneFile bumps = test::bumpScene(false);
    const Scene scene = facing({1.0f, -1.5f}, 4.2f);
    for (const SuppleScheme scheme :
         {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_PREP, SUPPLE_SCHEME_BLEND, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_POLYGONS}) {
        SCOPED_TRACE("scheme " + std::to_string(scheme));
        const Drawn drawn = drawWith(bumps, {.scheme = scheme, .rate = 4}, scene);
        EXPECT_TRUE(drawn.tangents || scheme != SUPPLE_SCHEME_PM);
        expectBumpsAlike(drawn.picture);
    }
    {
        SCOPED_TRACE("polygons, with TANGENT in the file");
        expectBumpsAlike(drawWith(test::bumpScene(true), {.scheme = SUPPLE_SCHEME_POLYGONS}, scene).picture);
    }
    SCOPED_TRACE("cage");
    Scene cage = scene;
    cage.cageFaces = true;
    const Picture faces = drawWith(bumps, {.rate = 4}, cage).picture;
    // Its shaped bumps have facets: the mapped ones are compared with each other.
    for (uint32_t row = 0; row < test::kBumpRows; ++row) {
        for (const glm::vec2 at : {glm::vec2(-0.2f, 0.0f), glm::vec2(0.0f, -0.2f)})
            EXPECT_NEAR(bumpLight(faces, test::kMappedBump, row, at), bumpLight(faces, test::kMirroredBump, row, at),
                        8.0f);
    }
}

TEST_F(MaterialPictureTest, TangentsOfTheFileChangeNothing) {
    const Scene scene = facing({1.0f, -1.5f}, 4.2f);
    const Picture without = drawWith(test::bumpScene(false), {.rate = 4}, scene).picture;
    EXPECT_EQ(without.rgba, drawWith(test::bumpScene(true), {.rate = 4}, scene).picture.rgba);
}

TEST_F(MaterialPictureTest, NormalMapsMayBeTransformed) {
    // Texture coordinates that are turned and mirrored by the material: the bump is where and as it was.
    SceneFile plain = square(flatColor("[0.5,0.5,0.5,1]", R"(,"normalTexture":{"index":0})"));
    plain.images = test::bumpScene(false).images;
    SceneFile turned = plain;
    turned.materials = {flatColor("[0.5,0.5,0.5,1]",
                                  R"(,"normalTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
                                  R"({"rotation":1.5707963,"offset":[1,1],"scale":[-1,1]}}})")};
    const Picture asIs = draw(plain, facing()), transformed = draw(turned, facing());
    EXPECT_LE(furthest(asIs, transformed), 6);
    EXPECT_GT(furthest(asIs, draw(square(flatColor("[0.5,0.5,0.5,1]")), facing())), 30);
}

TEST_F(MaterialPictureTest, MetalMirrorsInItsOwnColorAndPlasticInWhite) {
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    const auto brightest = [&](const std::string& material) {
        ball.materials = {material};
        const Picture picture = draw(ball, facing());
        glm::ivec3 most(0);
        for (uint32_t y = 60; y < 140; ++y) {
            for (uint32_t x = 80; x < 160; ++x)
                most = glm::max(most, colorAt(picture, x, y));
        }
        return most;
    };
    const glm::ivec3 metal =
        brightest(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0,0,1],"roughnessFactor":0.4}})");
    EXPECT_GT(metal.x, 200);
    EXPECT_LT(metal.y, 160) << "only what the tone curve leads to white";
    EXPECT_LT(metal.z, 160);
    const glm::ivec3 plastic = brightest(
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1],"metallicFactor":0,"roughnessFactor":0.25}})");
    EXPECT_GT(plastic.x, 60) << "the soft box";
    EXPECT_LT(furthest(plastic, glm::ivec3(plastic.x)), 40);
}

TEST_F(MaterialPictureTest, MasksCutAndLetLightThrough) {
    const Picture left = texels([](uint32_t x, uint32_t) { return glm::u8vec4(255, 255, 255, x < 4 ? 255 : 0); });
    const std::string mask = R"({"alphaMode":"MASK","extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":)"
                             R"({"baseColorTexture":{"index":0},"baseColorFactor":[0.8,0.1,0.1,1]}})";
    SceneFile empty = square(R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.1]}})");
    for (const bool cage : {false, true}) {
        SCOPED_TRACE(cage ? "cage" : "surface");
        Scene scene = facing();
        scene.ground = -1.0f;
        scene.camera.pitch = 0.1f;
        const Picture cut = draw(square(mask, {left}), scene, cage);
        const Picture nothing = draw(empty, scene, cage);
        EXPECT_EQ(colorAt(cut, 90, 100), glm::ivec3(byteOf(0.8f), byteOf(0.1f), byteOf(0.1f)));
        EXPECT_EQ(colorAt(cut, 150, 100), colorAt(nothing, 150, 100));
        // All holes and no shadow: the floor is as it is beside a square that blends, which casts none.
        const Picture clear = draw(square(flatColor("[1,1,1,0]", R"(,"alphaMode":"BLEND")")), scene, cage);
        EXPECT_LE(furthest(nothing, clear), 1);
    }
}

TEST_F(MaterialPictureTest, BlendedPartsShowWhatIsBehindTheFarthestFirst) {
    SceneFile file;
    // The nearest comes first in the file.
    file.meshes = {test::squareMesh({0.0f, 0.0f, 0.6f}, kSquareHalf, 1, 0),
                   test::squareMesh({0.0f, 0.0f, 0.3f}, kSquareHalf, 1, 1),
                   test::squareMesh({0.0f, 0.0f, 0.0f}, kSquareHalf, 1, 2)};
    const std::string blend = R"(,"alphaMode":"BLEND","doubleSided":true)";
    file.materials = {unlitColor("[1,0,0,0.5]", blend), unlitColor("[0,1,0,0.5]", blend),
                      unlitColor("[0,0,1,1]", R"(,"doubleSided":true)")};
    for (const bool cage : {false, true}) {
        SCOPED_TRACE(cage ? "cage" : "surface");
        const glm::ivec3 front(byteOf(0.5f), byteOf(0.25f), byteOf(0.25f));
        for (const bool multisample : {false, true})
            EXPECT_LE(furthest(middleOf(draw(file, facing(), cage, multisample)), front), 1);
        // From behind the opaque one hides the others; without it the green one is in front.
        const Scene behind = facing({}, 2.0f, 3.14159265f);
        EXPECT_LE(furthest(middleOf(draw(file, behind, cage)), {0, 0, 255}), 1);
    }
    std::swap(file.meshes[0].material, file.meshes[2].material); // opaque blue in front, seen from behind
    const glm::ivec3 back(byteOf(0.5f), byteOf(0.25f), byteOf(0.25f));
    EXPECT_LE(furthest(middleOf(draw(file, facing({}, 2.0f, 3.14159265f))), back), 1);
}

/// Exporters often call a whole body BLEND: where it is solid it hides itself, whatever the order of its faces, and
/// casts its shadow.
TEST_F(MaterialPictureTest, BlendedMaterialsThatAreSolidLookAsOpaqueOnes) {
    for (const bool cage : {false, true}) {
        SceneFile file;
        file.meshes = {test::squareMesh({0.0f, 0.0f, 0.5f}, 0.4f, 2, 0)};
        const SceneMesh wall = test::squareMesh({0.0f, 0.0f, 0.0f}, kSquareHalf, 2, 0);
        const auto first = static_cast<uint32_t>(file.meshes[0].positions.size());
        file.meshes[0].positions.insert(file.meshes[0].positions.end(), wall.positions.begin(), wall.positions.end());
        file.meshes[0].normals.insert(file.meshes[0].normals.end(), wall.normals.begin(), wall.normals.end());
        file.meshes[0].uvs.assign(file.meshes[0].positions.size(), glm::vec2(0.0f));
        for (const glm::vec3& position : file.meshes[0].positions)
            file.meshes[0].colors.emplace_back(position.z > 0.2f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
        for (std::array<uint32_t, 4> quad : wall.quads) {
            for (uint32_t& corner : quad)
                corner += first;
            file.meshes[0].quads.push_back(quad);
        }
        Scene scene = facing();
        scene.ground = -1.0f;
        scene.camera.pitch = 0.1f;
        file.materials = {flatColor("[1,1,1,1]", R"(,"doubleSided":true)")};
        const SceneFile blended = [&] {
            SceneFile made = file;
            made.materials = {flatColor("[1,1,1,1]", R"(,"doubleSided":true,"alphaMode":"BLEND")")};
            return made;
        }();
        const Picture opaque = draw(file, scene, cage);
        EXPECT_LE(furthest(opaque, draw(blended, scene, cage)), 1) << (cage ? "cage" : "surface");
        EXPECT_LE(furthest(draw(file, scene, cage, true), draw(blended, scene, cage, true)), 1) << "multisampled";
        EXPECT_GT(middleOf(opaque).x, middleOf(opaque).z + 60) << "the near one is red";
    }
}

TEST_F(MaterialPictureTest, EmissionIsAddedWithItsStrengthAndItsTexture) {
    const Picture left = texels(
        [](uint32_t x, uint32_t) { return x < 4 ? glm::u8vec4(255, 255, 255, 255) : glm::u8vec4(0, 0, 0, 255); });
    const auto glowing = [](const std::string& strength) {
        return flatColor("[0,0,0,1]", R"(,"emissiveFactor":[0,0.25,0],"emissiveTexture":{"index":0},"extensions":)"
                                      R"({"KHR_materials_emissive_strength":{"emissiveStrength":)" +
                                          strength + "}}");
    };
    const Picture dark = draw(square(flatColor("[0,0,0,1]")), facing());
    const Picture once = draw(square(glowing("1"), {left}), facing());
    const Picture twice = draw(square(glowing("2"), {left}), facing());
    EXPECT_EQ(colorAt(once, 150, 100), colorAt(dark, 150, 100)) << "the texture is black there";
    EXPECT_NEAR(colorAt(once, 90, 100).y, byteOf(0.25f), 12);
    EXPECT_NEAR(colorAt(twice, 90, 100).y, byteOf(0.5f), 12);
    EXPECT_LT(colorAt(twice, 90, 100).x, 40);
}

TEST_F(MaterialPictureTest, UnlitIsTheBaseColorAndNothingElse) {
    const std::string color = R"([0.2,0.5,0.8,1])";
    const glm::ivec3 expected(byteOf(0.2f), byteOf(0.5f), byteOf(0.8f));
    for (const bool cage : {false, true}) {
        const Picture picture = draw(square(unlitColor(color)), facing(), cage);
        for (uint32_t x = 60; x < 180; x += 10)
            EXPECT_LE(furthest(colorAt(picture, x, 100), expected), 1) << x;
    }
    // Colors of vertices multiply it.
    SceneFile painted = square(unlitColor(color));
    painted.meshes[0].colors.assign(painted.meshes[0].positions.size(), glm::vec4(0.5f, 1.0f, 0.5f, 1.0f));
    const glm::ivec3 half(byteOf(0.1f), byteOf(0.5f), byteOf(0.4f));
    EXPECT_LE(furthest(middleOf(draw(painted, facing())), half), 1);
}

TEST_F(MaterialPictureTest, EachTextureHasItsOwnTransform) {
    const Picture left = texels(
        [](uint32_t x, uint32_t) { return x < 4 ? glm::u8vec4(255, 255, 255, 255) : glm::u8vec4(0, 0, 0, 255); });
    // The base color is as it lies; the emission is moved by half its width.
    const std::string material =
        R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0},"metallicFactor":0},)"
        R"("emissiveFactor":[0,0,1],"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0.5,0]}}}})";
    for (const bool cage : {false, true}) {
        const Picture picture = draw(square(material, {left}), facing(), cage);
        EXPECT_GT(colorAt(picture, 90, 100).x, 100);
        EXPECT_LT(colorAt(picture, 90, 100).z, 60);
        EXPECT_LT(colorAt(picture, 150, 100).x, 60);
        EXPECT_GT(colorAt(picture, 150, 100).z, 200);
    }
}

TEST_F(MaterialPictureTest, TexturesLieOnTheSecondCoordinatesIfTheFileSaysSo) {
    const Picture left = texels(
        [](uint32_t x, uint32_t) { return x < 4 ? glm::u8vec4(255, 255, 255, 255) : glm::u8vec4(0, 0, 0, 255); });
    SceneFile file = square(
        flatColor("[0,0,0,1]", R"(,"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0,"texCoord":1})"), {left});
    for (const glm::vec2 uv : file.meshes[0].uvs)
        file.meshes[0].uvs1.emplace_back(1.0f - uv.x, uv.y);
    for (const bool cage : {false, true}) {
        const Picture picture = draw(file, facing(), cage);
        EXPECT_LT(colorAt(picture, 90, 100).y, 60);
        EXPECT_GT(colorAt(picture, 150, 100).y, 200);
    }
}

TEST_F(MaterialPictureTest, TexturesThatCannotBeReadAreLeftOut) {
    const std::string maps =
        R"(,"normalTexture":{"index":0},"occlusionTexture":{"index":0},"emissiveTexture":{"index":0},)"
        R"("emissiveFactor":[0.1,0.1,0])";
    const std::string none = R"(,"emissiveFactor":[0.1,0.1,0])";
    const Picture broken = draw(square(flatColor("[0.5,0.5,0.5,1]", maps), {Picture{}}), facing());
    EXPECT_EQ(broken.rgba, draw(square(flatColor("[0.5,0.5,0.5,1]", none)), facing()).rgba);
}

TEST_F(MaterialPictureTest, TexturesInWebPAreShownWhereTheFirstImageCannotBe) {
    // Two pixels, lossless: red, and half covered blue.
    const unsigned char bytes[] = {0x52, 0x49, 0x46, 0x46, 0x20, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42, 0x50, 0x56, 0x50,
                                   0x38, 0x4C, 0x14, 0x00, 0x00, 0x00, 0x2F, 0x01, 0x00, 0x00, 0x10, 0x0F, 0x30, 0x40,
                                   0xFB, 0x3F, 0xFF, 0x0F, 0xFC, 0x0F, 0x2D, 0x54, 0x20, 0xA2, 0xFF, 0x01};
    SceneFile file = square(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":)"
                            R"({"KHR_materials_unlit":{}}})",
                            {Picture{}});
    file.samplers = {R"({"magFilter":9728,"minFilter":9728})"};
    file.webps = {{reinterpret_cast<const char*>(bytes), sizeof bytes}};
    const Picture picture = draw(file, facing());
    if (colorAt(picture, 80, 100) == glm::ivec3(255))
        GTEST_SKIP() << "left out: built without libwebp";
    EXPECT_LE(furthest(colorAt(picture, 70, 100), glm::ivec3(255, 0, 0)), 2);
    EXPECT_LE(furthest(colorAt(picture, 170, 100), glm::ivec3(0, 64, 255)), 2);
}

TEST_F(MaterialPictureTest, TexturesInKtx2AreShown) {
    for (const std::string name : {"etc1s", "etc1s_alpha", "uastc_alpha", "uastc_zstd", "uastc_zstd_alpha"}) {
        SCOPED_TRACE(name);
        std::ifstream stream(SUPPLE_TEST_DATA "/ktx2/" + name + ".ktx2", std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        const Result<Picture> decoded = decodePicture(std::as_bytes(std::span(bytes)), name);
        if (!decoded && decoded.error().message.find("built without Basis Universal") != std::string::npos)
            GTEST_SKIP() << "left out: built without Basis Universal";
        SceneFile file = square(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":)"
                                R"({"KHR_materials_unlit":{}}})",
                                {Picture{}});
        file.samplers = {R"({"magFilter":9728,"minFilter":9728})"};
        file.ktx2s = {bytes};
        const Picture picture = draw(file, facing());
        // ETC1S has five bits a channel, and steps of brightness.
        EXPECT_LE(furthest(colorAt(picture, 90, 80), glm::ivec3(255, 0, 0)), 4);
        EXPECT_LE(furthest(colorAt(picture, 150, 80), glm::ivec3(0, 255, 0)), 4);
        EXPECT_LE(furthest(colorAt(picture, 90, 120), glm::ivec3(0, 0, 255)), 4);
        EXPECT_LE(furthest(colorAt(picture, 150, 120), glm::ivec3(132, 66, 33)), 4);
    }
}

std::string layered(const std::string& color, const std::string& name, const std::string& members) {
    return flatColor(color, R"(,"extensions":{"KHR_materials_)" + name + R"(":{)" + members + "}}");
}

TEST_F(MaterialPictureTest, ACoatMirrorsOverARoughMaterial) {
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    for (const bool cage : {false, true}) {
        const auto drawn = [&](const std::string& material) {
            ball.materials = {material};
            return draw(ball, facing(), cage);
        };
        const auto brightest = [&](const Picture& picture) {
            int most = 0;
            for (uint32_t y = 60; y < 140; ++y) {
                for (uint32_t x = 80; x < 160; ++x)
                    most = std::max(most, colorAt(picture, x, y).y);
            }
            return most;
        };
        const std::string red = "[0.5,0,0,1]";
        const Picture bare = drawn(flatColor(red));
        EXPECT_GT(brightest(drawn(layered(red, "clearcoat", R"("clearcoatFactor":1)"))), brightest(bare) + 60);
        EXPECT_EQ(drawn(layered(red, "clearcoat", R"("clearcoatRoughnessFactor":1)")).rgba, bare.rgba)
            << "no coat changes no pixel";
        EXPECT_LT(brightest(drawn(layered(red, "specular", R"("specularFactor":0)"))), 40) << "what mirrors nothing";
    }
}

TEST_F(MaterialPictureTest, SheenBrightensWhatIsLookedAtFromAside) {
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    const auto at = [&](const std::string& material, uint32_t y) {
        ball.materials = {material};
        return colorAt(draw(ball, facing()), 120, y);
    };
    const std::string black = "[0.01,0.01,0.01,1]";
    const std::string sheen = layered(black, "sheen", R"("sheenColorFactor":[0.1,0.9,0.1],"sheenRoughnessFactor":0.3)");
    const glm::ivec3 edge = at(sheen, 26), middle = at(sheen, 100);
    EXPECT_GT(edge.y, middle.y + 40);
    EXPECT_GT(edge.y, edge.x + 40) << "in its own color";
    EXPECT_LE(furthest(middle, at(flatColor(black), 100)), 25);
}

/// How much wider than high the bright places of a picture lie.
double wideness(const Picture& picture) {
    double all = 0, x1 = 0, y1 = 0, x2 = 0, y2 = 0;
    for (uint32_t y = 50; y < 150; ++y) {
        for (uint32_t x = 70; x < 170; ++x) {
            const double bright = std::max(colorAt(picture, x, y).y - 150, 0);
            all += bright;
            x1 += bright * x, y1 += bright * y;
            x2 += bright * x * x, y2 += bright * y * y;
        }
    }
    return std::sqrt((x2 / all - x1 * x1 / (all * all)) / (y2 / all - y1 * y1 / (all * all)));
}

TEST_F(MaterialPictureTest, AnisotropyStretchesHighlights) {
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    const auto drawn = [&](const std::string& members, bool cage) {
        ball.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.3},"extensions":)"
                          R"({"KHR_materials_anisotropy":{)" +
                          members + "}}}"};
        return draw(ball, facing(), cage);
    };
    for (const bool cage : {false, true}) {
        const double even = wideness(drawn("", cage));
        const double across = wideness(drawn(R"("anisotropyStrength":0.8)", cage));
        const double along = wideness(drawn(R"("anisotropyStrength":0.8,"anisotropyRotation":1.5708)", cage));
        EXPECT_GT(across, 1.1 * even) << "to the right, where the first coordinate grows";
        EXPECT_LT(along, even / 1.1) << "up";
        EXPECT_EQ(drawn(R"("anisotropyRotation":1)", cage).rgba, drawn("", cage).rgba)
            << "no strength changes no pixel";
    }
}

TEST_F(MaterialPictureTest, LightThatGoesIntoAVolumeComesOutBehindTheEdgeOfShadow) {
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    const std::string through = R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.8,0.8,1],"metallicFactor":0},)"
                                R"("extensions":{"KHR_materials_volume":{"thicknessFactor":1.6,)"
                                R"("attenuationDistance":0.2,"attenuationColor":[0.8,0.1,0.02]},)"
                                R"("KHR_materials_diffuse_transmission":{"diffuseTransmissionColorFactor":[1,1,1])";
    for (const bool cage : {false, true}) {
        ball.materials = {through + "}}}"};
        const Picture bare = draw(ball, facing(), cage);
        ball.materials = {through + R"(,"diffuseTransmissionFactor":0.8}}})"};
        const Picture picture = draw(ball, facing(), cage);
        int redder = 0;
        for (uint32_t step = 0; step < 80; ++step) { // from the key's side to the other
            const glm::ivec3 with = colorAt(picture, 90 + step, 70 + step),
                             without = colorAt(bare, 90 + step, 70 + step);
            redder = std::max(redder, with.x - with.z - (without.x - without.z));
        }
        EXPECT_GT(redder, 12);
        EXPECT_LE(furthest(colorAt(picture, 85, 65), colorAt(bare, 85, 65)), 60) << "towards the key it is white still";
    }
}

TEST_F(MaterialPictureTest, LeavesShowLightFromBehind) {
    const auto middle = [](const std::string& members) {
        return middleOf(draw(square(layered("[0.2,0.2,0.2,1]", "diffuse_transmission", members)), facing()));
    };
    const glm::ivec3 bare = middle(R"("diffuseTransmissionColorFactor":[0,1,0])");
    const glm::ivec3 leaf = middle(R"("diffuseTransmissionFactor":1,"diffuseTransmissionColorFactor":[0.1,1,0.1])");
    EXPECT_LT(std::abs(bare.x - bare.y), 25);
    EXPECT_GT(leaf.y, bare.y + 25);
    EXPECT_GT(leaf.y, leaf.x + 40) << "in its own color";
    Picture green = Picture::blank(1, 1);
    green.rgba = {89, 255, 89, 255}; // sRGB of the color above
    const glm::ivec3 mapped =
        middleOf(draw(square(layered("[0.2,0.2,0.2,1]", "diffuse_transmission",
                                     R"("diffuseTransmissionFactor":1,"diffuseTransmissionColorTexture":{"index":0})"),
                             {green}),
                      facing()));
    EXPECT_LE(furthest(mapped, leaf), 3);
}

TEST_F(MaterialPictureTest, ThickGlassTakesAwayLight) {
    const auto behind = [](const std::string& volume) {
        SceneFile file = square(unlitColor("[0.5,0.5,0.5,1]"));
        file.materials.push_back(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":)"
                                 R"({"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_volume":{)" +
                                 volume + "}}}");
        file.meshes.push_back(test::squareMesh(glm::vec3(0.0f, 0.0f, 0.3f), kSquareHalf, 4, 1));
        return middleOf(draw(file, facing()));
    };
    const std::string green = R"("attenuationDistance":0.5,"attenuationColor":[0.25,1,0.25],"thicknessFactor":)";
    const glm::ivec3 none = behind(""), thin = behind(green + "0"), thick = behind(green + "1");
    EXPECT_EQ(thin, none) << "a thin wall has no inside";
    EXPECT_LT(thick.x, none.x - 60);
    EXPECT_GE(thick.y, none.y - 3);
}

TEST_F(MaterialPictureTest, GlassShowsWhatIsBehindInItsColor) {
    const std::string pane = R"("transmissionFactor":1)";
    const auto scene = [&](const std::string& glass, const std::vector<Picture>& images = {}) {
        SceneFile file = square(unlitColor("[0.5,0.5,0.5,1]"), images);
        file.materials.push_back(glass);
        file.meshes.push_back(test::squareMesh(glm::vec3(0.0f, 0.0f, 0.3f), kSquareHalf, 4, 1));
        return file;
    };
    const std::string smooth = R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.2,0.2,1],"metallicFactor":0,)"
                               R"("roughnessFactor":0},"extensions":{"KHR_materials_transmission":{)";
    for (const auto& [cage, multisample] : {std::pair(false, false), {false, true}, {true, false}}) {
        const glm::ivec3 red = middleOf(draw(scene(smooth + pane + "}}}"), facing(), cage, multisample));
        EXPECT_NEAR(red.x, byteOf(0.5f), 25) << "what is behind, and a little that is mirrored";
        EXPECT_LT(red.y, byteOf(0.15f) + 25);
    }
    // Where a texture says that nothing goes through, it hides all.
    const Picture left = texels(
        [](uint32_t x, uint32_t) { return x < 4 ? glm::u8vec4(255, 255, 255, 255) : glm::u8vec4(0, 0, 0, 255); });
    const std::string half = smooth + pane + R"(,"transmissionTexture":{"index":0}}}})";
    SceneFile file = scene(half, {left});
    file.materials[0] = unlitColor("[0,0,1,1]");
    const Picture picture = draw(file, facing());
    EXPECT_LT(colorAt(picture, 70, 100).x, 120) << "blue through red";
    EXPECT_GT(colorAt(picture, 170, 100).x, 120);
}

TEST_F(MaterialPictureTest, GroundGlassBlursWhatIsBehind) {
    const Picture stripes = texels(
        [](uint32_t x, uint32_t) { return x % 2 == 0 ? glm::u8vec4(255, 255, 255, 255) : glm::u8vec4(0, 0, 0, 255); });
    const auto contrast = [&](const std::string& roughness) {
        SceneFile file = square(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":)"
                                R"({"KHR_materials_unlit":{}}})",
                                {stripes});
        file.materials.push_back(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":)" + roughness +
                                 R"(},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}})");
        file.meshes.push_back(test::squareMesh(glm::vec3(0.0f, 0.0f, 0.3f), kSquareHalf, 4, 1));
        const Picture picture = draw(file, facing());
        int least = 255, most = 0;
        for (uint32_t x = 70; x < 170; ++x) {
            least = std::min(least, colorAt(picture, x, 100).y);
            most = std::max(most, colorAt(picture, x, 100).y);
        }
        return most - least;
    };
    EXPECT_GT(contrast("0"), 150);
    EXPECT_LT(contrast("0.8"), 40);
}

TEST_F(MaterialPictureTest, AThinFilmColorsWhatIsMirrored) {
    const Picture black = texels([](uint32_t, uint32_t) { return glm::u8vec4(0, 0, 0, 255); });
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    ball.images = {black};
    for (const bool cage : {false, true}) {
        const auto drawn = [&](const std::string& members) {
            ball.materials = {R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.8,0.8,1],"metallicFactor":1,)"
                              R"("roughnessFactor":0.6},"extensions":{"KHR_materials_iridescence":{)" +
                              members + "}}}"};
            return draw(ball, facing(), cage);
        };
        const auto colored = [&](const std::string& members) {
            const glm::ivec3 color = colorAt(drawn(members), 120, 100);
            return color - (color.x + color.y + color.z) / 3;
        };
        const std::string film = R"("iridescenceFactor":1,"iridescenceIor":1.8)";
        const std::string thick = R"(,"iridescenceThicknessMaximum":)";
        const Picture bare = drawn("");
        EXPECT_EQ(drawn(R"("iridescenceIor":1.8)").rgba, bare.rgba) << "no film changes no pixel";
        // There and back a wave goes through 3.6 times the thickness. Both sides of the film turn it, so whole wave
        // lengths come back together: of green, which is 550 nanometres long, at 306. At 229 they cancel out.
        EXPECT_GT(colored(film + thick + "306").y, colored(film + thick + "229").y + 20);
        EXPECT_LT(colored(film + thick + "229").y, -10);
        EXPECT_EQ(drawn(film + thick + R"(400,"iridescenceTexture":{"index":0})").rgba, bare.rgba) << "by its red";
        EXPECT_EQ(drawn(film + thick + R"(400,"iridescenceThicknessTexture":{"index":0})").rgba,
                  drawn(film + thick + "100").rgba)
            << "the least, which is 100";
    }
}

TEST_F(MaterialPictureTest, TexturesOfLayersMultiplyTheirFactors) {
    // Without alpha, and black: what is multiplied by any of its channels is nothing.
    const Picture nothing = texels([](uint32_t, uint32_t) { return glm::u8vec4(0, 0, 0, 0); });
    const struct {
        const char *layer, *factors, *texture, *without;
    } cases[] = {
        {"specular", "", "specularTexture", R"("specularFactor":0)"},
        {"specular", "", "specularColorTexture", R"("specularColorFactor":[0,0,0])"},
        {"sheen", R"("sheenColorFactor":[0.5,1,0.5],"sheenRoughnessFactor":0.5)", "sheenColorTexture", ""},
        {"sheen", R"("sheenColorFactor":[0.5,1,0.5],"sheenRoughnessFactor":0.5)", "sheenRoughnessTexture",
         R"("sheenColorFactor":[0.5,1,0.5])"},
        {"clearcoat", R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.6)", "clearcoatTexture", ""},
        {"clearcoat", R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.6)", "clearcoatRoughnessTexture",
         R"("clearcoatFactor":1)"},
        {"transmission", R"("transmissionFactor":0.8)", "transmissionTexture", ""},
        {"diffuse_transmission", R"("diffuseTransmissionFactor":0.8,"diffuseTransmissionColorFactor":[1,0.2,0.2])",
         "diffuseTransmissionTexture", ""},
    };
    SceneFile ball;
    ball.meshes = {test::ballMesh(glm::vec3(0.0f), 0.8f, 6, 0)};
    ball.images = {nothing};
    for (const auto& [layer, factors, texture, without] : cases) {
        SCOPED_TRACE(texture);
        const auto drawn = [&](const std::string& members) {
            ball.materials = {layered("[0.4,0.3,0.2,1]", layer, members)};
            return draw(ball, facing());
        };
        const std::string factor = factors;
        const Picture with = drawn(factor + (factor.empty() ? "\"" : ",\"") + texture + R"(":{"index":0})");
        EXPECT_NE(with.rgba, drawn(factor).rgba);
        EXPECT_LE(furthest(with, drawn(without)), 1);
    }
}

TEST_F(MaterialPictureTest, TexturesOfLayersThatAreTooManyAreNamed) {
    std::string layers;
    for (
        const char* const members :
        {R"("clearcoat":{"clearcoatFactor":1,"clearcoatTexture":#,"clearcoatRoughnessTexture":#,"clearcoatNormalTexture":#})",
         R"("sheen":{"sheenColorFactor":[1,1,1],"sheenColorTexture":#,"sheenRoughnessTexture":#})",
         R"("transmission":{"transmissionFactor":0.5,"transmissionTexture":#})",
         R"("specular":{"specularTexture":#,"specularColorTexture":#})",
         R"("iridescence":{"iridescenceFactor":1,"iridescenceTexture":#,"iridescenceThicknessTexture":#})"}) {
        layers.append(layers.empty() ? "" : ",").append("\"KHR_materials_").append(members + 1);
    }
    for (size_t at = layers.find('#'); at != std::string::npos; at = layers.find('#'))
        layers.replace(at, 1, R"({"index":0})");
    SceneFile file = square(flatColor("[0.5,0.5,0.5,1]", R"(,"name":"beetle","extensions":{)" + layers + "}"),
                            {texels([](uint32_t, uint32_t) { return glm::u8vec4(128, 128, 255, 255); })});
    testing::internal::CaptureStderr();
    (void)draw(file, facing());
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("material beetle: iridescenceTexture, iridescenceThicknessTexture: left out, as 8 textures"),
              std::string::npos)
        << said;
}

TEST_F(MaterialPictureTest, OcclusionDimsLightFromAllRound) {
    const Picture left = texels([](uint32_t x, uint32_t) { return glm::u8vec4(x < 4 ? 255 : 0, 0, 0, 255); });
    const auto at = [&](const std::string& strength, uint32_t x) {
        const std::string material =
            flatColor("[0.6,0.6,0.6,1]", R"(,"occlusionTexture":{"index":0,"strength":)" + strength + "}");
        return colorAt(draw(square(material, {left}), facing()), x, 100).y;
    };
    const int open = colorAt(draw(square(flatColor("[0.6,0.6,0.6,1]")), facing()), 150, 100).y;
    EXPECT_NEAR(at("1", 90), colorAt(draw(square(flatColor("[0.6,0.6,0.6,1]")), facing()), 90, 100).y, 1);
    EXPECT_LT(at("1", 150), open - 15);
    EXPECT_GT(at("1", 150), 40) << "the key still shines";
    EXPECT_NEAR(at("0", 150), open, 1);
}

TEST_F(MaterialPictureTest, BackFacesAreDrawnIfTheFileSaysSo) {
    const Scene behind = facing({}, 2.0f, 3.14159265f);
    SceneFile clear = square(R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.1]}})");
    const glm::ivec3 backdrop = middleOf(draw(clear, behind));
    for (const bool cage : {false, true}) {
        EXPECT_EQ(middleOf(draw(square(unlitColor("[0,1,0,1]")), behind, cage)), backdrop);
        const SceneFile both = square(unlitColor("[0,1,0,1]", R"(,"doubleSided":true)"));
        EXPECT_EQ(middleOf(draw(both, behind, cage)), glm::ivec3(0, 255, 0));
        Scene normals = behind; // other views show what there is
        normals.view = shared::kViewNormals;
        EXPECT_NE(middleOf(draw(square(unlitColor("[0,1,0,1]")), normals, cage)), backdrop);
    }
}

TEST(EnvironmentTest, DirectionsAndPlacesAreInverse) {
    for (uint32_t i = 0; i < 500; ++i) {
        const float height = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 500.0f;
        const float out = std::sqrt(1.0f - height * height), angle = 2.39996323f * static_cast<float>(i);
        const glm::vec3 direction(out * std::cos(angle), height, out * std::sin(angle));
        EXPECT_LT(glm::distance(octahedralDirection(octahedralPlace(direction)), direction), 1e-5f);
    }
}

TEST(EnvironmentTest, LevelsBlurAndHaveNoSeam) {
    const StudioEnvironment environment = studioEnvironment();
    ASSERT_EQ(environment.levels.size(), size_t{shared::kEnvironmentLevels});
    float sharpest[4] = {2.0f, 2.0f, 2.0f, 2.0f};
    for (uint32_t level = 0; level < environment.levels.size(); ++level) {
        const uint32_t size = shared::kEnvironmentSize >> level;
        const std::vector<glm::vec4>& texels = environment.levels[level];
        ASSERT_EQ(texels.size(), size_t{size} * size);
        glm::vec4 most(0.0f);
        for (const glm::vec4& texel : texels) {
            most = glm::max(most, texel);
            for (int k = 0; k < 4; ++k)
                EXPECT_GE(texel[k], 0.0f);
        }
        for (int k = 0; k < 3; ++k) {
            EXPECT_LT(most[k], sharpest[k] + 1e-3f) << "level " << level;
            EXPECT_GT(most[k], 0.0f);
            sharpest[k] = most[k];
        }
        // Texels of the border are two of one direction each.
        for (uint32_t i = 0; i < size; ++i) {
            EXPECT_LT(glm::distance(texels[i], texels[size - 1 - i]), 1e-4f);
            EXPECT_LT(glm::distance(texels[size_t{i} * size], texels[size_t{size - 1 - i} * size]), 1e-4f);
        }
    }
    // A white mirror that faces the key, as rough as can be, gives about the light that a white wall does.
    EXPECT_GT(environment.keyRadiance, 2.0f);
    EXPECT_LT(environment.keyRadiance, 12.0f);
}

} // namespace
} // namespace supple::host
