#include "tests/tools/material_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <iterator>
#include <nlohmann/json.hpp>

namespace supple::test {

namespace {

using host::Picture;
using Json = nlohmann::ordered_json;

constexpr float kBumpHeight = 0.11f;
constexpr uint32_t kMapTexels = 256;

std::string encoded(const void* bytes, size_t size) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto* from = static_cast<const uint8_t*>(bytes);
    std::string text;
    for (size_t i = 0; i < size; i += 3) {
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < size ? from[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= size ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string pngBytes(const Picture& picture, const std::string& beside) {
    if (picture.rgba.empty())
        return "no picture";
    const std::string path = beside + ".png";
    if (!host::writePng(picture, path).ok())
        return {};
    std::ifstream stream(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(path);
    return bytes;
}

/// Accessors over one buffer, as they are added.
class Accessors {
public:
    template <class T>
    size_t add(const std::vector<T>& values, const char* type, int component, bool bounds = false) {
        const size_t bytes = values.size() * sizeof(T);
        views_.push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes}});
        buffer_.append(reinterpret_cast<const char*>(values.data()), bytes);
        buffer_.resize((buffer_.size() + 3) / 4 * 4);
        const size_t count = type == std::string("SCALAR") ? values.size() * (sizeof(T) / 4) : values.size();
        Json accessor = {
            {"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}};
        if constexpr (std::is_same_v<T, glm::vec3>) {
            if (bounds) {
                glm::vec3 low = values[0], high = values[0];
                for (const glm::vec3& value : values) {
                    low = glm::min(low, value);
                    high = glm::max(high, value);
                }
                accessor["min"] = {low.x, low.y, low.z};
                accessor["max"] = {high.x, high.y, high.z};
            }
        }
        list_.push_back(accessor);
        return list_.size() - 1;
    }
    void writeTo(Json& root) const {
        root["accessors"] = list_;
        root["bufferViews"] = views_;
        root["buffers"] = {
            {{"byteLength", buffer_.size()},
             {"uri", "data:application/octet-stream;base64," + encoded(buffer_.data(), buffer_.size())}}};
    }

private:
    std::string buffer_;
    Json views_ = Json::array();
    Json list_ = Json::array();
};

void addGrid(SceneMesh& mesh, uint32_t cells, const std::function<void(glm::vec2)>& addVertex) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t j = 0; j <= cells; ++j) {
        for (uint32_t i = 0; i <= cells; ++i)
            addVertex(glm::vec2(i, j) / static_cast<float>(cells)); // (s, t), t downwards
    }
    const auto at = [&](uint32_t i, uint32_t j) { return first + j * (cells + 1) + i; };
    for (uint32_t j = 0; j < cells; ++j) {
        for (uint32_t i = 0; i < cells; ++i)
            mesh.quads.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), at(i, j)});
    }
}

/// Height of a bump above its tile at a place from its middle, and its slope there.
struct Bump {
    float height;
    glm::vec2 slope;
};
Bump bumpAt(glm::vec2 place) {
    const float r = glm::length(place);
    if (r >= kBumpRadius || r == 0.0f)
        return {r == 0.0f ? kBumpHeight : 0.0f, glm::vec2(0.0f)};
    const float turn = glm::pi<float>() * r / kBumpRadius;
    const float fall = -0.5f * kBumpHeight * glm::pi<float>() / kBumpRadius * std::sin(turn);
    return {0.5f * kBumpHeight * (1.0f + std::cos(turn)), place * (fall / r)};
}
glm::vec3 bumpNormal(glm::vec2 slope) {
    return glm::normalize(glm::vec3(-slope, 1.0f));
}

/// The bump as a normal map: +Y is up in the picture.
Picture bumpMap() {
    Picture picture = Picture::blank(kMapTexels, kMapTexels);
    for (uint32_t y = 0; y < kMapTexels; ++y) {
        for (uint32_t x = 0; x < kMapTexels; ++x) {
            const glm::vec2 at = (glm::vec2(x, y) + 0.5f) / float{kMapTexels} - 0.5f;
            const glm::vec3 texel = bumpNormal(bumpAt({at.x, -at.y}).slope) * 0.5f + 0.5f;
            for (int k = 0; k < 3; ++k)
                picture.pixel(x, y)[k] = static_cast<uint8_t>(std::lround(texel[k] * 255.0f));
            picture.pixel(x, y)[3] = 255;
        }
    }
    return picture;
}

glm::vec2 turnedUv(glm::vec2 uv, uint32_t quarters, bool mirrored) {
    if (mirrored)
        uv.x = 1.0f - uv.x;
    for (uint32_t i = 0; i < quarters; ++i)
        uv = {uv.y, 1.0f - uv.x};
    return uv;
}

/// One colored texel a cell of a checkerboard.
Picture checker(uint32_t cells, glm::u8vec4 even, glm::u8vec4 odd) {
    constexpr uint32_t kCell = 16;
    Picture picture = Picture::blank(cells * kCell, cells * kCell);
    for (uint32_t y = 0; y < picture.height; ++y) {
        for (uint32_t x = 0; x < picture.width; ++x) {
            const glm::u8vec4 color = (x / kCell + y / kCell) % 2 == 0 ? even : odd;
            std::memcpy(picture.pixel(x, y), &color, 4);
        }
    }
    return picture;
}

/// Studs in rows, for a ball.
Picture studMap() {
    constexpr uint32_t kStuds = 5;
    Picture picture = Picture::blank(kMapTexels, kMapTexels);
    for (uint32_t y = 0; y < kMapTexels; ++y) {
        for (uint32_t x = 0; x < kMapTexels; ++x) {
            const glm::vec2 at = glm::fract((glm::vec2(x, y) + 0.5f) * (float{kStuds} / float{kMapTexels})) - 0.5f;
            const glm::vec3 texel = bumpNormal(bumpAt({at.x, -at.y}).slope * 1.6f) * 0.5f + 0.5f;
            for (int k = 0; k < 3; ++k)
                picture.pixel(x, y)[k] = static_cast<uint8_t>(std::lround(texel[k] * 255.0f));
            picture.pixel(x, y)[3] = 255;
        }
    }
    return picture;
}

std::string surface(const std::string& color, float metallic, float roughness, const std::string& more = {}) {
    return R"({"pbrMetallicRoughness":{"baseColorFactor":)" + color + R"(,"metallicFactor":)" +
           std::to_string(metallic) + R"(,"roughnessFactor":)" + std::to_string(roughness) + "}" + more + "}";
}

Json jsonOf(const SceneMesh& mesh, Accessors& accessors) {
    Json attributes;
    attributes["POSITION"] = accessors.add(mesh.positions, "VEC3", 5126, true);
    if (!mesh.normals.empty())
        attributes["NORMAL"] = accessors.add(mesh.normals, "VEC3", 5126);
    if (!mesh.uvs.empty())
        attributes["TEXCOORD_0"] = accessors.add(mesh.uvs, "VEC2", 5126);
    if (!mesh.uvs1.empty())
        attributes["TEXCOORD_1"] = accessors.add(mesh.uvs1, "VEC2", 5126);
    if (!mesh.tangents.empty())
        attributes["TANGENT"] = accessors.add(mesh.tangents, "VEC4", 5126);
    if (!mesh.colors.empty())
        attributes["COLOR_0"] = accessors.add(mesh.colors, "VEC4", 5126);
    std::vector<glm::uvec3> triangles;
    for (const auto& [a, b, c, d] : mesh.quads) {
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(a, c, d);
    }
    return {{"primitives",
             {{{"attributes", attributes},
               {"indices", accessors.add(triangles, "SCALAR", 5125)},
               {"material", mesh.material},
               {"extensions", {{"FB_ngon_encoding", Json::object()}}}}}}};
}

} // namespace

SceneMesh squareMesh(glm::vec3 center, float half, uint32_t cells, size_t material) {
    SceneMesh mesh;
    mesh.material = material;
    addGrid(mesh, cells, [&](glm::vec2 at) {
        mesh.positions.push_back(center + glm::vec3(2.0f * at.x - 1.0f, 1.0f - 2.0f * at.y, 0.0f) * half);
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.uvs.push_back(at);
    });
    return mesh;
}

SceneMesh ballMesh(glm::vec3 center, float radius, uint32_t cells, size_t material) {
    SceneMesh mesh;
    mesh.material = material;
    const glm::vec3 ahead[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    for (const glm::vec3& out : ahead) {
        const glm::vec3 up = out.y == 0.0f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(0.0f, 0.0f, -out.y);
        const glm::vec3 right = glm::cross(up, out);
        addGrid(mesh, cells, [&](glm::vec2 at) {
            const glm::vec2 turn = (at * 2.0f - 1.0f) * glm::quarter_pi<float>();
            const glm::vec3 normal =
                glm::normalize(out + right * std::tan(turn.x) - up * std::tan(turn.y)); // cells of about one size
            mesh.positions.push_back(center + radius * normal);
            mesh.normals.push_back(normal);
            mesh.uvs.push_back(at);
        });
    }
    return mesh;
}

SceneFile bumpScene(bool tangents) {
    SceneFile scene;
    scene.images.push_back(bumpMap());
    scene.samplers.emplace_back(R"({"wrapS":33071,"wrapT":33071})");
    const std::string clay = "[0.55,0.42,0.30,1]";
    scene.materials = {surface(clay, 0.0f, 0.45f), surface(clay, 0.0f, 0.45f, R"(,"normalTexture":{"index":0})")};
    for (uint32_t row = 0; row < kBumpRows; ++row) {
        for (uint32_t column = 0; column < kBumpColumns; ++column) {
            const bool shaped = column == kShapedBump, mirrored = column == kMirroredBump;
            SceneMesh& mesh = scene.meshes.emplace_back();
            mesh.material = shaped ? 0 : 1;
            // A map that is turned with its texture coordinates shows a round bump all the same.
            const glm::vec2 right = turnedUv({1.0f, 0.5f}, row, mirrored) - turnedUv({0.0f, 0.5f}, row, mirrored);
            const glm::vec2 down = turnedUv({0.5f, 1.0f}, row, mirrored) - turnedUv({0.5f, 0.0f}, row, mirrored);
            const glm::vec3 tangent(right.x, -down.x, 0.0f);        // where s grows
            const float side = right.x * down.y - right.y * down.x; // of a chart that is not mirrored: 1
            addGrid(mesh, shaped ? 20 : 2, [&](glm::vec2 at) {
                const glm::vec2 place = glm::vec2(at.x - 0.5f, 0.5f - at.y);
                const Bump bump = shaped ? bumpAt(place) : Bump{0.0f, glm::vec2(0.0f)};
                mesh.positions.emplace_back(place.x + static_cast<float>(column), place.y - static_cast<float>(row),
                                            bump.height);
                mesh.normals.push_back(bumpNormal(bump.slope));
                mesh.uvs.push_back(turnedUv(at, row, mirrored));
                if (tangents)
                    mesh.tangents.emplace_back(tangent, side);
            });
        }
    }
    return scene;
}

SceneFile ballScene() {
    SceneFile scene;
    scene.images = {checker(4, {230, 120, 40, 255}, {230, 120, 40, 0}), studMap(),
                    checker(3, {255, 255, 255, 255}, {0, 0, 0, 255})};
    const std::string colors[] = {"[0.62,0.05,0.04,1]", "[1.0,0.71,0.29,1]", "[0.91,0.92,0.92,1]"};
    constexpr uint32_t kColumns = 5;
    const auto add = [&](const std::string& material, uint32_t column, uint32_t row) {
        scene.materials.push_back(material);
        scene.meshes.push_back(ballMesh(glm::vec3(column, 3.0f - static_cast<float>(row), 0.0f) * 1.1f, 0.47f, 10,
                                        scene.materials.size() - 1));
    };
    for (uint32_t row = 0; row < 3; ++row) {
        for (uint32_t column = 0; column < kColumns; ++column)
            add(surface(colors[row], row == 0 ? 0.0f : 1.0f, static_cast<float>(column) * 0.25f), column, row);
    }
    add(surface("[0.02,0.02,0.02,1]", 0.0f, 0.6f,
                R"(,"emissiveFactor":[0.1,0.7,1],"emissiveTexture":{"index":2},)"
                R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":2}})"),
        0, 3);
    add(surface("[0.20,0.55,0.25,1]", 0.0f, 0.6f, R"(,"extensions":{"KHR_materials_unlit":{}})"), 1, 3);
    add(R"({"alphaMode":"MASK","doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0},)"
        R"("metallicFactor":0,"roughnessFactor":0.4}})",
        2, 3);
    add(surface("[0.35,0.65,0.95,0.35]", 0.0f, 0.08f, R"(,"alphaMode":"BLEND","doubleSided":true)"), 3, 3);
    add(surface("[0.95,0.55,0.36,1]", 1.0f, 0.32f, R"(,"normalTexture":{"index":1})"), 4, 3);
    return scene;
}

namespace {

/// Highlights that are stretched, and what light goes into.
void addScattered(const std::function<void(const std::string& material, uint32_t column)>& add) {
    const auto brushed = [](const std::string& members) {
        return R"(,"extensions":{"KHR_materials_anisotropy":{)" + members + "}}";
    };
    add(surface("[0.9,0.9,0.9,1]", 1.0f, 0.3f, brushed(R"("anisotropyStrength":0.8)")), 0);
    add(surface("[0.9,0.9,0.9,1]", 1.0f, 0.3f, brushed(R"("anisotropyStrength":0.8,"anisotropyRotation":1.5708)")), 1);
    const auto scatters = [](const std::string& through, const std::string& inside) {
        return R"(,"extensions":{"KHR_materials_diffuse_transmission":{)" + through +
               R"(},"KHR_materials_volume":{"thicknessFactor":0.9,)" + inside + "}}";
    };
    const std::string skin = "[0.9,0.51,0.33,1]";
    add(surface(skin, 0.0f, 0.5f), 2);
    add(surface(skin, 0.0f, 0.5f,
                scatters(R"("diffuseTransmissionFactor":0.5,"diffuseTransmissionColorFactor":[0.92,0.47,0.31])",
                         R"("attenuationDistance":0.1,"attenuationColor":[0.54,0.19,0.055])")),
        3);
    add(surface("[0.35,0.6,0.45,1]", 0.0f, 0.25f,
                scatters(R"("diffuseTransmissionFactor":0.9,"diffuseTransmissionColorFactor":[0.5,0.9,0.65])",
                         R"("attenuationDistance":0.6,"attenuationColor":[0.3,0.8,0.5])")),
        4);
}

/// Thin films: on lacquer of three thicknesses, on a metal, and a soap bubble that is thicker below. `slope`: an image.
void addFilms(const std::function<void(const std::string& material, uint32_t column)>& add, size_t slope) {
    const auto film = [](const std::string& index, const std::string& thickness, const std::string& more = {}) {
        return R"(,"extensions":{"KHR_materials_iridescence":{"iridescenceFactor":1,"iridescenceIor":)" + index +
               R"(,"iridescenceThicknessMaximum":)" + thickness + more + "}";
    };
    const std::string lacquer = "[0.02,0.02,0.025,1]";
    add(surface(lacquer, 0.0f, 0.2f, film("1.8", "250") + "}"), 0);
    add(surface(lacquer, 0.0f, 0.2f, film("1.8", "350") + "}"), 1);
    add(surface(lacquer, 0.0f, 0.2f, film("1.8", "500") + "}"), 2);
    add(surface("[0.8,0.8,0.8,1]", 1.0f, 0.25f, film("2.2", "420") + "}"), 3);
    add(surface("[1,1,1,1]", 0.0f, 0.0f,
                film("1.33", "800",
                     R"(,"iridescenceThicknessMinimum":200,"iridescenceThicknessTexture":{"index":)" +
                         std::to_string(slope) + "}") +
                    R"(,"KHR_materials_transmission":{"transmissionFactor":1}})"),
        4);
}

Picture slopeMap() {
    Picture picture = Picture::blank(1, 64);
    for (uint32_t y = 0; y < picture.height; ++y)
        std::fill_n(picture.pixel(0, y), 3, static_cast<uint8_t>(255 * y / (picture.height - 1)));
    return picture;
}

} // namespace

SceneFile layerScene() {
    SceneFile scene;
    scene.images = {studMap(), checker(4, {255, 255, 255, 255}, {0, 0, 0, 255}), slopeMap()};
    const auto add = [&](const std::string& material, uint32_t column, uint32_t row) {
        scene.materials.push_back(material);
        scene.meshes.push_back(ballMesh(glm::vec3(column, 3.0f - static_cast<float>(row), 0.0f) * 1.1f, 0.47f, 10,
                                        scene.materials.size() - 1));
    };
    const auto extended = [](const std::string& name, const std::string& members) {
        return R"(,"extensions":{"KHR_materials_)" + name + R"(":{)" + members + "}}";
    };
    const auto coat = [&](const std::string& members) { return extended("clearcoat", members); };
    const std::string paint = "[0.45,0.01,0.02,1]";
    add(surface(paint, 0.0f, 0.6f), 0, 0);
    add(surface(paint, 0.0f, 0.6f, coat(R"("clearcoatFactor":1)")), 1, 0);
    add(surface(paint, 0.0f, 0.6f, coat(R"("clearcoatFactor":1,"clearcoatRoughnessFactor":0.35)")), 2, 0);
    add(surface("[0.9,0.55,0.2,1]", 1.0f, 0.5f, coat(R"("clearcoatFactor":1)")), 3, 0);
    add(surface(paint, 0.0f, 0.6f, coat(R"("clearcoatFactor":1,"clearcoatNormalTexture":{"index":0})")), 4, 0);
    const auto sheen = [&](const std::string& members) { return extended("sheen", members); };
    const std::string cloth = "[0.05,0.06,0.16,1]";
    add(surface(cloth, 0.0f, 0.9f), 0, 1);
    add(surface(cloth, 0.0f, 0.9f, sheen(R"("sheenColorFactor":[0.6,0.65,0.9],"sheenRoughnessFactor":0.2)")), 1, 1);
    add(surface(cloth, 0.0f, 0.9f, sheen(R"("sheenColorFactor":[0.6,0.65,0.9],"sheenRoughnessFactor":0.5)")), 2, 1);
    add(surface(cloth, 0.0f, 0.9f, sheen(R"("sheenColorFactor":[0.6,0.65,0.9],"sheenRoughnessFactor":0.9)")), 3, 1);
    add(surface("[0.25,0.01,0.02,1]", 0.0f, 0.9f,
                sheen(R"("sheenColorFactor":[0.9,0.2,0.2],"sheenRoughnessFactor":0.4)")),
        4, 1);
    const auto glass = [&](const std::string& members) { return extended("transmission", members); };
    const std::string clear = R"("transmissionFactor":1)";
    add(surface("[1,1,1,1]", 0.0f, 0.0f, glass(clear)), 0, 2);
    add(surface("[0.25,0.75,0.45,1]", 0.0f, 0.0f, glass(clear) + R"(,"doubleSided":true)"), 1, 2);
    add(surface("[1,1,1,1]", 0.0f, 0.3f, glass(clear)), 2, 2);
    add(surface("[0.9,0.95,1,1]", 0.0f, 0.7f, glass(clear)), 3, 2);
    add(surface("[0.95,0.6,0.2,1]", 0.0f, 0.1f, glass(clear + R"(,"transmissionTexture":{"index":1})")), 4, 2);
    const std::string dark = "[0.02,0.02,0.02,1]";
    add(surface(dark, 0.0f, 0.25f, extended("specular", R"("specularFactor":0)")), 0, 3);
    add(surface(dark, 0.0f, 0.25f, extended("ior", R"("ior":1.2)")), 1, 3);
    add(surface(dark, 0.0f, 0.25f), 2, 3);
    add(surface(dark, 0.0f, 0.25f, extended("ior", R"("ior":2.4)")), 3, 3);
    add(surface(dark, 0.0f, 0.25f, extended("specular", R"("specularColorFactor":[4,1.5,0.2])")), 4, 3);
    addScattered([&](const std::string& material, uint32_t column) { add(material, column, 4); });
    addFilms([&](const std::string& material, uint32_t column) { add(material, column, 5); }, 2);
    scene.materials.push_back(surface("[0.8,0.8,0.8,1]", 0.0f, 0.8f));
    scene.materials.back().insert(scene.materials.back().find("{\"base") + 1, R"("baseColorTexture":{"index":1},)");
    scene.meshes.push_back(squareMesh(glm::vec3(2.2f, 1.1f, -0.9f), 0.55f, 4, scene.materials.size() - 1));
    for (glm::vec3& position : scene.meshes.back().positions)
        position.x = 2.2f + 5.0f * (position.x - 2.2f);
    return scene;
}

bool writeScene(const SceneFile& scene, const std::string& path) {
    Accessors accessors;
    Json root = {
        {"asset", {{"version", "2.0"}}},
        {"extensionsUsed",
         {"FB_ngon_encoding", "KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_texture_transform"}},
        {"scene", 0}};
    Json nodes = Json::array(), roots = Json::array(), meshes = Json::array();
    for (const SceneMesh& mesh : scene.meshes) {
        meshes.push_back(jsonOf(mesh, accessors));
        roots.push_back(nodes.size());
        nodes.push_back({{"mesh", meshes.size() - 1}});
    }
    root["scenes"] = {{{"nodes", roots}}};
    root["nodes"] = nodes;
    root["meshes"] = meshes;
    for (const std::string& material : scene.materials)
        root["materials"].push_back(Json::parse(material));
    for (const std::string& sampler : scene.samplers)
        root["samplers"].push_back(Json::parse(sampler));
    for (size_t i = 0; i < scene.images.size(); ++i) {
        const std::string png = pngBytes(scene.images[i], path);
        root["images"].push_back({{"uri", "data:image/png;base64," + encoded(png.data(), png.size())}});
        root["textures"].push_back({{"source", i}});
        if (i < scene.samplers.size())
            root["textures"][i]["sampler"] = i;
    }
    const auto addOthers = [&](const std::vector<std::string>& images, const char* extension, const std::string& type) {
        for (size_t i = 0; i < images.size(); ++i) {
            root["textures"][i]["extensions"][extension]["source"] = root["images"].size();
            root["images"].push_back(
                {{"uri", "data:" + type + ";base64," + encoded(images[i].data(), images[i].size())}});
        }
    };
    addOthers(scene.webps, "EXT_texture_webp", "image/webp");
    addOthers(scene.ktx2s, "KHR_texture_basisu", "image/ktx2");
    accessors.writeTo(root);
    std::ofstream stream(path);
    stream << root.dump();
    return stream.good();
}

} // namespace supple::test
