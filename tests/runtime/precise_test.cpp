// `precise` where it matters: the static check on every shader that feeds a position, and mutations that take `precise`
// from one helper: the static check must see each, and the bits of shared borders must show it.
#include "cage/topology.h"
#include "runtime/arrays/character_arrays.h"
#include "runtime/context.h"
#include "surface/grid.h"
#include "tests/support/gpu_surface.h"
#include "tests/support/meshes.h"
#include "tests/support/spirv_precise.h"
#include "tools/common/cage_arrays.h"
#include "tools/common/procedural.h"

#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>

namespace supple::test {
namespace {

struct Checked {
    const char* shader;
    const char* position; ///< what the shader calls the value that becomes a position or feeds one
    bool levels = true;   ///< it is compiled for levels as well
    bool roots = false; ///< what is computed once, as a joint's matrix: its square roots need not agree with another's
    std::string form = ""; ///< a macro that it is compiled with
};
const Checked kShaders[] = {
    {"evaluate/bicubic.comp", "position"},
    {"evaluate/edge.comp", "position"},
    {"prep/vertex.comp", "canonical"},
    {"prep/edge.comp", "canonical"},
    {"evaluate/bicubic.comp", "position", false, false, "-DFAN_RECORDS "},
    {"prep/edge.comp", "canonical", false, false, "-DFAN_RECORDS "},
    {"pm/vertex.comp", "canonical"},
    {"pm/facet.comp", "canonical"},
    {"pm/evaluate.comp", "position"},
    {"deform/deform.comp", "p"},
    {"deform/deform.comp", "p", false, false, "-DMUSH "},
    {"points/stencils.comp", "tangent", false},
    {"subdivision/isolate.comp", "canonical"},
    {"fragments/refine.comp", "p"},
    {"chains/vertex.comp", "canonical"},
    {"chains/chain.comp", "canonical"},
    {"catmull_clark/evaluate.comp", "position"},
    {"catmull_clark/edge.comp", "position", false},
    {"loop/evaluate.comp", "position", false}, // at levels the weights inside are no border's
    {"loop/edge.comp", "position", false},
    {"blend/chart.comp", "canonical"},
    {"blend/evaluate.comp", "position"},
    {"fragments/limit.comp", "position"},
    {"fragments/fragment.comp", "position"},
    {"pose/locals.comp", "local"},
    {"pose/locals.comp", "local", false, false, "-DADDS -DTRANSITIONS "},
    {"pose/roots.comp", "local"},
    {"pose/roots.comp", "held"},
    {"pose/modify.comp", "local"},
    {"pose/drivers.comp", "weights"},
    {"pose/palette.comp", "element"},
    {"pose/mix.comp", "rows"},
    {"pose/mix.comp", "rotation"},
    {"polygons/face.comp", "canonical"},
    {"polygons/frame.comp", "canonical", true, true},
};

TEST(Precise, CoversEveryOperationOnTheWayToAPosition) {
    for (const Checked& c : kShaders) {
        // Either mapping, at a rate and at levels: what a macro leaves out is not looked at.
        for (const std::string macros : {"", "-DWIDE", "-DLEVELS", "-DLEVELS -DWIDE"}) {
            if (!c.levels && macros.find("LEVELS") != std::string::npos) {
                continue;
            }
            const std::vector<uint32_t> spirv = compileShader(c.shader, "", c.form + macros);
            ASSERT_FALSE(spirv.empty());
            uint32_t checked = 0;
            const std::vector<std::string> offences = imprecisePositionArithmetic(spirv, c.position, checked, c.roots);
            std::printf("%-20s %s%-15s %u operations carry NoContraction\n", c.shader, c.form.c_str(), macros.c_str(),
                        checked);
            EXPECT_GE(checked, 5u) << c.shader << ": the walk found too little to be believed";
            for (const std::string& offence : offences) {
                ADD_FAILURE() << c.shader << " " << c.form << macros << ": " << offence;
            }
        }
    }
}

// What hosts compile (shaders/supple_patch.glsl) keeps its sums as kernels do.
TEST(Precise, CoversPositionsThatHostsEvaluate) {
    constexpr const char* kShader = SUPPLE_SOURCE_DIR "/tests/runtime/shaders/direct.comp";
    for (const std::string form : {"", " -DSUPPLE_PATCH_TEXELS"}) {
        const std::vector<uint32_t> spirv = compileShader(kShader, "", "-I" SUPPLE_SOURCE_DIR "/shaders" + form);
        ASSERT_FALSE(spirv.empty());
        uint32_t checked = 0, loops = 0;
        for (const std::string& offence : imprecisePositionArithmetic(spirv, "position", checked)) {
            ADD_FAILURE() << offence;
        }
        std::printf("%u operations carry NoContraction\n", checked);
        EXPECT_GE(checked, 100u);
        EXPECT_EQ(preciseInUnrolledLoops(spirv, loops), 0u);
    }
}

// So poses and cages have the same words on every driver (shaders/shared/portable.h).
TEST(Precise, PosesAndCagesAskForNothingThatDriversRoundAsTheyLike) {
    uint32_t kernels = 0;
    for (const auto& file : std::filesystem::directory_iterator(SUPPLE_SPIRV_DIR)) {
        const std::string name = file.path().filename().string();
        if (!name.ends_with(".spv") ||
            !(name.starts_with("pose_") || name.starts_with("deform_") || name.starts_with("soft_")))
            continue;
        ++kernels;
        for (const std::string& operation : operationsThatDriversRound(readWords(file.path())))
            ADD_FAILURE() << name << ": " << operation;
    }
    EXPECT_GE(kernels, 60u);
    // It sees one where there is one.
    EXPECT_FALSE(operationsThatDriversRound(compileShader("polygons/frame.comp", "")).empty());
}

TEST(Precise, IsNotLostWhereLoopsAreUnrolled) {
    uint32_t kernels = 0, loops = 0;
    for (const auto& file : std::filesystem::directory_iterator(SUPPLE_SPIRV_DIR)) {
        const std::string name = file.path().filename().string();
        if (!name.ends_with(".spv") || name.ends_with(".opt.spv")) {
            continue; // as glslang wrote it
        }
        ++kernels;
        EXPECT_EQ(preciseInUnrolledLoops(readWords(file.path()), loops), 0u) << name;
    }
    std::printf("%u kernels, %u loops to be unrolled\n", kernels, loops);
    EXPECT_GE(kernels, 2u * static_cast<uint32_t>(surface::Kernel::count));
    EXPECT_GT(loops, 0u);
    // It sees one where there is one.
    const std::vector<uint32_t> unrolled =
        compileEdited("loop/evaluate.comp", "    do { // to before endJ - 1", "    [[unroll]] do { //", "");
    EXPECT_GT(preciseInUnrolledLoops(unrolled, loops), 0u);
}

/// Border samples that differ when evaluation runs the given code, over rates 5, 7, 11.
uint64_t differingBits(const std::vector<uint32_t>& evaluate) {
    host::Device& device = *testDevice();
    SuppleContextDesc desc = host::contextDesc(device);
    desc.mapping = SUPPLE_MAPPING_NARROW;
    surface::Shaders shaders = surface::Shaders::embedded();
    shaders[surface::Kernel::evaluateBicubic] = {evaluate, {}};
    Result<std::unique_ptr<runtime::Context>> context = runtime::Context::create(desc, shaders);
    if (!context) {
        ADD_FAILURE() << context.error().message;
        return 0;
    }
    const cage::Cage cage = perturbed(cage::makeSplitTorus(8, 7), 0.02f, 11);
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    const host::CageArrays arrays(cage);

    uint64_t different = 0, frame = 0;
    for (const uint32_t rate : {5u, 7u, 11u}) {
        Result<cage::Character> character = runtime::characterFromArrays(arrays.desc, "mutation");
        Result<uint64_t> asset = (*context)->createAsset(std::move(*character), 0);
        SuppleGroupDesc groupDesc{};
        groupDesc.structSize = sizeof(groupDesc);
        groupDesc.asset = {*asset};
        groupDesc.capacity = 1;
        groupDesc.scheme = SUPPLE_SCHEME_PREP;
        groupDesc.rate = rate;
        groupDesc.vertexFormat = SUPPLE_VERTEX_24;
        Result<uint64_t> id = (*context)->createGroup(groupDesc);
        EXPECT_TRUE((*context)->groups.find(*id)->slots().create().has_value());
        const SuppleGroup handle{*id};
        SuppleRecordDesc record{};
        record.structSize = sizeof(record);
        record.groups = &handle;
        record.groupCount = 1;
        record.after = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
        ++frame;
        EXPECT_TRUE((*context)->beginFrame(frame, frame - 1).ok());
        EXPECT_TRUE(device
                        .submitAndWait(
                            [&](VkCommandBuffer commands) { EXPECT_TRUE((*context)->record(commands, record).ok()); })
                        .ok());
        const runtime::Group& group = *(*context)->groups.find(*id);
        SuppleVertexStreams streams{};
        group.surfaces()[0].streams()->fill(streams);
        SuppleGridOutput grid{};
        group.surfaces()[0].fillGrid(grid);
        const Result<std::vector<std::byte>> bytes = device.readBuffer(streams.vertices);
        std::vector<uint32_t> patchOfFace(cage.faceCount());
        for (uint32_t p = 0; p < group.surfaces()[0].tables().patches.size(); ++p) {
            patchOfFace[group.surfaces()[0].tables().patches[p].face] = p;
        }
        const auto position = [&](uint32_t corner, uint32_t k) {
            const uint32_t face = topology->cornerFaces[corner];
            const uint32_t edge = corner - cage.faceStarts[face];
            return bytes->data() + 24 * (size_t{patchOfFace[face]} * grid.drawRanges[0].samplesPerPatch +
                                         surface::edgeSample(surface::Domain::quad, rate, edge, k));
        };
        for (const cage::Topology::Edge& edge : topology->edges) {
            for (uint32_t k = 0; k <= rate && edge.twin != cage::kNone; ++k) {
                different += std::memcmp(position(edge.corner, k), position(edge.twin, rate - k), 12) != 0;
            }
        }
    }
    return different;
}

TEST(Precise, MutationsAreCaught) {
    ASSERT_NE(testDevice(), nullptr);
    EXPECT_EQ(differingBits(optimized(compileShader("evaluate/bicubic.comp", ""))), 0u) << "unmutated";
    uint64_t shown = 0;
    for (const char* helper : {"sum4", "sum2", "bernstein3", "bernstein5", "parameterPair", "placed", "*"}) {
        const std::vector<uint32_t> spirv = compileShader("evaluate/bicubic.comp", helper);
        ASSERT_FALSE(spirv.empty());
        uint32_t checked = 0;
        const size_t offences = imprecisePositionArithmetic(spirv, "position", checked).size();
        const uint64_t bits = differingBits(optimized(spirv));
        std::printf("without precise in %-14s static check: %zu operations; border samples that differ: %llu\n", helper,
                    offences, static_cast<unsigned long long>(bits));
        EXPECT_GT(offences, 0u) << helper;
        shown += bits > 0 ? 1 : 0;
    }
    // Which helper shows in the bits is the compiler's choice; that none does would mean the bit test is blind.
    EXPECT_GE(shown, 1u);
}

} // namespace
} // namespace supple::test
