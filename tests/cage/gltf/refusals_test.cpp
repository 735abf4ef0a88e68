// Every way a file can be wrong has a line that names file, element and reason, if it is read strictly. Most cases
// change one thing in a file that is right. What other readings make of them is in lenient_test.cpp.
#include "tests/cage/gltf/reading.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <unistd.h>

namespace supple::cage {
namespace {

using namespace test;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::string withJson(const std::string& from, const std::string& to, ErrorCode code = ErrorCode::asset) {
    const GltfBuilder b = skinnedQuad();
    return messageOf(packGlb(replaced(b.json(), from, to), b.binary()), code);
}

std::string withFloat(QuadAccessor accessor, size_t component, float value) {
    GltfBuilder b = skinnedQuad();
    b.setFloat(accessor, component, value);
    return messageOf(b.glb());
}

std::string withText(const std::string& text, ErrorCode code = ErrorCode::asset) {
    return messageOf(toBytes(text), code);
}

TEST(GltfRefusals, BaseFileIsRight) {
    EXPECT_EQ(messageOf(skinnedQuad().glb()), "accepted");
    EXPECT_EQ(messageOf(skinnedQuad().embedded()), "accepted");
}

// ---- container and JSON ---------------------------------------------------------------------------------------------

TEST(GltfRefusals, Container) {
    EXPECT_EQ(messageOf(std::vector<std::byte>()), "t.glb: file: empty");
    EXPECT_EQ(withText("gltf, but not really"),
              "t.glb: file: neither GLB nor glTF JSON: no 'glTF' magic and no '{' at its start");
    EXPECT_EQ(withText("glTF"), "t.glb: GLB header: truncated: 4 of 12 bytes");

    std::vector<std::byte> glb = skinnedQuad().glb();
    const std::string size = std::to_string(glb.size());
    auto shorter = glb;
    shorter.resize(glb.size() - 1);
    EXPECT_EQ(messageOf(shorter), "t.glb: GLB header: truncated: " + size + " bytes announced, " +
                                      std::to_string(shorter.size()) + " present");
    auto oldVersion = glb;
    oldVersion[4] = std::byte{1};
    EXPECT_EQ(messageOf(oldVersion), "t.glb: GLB header: version 1, only 2 is supported");
    auto noJson = glb;
    noJson[16] = std::byte{'B'};
    EXPECT_EQ(messageOf(noJson), "t.glb: GLB chunk 0: not the JSON chunk");
    auto longChunk = glb;
    longChunk[14] = std::byte{0x7F};
    EXPECT_NE(messageOf(longChunk).find("t.glb: GLB chunk 0: truncated: "), std::string::npos);
    auto onlyHeader = std::vector<std::byte>(glb.begin(), glb.begin() + 12);
    onlyHeader[8] = std::byte{12};
    onlyHeader[9] = std::byte{0};
    EXPECT_EQ(messageOf(onlyHeader), "t.glb: GLB: no JSON chunk");
    onlyHeader.resize(16);
    onlyHeader[8] = std::byte{16};
    EXPECT_EQ(messageOf(onlyHeader), "t.glb: GLB chunk 0: truncated header");
}

TEST(GltfRefusals, Json) {
    EXPECT_EQ(withText("{\"asset\":").rfind("t.glb: JSON: parse error at line 1, column 10: ", 0), 0u);
    EXPECT_EQ(withText("{\"a\":\"\xFF\"}").rfind("t.glb: JSON: parse error", 0), 0u);
    EXPECT_EQ(withText("{\"a\":1e999}").rfind("t.glb: JSON: number overflow", 0), 0u);
    EXPECT_EQ(withText("{\"asset\":\n\x01}").find('\n'), std::string::npos) << "one line, whatever the file holds";
    EXPECT_EQ(withText("{}"), "t.glb: asset: missing: not a glTF 2.0 file");
    EXPECT_EQ(withText(R"({"asset":{}})"), "t.glb: asset version: \"\", only 2.x is supported");
    EXPECT_EQ(withText(R"({"asset":{"version":"1.0"}})"), "t.glb: asset version: \"1.0\", only 2.x is supported");
    EXPECT_EQ(withText(R"({"asset":{"version":2}})"), "t.glb: asset version: not a string");
    EXPECT_EQ(withText(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
              "t.glb: asset minVersion: \"2.1\", only 2.0 is supported");
    EXPECT_EQ(withText(R"({"asset":{"version":"2.0"},"nodes":{}})"), "t.glb: nodes: not an array");
    EXPECT_EQ(withText(R"({"asset":{"version":"2.0"},"nodes":[7]})"), "t.glb: nodes 0: not an object");
    EXPECT_EQ(withText(R"({"asset":{"version":"2.0"}})"), "t.glb: meshes: none");
}

TEST(GltfRefusals, NestingBomb) {
    const std::string reason = "nested deeper than 64 at byte ";
    EXPECT_EQ(withText("{\"a\":" + std::string(1000000, '['), ErrorCode::limit), "t.glb: JSON: " + reason + "68");
    // Brackets inside strings do not nest.
    EXPECT_EQ(withText(R"({"a":"\")" + std::string(1000, '[') + "\"}"), "t.glb: asset: missing: not a glTF 2.0 file");
}

TEST(GltfRefusals, Extensions) {
    const auto required = [](const std::string& name) {
        GltfBuilder b = skinnedQuad();
        b.more += R"(,"extensionsRequired":[")" + name + "\"]";
        return messageOf(b.glb());
    };
    EXPECT_EQ(required("FB_ngon_encoding"), "accepted");
    EXPECT_EQ(required("KHR_mesh_quantization"), "accepted");
    EXPECT_EQ(required("EXT_meshopt_compression"), "accepted");
    EXPECT_EQ(required("KHR_draco_mesh_compression"), "accepted");
    EXPECT_EQ(required("ACME_thing"), "t.glb: extensionsRequired: ACME_thing is not supported");
    EXPECT_EQ(withJson(R"("scene":0)", R"("scene":0,"extensionsUsed":[1])"), "t.glb: extensionsUsed: not all strings");
    EXPECT_EQ(
        withJson(R"("indices":3,"mode":4)", R"("indices":9,"mode":4,"extensions":{"KHR_draco_mesh_compression":{}})"),
        "t.glb: mesh 0 primitive 0 indices: accessor 9 is out of range: the file has 9");
    EXPECT_EQ(withJson(R"({"bufferView":3,"componentType":5123,"count":6,"type":"SCALAR"})",
                       R"({"componentType":5123,"count":6,"type":"SCALAR"})"),
              "t.glb: mesh 0 primitive 0 indices: accessor 3 has no bufferView");
    const GltfBuilder b = skinnedQuad();
    const std::string draco = replaced(b.json(), R"("mode":4)", R"("extensions":{"KHR_draco_mesh_compression":{}})");
    EXPECT_EQ(messageOf(packGlb(replaced(draco, R"({"bufferView":0,)", "{"), b.binary())),
              "t.glb: mesh 0 primitive 0 KHR_draco_mesh_compression: bufferView is missing");
}

// ---- buffers and accessors ------------------------------------------------------------------------------------------

TEST(GltfRefusals, Buffers) {
    const GltfBuilder b = skinnedQuad();
    const std::string length = std::to_string(b.binary().size());
    EXPECT_EQ(messageOf(packGlb(b.json(), {})), "t.glb: buffer 0: the GLB has no binary chunk or an empty one");
    EXPECT_EQ(withText(b.json()), "t.glb: buffer 0: no uri");
    EXPECT_EQ(withJson(R"({"byteLength":)" + length, R"({"byteLength":99999)"),
              "t.glb: buffer 0: truncated: byteLength is 99999, " + length + " bytes present");
    EXPECT_EQ(withJson(R"({"byteLength":)" + length, R"({"byteLength":0)"), "t.glb: buffer 0 byteLength: zero");
    EXPECT_EQ(withJson(R"({"byteLength":)" + length, R"({"bytes":1)"), "t.glb: buffer 0: byteLength is missing");
    EXPECT_EQ(withJson(R"({"byteLength":)" + length, R"({"byteLength":-1)"),
              "t.glb: buffer 0 byteLength: -1 is negative");
    EXPECT_EQ(withJson(R"({"byteLength":)" + length, R"({"byteLength":1.5)"),
              "t.glb: buffer 0 byteLength: not an integer");
    EXPECT_EQ(withText(b.json("data:application/octet-stream;base64,AAA*")),
              "t.glb: buffer 0 uri: data URI: not base64 at character 40");
    EXPECT_EQ(withText(b.json("data:application/octet-stream;base64")),
              "t.glb: buffer 0 uri: data URI without a comma");
    EXPECT_EQ(withText(b.json("data:;base64,AAAA")),
              "t.glb: buffer 0: truncated: byteLength is " + length + ", 3 bytes present");
}

TEST(GltfRefusals, ExternalFiles) {
    const GltfBuilder b = skinnedQuad();
    EXPECT_EQ(withText(b.json("quad.bin")),
              "t.glb: buffer 0 uri: \"quad.bin\": external files are not allowed for an asset read from memory");

    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / ("supple_gltf_refusals_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder / "asset" / "sub");
    std::ofstream(folder / "outside.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(b.binary().data()), static_cast<std::streamsize>(b.binary().size()));
    fs::copy(folder / "outside.bin", folder / "asset" / "in side.bin");
    fs::copy(folder / "outside.bin", folder / "asset" / "sub" / "a+b.bin");
    fs::create_symlink("../outside.bin", folder / "asset" / "link.bin");
    const auto with = [&](const std::string& uri, ErrorCode code = ErrorCode::asset) {
        std::ofstream(folder / "asset" / "t.gltf") << b.json(uri);
        const Result<Character> result = readGltfFile((folder / "asset" / "t.gltf").string());
        if (result.ok())
            return std::string("accepted");
        EXPECT_EQ(result.error().code, code);
        return result.error().message;
    };
    const auto refused = [](const std::string& uri, const std::string& reason) {
        return "t.gltf: buffer 0 uri: \"" + uri + "\": " + reason;
    };
    EXPECT_EQ(with("in%20side.bin"), "accepted");
    EXPECT_EQ(with("in side.bin"), "accepted");
    EXPECT_EQ(with("./sub/a+b.bin"), "accepted") << "'+' is no space in a path";
    EXPECT_EQ(with("../outside.bin"), refused("../outside.bin", "path leaves the asset's folder"));
    EXPECT_EQ(with("sub/../../outside.bin"), refused("sub/../../outside.bin", "path leaves the asset's folder"));
    EXPECT_EQ(with("%2e%2e/outside.bin"), refused("%2e%2e/outside.bin", "path leaves the asset's folder"));
    EXPECT_EQ(with("link.bin"), refused("link.bin", "path leaves the asset's folder"));
    EXPECT_EQ(with("/etc/passwd"), refused("/etc/passwd", "only relative paths with forward slashes are allowed"));
    EXPECT_EQ(with("..\\\\outside.bin"),
              refused("..\\outside.bin", "only relative paths with forward slashes are allowed"));
    EXPECT_EQ(with("file:///etc/passwd"),
              refused("file:///etc/passwd", "only relative paths and data: URIs are allowed"));
    EXPECT_EQ(with("https://example.com/a.bin"),
              refused("https://example.com/a.bin", "only relative paths and data: URIs are allowed"));
    EXPECT_EQ(with("C%3A/a.bin"), refused("C%3A/a.bin", "only relative paths and data: URIs are allowed"));
    EXPECT_EQ(with("sub/C%3Aa.bin"),
              refused("sub/C%3Aa.bin", "path contains a colon, which means a drive or a stream on Windows"));
    EXPECT_EQ(with("sub/NUL.bin"), refused("sub/NUL.bin", "path names a device of Windows"));
    EXPECT_EQ(with("a%00b"), refused("a%00b", "path contains a NUL character"));
    EXPECT_EQ(with("sub", ErrorCode::io), refused("sub", "not a regular file"));
    EXPECT_EQ(with("none.bin", ErrorCode::io), refused("none.bin", "no such file"));

    const std::string missing = (folder / "missing.glb").string();
    const Result<Character> result = readGltfFile(missing);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::io);
    EXPECT_EQ(result.error().message, "missing.glb: file: no such file: \"" + missing + "\"");
    EXPECT_FALSE(readGltfFile(folder.string()).ok());
    EXPECT_FALSE(readGltfFile("").ok());
    fs::remove_all(folder);
}

TEST(GltfRefusals, BufferViews) {
    const std::string first = R"({"buffer":0,"byteOffset":0,"byteLength":48})";
    const std::string length = std::to_string(skinnedQuad().binary().size());
    EXPECT_EQ(withJson(first, R"({"buffer":1,"byteOffset":0,"byteLength":48})"),
              "t.glb: bufferView 0 buffer: buffer 1 is out of range: the file has 1");
    EXPECT_EQ(withJson(first, R"({"byteLength":48})"), "t.glb: bufferView 0: buffer is missing");
    EXPECT_EQ(withJson(first, R"({"buffer":0})"), "t.glb: bufferView 0: byteLength is missing");
    EXPECT_EQ(withJson(first, R"({"buffer":0,"byteLength":0})"), "t.glb: bufferView 0 byteLength: zero");
    EXPECT_EQ(withJson(first, R"({"buffer":0,"byteOffset":8,"byteLength":)" + length + "}"),
              "t.glb: bufferView 0: bytes 8 + " + length + " are out of range: the buffer has " + length);
    EXPECT_EQ(withJson(first, R"({"buffer":0,"byteOffset":18446744073709551615,"byteLength":2})"),
              "t.glb: bufferView 0: bytes 18446744073709551615 + 2 are out of range: the buffer has " + length);
    EXPECT_EQ(withJson(first, R"({"buffer":0,"byteLength":48,"byteStride":6})"),
              "t.glb: bufferView 0 byteStride: 6 is not a multiple of 4 in 4..252");
    EXPECT_EQ(withJson(first, R"({"buffer":0,"byteLength":48,"byteStride":8})"),
              "t.glb: mesh 0 primitive 0 POSITION: byteStride 8 is less than the element's 12 bytes");
}

TEST(GltfRefusals, Accessors) {
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
    const auto with = [&](const std::string& to, ErrorCode code = ErrorCode::asset) {
        return withJson(first, to, code);
    };
    EXPECT_EQ(with(R"({"bufferView":9,"componentType":5126,"count":4,"type":"VEC3"})"),
              "t.glb: accessor 0 bufferView: bufferView 9 is out of range: the file has 9");
    EXPECT_EQ(with(R"({"bufferView":4294967296,"componentType":5126,"count":4,"type":"VEC3"})"),
              "t.glb: accessor 0 bufferView: bufferView 4294967296 is out of range: the file has 9");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5130,"count":4,"type":"VEC3"})"),
              "t.glb: accessor 0 componentType: 5130 is not allowed");
    EXPECT_EQ(with(R"({"bufferView":0,"count":4,"type":"VEC3"})"), "t.glb: accessor 0: componentType is missing");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC5"})"),
              "t.glb: accessor 0 type: \"VEC5\" is not allowed");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5126,"count":0,"type":"VEC3"})"),
              "t.glb: accessor 0 count: zero");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","normalized":1})"),
              "t.glb: accessor 0 normalized: not a boolean");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})"),
              "t.glb: mesh 0 primitive 0 POSITION: 5 elements at byte 0 are out of range: bufferView 0 has 48 bytes");
    EXPECT_EQ(with(R"({"bufferView":0,"byteOffset":4,"componentType":5126,"count":4,"type":"VEC3"})"),
              "t.glb: mesh 0 primitive 0 POSITION: 4 elements at byte 4 are out of range: bufferView 0 has 48 bytes");
    for (const char* count : {R"("bufferView":0,"count":1537228672809129302)", R"("count":16777217)"}) {
        const std::string accessor = std::string("{") + count + R"(,"componentType":5126,"type":"VEC3"})";
        EXPECT_TRUE(with(accessor, ErrorCode::limit)
                        .starts_with("t.glb: mesh 0 primitive 0: the file needs more memory than one of "));
    }
    EXPECT_EQ(messageOf(packGlb(replaced(skinnedQuad().json(), first,
                                         R"({"count":16777217,"componentType":5126,"type":"VEC3"})"),
                                skinnedQuad().binary()),
                        ErrorCode::limit, kMuchMemory),
              "t.glb: mesh 0 primitive 0: more than 16777216 vertices");
    EXPECT_EQ(
        withJson(R"({"bufferView":5,"componentType":5126,"count":3,"type":"SCALAR"})",
                 R"({"componentType":5126,"count":16777217,"type":"SCALAR"})", ErrorCode::limit),
        "t.glb: animation 0 channel 0 input: accessor without bufferView: 16777217 elements, at most 16777216 are "
        "read");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"})"),
              "t.glb: mesh 0 primitive 0 POSITION: VEC2 instead of VEC3");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5122,"count":4,"type":"VEC3"})"),
              "t.glb: mesh 0 primitive 0 POSITION: SHORT components need KHR_mesh_quantization, which the file does "
              "not declare");
    EXPECT_EQ(with(R"({"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3"})"),
              "t.glb: mesh 0 primitive 0 POSITION: normalized SHORT components need KHR_mesh_quantization, which the "
              "file does not declare");
}

TEST(GltfRefusals, SparseAccessors) {
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
    const auto with = [&](const std::string& sparse) {
        return withJson(first,
                        R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":)" + sparse + "}");
    };
    EXPECT_EQ(with("7"), "t.glb: accessor 0 sparse: not an object");
    EXPECT_EQ(with(R"({"count":0})"), "t.glb: accessor 0 sparse count: 0 is not in 1..4");
    EXPECT_EQ(with(R"({"count":5})"), "t.glb: accessor 0 sparse count: 5 is not in 1..4");
    EXPECT_EQ(with(R"({"count":1})"), "t.glb: accessor 0 sparse indices: missing");
    EXPECT_EQ(with(R"({"count":1,"indices":{"bufferView":3,"componentType":5123}})"),
              "t.glb: accessor 0 sparse values: missing");
    EXPECT_EQ(with(R"({"count":1,"indices":{"bufferView":3,"componentType":5126},"values":{"bufferView":0}})"),
              "t.glb: accessor 0 sparse indices componentType: 5126 is not allowed");
    EXPECT_EQ(with(R"({"count":1,"indices":{"bufferView":30,"componentType":5123},"values":{"bufferView":0}})"),
              "t.glb: accessor 0 sparse indices bufferView: bufferView 30 is out of range: the file has 9");
    // The index buffer 0 1 2 0 2 3 serves as sparse indices: they rise up to the third.
    EXPECT_EQ(with(R"({"count":3,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}})"),
              "accepted");
    EXPECT_EQ(with(R"({"count":4,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}})"),
              "t.glb: mesh 0 primitive 0 POSITION sparse indices: not strictly increasing");
    EXPECT_EQ(with(R"({"count":4,"indices":{"bufferView":3,"componentType":5125},"values":{"bufferView":0}})"),
              "t.glb: mesh 0 primitive 0 POSITION sparse indices: 4 elements at byte 0 are out of range: bufferView 3 "
              "has 12 bytes");
    EXPECT_EQ(with(R"({"count":1,"indices":{"bufferView":3,"componentType":5125},"values":{"bufferView":0}})"),
              "t.glb: mesh 0 primitive 0 POSITION sparse indices: 65536 is out of range: the accessor has 4 elements");
    EXPECT_EQ(with(R"({"count":2,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":3}})"),
              "t.glb: mesh 0 primitive 0 POSITION sparse values: 2 elements at byte 0 are out of range: bufferView 3 "
              "has 12 bytes");
}

// ---- nodes and skins ------------------------------------------------------------------------------------------------

TEST(GltfRefusals, Nodes) {
    const std::string root = R"({"name":"root","children":[2]})";
    const std::string tip = R"({"name":"tip","translation":[1,0,0]})";
    EXPECT_EQ(withJson(root, R"({"children":[3]})"),
              "t.glb: node 1 children[0]: node 3 is out of range: the file has 3");
    EXPECT_EQ(withJson(root, R"({"children":[1]})"), "t.glb: node 1: is its own child");
    EXPECT_EQ(withJson(root, R"({"children":[2,2]})"), "t.glb: node 2: listed twice by its parent, node 1");
    EXPECT_EQ(withJson(tip, R"({"children":[1]})"), "t.glb: node 1: is its own ancestor");
    EXPECT_EQ(withJson(R"({"mesh":0,"skin":0})", R"({"mesh":0,"skin":0,"children":[2]})"),
              "t.glb: node 2: has two parents, nodes 0 and 1");
    EXPECT_EQ(withJson(tip, R"({"translation":[1,0]})"), "t.glb: node 2 translation: 2 numbers instead of 3");
    EXPECT_EQ(withJson(tip, R"({"translation":[1,0,"x"]})"), "t.glb: node 2 translation: not all numbers");
    EXPECT_EQ(withJson(tip, R"({"translation":[1,0,1e39]})"), "t.glb: node 2 translation: not finite");
    EXPECT_EQ(withJson(tip, R"({"rotation":[0,0,0,0]})"), "t.glb: node 2 rotation: zero quaternion");
    EXPECT_EQ(withJson(tip, R"({"name":3})"), "t.glb: node 2 name: not a string");
    EXPECT_EQ(withJson(R"({"mesh":0,"skin":0})", R"({"mesh":1,"skin":0})"),
              "t.glb: node 0 mesh: mesh 1 is out of range: the file has 1");
    EXPECT_EQ(withJson(R"({"mesh":0,"skin":0})", R"({"mesh":0,"skin":1})"),
              "t.glb: node 0 skin: skin 1 is out of range: the file has 1");
    EXPECT_EQ(withJson(R"({"mesh":0,"skin":0})", "{}"),
              "t.glb: nodes: none has a mesh, but 1 clip: it is no character, but a file of clips for one");
    EXPECT_EQ(withJson(R"("scene":0)", R"("scene":1)"), "t.glb: JSON scene: scene 1 is out of range: the file has 1");
    EXPECT_EQ(withJson(R"({"nodes":[0,1]})", R"({"nodes":[0,9]})"),
              "t.glb: scene 0 nodes[1]: node 9 is out of range: the file has 3");
    EXPECT_EQ(withJson(root, R"({"children":[2],"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,2]})"),
              "t.glb: node 1 matrix: last row is not 0 0 0 1");
    EXPECT_EQ(withJson(root, R"({"children":[2],"matrix":[1]})"), "t.glb: node 1 matrix: 1 numbers instead of 16");
}

TEST(GltfRefusals, DeepNodeTree) {
    const auto chain = [](uint32_t depth) {
        GltfBuilder b = skinnedQuad();
        b.nodes = R"([{"mesh":0,"skin":0},{"name":"root","children":[2]},{"name":"tip","children":[3]})";
        for (uint32_t i = 3; i < depth + 1; ++i)
            b.nodes += i < depth ? R"(,{"children":[)" + std::to_string(i + 1) + "]}" : ",{}";
        b.nodes += "]";
        return b.glb();
    };
    EXPECT_EQ(messageOf(chain(kMaxNodeDepth)), "accepted");
    EXPECT_EQ(messageOf(chain(kMaxNodeDepth + 1), ErrorCode::limit),
              "t.glb: node 1025: nested deeper than 1024 levels");
    EXPECT_EQ(messageOf(chain(200000), ErrorCode::limit), "t.glb: node 1025: nested deeper than 1024 levels");
}

TEST(GltfRefusals, Skins) {
    const std::string joints = R"({"joints":[1,2],"inverseBindMatrices":4})";
    EXPECT_EQ(withJson(joints, "{}"), "t.glb: skin 0: no joints");
    EXPECT_EQ(withJson(joints, R"({"joints":[]})"), "t.glb: skin 0: no joints");
    EXPECT_EQ(withJson(joints, R"({"joints":[1,3]})"),
              "t.glb: skin 0 joints[1]: node 3 is out of range: the file has 3");
    EXPECT_EQ(withJson(joints, R"({"joints":[1,2],"skeleton":3})"),
              "t.glb: skin 0 skeleton: node 3 is out of range: the file has 3");
    EXPECT_EQ(withJson(joints, R"({"joints":[1,2,0],"inverseBindMatrices":4})"),
              "t.glb: skin 0 inverseBindMatrices: 2 matrices for 3 joints");
    EXPECT_EQ(withJson(joints, R"({"joints":[1,2],"inverseBindMatrices":0})"),
              "t.glb: skin 0 inverseBindMatrices: VEC3 instead of MAT4");
    EXPECT_EQ(withFloat(kInverseBinds, 16 + 5, kNan), "t.glb: skin 0 inverseBindMatrices[1]: not finite");
    EXPECT_EQ(withFloat(kInverseBinds, 15, 2.0f), "t.glb: skin 0 inverseBindMatrices[0]: last row is not 0 0 0 1");
}

TEST(GltfRefusals, JointsAndWeights) {
    const std::string sets = R"("JOINTS_0":1,"WEIGHTS_0":2)";
    EXPECT_EQ(withJson(sets + ",", ""),
              "t.glb: mesh 0 primitive 0: no JOINTS_0 and WEIGHTS_0, but its node has a skin");
    EXPECT_EQ(withJson(sets, R"("JOINTS_0":1)"), "t.glb: mesh 0 primitive 0: JOINTS_0 without WEIGHTS_0");
    EXPECT_EQ(withJson(sets, sets + R"(,"WEIGHTS_1":2)"), "t.glb: mesh 0 primitive 0: WEIGHTS_1 without JOINTS_1");
    EXPECT_EQ(withJson(sets, sets + R"(,"JOINTS_2":1,"WEIGHTS_2":2)"),
              "t.glb: mesh 0 primitive 0: JOINTS_2 does not continue the sets from 0");
    EXPECT_EQ(withJson(R"("JOINTS_0":1)", R"("JOINTS_0":2)"),
              "t.glb: mesh 0 primitive 0 JOINTS_0: FLOAT components are not allowed here");
    EXPECT_EQ(withJson(R"("WEIGHTS_0":2)", R"("WEIGHTS_0":1)"),
              "t.glb: mesh 0 primitive 0 WEIGHTS_0: UNSIGNED_BYTE components without \"normalized\": true");
    EXPECT_EQ(withJson(R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"})",
                       R"({"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"})"),
              "t.glb: mesh 0 primitive 0 JOINTS_0: 3 elements for 4 vertices");
    EXPECT_EQ(withFloat(kWeights, 9, kNan), "t.glb: mesh 0 primitive 0 WEIGHTS_0[2]: not finite");
    EXPECT_EQ(withFloat(kWeights, 9, kInf), "t.glb: mesh 0 primitive 0 WEIGHTS_0[2]: not finite");
    EXPECT_EQ(withFloat(kWeights, 9, -0.25f), "t.glb: mesh 0 primitive 0 WEIGHTS_0[2]: negative");
    GltfBuilder b = skinnedQuad();
    b.setByte(kJoints, 5, 2);
    EXPECT_EQ(messageOf(b.glb()), "t.glb: mesh 0 primitive 0 JOINTS_0[1]: joint 2 is out of range: the skin has 2");
    std::string many;
    for (int n = 1; n <= 16; ++n)
        many += ",\"JOINTS_" + std::to_string(n) + "\":1,\"WEIGHTS_" + std::to_string(n) + "\":2";
    EXPECT_EQ(withJson(sets, sets + many, ErrorCode::limit),
              "t.glb: mesh 0 primitive 0: more than 16 sets of joints and weights");
}

// ---- mesh -----------------------------------------------------------------------------------------------------------

TEST(GltfRefusals, Mesh) {
    EXPECT_EQ(withJson(R"("POSITION":0,)", ""), "t.glb: mesh 0 primitive 0: no POSITION");
    EXPECT_EQ(withJson(R"("POSITION":0)", R"("POSITION":9)"),
              "t.glb: mesh 0 primitive 0 POSITION: accessor 9 is out of range: the file has 9");
    EXPECT_EQ(withJson(R"("mode":4)", R"("mode":7)"), "t.glb: mesh 0 primitive 0 mode: not in 0..6");
    EXPECT_EQ(withJson(R"("mode":4)", R"("mode":1)"),
              "t.glb: mesh 0: nothing but lines: no primitive of TRIANGLES, so there is no surface");
    EXPECT_EQ(withJson(R"("mode":4)", R"("material":0)"),
              "t.glb: mesh 0 primitive 0 material: material 0 is out of range: the file has 0");
    EXPECT_EQ(withFloat(kPositions, 4, kNan), "t.glb: mesh 0 primitive 0 POSITION[1]: not finite");
    EXPECT_EQ(withFloat(kPositions, 11, -kInf), "t.glb: mesh 0 primitive 0 POSITION[3]: not finite");
    EXPECT_EQ(withJson(R"("TEXCOORD_0":8)", R"("TEXCOORD_0":0)"),
              "t.glb: mesh 0 primitive 0 TEXCOORD_0: VEC3 instead of VEC2");
    EXPECT_EQ(withJson(R"({"bufferView":8,"componentType":5126,"count":4,"type":"VEC2"})",
                       R"({"bufferView":8,"componentType":5126,"count":3,"type":"VEC2"})"),
              "t.glb: mesh 0 primitive 0 TEXCOORD_0: 3 elements for 4 vertices");
    GltfBuilder none = skinnedQuad();
    none.meshes = R"([{"primitives":[]}])";
    EXPECT_EQ(messageOf(none.glb()), "t.glb: mesh 0: no primitives");
    none.meshes = R"([{"primitives":[{}]}])";
    EXPECT_EQ(messageOf(none.glb()), "t.glb: mesh 0 primitive 0: no attributes");
    none.meshes = "[]";
    EXPECT_EQ(messageOf(none.glb()), "t.glb: node 0 mesh: mesh 0 is out of range: the file has 0");
}

TEST(GltfRefusals, Indices) {
    GltfBuilder b = skinnedQuad();
    b.setByte(kIndices, 4, 4);
    EXPECT_EQ(messageOf(b.glb()),
              "t.glb: mesh 0 primitive 0 indices[2]: 4 is out of range: the primitive has 4 vertices");
    b.setByte(kIndices, 4, 0xFF);
    b.setByte(kIndices, 5, 0xFF);
    EXPECT_EQ(messageOf(b.glb()),
              "t.glb: mesh 0 primitive 0 indices[2]: 65535 is the restart value, which glTF 2.0 forbids");
    EXPECT_EQ(withJson(R"("count":6,"type":"SCALAR")", R"("count":5,"type":"SCALAR")"),
              "t.glb: mesh 0 primitive 0 indices: 5, not a multiple of 3");
    EXPECT_EQ(withJson(R"("indices":3,)", ""),
              "t.glb: mesh 0 primitive 0: 4 vertices without indices, not a multiple of 3");
    EXPECT_EQ(withJson(R"("indices":3)", R"("indices":5)"),
              "t.glb: mesh 0 primitive 0 indices: FLOAT components are not allowed here");
    EXPECT_EQ(withJson(R"("indices":3)", R"("indices":-1)"), "t.glb: mesh 0 primitive 0 indices: -1 is negative");
    GltfBuilder flat = skinnedQuad();
    for (size_t i = 0; i < 12; ++i)
        flat.setByte(kIndices, i, 0);
    EXPECT_EQ(messageOf(flat.glb()), "t.glb: mesh 0: no triangle is left");
}

TEST(GltfRefusals, MorphTargets) {
    const auto with = [](const std::string& targets, ErrorCode code = ErrorCode::asset) {
        return withJson(R"("mode":4)", R"("targets":)" + targets, code);
    };
    EXPECT_EQ(with(R"([{"POSITION":0},{"NORMAL":0}])"), "accepted");
    EXPECT_EQ(with("{}"), "t.glb: mesh 0 primitive 0 targets: not an array");
    EXPECT_EQ(with("[0]"), "t.glb: mesh 0 primitive 0 target 0: not an object");
    EXPECT_EQ(with(R"([{"POSITION":9}])"),
              "t.glb: mesh 0 primitive 0 target 0 POSITION: accessor 9 is out of range: the file has 9");
    EXPECT_EQ(with(R"([{"POSITION":0},{"POSITION":5}])"),
              "t.glb: mesh 0 primitive 0 target 1 POSITION: 3 elements for 4 vertices");
    EXPECT_EQ(with(R"([{"POSITION":2}])"), "t.glb: mesh 0 primitive 0 target 0 POSITION: VEC4 instead of VEC3");
    GltfBuilder b = skinnedQuad();
    const int deltas = b.addFloats("VEC3", {0, 0, 0, 0, 0, 0, 0, kNan, 0, 0, 0, 0});
    const std::string mesh = b.meshes;
    const auto meshWith = [&](const std::string& ofPrimitive, const std::string& ofMesh) {
        b.meshes = replaced(mesh, R"("mode":4)", R"("targets":)" + ofPrimitive);
        b.meshes = replaced(b.meshes, "[{\"primitives\"", "[{" + ofMesh + "\"primitives\"");
        return messageOf(b.glb());
    };
    EXPECT_EQ(meshWith(R"([{"POSITION":)" + std::to_string(deltas) + "}]", ""),
              "t.glb: mesh 0 primitive 0 target 0 POSITION[2]: not finite");
    EXPECT_EQ(meshWith(R"([{"POSITION":0}])", R"("weights":[0,1],)"),
              "t.glb: mesh 0 weights: 2 weights for 1 morph target");
    EXPECT_EQ(meshWith(R"([{"POSITION":0}])", R"("weights":["a"],)"), "t.glb: mesh 0 weights: not all numbers");
    EXPECT_EQ(meshWith("[]", R"("weights":[0,1],)"), "accepted") << "with a warning";
    b.nodes = replaced(b.nodes, R"({"mesh":0)", R"({"weights":[],"mesh":0)");
    EXPECT_EQ(meshWith(R"([{"POSITION":0}])", ""), "accepted");
    b.nodes = replaced(b.nodes, R"("weights":[])", R"("weights":[1,2])");
    EXPECT_EQ(meshWith(R"([{"POSITION":0}])", R"("weights":[1],)"),
              "t.glb: node 0 weights: 2 weights for 1 morph target");

    GltfBuilder two = skinnedQuad();
    const auto primitive = [](const std::string& more) {
        return R"({"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"indices":3,"targets":[)" + more + "]}";
    };
    two.meshes =
        R"([{"primitives":[)" + primitive(R"({"POSITION":0})") + "," + primitive(R"({"POSITION":0},{})") + "]}]";
    EXPECT_EQ(messageOf(two.glb()), "t.glb: mesh 0 primitive 1: 2 morph targets, but primitives before it have 1");
    // Many targets of one accessor that needs no bytes.
    std::string many;
    for (int i = 0; i < 65; ++i) {
        many += std::string(many.empty() ? "" : ",") + R"({"POSITION":0})";
    }
    GltfBuilder zeros = skinnedQuad();
    zeros.meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"targets":[)" + many + "]}]}]";
    zeros.nodes = R"([{"mesh":0},{},{}])";
    const std::string first = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
    EXPECT_EQ(
        messageOf(packGlb(replaced(zeros.json(), first, R"({"componentType":5126,"count":1048575,"type":"VEC3"})"),
                          zeros.binary()),
                  ErrorCode::limit, kMuchMemory),
        "t.glb: mesh 0 primitive 0: the morph targets hold more than 67108864 displacements");
}

// ---- animation ------------------------------------------------------------------------------------------------------

TEST(GltfRefusals, Animations) {
    const std::string first = R"({"sampler":0,"target":{"node":2,"path":"rotation"}})";
    EXPECT_EQ(withJson(first, R"({"sampler":2,"target":{"node":2,"path":"rotation"}})"),
              "t.glb: animation 0 channel 0 sampler: sampler 2 is out of range: the file has 2");
    EXPECT_EQ(withJson(first, R"({"target":{"node":2,"path":"rotation"}})"),
              "t.glb: animation 0 channel 0: sampler is missing");
    EXPECT_EQ(withJson(first, R"({"sampler":0,"target":{"node":3,"path":"rotation"}})"),
              "t.glb: animation 0 channel 0 target node: node 3 is out of range: the file has 3");
    EXPECT_EQ(withJson(first, R"({"sampler":0,"target":{"node":2}})"), "t.glb: animation 0 channel 0: path is missing");
    EXPECT_EQ(withJson(first, R"({"sampler":1,"target":{"node":2,"path":"translation"}})"),
              "t.glb: animation 0 channel 1: a second channel for translation of node 2");
    EXPECT_EQ(withJson(first, R"({"sampler":0,"target":{"node":2,"path":"scale"}})"),
              "t.glb: animation 0 channel 0 output: VEC4 instead of VEC3");
    EXPECT_EQ(withJson(R"({"name":"tip","translation":[1,0,0]})",
                       R"({"name":"tip","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,1,0,0,1]})"),
              "t.glb: animation 0 channel 0: animates node 2, which has a matrix\n"
              "t.glb: animation 0 channel 1: animates node 2, which has a matrix");
    EXPECT_EQ(withJson(R"({"input":5,"output":6})", R"({"input":5,"output":6,"interpolation":"SMOOTH"})"),
              "t.glb: animation 0 sampler 0 interpolation: \"SMOOTH\" is not allowed");
    EXPECT_EQ(withJson(R"({"input":5,"output":6})", R"({"input":5})"),
              "t.glb: animation 0 sampler 0: output is missing");
    EXPECT_EQ(withJson(R"({"input":5,"output":6})", R"({"input":9,"output":6})"),
              "t.glb: animation 0 sampler 0 input: accessor 9 is out of range: the file has 9");
    EXPECT_EQ(withJson(R"({"input":5,"output":6})", R"({"input":5,"output":2})"),
              "t.glb: animation 0 channel 0 output: 4 elements for 3 keys");
    EXPECT_EQ(withJson(R"({"input":5,"output":6})", R"({"input":5,"output":6,"interpolation":"CUBICSPLINE"})"),
              "t.glb: animation 0 channel 0 output: 3 elements for 3 keys of CUBICSPLINE");
    const GltfBuilder b = skinnedQuad();
    const std::string cubic =
        replaced(b.json(), R"({"input":5,"output":6})", R"({"input":5,"output":6,"interpolation":"CUBICSPLINE"})");
    EXPECT_EQ(
        messageOf(packGlb(replaced(cubic, R"("count":3,"type":"SCALAR")", R"("count":1,"type":"SCALAR")"), b.binary())),
        "t.glb: animation 0 channel 0 input: CUBICSPLINE needs at least two keys\n"
        "t.glb: animation 0 channel 1 output: 3 elements for 1 key");
    // Four rotations as weights: three keys of two targets need six.
    const GltfBuilder w = skinnedQuad();
    std::string weights = replaced(w.json(), R"("mode":4)", R"("targets":[{},{}])");
    weights = replaced(weights, first, R"({"sampler":0,"target":{"node":0,"path":"weights"}})");
    EXPECT_EQ(messageOf(packGlb(weights, w.binary())), "t.glb: animation 0 channel 0 output: VEC4 instead of SCALAR");
    weights = replaced(weights, R"({"input":5,"output":6})", R"({"input":5,"output":5})");
    EXPECT_EQ(messageOf(packGlb(weights, w.binary())),
              "t.glb: animation 0 channel 0 output: 3 elements for 3 keys of 2 morph targets");
    const auto bothInputs = [](const std::string& what) { // both channels have the same times
        return "t.glb: animation 0 channel 0 input" + what + "\nt.glb: animation 0 channel 1 input" + what;
    };
    EXPECT_EQ(withFloat(kTimes, 1, kNan), bothInputs("[1]: not finite"));
    EXPECT_EQ(withFloat(kTimes, 1, 0.0f), bothInputs("[1]: not later than the key before it"));
    EXPECT_EQ(withFloat(kTimes, 2, 0.5f), bothInputs("[2]: not later than the key before it"));
    EXPECT_EQ(withFloat(kRotations, 5, kInf), "t.glb: animation 0 channel 0 output[1]: not finite");
    EXPECT_EQ(withFloat(kRotations, 3, 0.0f), "t.glb: animation 0 channel 0 output[0]: zero quaternion");
    EXPECT_EQ(withFloat(kTranslations, 8, kNan), "t.glb: animation 0 channel 1 output[2]: not finite");
}

// ---- several faults -------------------------------------------------------------------------------------------------

TEST(GltfRefusals, AllFaultsAreToldAtOnce) {
    GltfBuilder b = skinnedQuad();
    b.setFloat(kRotations, 5, kInf);
    b.setFloat(kTranslations, 8, kNan);
    b.setFloat(kPositions, 0, kNan);
    EXPECT_EQ(messageOf(b.glb()), "t.glb: mesh 0 primitive 0 POSITION[0]: not finite\n"
                                  "t.glb: animation 0 channel 0 output[1]: not finite\n"
                                  "t.glb: animation 0 channel 1 output[2]: not finite");
    std::string json = replaced(b.json(), R"({"input":5,"output":6})", R"({"input":5,"output":99})");
    json = replaced(json, R"("name":"tip","translation":[1,0,0])", R"("name":"tip","translation":[1,0])");
    EXPECT_EQ(messageOf(packGlb(json, b.binary())),
              "t.glb: node 2 translation: 2 numbers instead of 3\n"
              "t.glb: animation 0 sampler 0 output: accessor 99 is out of range: the file has 9");
}

TEST(GltfRefusals, ManyFaultsEndInOneLine) {
    const GltfBuilder b = skinnedQuad();
    std::string nodes = R"({"name":"tip","translation":[1,0,0]})";
    for (int i = 0; i < 100; ++i) {
        nodes += R"(,{"scale":[1]})";
    }
    const std::string message =
        messageOf(packGlb(replaced(b.json(), R"({"name":"tip","translation":[1,0,0]})", nodes), b.binary()));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 32);
    EXPECT_TRUE(message.ends_with("\nt.glb: file: the rest was not read after 32 faults")) << message;
}

} // namespace
} // namespace supple::cage
