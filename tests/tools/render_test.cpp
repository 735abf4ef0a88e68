// Pictures: what is drawn stands where it should, is the same from run to run, and draws without a word from the
// validation layer. Judging beauty stays with people.
#include "host/surface_renderer.h"
#include "tests/tools/validated_device.h"
#include "tools/common/figure_file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <random>

namespace supple::host {
namespace {

constexpr VkExtent2D kSize{240, 200};
constexpr float kMargin = 0.08f;

/// One device for all pictures, under the validation layer where it is installed.
class RenderTest : public testing::Test {
protected:
    static void SetUpTestSuite() {
        Result<std::unique_ptr<Device>> device = createValidatedDevice();
        ASSERT_TRUE(device.ok()) << device.error().message;
        device_ = std::move(*device);
        Result<std::unique_ptr<Context>> context = Context::create(*device_);
        ASSERT_TRUE(context.ok()) << context.error().message;
        context_ = std::move(*context);
        Result<std::unique_ptr<SurfaceRenderer>> renderer =
            SurfaceRenderer::create(*device_, {.quality = StudioQuality::interactive(true)});
        ASSERT_TRUE(renderer.ok()) << renderer.error().message;
        renderer_ = std::move(*renderer);
        Result<DrawTarget> target = DrawTarget::create(*device_, kSize, renderer_->samples());
        ASSERT_TRUE(target.ok()) << target.error().message;
        target_ = std::move(*target);
        Result<std::unique_ptr<Figure>> figure = openFigure(*context_, std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
        ASSERT_TRUE(figure.ok()) << figure.error().message;
        figure_ = std::move(*figure);
    }

    static void TearDownTestSuite() {
        figure_.reset();
        target_ = {};
        renderer_.reset();
        context_.reset();
        if (device_ == nullptr)
            return;
        const std::shared_ptr<const ValidationLog> validation = device_->validation();
        device_.reset();
        EXPECT_EQ(validation->messageCount(), 0u);
    }

    void SetUp() override { ASSERT_NE(figure_, nullptr); }
    void TearDown() override { EXPECT_EQ(device_->validation()->messageCount(), 0u); }

    static std::unique_ptr<FigureGroup> makeGroup(GroupOptions options = {.rate = 4}) {
        Result<std::unique_ptr<FigureGroup>> group = FigureGroup::create(*figure_, options);
        EXPECT_TRUE(group.ok()) << (group.ok() ? "" : group.error().message);
        return std::move(*group);
    }

    static void evaluate(FigureGroup& group) {
        const SuppleGroup groups[] = {group.handle()};
        const Status status = context_->evaluate(groups);
        ASSERT_TRUE(status.ok()) << status.error().message;
    }

    static Scene frontScene(const FigureGroup& group, float yaw) {
        const Result<std::vector<glm::vec3>> points = group.readSurface();
        EXPECT_TRUE(points.ok());
        Scene scene;
        scene.camera = frameCamera(*points, yaw, 0.2f, static_cast<float>(kSize.width) / kSize.height, kMargin);
        scene.bounds = boundsOf(*points);
        scene.lightYaw = yaw;
        return scene;
    }

    static Picture draw(const FigureGroup& group, Scene scene) {
        Result<FigureBinding> binding = renderer_->bind(group);
        EXPECT_TRUE(binding.ok());
        scene.group = &group;
        scene.binding = &*binding;
        EXPECT_TRUE(renderer_->prepare(scene).ok());
        const Status status =
            device_->submitAndWait([&](VkCommandBuffer commands) { renderer_->record(commands, 0, target_, scene); });
        EXPECT_TRUE(status.ok());
        Result<Picture> picture = readPicture(*device_, target_.color().handle(), kSize, kPictureFormat);
        EXPECT_TRUE(picture.ok());
        return *picture;
    }

    static inline std::unique_ptr<Device> device_;
    static inline std::unique_ptr<Context> context_;
    static inline std::unique_ptr<SurfaceRenderer> renderer_;
    static inline DrawTarget target_;
    static inline std::unique_ptr<Figure> figure_;
};

/// In the normals view the figure is vivid and the backdrop is grey.
bool isFigure(const Picture& normals, uint32_t x, uint32_t y) {
    const uint8_t* pixel = normals.pixel(x, y);
    return *std::max_element(pixel, pixel + 3) - *std::min_element(pixel, pixel + 3) > 48;
}

struct Silhouette {
    double coverage = 0.0; ///< share of the picture
    uint32_t left = kSize.width;
    uint32_t right = 0;
    uint32_t top = kSize.height;
    uint32_t bottom = 0;
};

Silhouette silhouette(const Picture& normals) {
    Silhouette found;
    uint32_t count = 0;
    for (uint32_t y = 0; y < normals.height; ++y) {
        for (uint32_t x = 0; x < normals.width; ++x) {
            if (!isFigure(normals, x, y))
                continue;
            ++count;
            found.left = std::min(found.left, x);
            found.right = std::max(found.right, x);
            found.top = std::min(found.top, y);
            found.bottom = std::max(found.bottom, y);
        }
    }
    found.coverage = static_cast<double>(count) / (normals.width * normals.height);
    return found;
}

/// Mean difference of a channel, 0..255.
double difference(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.rgba.size(); ++i)
        sum += std::abs(static_cast<int>(a.rgba[i]) - static_cast<int>(b.rgba[i]));
    return sum / static_cast<double>(a.rgba.size());
}

TEST_F(RenderTest, FigureFillsTheFrameUpToItsMargin) {
    const std::unique_ptr<FigureGroup> group = makeGroup();
    evaluate(*group);
    Scene scene = frontScene(*group, 0.6f);
    scene.view = shared::kViewNormals;
    const Silhouette seen = silhouette(draw(*group, scene));
    EXPECT_GT(seen.coverage, 0.12);
    EXPECT_LT(seen.coverage, 0.70);
    // It touches the margin in one direction, on both sides, and stays inside in the other.
    const double tall = static_cast<double>(seen.bottom - seen.top + 1) / kSize.height;
    const double wide = static_cast<double>(seen.right - seen.left + 1) / kSize.width;
    EXPECT_NEAR(std::max(tall, wide), 1.0 - 2.0 * kMargin, 0.03);
}

TEST_F(RenderTest, EveryViewDrawsAndDiffersFromTheOthers) {
    const std::unique_ptr<FigureGroup> group = makeGroup();
    evaluate(*group);
    Scene scene = frontScene(*group, 0.6f);
    scene.ground = scene.bounds.min.y;
    std::vector<Picture> pictures;
    for (const uint32_t view :
         {shared::kViewShaded, shared::kViewWire, shared::kViewPatches, shared::kViewNormals, shared::kViewZebra}) {
        scene.view = view;
        pictures.push_back(draw(*group, scene));
        EXPECT_EQ(difference(pictures.back(), draw(*group, scene)), 0.0) << "view " << view << ", drawn twice";
    }
    for (size_t i = 0; i < pictures.size(); ++i) {
        for (size_t j = i + 1; j < pictures.size(); ++j)
            EXPECT_GT(difference(pictures[i], pictures[j]), 1.0) << "views " << i << " and " << j;
    }
}

TEST_F(RenderTest, CageAndSurfaceCoverAboutTheSamePixels) {
    const std::unique_ptr<FigureGroup> group = makeGroup();
    evaluate(*group);
    Scene scene = frontScene(*group, 0.6f);
    scene.view = shared::kViewNormals;
    const Picture surface = draw(*group, scene);
    scene.cageFaces = true;
    const Picture cage = draw(*group, scene);
    uint32_t both = 0;
    uint32_t either = 0;
    for (uint32_t y = 0; y < kSize.height; ++y) {
        for (uint32_t x = 0; x < kSize.width; ++x) {
            const bool inSurface = isFigure(surface, x, y);
            const bool inCage = isFigure(cage, x, y);
            both += inSurface && inCage ? 1 : 0;
            either += inSurface || inCage ? 1 : 0;
        }
    }
    EXPECT_GT(static_cast<double>(both) / either, 0.80);
    EXPECT_GT(silhouette(cage).coverage, silhouette(surface).coverage) << "the surface shrinks from its cage";
    scene.cageFaces = false;
    scene.cageEdges = true;
    EXPECT_GT(difference(surface, draw(*group, scene)), 0.5) << "the cage's lines";
}

TEST_F(RenderTest, BothVertexFormatsGiveTheSamePicture) {
    Picture pictures[2];
    for (const SuppleVertexFormat format : {SUPPLE_VERTEX_16, SUPPLE_VERTEX_24}) {
        const std::unique_ptr<FigureGroup> group = makeGroup({.rate = 4, .vertexFormat = format});
        evaluate(*group);
        pictures[format] = draw(*group, frontScene(*group, 0.6f));
    }
    EXPECT_LT(difference(pictures[0], pictures[1]), 0.05);
}

TEST_F(RenderTest, TurningTheFigureAndTheCameraTogetherChangesNothing) {
    const std::unique_ptr<FigureGroup> group = makeGroup();
    evaluate(*group);
    const Picture before = draw(*group, frontScene(*group, 0.6f));
    const glm::mat4 quarterTurn = glm::rotate(glm::mat4(1.0f), glm::half_pi<float>(), glm::vec3(0.0f, 1.0f, 0.0f));
    ASSERT_EQ(suppleSetTransform(context_->handle(), group->instance(0), &quarterTurn[0][0]), SUPPLE_OK);
    evaluate(*group);
    const Picture after = draw(*group, frontScene(*group, 0.6f + glm::half_pi<float>()));
    // Shadow maps fall on other texels; nothing else may move.
    EXPECT_LT(difference(before, after), 0.6);
}

TEST_F(RenderTest, InstancesStandWhereTheirTransformsPutThem) {
    const std::unique_ptr<FigureGroup> group = makeGroup({.instances = 2, .rate = 4});
    const glm::mat4 aside = glm::translate(glm::mat4(1.0f), glm::vec3(3.0f, 0.0f, 0.0f));
    ASSERT_EQ(suppleSetTransform(context_->handle(), group->instance(1), &aside[0][0]), SUPPLE_OK);
    evaluate(*group);
    Scene scene = frontScene(*group, 0.0f);
    scene.view = shared::kViewNormals;
    const Picture picture = draw(*group, scene);
    double halves[2] = {};
    for (uint32_t y = 0; y < kSize.height; ++y) {
        for (uint32_t x = 0; x < kSize.width; ++x)
            halves[x * 2 / kSize.width] += isFigure(picture, x, y) ? 1.0 : 0.0;
    }
    EXPECT_GT(halves[0], 500.0);
    EXPECT_NEAR(halves[0] / halves[1], 1.0, 0.1);
}

/// Slots of visible instances are no longer counted from 0 without a gap; neither surface, cage nor shadow may mistake
/// one for another.
TEST_F(RenderTest, InstancesAreDrawnByTheirSlotsWhenOthersAreHidden) {
    const std::unique_ptr<FigureGroup> group = makeGroup({.instances = 3, .rate = 4});
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 2.0f, glm::vec3(0.0f, 1.0f, 0.0f));
    const glm::mat4 aside = glm::translate(glm::mat4(1.0f), glm::vec3(30.0f, 0.0f, 0.0f));
    for (const uint32_t instance : {0u, 2u})
        ASSERT_EQ(suppleSetTransform(context_->handle(), group->instance(instance), &aside[0][0]), SUPPLE_OK);
    ASSERT_EQ(suppleSetTransform(context_->handle(), group->instance(1), &turned[0][0]), SUPPLE_OK);
    for (const uint32_t instance : {0u, 2u})
        ASSERT_TRUE(group->setVisible(instance, false).ok());
    ASSERT_EQ(group->visibleCount(), 1u);
    // As many instances, for the grid of shadows follows their number; its only visible one has slot 0.
    const std::unique_ptr<FigureGroup> alone = makeGroup({.instances = 3, .rate = 4});
    for (const uint32_t instance : {1u, 2u})
        ASSERT_TRUE(alone->setVisible(instance, false).ok());
    ASSERT_EQ(suppleSetTransform(context_->handle(), alone->instance(0), &turned[0][0]), SUPPLE_OK);
    evaluate(*group);
    evaluate(*alone);
    for (const bool cage : {false, true}) {
        Scene scene = frontScene(*alone, 0.6f);
        scene.ground = scene.bounds.min.y;
        scene.cageFaces = cage;
        scene.cageEdges = true;
        EXPECT_EQ(draw(*group, scene).rgba, draw(*alone, scene).rgba) << (cage ? "the cage" : "the surface");
    }
}

/// A hidden part is neither drawn nor casts a shadow, as surface and as cage: without its only part, an instance leaves
/// the picture that it leaves if it is not visible.
TEST_F(RenderTest, HiddenPartsLeaveNothing) {
    ASSERT_EQ(figure_->partNames().size(), 1u);
    for (const bool mesh : {false, true}) {
        const std::unique_ptr<FigureGroup> group = makeGroup({.rate = 4, .sharedSamples = mesh});
        evaluate(*group);
        Scene scene = frontScene(*group, 0.6f);
        scene.ground = scene.bounds.min.y;
        for (const bool cage : {false, true}) {
            SCOPED_TRACE(cage ? "the cage" : "the surface");
            scene.cageFaces = cage;
            scene.cageEdges = true;
            const auto picture = [&](bool visible, bool partVisible) {
                EXPECT_TRUE(group->setVisible(0, visible).ok());
                EXPECT_TRUE(group->setPartVisible(0, partVisible).ok());
                EXPECT_EQ(group->isPartVisible(0), partVisible);
                evaluate(*group);
                return draw(*group, scene).rgba;
            };
            const std::vector<uint8_t> shown = picture(true, true), hidden = picture(true, false);
            EXPECT_NE(shown, hidden);
            EXPECT_EQ(hidden, picture(false, true));
            EXPECT_EQ(shown, picture(true, true));
        }
    }
}

/// Both buffers have room between their instances that nothing writes, and what is read back must not show it.
TEST_F(RenderTest, PositionsReadBackAreThoseOfVerticesAlone) {
    Result<std::unique_ptr<Figure>> helmet = openFigure(*context_, std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    ASSERT_TRUE(helmet.ok()) << helmet.error().message;
    constexpr uint32_t kInstances = 2;
    Result<std::unique_ptr<FigureGroup>> group = FigureGroup::create(**helmet, {.instances = kInstances, .rate = 2});
    ASSERT_TRUE(group.ok()) << group.error().message;
    const glm::vec3 aside(100.0f, 0.0f, 0.0f);
    const glm::mat4 transform = glm::translate(glm::mat4(1.0f), aside);
    ASSERT_EQ(suppleSetTransform(context_->handle(), (*group)->instance(1), &transform[0][0]), SUPPLE_OK);
    evaluate(**group);
    const std::vector<glm::vec3>& rest = (*helmet)->cage().positions;
    ASSERT_GT((*group)->surfaces()[0].output.info.cageVerticesPerInstance, rest.size()) << "a cage that leaves room";
    const Result<std::vector<glm::vec3>> cage = (*group)->readCage();
    ASSERT_TRUE(cage.ok());
    ASSERT_EQ(cage->size(), kInstances * rest.size());
    for (size_t i = 0; i < rest.size(); ++i) {
        EXPECT_LT(glm::distance((*cage)[i], rest[i]), 1e-4f) << i;
        EXPECT_LT(glm::distance((*cage)[rest.size() + i], rest[i] + aside), 1e-4f) << i;
    }
    const Result<std::vector<glm::vec3>> surface = (*group)->readSurface();
    ASSERT_TRUE(surface.ok());
    EXPECT_EQ(surface->size(), kInstances * (*group)->surfaces()[0].output.grid.vertexCount);
}

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::vector<uint8_t> fileBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

const std::string kPainted = R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}}})";

/// A cube of six quads, every side with the whole of the picture on it, texture 0 of the material and the sampler.
std::string texturedCube(const std::filesystem::path& directory, const Picture& picture, const std::string& material,
                         const std::string& sampler) {
    const std::filesystem::path png = directory / "texture.png";
    EXPECT_TRUE(writePng(picture, png.string()).ok());
    std::vector<float> floats; // 24 positions, then 24 UVs
    std::vector<float> uvs;
    std::vector<uint16_t> indices;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const float sign = side % 2 == 0 ? 1.0f : -1.0f;
        const auto first = static_cast<uint16_t>(side * 4);
        for (int corner = 0; corner < 4; ++corner) {
            const float u = corner == 1 || corner == 2 ? 1.0f : -1.0f;
            const float v = corner >= 2 ? 1.0f : -1.0f;
            float position[3];
            position[axis] = sign;
            position[(axis + 1) % 3] = u * sign;
            position[(axis + 2) % 3] = v;
            floats.insert(floats.end(), position, position + 3);
            uvs.push_back(u * sign * 0.5f + 0.5f);
            uvs.push_back(0.5f - v * 0.5f);
        }
        for (const int corner : {0, 1, 2, 0, 2, 3})
            indices.push_back(static_cast<uint16_t>(first + corner));
    }
    floats.insert(floats.end(), uvs.begin(), uvs.end());
    std::vector<uint8_t> bytes(floats.size() * 4 + indices.size() * 2);
    std::memcpy(bytes.data(), floats.data(), floats.size() * 4);
    std::memcpy(bytes.data() + floats.size() * 4, indices.data(), indices.size() * 2);
    const std::string gltf =
        R"({"asset":{"version":"2.0"},"extensionsUsed":["FB_ngon_encoding"],"scene":0,"scenes":[{"nodes":[0]}],)"
        R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,)"
        R"("material":0,"extensions":{"FB_ngon_encoding":{}}}]}],)"
        R"("materials":[)" +
        material + R"(],"textures":[{"source":0,"sampler":0}],"samplers":[)" + sampler +
        R"(],"images":[{"uri":"data:image/png;base64,)" + base64(fileBytes(png)) +
        R"("}],"accessors":[{"bufferView":0,"componentType":5126,"count":24,"type":"VEC3","min":[-1,-1,-1],)"
        R"("max":[1,1,1]},{"bufferView":1,"componentType":5126,"count":24,"type":"VEC2"},)"
        R"({"bufferView":2,"componentType":5123,"count":36,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":288},{"buffer":0,"byteOffset":288,"byteLength":192},)"
        R"({"buffer":0,"byteOffset":480,"byteLength":72}],"buffers":[{"byteLength":552,)"
        R"("uri":"data:application/octet-stream;base64,)" +
        base64(bytes) + R"("}]})";
    const std::filesystem::path file = directory / "cube.gltf";
    std::ofstream(file) << gltf;
    return file.string();
}

/// The cube, evaluated, from its +Z side: there the picture's U runs along +X and its V down.
class CubeTest : public RenderTest {
protected:
    Picture look(const Picture& picture, bool cage, const std::string& material = kPainted,
                 const std::string& sampler = "{}") {
        const std::filesystem::path directory =
            std::filesystem::temp_directory_path() / ("supple_render_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(directory);
        Result<std::unique_ptr<Figure>> cube =
            openFigure(*context_, texturedCube(directory, picture, material, sampler));
        std::filesystem::remove_all(directory);
        EXPECT_TRUE(cube.ok()) << cube.error().message;
        Result<std::unique_ptr<FigureGroup>> group = FigureGroup::create(**cube, {.rate = 8});
        EXPECT_TRUE(group.ok()) << group.error().message;
        evaluate(**group);
        Scene scene = frontScene(**group, 0.0f);
        scene.cageFaces = cage;
        scene.camera.distance *= 1.5f; // the cage is larger
        return draw(**group, scene);
    }

    /// The left half red, the right half blue.
    static Picture halves() {
        Picture picture = Picture::blank(16, 16);
        for (uint32_t y = 0; y < 16; ++y) {
            for (uint32_t x = 0; x < 16; ++x)
                picture.pixel(x, y)[x < 8 ? 0 : 2] = 230;
        }
        return picture;
    }

    /// 'r', 'b' or '?' at a place near the middle.
    static char colorAt(const Picture& seen, float x, float y) {
        const uint8_t* pixel =
            seen.pixel(static_cast<uint32_t>(x * kSize.width), static_cast<uint32_t>(y * kSize.height));
        const int redder = int{pixel[0]} - int{pixel[2]};
        return redder > 40 ? 'r' : redder < -40 ? 'b' : '?';
    }

    /// Of the cage's side in the middle row, at these fractions of its width.
    static std::string colorsAlong(const Picture& seen, std::initializer_list<float> places) {
        float left = 1.0f, right = 0.0f;
        for (uint32_t x = 0; x < kSize.width; ++x) {
            const float at = (static_cast<float>(x) + 0.5f) / kSize.width;
            if (colorAt(seen, at, 0.5f) != '?') {
                left = std::min(left, at);
                right = std::max(right, at);
            }
        }
        EXPECT_GT(right - left, 0.2f);
        std::string colors;
        for (const float place : places)
            colors += colorAt(seen, left + place * (right - left), 0.5f);
        return colors;
    }

    /// The base color with a transform.
    static std::string transformed(const std::string& transform) {
        return R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0,"extensions":)"
               R"({"KHR_texture_transform":)" +
               transform + "}}}}";
    }
};

TEST_F(CubeTest, TexturesLieWhereTheirUvsPutThem) {
    for (const bool cage : {false, true}) {
        const Picture seen = look(halves(), cage);
        EXPECT_EQ(colorAt(seen, 0.45f, 0.5f), 'r') << "to the left";
        EXPECT_EQ(colorAt(seen, 0.55f, 0.5f), 'b') << "to the right";
    }
}

TEST_F(CubeTest, TexturesAreTransformed) {
    for (const bool cage : {false, true}) {
        SCOPED_TRACE(cage ? "cage" : "surface");
        const Picture mirrored = look(halves(), cage, transformed(R"({"scale":[-1,1],"offset":[1,0]})"));
        EXPECT_EQ(colorAt(mirrored, 0.45f, 0.5f), 'b');
        EXPECT_EQ(colorAt(mirrored, 0.55f, 0.5f), 'r');
        // Counter-clockwise by a right angle: what was looked up to the right now is further up.
        const Picture turned = look(halves(), cage, transformed(R"({"rotation":1.5707963267948966,"offset":[0,1]})"));
        EXPECT_EQ(colorAt(turned, 0.5f, 0.42f), 'r') << "up";
        EXPECT_EQ(colorAt(turned, 0.5f, 0.62f), 'b') << "down";
    }
}

TEST_F(CubeTest, TexturesWrapAsTheirSamplersSay) {
    const std::string twice = transformed(R"({"scale":[2,1]})");
    const auto seen = [&](const char* wrap) {
        const Picture picture = look(halves(), true, twice, std::string(R"({"magFilter":9728,"wrapS":)") + wrap + "}");
        return colorsAlong(picture, {0.1f, 0.4f, 0.6f, 0.9f});
    };
    EXPECT_EQ(seen("10497"), "rbrb") << "repeat";
    EXPECT_EQ(seen("33071"), "rbbb") << "clamp to edge";
    EXPECT_EQ(seen("33648"), "rbbr") << "mirrored repeat";
}

TEST_F(CubeTest, MetalAndRoughnessAreTheTexturesTimesTheFactors) {
    Picture picture = Picture::blank(4, 4); // roughness 1, metallic 0.5
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
            picture.pixel(x, y)[1] = 255;
            picture.pixel(x, y)[2] = 128;
        }
    }
    const auto seen = [&](bool cage, const std::string& surface) {
        return look(picture, cage, R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},)" + surface + "}}");
    };
    const auto difference = [](const Picture& a, const Picture& b) {
        int most = 0;
        for (size_t i = 0; i < a.rgba.size(); ++i)
            most = std::max(most, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
        return most;
    };
    const std::string texture = R"(,"metallicRoughnessTexture":{"index":0})";
    for (const bool cage : {false, true}) {
        SCOPED_TRACE(cage ? "cage" : "surface");
        const Picture half = seen(cage, R"("metallicFactor":0.5019608,"roughnessFactor":0.5)");
        const Picture looked = seen(cage, R"("metallicFactor":1,"roughnessFactor":0.5)" + texture);
        EXPECT_LE(difference(half, looked), 1) << "green and blue are numbers, not sRGB colors";
        EXPECT_GT(difference(half, seen(cage, R"("metallicFactor":1,"roughnessFactor":0.5)")), 20);
        EXPECT_GT(difference(half, seen(cage, R"("metallicFactor":0.5019608,"roughnessFactor":0.15)")), 10);
    }
}

TEST(PictureTest, PngKeepsEveryPixel) {
    Picture picture = Picture::blank(37, 11);
    for (size_t i = 0; i < picture.rgba.size(); ++i)
        picture.rgba[i] = static_cast<uint8_t>(i * 7 + i / 5);
    const std::string path =
        (std::filesystem::temp_directory_path() / ("supple_picture_" + std::to_string(std::random_device()()) + ".png"))
            .string();
    ASSERT_TRUE(writePng(picture, path).ok());
    const Result<Picture> read = readPng(path);
    std::remove(path.c_str());
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->width, 37u);
    EXPECT_EQ(read->height, 11u);
    EXPECT_EQ(read->rgba, picture.rgba);
}

TEST(PictureTest, WhatIsNoPictureIsRefused) {
    const std::byte noise[] = {std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}, std::byte{0}};
    const Result<Picture> decoded = decodePicture(noise, "image 3");
    ASSERT_FALSE(decoded.ok());
    EXPECT_EQ(decoded.error().code, ErrorCode::asset);
    EXPECT_EQ(decoded.error().message.rfind("image 3: ", 0), 0u);
    EXPECT_FALSE(readPng("/nowhere/at/all.png").ok());
    EXPECT_FALSE(writePng(Picture::blank(2, 2), "/nowhere/at/all.png").ok());
}

TEST(PictureTest, TheMeanIsTakenInLinearLight) {
    Picture black = Picture::blank(1, 1);
    Picture white = Picture::blank(1, 1);
    std::fill(white.rgba.begin(), white.rgba.end(), uint8_t{255});
    PictureAverage average(1, 1);
    average.add(black);
    average.add(white);
    EXPECT_EQ(average.picture().rgba[0], 188); // half the light
    PictureAverage single(1, 1);
    single.add(white);
    EXPECT_EQ(single.picture().rgba[0], 255);
}

TEST(CameraTest, FramedPointsAreInsideAndTouchTheMargin) {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 200; ++i) {
        const auto t = static_cast<float>(i);
        points.emplace_back(3.0f * std::sin(t), std::cos(2.0f * t) + 0.2f * t, std::sin(5.0f * t));
    }
    for (const float aspect : {0.5f, 1.0f, 2.5f}) {
        const Camera camera = frameCamera(points, 0.7f, 0.3f, aspect, kMargin);
        const glm::mat4 toClip = camera.projection(aspect, boundsOf(points).radius()) * camera.view();
        float reach = 0.0f;
        for (const glm::vec3& point : points) {
            const glm::vec4 clip = toClip * glm::vec4(point, 1.0f);
            ASSERT_GT(clip.w, 0.0f);
            EXPECT_GT(clip.z, 0.0f);
            EXPECT_LT(clip.z, clip.w);
            reach = std::max({reach, std::abs(clip.x / clip.w), std::abs(clip.y / clip.w)});
        }
        EXPECT_NEAR(reach, 1.0f - 2.0f * kMargin, 1e-3f);
    }
}

TEST(DeviceTest, UnknownDeviceIsNamedWithWhatThereIs) {
    const Result<std::unique_ptr<Device>> device = Device::create({.device = "no such thing"});
    ASSERT_FALSE(device.ok());
    EXPECT_EQ(device.error().code, ErrorCode::unsupported);
    EXPECT_NE(device.error().message.find("no such thing"), std::string::npos);
}

} // namespace
} // namespace supple::host
