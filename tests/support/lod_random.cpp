#include "tests/support/lod_random.h"

#include "tests/support/spirv_precise.h"
#include "tools/common/inside_output.h"

#include <array>
#include <map>
#include <tuple>

namespace supple::test {

namespace {

/// Levels of edges from 1 up to where the range ends, which the camera tells: 1, odd integers and almost 1 more often.
/// Both sides of an edge see the same, for the two ends come in as a sum.
constexpr const char* kRandomEdge = R"(
    uvec3 ends = floatBitsToUint(x0) + floatBitsToUint(x1);
    uint h = (ends.x * 0x9E3779B9u) ^ (ends.y * 0x85EBCA6Bu) ^ (ends.z * 0xC2B2AE35u);
    h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12u)) * 0x297A2D39u;
    h ^= h >> 15u;
    if (level > 0.0) {
        float octaves = LOD_CAMERA.focal > 100.0 ? 5.97 : LOD_CAMERA.focal > 1.0 ? 2.0 : 0.0;
        level = exp2(float(h & 0xFFFFu) / 65536.0 * octaves);
        uint kind = (h >> 16u) & 7u;
        if (kind == 0u) level = 1.0;
        if (kind == 1u) level = 2.0 * floor(0.5 * level) + 1.0;
        if (kind == 2u) level = 1.000001;
        if (octaves == 0.0) level = 0.9;
    }
    scratchWords.at[levelBase(instance) + edge] = floatBitsToUint(level);)";

/// And capacities up to four octaves above what a patch needs, of every fourth one none.
constexpr const char* kRandomCapacity = R"(
    uint above = (patchIndex * 2654435761u) >> 24u;
    at = min(at + float(above < 64u ? 0u : above), 895.0);
    uint bin = min(uint(at), kLodBins - 2u), weight = min(uint((at - float(bin)) * float(kSplitUnit)), kSplitUnit);)";

/// What a record says its capacity's index is: any word.
constexpr const char* kWrongCapacity = "place * samples, (patchIndex * 2654435761u) >> (patchIndex % 32u));";

/// A kernel with a piece of it replaced. Optimized, as the layouts have the bindings of their mapping alone. Each is
/// compiled once in a process: that takes a second.
const std::vector<uint32_t>& edited(const std::string& path, const std::string& from, const std::string& to,
                                    const std::string& macros) {
    static std::map<std::array<std::string, 4>, std::vector<uint32_t>> known;
    const auto [found, isNew] = known.try_emplace({path, from, to, macros});
    if (isNew) {
        found->second = optimized(compileEdited(path, from, to, macros));
    }
    return found->second;
}

} // namespace

RandomLevels::RandomLevels(const Options& options) : edges_(options.edges) {
    const std::string macros = options.mapping == SUPPLE_MAPPING_WIDE ? "-DWIDE" : "";
    surface::Shaders shaders = surface::Shaders::embedded();
    using surface::Kernel;
    bool areThere = true;
    const auto replace = [&](Kernel kernel, const std::vector<uint32_t>& words) {
        shaders[kernel] = {words, words}; // of this mapping
        areThere = areThere && !words.empty();
    };
    const std::tuple<std::string, Kernel, Kernel> kBorders[] = {
        {"", Kernel::lodEdge, Kernel::lodPatch},
        {" -DHALVES", Kernel::lodEdgeHalves, Kernel::lodPatchHalves},
        {" -DCHARTS", Kernel::lodEdgeCharts, Kernel::lodPatchCharts},
        {" -DTRIANGLES", Kernel::lodEdgeTriangles, Kernel::lodPatchTriangles}};
    for (const auto& [borders, edge, patch] : kBorders) {
        replace(patch, edited("lod/patch.comp",
                              "    uint bin = min(uint(at), kLodBins - 2u), weight = min(uint((at - float(bin)) * "
                              "float(kSplitUnit)), kSplitUnit);",
                              kRandomCapacity, macros + borders));
        if (options.edges == Edges::random) {
            replace(edge,
                    edited("lod/edge.comp", "    scratchWords.at[levelBase(instance) + edge] = floatBitsToUint(level);",
                           kRandomEdge, macros + borders));
        }
    }
    if (options.wrongCapacities) {
        replace(Kernel::lodPlace, edited("lod/place.comp", "place * samples, capacity);", kWrongCapacity, macros));
    }
    if (testDevice() == nullptr || !areThere) {
        ADD_FAILURE() << "no device, or no shaders";
        return;
    }
    SuppleContextDesc contextDesc = host::contextDesc(*testDevice());
    contextDesc.mapping = options.mapping;
    Result<std::unique_ptr<runtime::Context>> context = runtime::Context::create(contextDesc, shaders);
    SuppleViewDesc viewDesc{};
    viewDesc.structSize = sizeof(viewDesc);
    viewDesc.maxVertices = 5'000'000;
    viewDesc.vertexFormat = options.vertexFormat;
    viewDesc.flags = options.tangents ? SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_TANGENTS : 0;
    const Result<uint64_t> view = context.ok() ? (*context)->createView(viewDesc) : Result<uint64_t>(context.error());
    if (!view.ok()) {
        ADD_FAILURE() << view.error().message;
        return;
    }
    view_ = *view;
    context_ = std::move(*context);
    setRange(Range::all);
}

void RandomLevels::setRange(Range range) {
    const float random = range == Range::all ? 800.0f : range == Range::low ? 8.0f : 0.01f;
    camera_.pixelsPerUnit = edges_ == Edges::random ? random : 100.0f; // from among the cages: else most levels are 63
}

std::optional<RandomLevels::Drawn> RandomLevels::draw(cage::Character character, SuppleGroupDesc desc,
                                                      uint32_t vertexBudget) {
    camera_.vertexBudget = vertexBudget;
    context_->views.find(view_)->setCamera(camera_);
    const Result<uint64_t> asset = context_->createAsset(std::move(character), 0);
    if (!asset.ok()) {
        ADD_FAILURE() << asset.error().message;
        return std::nullopt;
    }
    desc.structSize = sizeof(desc);
    desc.asset = {*asset};
    desc.capacity = 1;
    desc.view = {view_};
    const Result<uint64_t> id = context_->createGroup(desc);
    (void)context_->assets.remove(*asset);
    if (!id.ok()) {
        return std::nullopt;
    }
    runtime::Group& group = *context_->groups.find(*id);
    if (group.surfaces()[0].kind() != SUPPLE_TESSELLATION_LEVELS) { // fragments stand in for Loop patches
        EXPECT_TRUE(context_->destroyGroup(*id));
        return std::nullopt;
    }
    EXPECT_TRUE(group.slots().create().has_value());
    const SuppleGroup handle{*id};
    SuppleRecordDesc record{};
    record.structSize = sizeof(record);
    record.groups = &handle;
    record.groupCount = 1;
    record.after = {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
    ++frame_;
    EXPECT_TRUE(context_->beginFrame(frame_, frame_ - 1).ok());
    EXPECT_TRUE(
        testDevice()
            ->submitAndWait([&](VkCommandBuffer commands) { EXPECT_TRUE(context_->record(commands, record).ok()); })
            .ok());
    Drawn drawn{readLodSurface(*testDevice(), tools::insideOutput(group)), group.surfaces()[0].tables().patches};
    EXPECT_TRUE(context_->destroyGroup(*id));
    return drawn;
}

} // namespace supple::test
