// What reading a file takes: no more than in proportion to its size, whatever the file asks for.
#include "cage/formats/reader.h"
#include "cage/memory_budget.h"
#include "tests/cage/gltf/builder.h"
#include "tests/support/host_memory.h"
#include "tests/support/shared_assets.h"

#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

namespace supple::test {
namespace {

struct Reading {
    Result<cage::Character> character;
    HostMemory memory;
    double seconds = 0.0; ///< the process's own, so that a busy machine finds nothing
};

#if defined(__has_feature) // clang
#if __has_feature(address_sanitizer)
#define SUPPLE_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) // GCC
#define SUPPLE_SANITIZED
#endif

#ifdef SUPPLE_SANITIZED
constexpr double kMostSeconds = 10.0;
#else
constexpr double kMostSeconds = 1.0;
#endif

Reading readCounted(const std::vector<std::byte>& bytes, const std::string& name, const std::string& folder = "",
                    const cage::GltfOptions& options = {}) {
    resetHostMemory();
    const std::clock_t begin = std::clock();
    Result<cage::Character> character = cage::readCharacter(bytes, name, folder, options);
    const std::clock_t spent = std::clock() - begin;
    const HostMemory memory = hostMemory();
    return {std::move(character), memory, static_cast<double>(spent) / CLOCKS_PER_SEC};
}

uint64_t allowed(uint64_t fileBytes) {
    return cage::kBaseMemory + cage::kMemoryPerByte * fileBytes;
}

/// `text` over and over with commas between.
std::string list(size_t count, const std::string& text) {
    std::string all;
    all.reserve(count * (text.size() + 1));
    for (size_t i = 0; i < count; ++i) {
        all += (i == 0 ? "" : ",") + text;
    }
    return all;
}

/// The file takes no more than it may. Returns why it was refused, or nothing.
std::string readWithin(const char* what, const std::vector<std::byte>& bytes, const std::string& name = "hostile.glb") {
    const Reading reading = readCounted(bytes, name);
    const std::string why = reading.character ? "" : reading.character.error().message;
    std::printf("  %-28s %8zu bytes: %7.2f MB at a time, %7.2f MB in all, %.3f s  %s\n", what, bytes.size(),
                static_cast<double>(reading.memory.peak) / 1e6, static_cast<double>(reading.memory.bytes) / 1e6,
                reading.seconds, why.substr(0, 150).c_str());
    EXPECT_LE(reading.memory.peak, allowed(bytes.size())) << what;
    EXPECT_LT(reading.seconds, kMostSeconds) << what;
    return why;
}

void expectRefused(const char* what, const std::vector<std::byte>& bytes, const std::string& element) {
    const std::string why = readWithin(what, bytes);
    EXPECT_TRUE(why.starts_with("hostile.glb: " + element + ": the file needs more memory than one of " +
                                std::to_string(bytes.size()) + " bytes may take by default, " +
                                std::to_string(allowed(bytes.size())) + " bytes"))
        << what << ": " << why;
}

/// The top-level members of a file of one triangle whose positions are zeros, with `more` behind them.
std::string triangleText(const std::string& primitive, const std::string& accessors, const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + primitive +
           R"(}]}],"accessors":[)" + accessors + "]" + more + "}";
}

TEST(ReadingMemory, ImagesShareTheBytesOfABufferView) {
    constexpr size_t kImages = 20000;
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    const int pixels = b.addIntegers("SCALAR", 5121, std::vector<uint32_t>(300000, 0xABu));
    b.more =
        R"(,"images":[)" + list(kImages, R"({"bufferView":)" + std::to_string(pixels) + R"(,"mimeType":"a"})") + "]";
    const std::vector<std::byte> bytes = b.glb();
    EXPECT_EQ(readWithin("20,000 images on one view", bytes), "");
    const Reading reading = readCounted(bytes, "hostile.glb");
    ASSERT_TRUE(reading.character.ok());
    ASSERT_EQ(reading.character->images.size(), kImages);
    EXPECT_EQ(reading.character->images[0].bytes.data(), reading.character->images[kImages - 1].bytes.data());
}

TEST(ReadingMemory, AnExternalFileIsReadOnce) {
    size_t asked = 0;
    cage::GltfOptions options;
    options.readFile = [&](const std::string&) -> Result<std::vector<std::byte>> {
        ++asked;
        return std::vector<std::byte>(1000000);
    };
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    b.more = R"(,"images":[)" + list(1000, R"({"uri":"a.png"})") + "]";
    const std::vector<std::byte> bytes = b.glb();
    const Reading reading = readCounted(bytes, "images.glb", "", options);
    EXPECT_TRUE(reading.character.ok());
    EXPECT_EQ(asked, 1u);
    EXPECT_LE(reading.memory.peak, allowed(bytes.size() + 1000000));
}

TEST(ReadingMemory, ZerosWithoutBytesAreCounted) {
    std::string attributes = R"("POSITION":0)";
    for (int n = 0; n < 16; ++n) {
        attributes += ",\"JOINTS_" + std::to_string(n) + R"(":1,"WEIGHTS_)" + std::to_string(n) + R"(":2)";
    }
    const std::string zeros = R"(,"count":16777215,"type":)";
    const std::string text = R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0]}],)"
                             R"("meshes":[{"primitives":[{"attributes":{)" +
                             attributes + R"(}}]}],"accessors":[{"componentType":5126)" + zeros +
                             R"("VEC3"},{"componentType":5121)" + zeros + R"("VEC4"},{"componentType":5126)" + zeros +
                             R"("VEC4"}]})";
    expectRefused("16 influence sets of zeros", toBytes(text), "mesh 0 primitive 0");
}

TEST(ReadingMemory, LinesOfHiddenEdgesAreCounted) {
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2},
                              R"(,"extensions":{"EXT_mesh_primitive_edge_visibility":{"lineStrings":[)" +
                                  list(16, R"({"indices":2})") + "]}}");
    std::string text = b.json();
    text.insert(text.find(R"(],"nodes")"), R"(,{"componentType":5125,"count":16777216,"type":"SCALAR"})");
    expectRefused("line strips of zeros", packGlb(text, b.binary()),
                  "mesh 0 primitive 0 EXT_mesh_primitive_edge_visibility lineString 0 indices");
}

TEST(ReadingMemory, InverseBindsBeyondTheJointsAreCounted) {
    expectRefused("2^24 inverse binds",
                  toBytes(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"skin":0}],"skins":[{"joints":[0],)"
                          R"("inverseBindMatrices":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":1}}]}],)"
                          R"("accessors":[{"componentType":5126,"count":16777216,"type":"MAT4"},)"
                          R"({"componentType":5126,"count":3,"type":"VEC3"}]})"),
                  "skin 0 inverseBindMatrices");
}

TEST(ReadingMemory, CornersAreCounted) {
    // 48 M corners: 3,000 of them, and 16,000 nodes that show them.
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {});
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < 3000; ++i) {
        indices.push_back(i % 3);
    }
    b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, indices);
    b.nodes = "[" + list(16000, R"({"mesh":0})") + "]";
    const std::string why = readWithin("48 M corners of shared meshes", b.glb());
    EXPECT_NE(why.find("the file needs more memory"), std::string::npos) << why;
}

TEST(ReadingMemory, EmptyElementsAreCounted) {
    const std::string triangle = R"("attributes":{"POSITION":0})";
    const std::string zeros = R"({"componentType":5126,"count":3,"type":"VEC3"})";
    for (const char* name : {"materials", "nodes", "images", "textures", "samplers", "scenes", "bufferViews", "skins",
                             "animations", "accessors", "buffers", "cameras", "extensionsUsed"}) {
        std::string text = triangleText(triangle, zeros);
        if (std::string(name) == "nodes") {
            text.replace(text.find(R"({"mesh":0})"), 10, R"({"mesh":0},)" + list(300000, "{}"));
        } else if (std::string(name) == "accessors") {
            text.replace(text.find(zeros), zeros.size(), zeros + "," + list(300000, "{}"));
        } else {
            text.insert(text.size() - 1, std::string(",\"") + name + "\":[" + list(300000, "{}") + "]");
        }
        readWithin((std::string("300,000 empty ") + name).c_str(), toBytes(text));
    }
}

TEST(ReadingMemory, NumbersAndStringsOfTheTextAreCounted) {
    const std::string triangle = R"("attributes":{"POSITION":0})";
    const std::string zeros = R"({"componentType":5126,"count":3,"type":"VEC3"})";
    for (const auto& [what, item] : {std::pair("numbers", "0"),
                                     {"strings", "\"\""},
                                     {"lists", "[]"},
                                     {"objects", "{}"},
                                     {"members", R"({"":0})"},
                                     {"words", "null"}}) {
        const std::string text = triangleText(triangle, zeros, R"(,"extras":[)" + list(500000, item) + "]");
        readWithin((std::string("500,000 ") + what).c_str(), toBytes(text));
    }
    std::string members;
    for (size_t i = 0; i < 200000; ++i) {
        members += (i == 0 ? "\"" : ",\"") + std::to_string(i) + "\":0";
    }
    readWithin("200,000 attributes", toBytes(triangleText(R"("attributes":{"POSITION":0,)" + members + "}", zeros)));
    readWithin("200,000 targets",
               toBytes(triangleText(triangle + R"(,"targets":[)" + list(200000, R"({"POSITION":0})") + "]", zeros)));
}

TEST(ReadingMemory, WhatNodesShareIsCountedForEach) {
    const std::string zeros = R"({"componentType":5126,"count":3,"type":"VEC3"})";
    const std::string nodes = "[" + list(10000, R"({"mesh":0,"skin":0})") + "]";
    readWithin("a skin of 10,000 nodes",
               toBytes(R"({"asset":{"version":"2.0"},"nodes":)" + nodes + R"(,"skins":[{"joints":[)" +
                       [] {
                           std::string joints;
                           for (int i = 0; i < 10000; ++i) {
                               joints += (i == 0 ? "" : ",") + std::to_string(i);
                           }
                           return joints;
                       }() +
                       R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[)" + zeros +
                       "]}"));
    const std::string plain = "[" + list(10000, R"({"mesh":0})") + "]";
    readWithin("the name of 10,000 parts",
               toBytes(R"({"asset":{"version":"2.0"},"nodes":)" + plain + R"(,"meshes":[{"name":")" +
                       std::string(100000, 'n') +
                       R"(","primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)" + zeros + "," +
                       zeros + "]}"));
    readWithin("target names of 10,000 parts",
               toBytes(R"({"asset":{"version":"2.0"},"nodes":)" + plain + R"(,"meshes":[{"extras":{"targetNames":[)" +
                       list(10000, R"("abcdefghijklmnopqrstuvwxyz")") +
                       R"(]},"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":0}]}]}],"accessors":[)" +
                       zeros + "]}"));
    readWithin("extensions of 10,000 parts",
               toBytes(R"({"asset":{"version":"2.0"},"extensionsUsed":[)" + list(100000, R"("a")") + R"(],"nodes":)" +
                       plain + R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[)" + zeros +
                       "]}"));
}

TEST(ReadingMemory, WhatExtensionsLeaveOutIsCounted) {
    const std::string zeros = R"({"componentType":5126,"count":3,"type":"VEC3"})";
    const auto file = [&](const std::string& nodes, const std::string& more) {
        return toBytes(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes +
                       R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[)" + zeros + "]" +
                       more + "}");
    };
    const std::string hidden = R"({"mesh":0,"extensions":{"KHR_node_visibility":{"visible":false}}})";
    EXPECT_EQ(readWithin("100,000 hidden nodes", file(list(100000, hidden) + R"(,{"mesh":0})", "")), "");
    std::string named, channels;
    for (int i = 0; i < 50000; ++i) {
        named += R"({"mesh":0,"extensions":{"a)" + std::to_string(i) + R"(":0}},)";
        channels += (i == 0 ? "" : ",") + std::string(R"({"sampler":0,"target":{"path":"pointer","extensions":)") +
                    R"({"KHR_animation_pointer":{"pointer":"/a)" + std::to_string(i) + R"("}}}})";
    }
    (void)readWithin("50,000 unread extensions", file(named + R"({"mesh":0})", ""));
    EXPECT_EQ(readWithin("50,000 kinds of pointers",
                         file(R"({"mesh":0})", R"(,"animations":[{"samplers":[{"input":0,"output":0}],"channels":[)" +
                                                   channels + "]}]")),
              "");
}

TEST(ReadingMemory, LinesOfAnObjAreCounted) {
    const auto lines = [](size_t count, const std::string& line) {
        std::string all = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n";
        for (size_t i = 0; i < count; ++i) {
            all += line;
        }
        return all;
    };
    for (const char* line : {"f 1 2 3\n", "f 1 2 3 4\n", "f 1 1 1\n", "v 0 0 0\n", "vn 0 0 1\n", "vt 0 0\n", "l 1 2\n",
                             "v 0 0 0 1 1 1\n", "usemtl a\n", "g a\n", "o a\n", "s 1\n", "\n", "#\n", "?\n", "p 1\n"}) {
        readWithin(("100,000 lines of " + std::string(line).substr(0, 3)).c_str(), toBytes(lines(100000, line)),
                   "hostile.obj");
    }
    std::string fans; // vertices of their own, and as few bytes as can be
    for (int i = 0; i < 100000; ++i) {
        fans += "v 0 0 " + std::to_string(i % 10) + "\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
    }
    readWithin("100,000 triangles", toBytes(fans), "hostile.obj");
    std::string named = lines(0, "");
    for (int i = 0; i < 100000; ++i) {
        named += "usemtl " + std::to_string(i) + "\nf 1 2 3\n";
    }
    readWithin("100,000 materials", toBytes(named), "hostile.obj");
    for (const auto& [count, line] : {std::pair(16383, "g "), std::pair(100000, "o "), std::pair(100000, "mtllib ")}) {
        std::string parts = lines(0, "");
        for (int i = 0; i < count; ++i) {
            parts += line + std::to_string(i) + (line[0] == 'm' ? "\n" : "\nf 1 2 3\n");
        }
        readWithin((std::to_string(count) + " times " + line).c_str(), toBytes(parts), "hostile.obj");
    }
    std::string soup = lines(0, "");
    for (int i = 0; i < 100000; ++i) {
        soup += "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nf -1 -2 -3\n";
    }
    readWithin("100,000 triangles, one place", toBytes(soup), "hostile.obj");
    std::string polygon = lines(0, "");
    for (int i = 0; i < 200000; ++i) {
        polygon += "v 0 0 0\n";
    }
    polygon += "f";
    for (int i = 1; i <= 200000; ++i) {
        polygon += " " + std::to_string(i);
    }
    readWithin("a face of 200,000 corners", toBytes(polygon + "\n"), "hostile.obj");
}

TEST(ReadingMemory, TheLimitIsTheHosts) {
    GltfBuilder b = plainMesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    cage::GltfOptions options;
    options.memoryLimit = 1000;
    const Result<cage::Character> small = cage::readGltf(b.glb(), "a.glb", "", options);
    ASSERT_FALSE(small.ok());
    EXPECT_EQ(small.error().code, ErrorCode::limit);
    EXPECT_EQ(small.error().message, "a.glb: JSON: the file needs more memory than the 1000 bytes of memoryLimit");
    options.memoryLimit = 1u << 30;
    b.nodes = "[" + list(16000, R"({"mesh":0})") + "]";
    EXPECT_TRUE(cage::readGltf(b.glb(), "a.glb", "", options).ok());
}

/// Everything a folder has that a reader takes.
void readFolder(const std::filesystem::path& folder, size_t& files) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (!entry.is_regular_file() || (ending != ".glb" && ending != ".gltf" && ending != ".obj")) {
            continue;
        }
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(stream)), {});
        uint64_t fileBytes = text.size();
        cage::GltfOptions options;
        options.readFile = [&](const std::string& path) {
            Result<std::vector<std::byte>> bytes = [&]() -> Result<std::vector<std::byte>> {
                std::ifstream external(entry.path().parent_path() / path, std::ios::binary);
                if (!external) {
                    return Error{ErrorCode::io, "no such file"};
                }
                return toBytes({std::istreambuf_iterator<char>(external), {}});
            }();
            fileBytes += bytes ? bytes->size() : 0;
            return bytes;
        };
        const Reading reading = readCounted(toBytes(text), entry.path().filename().string(), "", options);
        EXPECT_LE(reading.memory.bytes, allowed(fileBytes)) << entry.path();
        EXPECT_TRUE(reading.character.ok() ||
                    reading.character.error().message.find("needs more memory") == std::string::npos)
            << reading.character.error().message;
        ++files;
    }
}

TEST(ReadingMemory, EveryCharacterTakesLessInAll) {
    size_t files = 0;
    readFolder(SUPPLE_SAMPLE_ASSETS, files);
    readFolder(SUPPLE_TEST_DATA, files);
    EXPECT_GE(files, 3u);
    const size_t own = files;
    if (std::filesystem::is_directory(SUPPLE_SHARED_DIR "/assets")) {
        readFolder(SUPPLE_SHARED_DIR "/assets", files);
    }
    std::printf("  %zu files, %zu of them not in the repository\n", files, files - own);
}

} // namespace
} // namespace supple::test
