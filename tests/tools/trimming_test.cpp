// Trimmed surfaces: the contour is where the image says, to the pixel, for every scheme and at every rate; light falls
// through the holes; multisampling covers what the contour leaves. Drawn under the validation layer.
#include "cage/materials.h"
#include "cage/single_joint.h"
#include "host/surface_renderer.h"
#include "tests/tools/two_renderers.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/character_file.h"
#include "tools/common/figure_file.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <unistd.h>

namespace supple::host {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kCells = 6; ///< of the sheet, a side
constexpr float kHalf = 1.5f;  ///< of its width

using Distance = std::function<float(glm::vec2)>; ///< from a contour in the unit square, negative in the hole

float circle(glm::vec2 at, float radius) {
    return glm::length(at - 0.5f) - radius;
}
float straight(glm::vec2 at) {
    return glm::dot(at - glm::vec2(0.5f, 0.45f), glm::normalize(glm::vec2(0.3f, 1.0f)));
}

/// Side by side: images whose value passes a half at the contour.
std::vector<std::byte> imageOf(const std::vector<Distance>& tiles, bool inAlpha = false) {
    constexpr uint32_t kTexels = 128;
    Picture picture = Picture::blank(kTexels * static_cast<uint32_t>(tiles.size()), kTexels);
    for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x) {
            const glm::vec2 at = (glm::vec2(x % kTexels, y) + 0.5f) / float{kTexels};
            const float value = std::clamp(0.5f + tiles[x / kTexels](at) * 16.0f, 0.0f, 1.0f);
            uint8_t* pixel = picture.pixel(x, y);
            std::fill(pixel, pixel + 4, uint8_t{255});
            pixel[inAlpha ? 3 : 0] = static_cast<uint8_t>(std::lround(value * 255.0f));
        }
    }
    const fs::path path = fs::path(testing::TempDir()) / ("supple_trim_" + std::to_string(getpid()) + ".png");
    EXPECT_TRUE(writePng(picture, path.string()).ok());
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> chars{std::istreambuf_iterator<char>(stream), {}};
    fs::remove(path);
    std::vector<std::byte> bytes(chars.size());
    std::memcpy(bytes.data(), chars.data(), chars.size());
    return bytes;
}

/// A square of kCells cells a side that a function places; (s, t) run over the unit square, t downwards.
void addSheet(cage::Cage& cage, uint32_t material, const std::function<glm::vec3(glm::vec2)>& place) {
    const uint32_t first = cage.vertexCount();
    for (uint32_t j = 0; j <= kCells; ++j) {
        for (uint32_t i = 0; i <= kCells; ++i) {
            cage.positions.push_back(place(glm::vec2(i, j) / float{kCells}));
        }
    }
    if (cage.faceStarts.empty()) {
        cage.faceStarts.push_back(0);
    }
    for (uint32_t j = 0; j < kCells; ++j) {
        for (uint32_t i = 0; i < kCells; ++i) {
            const glm::uvec2 corners[] = {{i, j + 1}, {i + 1, j + 1}, {i + 1, j}, {i, j}};
            for (const glm::uvec2& corner : corners) {
                cage.faceVertices.push_back(first + corner.y * (kCells + 1) + corner.x);
                cage.cornerUvs.push_back(glm::vec2(corner) / float{kCells});
            }
            cage.faceStarts.push_back(cage.cornerCount());
            cage.faceMaterials.push_back(material);
        }
    }
}

glm::vec3 flat(glm::vec2 at) {
    return {kHalf * (2.0f * at.x - 1.0f), kHalf * (1.0f - 2.0f * at.y), 0.0f};
}
glm::vec3 curved(glm::vec2 at) {
    const glm::vec3 p = flat(at);
    return {p.x, p.y, -0.35f * glm::dot(p, p)};
}

constexpr cage::Texture kClamped{.image = 0, .wrapU = cage::Wrap::clampToEdge, .wrapV = cage::Wrap::clampToEdge};

cage::Character sheet(const std::function<glm::vec3(glm::vec2)>& place) {
    cage::Character character;
    addSheet(character.cage, 0, place);
    character.materials = {cage::namedMaterial("")};
    cage::bindToOneJoint(character, "sheet");
    return character;
}

/// Trimmed on its UVs.
cage::Character trimmedSheet(const std::function<glm::vec3(glm::vec2)>& place, const Distance& contour) {
    cage::Character character = sheet(place);
    character.images = {{"trim", "image/png", imageOf({contour})}};
    character.materials[0].trim = cage::Trim{.texture = kClamped};
    return character;
}

class TrimmingTest : public TwoRenderers {
protected:
    static std::unique_ptr<Figure> open(const cage::Character& character) {
        const Result<cage::GlbFile> glb = cage::writeGlb(character);
        EXPECT_TRUE(glb.ok()) << (glb.ok() ? "" : glb.error().message);
        const fs::path path = fs::path(testing::TempDir()) / ("supple_trim_" + std::to_string(getpid()) + ".glb");
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(glb->bytes.data()), static_cast<std::streamsize>(glb->bytes.size()));
        Result<std::unique_ptr<Figure>> figure = openFigure(*context_, path.string());
        fs::remove(path);
        EXPECT_TRUE(figure.ok()) << (figure.ok() ? "" : figure.error().message);
        return std::move(*figure);
    }

    static Scene front() {
        Scene scene;
        scene.camera.distance = 6.0f;
        scene.camera.fieldOfView = 2.0f * std::atan(kHalf * 0.9f / scene.camera.distance);
        scene.bounds.add(glm::vec3(-kHalf));
        scene.bounds.add(glm::vec3(kHalf));
        scene.view = shared::kViewNormals;
        return scene;
    }

    static Picture draw(const cage::Character& character, const GroupOptions& options, Scene scene,
                        bool multisample = false) {
        const std::unique_ptr<Figure> figure = open(character);
        Result<std::unique_ptr<FigureGroup>> group = FigureGroup::create(*figure, options);
        EXPECT_TRUE(group.ok()) << (group.ok() ? "" : group.error().message);
        const SuppleGroup groups[] = {(*group)->handle()};
        EXPECT_TRUE(context_->evaluate(groups).ok());
        Result<FigureBinding> binding = renderers_[multisample]->bind(**group);
        EXPECT_TRUE(binding.ok());
        scene.group = group->get();
        scene.binding = &*binding;
        EXPECT_TRUE(renderers_[multisample]->prepare(scene).ok());
        EXPECT_TRUE(device_
                        ->submitAndWait([&](VkCommandBuffer commands) {
                            renderers_[multisample]->record(commands, 0, targets_[multisample], scene);
                        })
                        .ok());
        Result<Picture> picture =
            readPicture(*device_, targets_[multisample].color().handle(), kStageSize, kPictureFormat);
        EXPECT_TRUE(picture.ok());
        return *picture;
    }
};

/// In the normals view the sheet is vivid and the backdrop is grey.
bool isSheet(const Picture& normals, uint32_t x, uint32_t y) {
    const uint8_t* pixel = normals.pixel(x, y);
    return *std::max_element(pixel, pixel + 3) - *std::min_element(pixel, pixel + 3) > 48;
}

/// Where a pixel of the front view meets the flat sheet, in its unit square; and how wide a pixel is there.
constexpr float kPixel = 0.9f / float{kStageSize.height};
glm::vec2 onSheet(uint32_t x, uint32_t y) {
    return 0.5f + (glm::vec2(x, y) + 0.5f - glm::vec2(kStageSize.width, kStageSize.height) * 0.5f) * kPixel;
}

/// Pixels that are on the wrong side of the contour though they are more than `margin` pixels away from it.
uint32_t wrongPixels(const Picture& picture, const Distance& contour, float margin) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < kStageSize.height; ++y) {
        for (uint32_t x = 0; x < kStageSize.width; ++x) {
            const glm::vec2 at = onSheet(x, y);
            const glm::vec2 fromRim = glm::min(at, 1.0f - at);
            if (std::min(fromRim.x, fromRim.y) < 2.0f * kPixel ||
                std::max(fromRim.x, fromRim.y) < 1.0f / float{kCells}) {
                continue; // the sheet's own rim, and its corners, two of which Loop rounds off
            }
            const float away = contour(at) / kPixel;
            count += std::abs(away) > margin && isSheet(picture, x, y) != (away > 0.0f) ? 1 : 0;
        }
    }
    return count;
}

uint32_t differentPixels(const Picture& a, const Picture& b) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < kStageSize.height; ++y) {
        for (uint32_t x = 0; x < kStageSize.width; ++x) {
            count += isSheet(a, x, y) != isSheet(b, x, y) ? 1 : 0;
        }
    }
    return count;
}

const Distance kCircle = [](glm::vec2 at) { return circle(at, 0.3f); };
const Distance kStraight = [](glm::vec2 at) { return straight(at); };

constexpr std::pair<SuppleScheme, const char*> kSchemes[] = {{SUPPLE_SCHEME_PM, "P_m"},
                                                             {SUPPLE_SCHEME_PREP, "p-rep"},
                                                             {SUPPLE_SCHEME_FRAGMENTS, "Catmull-Clark"},
                                                             {SUPPLE_SCHEME_LOOP, "Loop"}};

TEST_F(TrimmingTest, ContoursAreWhereTheImageSaysInEveryScheme) {
    for (const auto& [contour, name] : {std::pair(kCircle, "circle"), std::pair(kStraight, "straight")}) {
        const cage::Character character = trimmedSheet(flat, contour);
        for (const auto& [scheme, schemeName] : kSchemes) {
            SCOPED_TRACE(std::string(name) + ", " + schemeName);
            const Picture coarse = draw(character, {.scheme = scheme, .rate = 4}, front());
            const Picture fine = draw(character, {.scheme = scheme, .rate = 16}, front());
            const uint32_t different = differentPixels(coarse, fine);
            RecordProperty(std::string(name) + " " + schemeName, static_cast<int>(different));
            std::printf("%s, %s: %u pixels differ between rates 4 and 16\n", name, schemeName, different);
            EXPECT_LE(different, 4u);
            EXPECT_EQ(wrongPixels(coarse, contour, 0.35f), 0u);
            EXPECT_EQ(wrongPixels(fine, contour, 0.35f), 0u);
        }
    }
}

TEST_F(TrimmingTest, ContoursOnACurvedSheetKeepWithTheRate) {
    for (const auto& [contour, name] : {std::pair(kCircle, "circle"), std::pair(kStraight, "straight")}) {
        const cage::Character character = trimmedSheet(curved, contour);
        const Picture whole[] = {draw(sheet(curved), {.rate = 4}, front()), draw(sheet(curved), {.rate = 16}, front())};
        const Picture picture[] = {draw(character, {.rate = 4}, front()), draw(character, {.rate = 16}, front())};
        const uint32_t outline = differentPixels(whole[0], whole[1]);
        const uint32_t contours = differentPixels(picture[0], picture[1]);
        std::printf("%s: %u pixels differ between rates 4 and 16, of the untrimmed sheet %u\n", name, contours,
                    outline);
        EXPECT_LE(contours, outline + 16) << "of about 380 along the contour";
        EXPECT_GT(differentPixels(picture[1], whole[1]), 5000u);
    }
}

TEST_F(TrimmingTest, FacesHaveTilesInEveryScheme) {
    cage::Character character = sheet(flat);
    const std::vector<Distance> tiles = {[](glm::vec2) { return 1.0f; }, [](glm::vec2 at) { return circle(at, 0.35f); },
                                         [](glm::vec2 at) { return at.y - 0.6f; }};
    character.images = {{"strip", "image/png", imageOf(tiles)}};
    character.materials[0].trim = cage::Trim{.domain = cage::TrimDomain::face, .texture = {.image = 0}, .tiles = 3};
    for (uint32_t f = 0; f < character.cage.faceCount(); ++f) {
        character.cage.faceTrimTiles.push_back(f % 4 == 3 ? cage::kNone : f % 4);
    }
    // Corner 0 of a face is its lower left one: there v is 0.
    const Distance contour = [&](glm::vec2 at) {
        const glm::vec2 cell = glm::min(glm::floor(at * float{kCells}), float{kCells} - 1.0f);
        const glm::vec2 in = at * float{kCells} - cell;
        const uint32_t tile = (static_cast<uint32_t>(cell.y) * kCells + static_cast<uint32_t>(cell.x)) % 4;
        const glm::vec2 border = glm::min(in, 1.0f - in) * (1.0f / float{kCells});
        if (std::min(border.x, border.y) < 0.6f * kPixel) {
            return 0.0f; // between faces: either one's
        }
        return tile == 3 ? 1.0f : tiles[tile]({in.x, 1.0f - in.y}) / float{kCells};
    };
    for (const auto& [scheme, schemeName] : kSchemes) {
        for (const uint32_t rate : {4u, 16u}) {
            SCOPED_TRACE(std::string(schemeName) + " at rate " + std::to_string(rate));
            EXPECT_EQ(wrongPixels(draw(character, {.scheme = scheme, .rate = rate}, front()), contour, 0.4f), 0u);
        }
    }
}

TEST_F(TrimmingTest, AMaskDrawsAsTheTrim) {
    const cage::Character trim = trimmedSheet(flat, kCircle);
    cage::Character mask = trim;
    mask.images[0].bytes = imageOf({kCircle}, true);
    cage::Material& material = mask.materials[0];
    material.trim.reset();
    material.alphaMode = cage::AlphaMode::mask;
    material.baseColorTexture = kClamped;
    EXPECT_EQ(differentPixels(draw(trim, {}, front()), draw(mask, {}, front())), 0u);

    // The trim wins, whatever the mask would take away.
    mask.materials[0].trim = trim.materials[0].trim;
    mask.materials[0].trim->texture.image = 1;
    mask.materials[0].baseColorFactor.a = 0.0f;
    mask.images.push_back(trim.images[0]);
    EXPECT_EQ(differentPixels(draw(trim, {}, front()), draw(mask, {}, front())), 0u);
}

float linear(uint8_t value) {
    const float x = static_cast<float>(value) / 255.0f;
    return x < 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

TEST_F(TrimmingTest, MultisampledContoursCoverTheirShare) {
    if (renderers_[1]->samples() == VK_SAMPLE_COUNT_1_BIT) {
        GTEST_SKIP() << "the device has one sample a pixel";
    }
    const Picture whole = draw(sheet(flat), {}, front(), true);
    const Picture none = draw(trimmedSheet(flat, [](glm::vec2) { return -1.0f; }), {}, front(), true);
    const Picture hole = draw(trimmedSheet(flat, kCircle), {}, front(), true);
    double area = 0.0;
    uint32_t partial = 0;
    for (uint32_t y = 0; y < kStageSize.height; ++y) {
        for (uint32_t x = 0; x < kStageSize.width; ++x) {
            const float full = linear(whole.pixel(x, y)[2]), empty = linear(none.pixel(x, y)[2]);
            if (full - empty < 0.1f) {
                continue;
            }
            const float taken = (full - linear(hole.pixel(x, y)[2])) / (full - empty);
            area += taken;
            partial += taken > 0.15f && taken < 0.85f ? 1 : 0;
        }
    }
    const double radius = 0.3 / kPixel, expected = 3.14159265 * radius * radius;
    std::printf("hole of %.1f pixels, %.1f expected; %u pixels partly covered\n", area, expected, partial);
    EXPECT_NEAR(area, expected, 0.25 * 2.0 * 3.14159265 * radius) << "a quarter of a pixel along the contour";
    EXPECT_GT(partial, 150u) << "of about 420 along the contour";
}

TEST_F(TrimmingTest, LightFallsThroughHoles) {
    // A sheet over a larger one, seen from the side: what is lit below it is what the upper one lets through.
    const auto pair = [](bool trimmed) {
        cage::Character character;
        addSheet(character.cage, 0,
                 [](glm::vec2 at) { return glm::vec3(3.0f * at.x - 1.5f, 1.2f, 3.0f * at.y - 1.5f); });
        addSheet(character.cage, 1,
                 [](glm::vec2 at) { return glm::vec3(6.0f * at.x - 3.0f, 0.0f, 6.0f * at.y - 3.0f); });
        character.materials.assign(2, cage::namedMaterial(""));
        if (trimmed) {
            character.images = {{"trim", "image/png", imageOf({kCircle})}};
            character.materials[0].trim = cage::Trim{.texture = {.image = 0}};
        }
        cage::bindToOneJoint(character, "sheets");
        return character;
    };
    Scene scene;
    scene.camera = {.target = glm::vec3(0.0f, 0.3f, 0.0f), .pitch = 0.16f, .distance = 14.0f};
    scene.bounds.add(glm::vec3(-3.0f, 0.0f, -3.0f));
    scene.bounds.add(glm::vec3(3.0f, 1.2f, 3.0f));
    const Picture whole = draw(pair(false), {}, scene);
    const Picture hole = draw(pair(true), {}, scene);
    uint32_t brighter = 0, darker = 0;
    for (uint32_t y = kStageSize.height / 2; y < kStageSize.height; ++y) { // the lower sheet is below the middle
        for (uint32_t x = 0; x < kStageSize.width; ++x) {
            const int change = int{hole.pixel(x, y)[1]} - int{whole.pixel(x, y)[1]};
            brighter += change > 20 ? 1 : 0;
            darker += change < -4 ? 1 : 0;
        }
    }
    if (const char* folder = std::getenv("SUPPLE_TEST_PICTURES")) {
        EXPECT_TRUE(writePng(whole, std::string(folder) + "/shadow_whole.png").ok());
        EXPECT_TRUE(writePng(hole, std::string(folder) + "/shadow_hole.png").ok());
    }
    std::printf("%u pixels brighter, %u darker\n", brighter, darker);
    EXPECT_GT(brighter, 150u);
    EXPECT_EQ(darker, 0u);
}

TEST_F(TrimmingTest, TheHelmetHasItsHolesInEveryScheme) {
    const Result<CharacterFile> file = readCharacterFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/helmet.glb");
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_LT(file->bytes.size(), 200'000u);
    EXPECT_TRUE(file->character.warnings.empty());
    ASSERT_EQ(file->character.materials.size(), 3u);
    EXPECT_FALSE(file->character.materials[0].trim);
    EXPECT_TRUE(file->character.materials[1].trim && file->character.materials[2].trim);
    cage::Character whole = file->character;
    for (cage::Material& material : whole.materials) {
        material.trim.reset();
    }
    Scene scene = front();
    scene.camera.fieldOfView *= 1.2f;
    for (const auto& [scheme, schemeName] : kSchemes) {
        const GroupOptions options{.scheme = scheme};
        EXPECT_GT(differentPixels(draw(file->character, options, scene), draw(whole, options, scene)), 400u)
            << schemeName << ": through the breathing holes one sees the floor's side";
    }
}

/// On a cage of triangles to hexagons, given as arrays: every sample of a patch lies in the tile of the face the patch
/// is of, however the scheme split or subdivided it.
TEST_F(TrimmingTest, FaceCoordinatesAreTheirFaces) {
    Result<CharacterFile> file = readCharacterFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip.glb");
    ASSERT_TRUE(file.ok());
    cage::Cage& cage = file->character.cage;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        cage.faceTrimTiles.push_back(f % 7 == 0 ? cage::kNone : f % SUPPLE_MAX_TRIM_TILES);
    }
    const CageArrays arrays(cage);
    SuppleAssetDesc assetDesc{};
    assetDesc.structSize = sizeof(assetDesc);
    assetDesc.name = "pip with tiles";
    assetDesc.cage = &arrays.desc;
    SuppleAsset asset{};
    ASSERT_EQ(suppleCreateAsset(context_->handle(), &assetDesc, &asset), SUPPLE_OK);
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS, SUPPLE_SCHEME_LOOP}) {
        SCOPED_TRACE(scheme);
        SuppleGroupDesc desc{};
        desc.structSize = sizeof(desc);
        desc.flags = SUPPLE_GROUP_ATTRIBUTES;
        desc.asset = asset;
        desc.capacity = 1;
        desc.scheme = scheme;
        desc.rate = 4;
        SuppleGroup group{};
        ASSERT_EQ(suppleCreateGroup(context_->handle(), &desc, &group), SUPPLE_OK);
        SuppleInstance instance{};
        ASSERT_EQ(suppleCreateInstance(context_->handle(), group, &instance), SUPPLE_OK);
        ASSERT_TRUE(context_->evaluate({&group, 1}).ok());
        host::GroupOutput output{};
        ASSERT_EQ(host::getGroupOutput(context_->handle(), group, output), SUPPLE_OK);
        std::vector<SupplePatchInfo> patches(output.surface.patchCount);
        uint32_t count = output.surface.patchCount;
        ASSERT_EQ(suppleGetPatches(context_->handle(), group, 0, patches.data(), &count), SUPPLE_OK);
        ASSERT_EQ(output.streams.faceUvs.stride, sizeof(glm::vec2));
        const Result<std::vector<std::byte>> bytes = device_->readBuffer(output.streams.faceUvs);
        ASSERT_TRUE(bytes.ok());
        uint32_t wrong = 0;
        for (uint32_t r = 0; r < output.grid.drawRangeCount; ++r) {
            const SuppleDrawRange& range = output.grid.drawRanges[r];
            for (uint32_t i = 0; i < range.patchCount * range.samplesPerPatch; ++i) {
                glm::vec2 at;
                std::memcpy(&at, bytes->data() + (range.firstVertex + i) * sizeof(at), sizeof(at));
                const uint32_t tile = cage.faceTrimTiles[patches[range.firstPatch + i / range.samplesPerPatch].face];
                const float expected = tile == cage::kNone ? -1.0f : static_cast<float>(tile);
                const glm::vec2 in(at.x - 2.0f * expected, at.y);
                const bool inside = glm::all(glm::greaterThanEqual(in, glm::vec2(-1e-3f))) &&
                                    glm::all(glm::lessThanEqual(in, glm::vec2(1.001f)));
                wrong += inside && std::floor(0.5f * at.x + 0.25f) == expected ? 0 : 1;
            }
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(suppleDestroyGroup(context_->handle(), group), SUPPLE_OK);
    }
    EXPECT_EQ(suppleDestroyAsset(context_->handle(), asset), SUPPLE_OK);
}

TEST_F(TrimmingTest, HostsAreToldWhatTheyNeed) {
    cage::Character character = trimmedSheet(flat, kCircle);
    character.materials[0].name = "shell";
    character.materials[0].doubleSided = true;
    character.materials[0].trim->channel = 2;
    character.materials[0].trim->cutoff = 0.25f;
    const std::unique_ptr<Figure> figure = open(character);
    SuppleMaterialInfo material{};
    material.structSize = sizeof(material);
    ASSERT_EQ(suppleGetMaterialInfo(context_->handle(), figure->asset(), 0, &material), SUPPLE_OK);
    EXPECT_STREQ(material.name, "shell");
    EXPECT_EQ(material.doubleSided, 1u);
    EXPECT_EQ(material.trimDomain, SUPPLE_TRIM_UV);
    EXPECT_EQ(material.trim.image, 0u);
    EXPECT_EQ(material.trim.uvSet, 0u);
    EXPECT_EQ(material.trimChannel, 2u);
    EXPECT_EQ(material.trimCutoff, 0.25f);
    EXPECT_EQ(material.trimFactor, 1.0f);
    EXPECT_EQ(material.trimAlpha, 0u);
    EXPECT_EQ(material.trim.wrap[0], SUPPLE_WRAP_CLAMP);
    SuppleImageInfo image{};
    image.structSize = sizeof(image);
    ASSERT_EQ(suppleGetImageInfo(context_->handle(), figure->asset(), material.trim.image, &image), SUPPLE_OK);
    EXPECT_STREQ(image.mimeType, "image/png");
    ASSERT_EQ(image.byteCount, character.images[0].bytes.size());
    EXPECT_EQ(std::memcmp(image.bytes, character.images[0].bytes.data(), image.byteCount), 0);

    EXPECT_EQ(suppleGetMaterialInfo(context_->handle(), figure->asset(), 1, &material), SUPPLE_ERROR_ARGUMENT);
    EXPECT_EQ(suppleGetImageInfo(context_->handle(), figure->asset(), 1, &image), SUPPLE_ERROR_ARGUMENT);
    material.structSize = 0;
    EXPECT_EQ(suppleGetMaterialInfo(context_->handle(), figure->asset(), 0, &material), SUPPLE_ERROR_ARGUMENT);
}

} // namespace
} // namespace supple::host
