// A character cut into mesh nodes that share a skin is, on the device, the character in one mesh.
#include "cage/character.h"
#include "cage/gltf/reader.h"
#include "tests/support/gpu_comparison.h"
#include "tools/gltf/writer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <tuple>

namespace supple::test {
namespace {

constexpr uint32_t kSewnParts = 3;

/// Per face: which of the slabs of equal height it lies in.
std::vector<uint32_t> slabsOf(const cage::Cage& cage, uint32_t slabs) {
    float low = INFINITY, high = -INFINITY;
    for (const glm::vec3& position : cage.positions) {
        low = std::min(low, position.y);
        high = std::max(high, position.y);
    }
    std::vector<uint32_t> of;
    for (uint32_t f = 0; f < cage.faceCount(); ++f) {
        float middle = 0.0f;
        for (uint32_t c = cage.faceStarts[f]; c < cage.faceStarts[f + 1]; ++c) {
            middle += cage.positions[cage.faceVertices[c]].y / static_cast<float>(cage.sides(f));
        }
        const float slab = static_cast<float>(slabs) * (middle - low) / (high - low);
        of.push_back(std::min(static_cast<uint32_t>(slab), slabs - 1));
    }
    return of;
}

template <class T>
void reorderFaces(const std::vector<uint32_t>& order, std::vector<T>& perFace) {
    std::vector<T> sorted;
    for (size_t i = 0; i < order.size() && !perFace.empty(); ++i) {
        sorted.push_back(perFace[order[i]]);
    }
    perFace = sorted;
}

template <class T>
void reorderCorners(const cage::Cage& cage, const std::vector<uint32_t>& order, std::vector<T>& perCorner) {
    std::vector<T> sorted;
    for (size_t i = 0; i < order.size() && !perCorner.empty(); ++i) {
        sorted.insert(sorted.end(), perCorner.begin() + cage.faceStarts[order[i]],
                      perCorner.begin() + cage.faceStarts[order[i] + 1]);
    }
    perCorner = sorted;
}

/// With the faces of a slab behind those of the one below it, so that slabs are runs of faces. Returns their ends.
std::vector<uint32_t> sortBySlabs(cage::Cage& cage, uint32_t slabs) {
    const std::vector<uint32_t> of = slabsOf(cage, slabs);
    std::vector<uint32_t> order(cage.faceCount());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return of[a] < of[b]; });
    EXPECT_TRUE(cage.holes.empty());
    reorderCorners(cage, order, cage.faceVertices);
    reorderCorners(cage, order, cage.cornerUvs);
    reorderCorners(cage, order, cage.cornerUvs1);
    reorderCorners(cage, order, cage.cornerColors);
    reorderCorners(cage, order, cage.cornerNormals);
    cage.faceTriangles.clear();
    reorderFaces(order, cage.faceMaterials);
    reorderFaces(order, cage.faceTrimTiles);
    std::vector<uint32_t> starts{0}, firstFaces;
    for (const uint32_t face : order) {
        while (firstFaces.size() <= of[face]) {
            firstFaces.push_back(static_cast<uint32_t>(starts.size() - 1));
        }
        starts.push_back(starts.back() + cage.sides(face));
    }
    cage.faceStarts = starts;
    return firstFaces;
}

/// Every run of faces a part of a node of its own, all of one skin and with the same morph targets.
cage::Character cut(cage::Character character, const std::vector<uint32_t>& firstFaces) {
    const cage::Part whole = character.parts.at(0);
    character.parts.assign(firstFaces.size(), whole);
    for (uint32_t p = 1; p < firstFaces.size(); ++p) {
        cage::Part& part = character.parts[p];
        const cage::Node node = character.skeleton.nodes[whole.node];
        part.node = static_cast<uint32_t>(character.skeleton.nodes.size());
        part.name = whole.name + " " + std::to_string(p);
        part.firstFace = firstFaces[p];
        character.skeleton.nodes.push_back(node);
        character.skeleton.nodes.back().name = part.name;
        character.skeleton.parentsFirst.push_back(part.node);
    }
    return character;
}

/// Where the writer put a character.
class WrittenCharacter {
public:
    WrittenCharacter(const cage::Character& character, const std::string& name)
        : path_(std::filesystem::path(testing::TempDir()) / ("supple_sewn_" + name + ".glb")) {
        const Result<cage::GlbFile> file = cage::writeGlb(character);
        if (!file) {
            ADD_FAILURE() << file.error().message;
            return;
        }
        std::ofstream(path_, std::ios::binary)
            .write(reinterpret_cast<const char*>(file->bytes.data()), static_cast<std::streamsize>(file->bytes.size()));
    }
    ~WrittenCharacter() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    WrittenCharacter(const WrittenCharacter&) = delete;
    WrittenCharacter& operator=(const WrittenCharacter&) = delete;

    [[nodiscard]] std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
};

/// Face, class and number among the face's patches of that class: parts and materials alone change their order.
using PatchName = std::tuple<uint32_t, SupplePatchClass, uint32_t>;

std::map<PatchName, uint32_t> patchesByName(const GpuSurface& gpu) {
    std::map<std::pair<uint32_t, SupplePatchClass>, uint32_t> counts;
    std::map<PatchName, uint32_t> names;
    for (uint32_t p = 0; p < gpu.patches().size(); ++p) {
        const SupplePatchInfo& patch = gpu.patches()[p];
        names[{patch.face, patch.patchClass, counts[{patch.face, patch.patchClass}]++}] = p;
    }
    return names;
}

struct ComparedSewn {
    ComparedBits positions, normals;
};

void compare(const GpuSurface& whole, const GpuSurface& parts, ComparedSewn& compared) {
    const std::map<PatchName, uint32_t> a = patchesByName(whole), b = patchesByName(parts);
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, patch] : a) {
        const auto other = b.find(name);
        ASSERT_NE(other, b.end()) << "face " << std::get<0>(name);
        ASSERT_EQ(whole.sampleCount(patch), parts.sampleCount(other->second));
        for (uint32_t s = 0; s < whole.sampleCount(patch); ++s) {
            const GpuSurface::Vertex &mine = whole.vertex(0, patch, s), &theirs = parts.vertex(0, other->second, s);
            compared.positions.compare(mine.position, theirs.position);
            compared.normals.compare(mine.normal, theirs.normal);
        }
    }
}

struct SewnCase {
    const char* name;
    const char* file;
    SuppleScheme scheme;
};
constexpr SewnCase kSewnCases[] = {{"Prep", "pip_quads.glb", SUPPLE_SCHEME_PREP},
                                   {"Pm", "pip.glb", SUPPLE_SCHEME_PM},
                                   {"Fragments", "pip.glb", SUPPLE_SCHEME_FRAGMENTS},
                                   {"Loop", "pip.glb", SUPPLE_SCHEME_LOOP},
                                   {"CatmullClark", "pip.glb", SUPPLE_SCHEME_CATMULL_CLARK},
                                   {"Blend", "pip.glb", SUPPLE_SCHEME_BLEND}};

class SewnParts : public testing::TestWithParam<SewnCase> {};
INSTANTIATE_TEST_SUITE_P(Schemes, SewnParts, testing::ValuesIn(kSewnCases),
                         [](const auto& param) { return std::string(param.param.name); });

TEST_P(SewnParts, AreTheWholeMesh) {
    ASSERT_NE(testDevice(), nullptr);
    const ValidationGuard guard;
    const std::string path = std::string(SUPPLE_SAMPLE_ASSETS) + "/" + GetParam().file;
    Result<cage::Character> character = cage::readGltfFile(path);
    ASSERT_TRUE(character.ok()) << character.error().message;
    ASSERT_EQ(character->parts.size(), 1u);
    const std::vector<uint32_t> firstFaces = sortBySlabs(character->cage, kSewnParts);
    ASSERT_EQ(firstFaces.size(), kSewnParts);
    const WrittenCharacter wholeFile(*character, std::string(GetParam().name) + "_whole");
    const WrittenCharacter partsFile(cut(*character, firstFaces), std::string(GetParam().name) + "_parts");
    const Result<cage::Character> sewn = cage::readGltfFile(partsFile.path());
    const Result<cage::Character> apart = cage::readGltfFile(partsFile.path(), {.sewParts = false});
    ASSERT_TRUE(sewn.ok() && apart.ok());
    EXPECT_TRUE(sewn->damages.empty());
    EXPECT_EQ(sewn->parts.size(), kSewnParts);
    EXPECT_EQ(sewn->cage.vertexCount(), character->cage.vertexCount());
    EXPECT_GT(apart->cage.vertexCount(), sewn->cage.vertexCount()) << "there is something to sew";

    for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
        SCOPED_TRACE(mappingName(mapping));
        GpuOptions options;
        options.mapping = mapping;
        options.scheme = GetParam().scheme;
        options.rate = 4;
        options.flags = 0;
        GpuSurface whole(*testDevice(), wholeFile.path(), options), parts(*testDevice(), partsFile.path(), options);
        ASSERT_TRUE(whole.valid() && parts.valid());
        ComparedSewn compared;
        const auto clips = static_cast<uint32_t>(std::min<size_t>(character->clips.size(), 3));
        ASSERT_GT(clips, 0u);
        for (uint32_t clip = 0; clip < clips; ++clip) {
            for (const double part : {0.0, 0.37, 0.81}) {
                const double time = part * character->clips[clip].duration;
                for (GpuSurface* gpu : {&whole, &parts}) {
                    ASSERT_EQ(suppleSetClipPose(gpu->context().handle(), gpu->instance(0), clip, time), SUPPLE_OK);
                    gpu->evaluate();
                }
                ASSERT_NO_FATAL_FAILURE(compare(whole, parts, compared));
            }
        }
        EXPECT_GT(compared.positions.samples, 0u);
        EXPECT_EQ(compared.positions.different, 0u);
        EXPECT_EQ(compared.normals.different, 0u);
    }
}

} // namespace
} // namespace supple::test
