// Every kind of picture is drawn twice, by two processes, and has the same bytes. What malloc hands out holds other
// bytes in the one than in the other, so that reading what nobody wrote shows. With a device that is a CPU that goes
// for the memory of buffers and images, too.
#include "tests/tools/command_runner.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

using Json = nlohmann::json;

using supple::test::kCubeObj;
using supple::test::Outcome;
using supple::test::readText;
using supple::test::writeText;

/// What glibc fills memory with is the complement of these: large numbers, and negative ones of about 1.5.
constexpr int kFills[] = {0x80, 0x40};

/// Open, with a sharp edge and a semi-sharp one.
constexpr const char* kRidge = "v -1 0 0\nv 0 0 0\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\nv -1 2 0\nv 0 2 0\nv 1 2 0\n"
                               "f 1 2 5 4\nf 2 3 6 5\nf 4 5 8 7\nf 5 6 9 8\n"
                               "t crease 2/1/0 1 4 10.0\nt crease 2/1/0 4 7 1.5\n";

/// Four quads side by side, one for each kind of material: a texture on the second UV set, a mask, a translucent one,
/// and a trim on tiles of faces. All have colors.
Json materialsGltf() {
    Json gltf = Json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "extensionsUsed": ["FB_ngon_encoding"], "images": [{"uri": "texture.png"}], "textures": [{"source": 0}],
        "materials": [
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1}}},
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "alphaMode": "MASK", "alphaCutoff": 0.5},
            {"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.2, 0.5]}, "alphaMode": "BLEND", "doubleSided": true},
            {"extras": {"trim": {"texture": {"index": 0}, "domain": "face", "tiles": 2, "channel": "g", "cutoff": 0.5}}}]})");
    const char* const kTypes[] = {"VEC3", "VEC2", "VEC2", "VEC4", "SCALAR", "SCALAR"};
    const size_t kSizes[] = {48, 32, 32, 64, 16, 12};
    size_t offset = 0;
    for (int quad = 0; quad < 4; ++quad) {
        const int first = 6 * quad;
        for (int i = 0; i < 6; ++i) {
            gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", kSizes[i]}});
            gltf["accessors"].push_back({{"bufferView", first + i},
                                         {"componentType", i == 5 ? 5123 : 5126},
                                         {"count", i == 5 ? 6 : 4},
                                         {"type", kTypes[i]}});
            offset += kSizes[i];
        }
        gltf["accessors"][static_cast<size_t>(first)].update(
            {{"min", {2 * quad, 0, 0}}, {"max", {2 * quad + 2, 2, 0}}});
        gltf["meshes"][0]["primitives"].push_back({{"attributes",
                                                    {{"POSITION", first},
                                                     {"TEXCOORD_0", first + 1},
                                                     {"TEXCOORD_1", first + 2},
                                                     {"COLOR_0", first + 3},
                                                     {"_TRIM_TILE", first + 4}}},
                                                   {"indices", first + 5},
                                                   {"material", quad},
                                                   {"extensions", {{"FB_ngon_encoding", Json::object()}}}});
    }
    gltf["buffers"] = {{{"uri", "materials.bin"}, {"byteLength", offset}}};
    return gltf;
}

std::string materialsBinary() {
    std::string bytes;
    const auto add = [&](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
    };
    for (int quad = 0; quad < 4; ++quad) {
        const auto x = static_cast<float>(2 * quad);
        add(std::vector<float>{x, 0, 0, x + 2, 0, 0, x + 2, 2, 0, x, 2, 0});
        add(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0});
        add(std::vector<float>{0, 0, 2, 0, 2, 2, 0, 2});
        add(std::vector<float>{1, 1, 1, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0});
        add(std::vector<float>{0, 0, 0, 0});
        add(std::vector<uint16_t>{0, 1, 2, 0, 2, 3});
    }
    return bytes;
}

struct Picture {
    std::string name;
    std::string arguments; ///< without the output; %: the folder of the sample assets
};

void PrintTo(const Picture& picture, std::ostream* stream) {
    *stream << picture.name;
}

class Pictures : public supple::test::CommandTest, public testing::WithParamInterface<Picture> {
protected:
    Outcome drawWith(int fill, const std::string& arguments) {
        return runProgram("MALLOC_PERTURB_=" + std::to_string(fill) + " '" + std::string(SUPPLE_COMMAND) + "' " +
                          arguments + (supple::test::validationWanted() ? " --validate" : ""));
    }
};

TEST_P(Pictures, AreTheSameWhenDrawnTwice) {
    writeText(file("cube.obj"), kCubeObj);
    writeText(file("ridge.obj"), kRidge);
    std::string arguments = GetParam().arguments;
    if (const size_t at = arguments.find('%'); at != std::string::npos) {
        arguments.replace(at, 1, SUPPLE_SAMPLE_ASSETS);
    }
    if (arguments.find("materials.gltf") != std::string::npos) {
        writeText(file("materials.gltf"), materialsGltf().dump());
        writeText(file("materials.bin"), materialsBinary());
        ASSERT_EQ(run("render cube.obj -o texture.png --size 32x16 --view normals").exitCode, 0);
    }
    std::vector<std::string> pictures;
    for (const int fill : kFills) {
        const Outcome outcome = drawWith(fill, arguments + " -o picture.png");
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        pictures.push_back(readText(file("picture.png")));
        std::filesystem::remove(file("picture.png"));
    }
    EXPECT_GT(pictures[0].size(), 500u) << "more than a backdrop";
    EXPECT_TRUE(pictures[0] == pictures[1]) << "supple " << arguments;
}

std::vector<Picture> pictures() {
    std::vector<Picture> all;
    for (const std::string view : {"shaded", "wire", "patches", "normals", "zebra"}) {
        const std::string common = "render cube.obj --size 64x48 --rate 4 --view " + view;
        all.push_back({view + "Surfaces", common + " --scheme all"});
        all.push_back({view + "Cage", common + " --scheme cage"});
    }
    const std::string render = "render --size 64x48 ";
    const std::string helmet = render + "%/helmet.glb --rate 2 --clip salute --time 1.5 ";
    all.push_back({"trims", helmet});
    all.push_back({"trimsWide", helmet + "--scheme blend --mapping wide --no-ground"});
    all.push_back({"trimsCage", helmet + "--scheme cage"});
    all.push_back({"materials", render + "materials.gltf --rate 4 --yaw 20"});
    all.push_back({"materialsBehind", render + "materials.gltf --rate 4 --yaw 200 --scheme catmull-clark"});
    all.push_back({"materialsCage", render + "materials.gltf --scheme cage"});
    all.push_back({"creases", render + "ridge.obj --rate 4 --scheme blend --creases curve --sharp 1"});
    all.push_back({"creasesClose", render + "ridge.obj --rate 4 --scheme loop --cage --zoom 2 --at 0.4,0.6"});
    all.push_back({"sharedSamples", render + "cube.obj --rate 4 --scheme prep --shared-samples"});
    all.push_back({"sharedSamplesWire", render + "%/pip.glb --rate 2 --shared-samples --view wire"});
    all.push_back({"pose", render + "%/pip.glb --rate 2 --clip walk --time 0.4 --skinning dual-quaternion"});
    all.push_back({"sheet", "sheet %/helmet.glb --cell 40x40 --columns 2 --rate 2"});
    all.push_back({"sheetZebra", "sheet cube.obj --cell 40x40 --columns 1 --view zebra --cage --no-labels"});
    return all;
}

INSTANTIATE_TEST_SUITE_P(All, Pictures, testing::ValuesIn(pictures()),
                         [](const auto& info) { return info.param.name; });

} // namespace
