// Subdivision in views: which rate instances take, what is evaluated, listed and drawn of each, against groups of that
// rate alone.
#include "cage/gltf/reader.h"
#include "surface/lod/instance.h"
#include "tests/support/gpu_comparison.h"
#include "tests/support/limited_device.h"
#include "tests/support/lod_budget.h"
#include "tests/support/meshes.h"
#include "tests/support/rigged_tube.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/test_view.h"
#include "tools/common/procedural.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <optional>
#include <set>

namespace supple::test {
namespace {

class LodRates : public CrowdContexts, public testing::WithParamInterface<SuppleMapping> {};
INSTANTIATE_TEST_SUITE_P(Mappings, LodRates, testing::Values(SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE),
                         [](const auto& param) { return mappingName(param.param); });

SuppleGroupDesc groupOf(SuppleAsset asset, uint32_t capacity, SuppleScheme scheme, uint32_t rate) {
    SuppleGroupDesc desc{};
    desc.asset = asset;
    desc.capacity = capacity;
    desc.scheme = scheme;
    desc.rate = rate;
    desc.vertexFormat = SUPPLE_VERTEX_24; // as TestView
    return desc;
}

/// One rate of a group as the device left it.
struct RateOutput {
    SuppleRate rate{};
    std::vector<SuppleDrawRange> ranges;
    std::vector<VkDrawIndexedIndirectCommand> draws;
    std::vector<uint32_t> slots; ///< as many of its list as the first draw says
};

/// A group's outputs, read back.
struct ReadBack {
    host::GroupOutput output{};
    std::vector<RateOutput> rates;
    std::vector<std::byte> vertices, previous, tangents, attributes, uvs1;

    /// What lies between two vertices of an instance.
    [[nodiscard]] static std::vector<std::byte> part(const std::vector<std::byte>& bytes, size_t stride, size_t first,
                                                     size_t count) {
        EXPECT_LE((first + count) * stride, bytes.size());
        const auto begin = bytes.begin() + static_cast<ptrdiff_t>(first * stride);
        return {begin, begin + static_cast<ptrdiff_t>(count * stride)};
    }
    [[nodiscard]] size_t firstVertex(uint32_t slot, size_t r) const {
        return size_t{slot} * output.grid.verticesPerInstance + rates[r].ranges.front().firstVertex;
    }
    [[nodiscard]] size_t vertexCount(size_t r) const {
        const SuppleDrawRange& last = rates[r].ranges.back();
        return last.firstVertex + size_t{last.patchCount} * last.samplesPerPatch - rates[r].ranges.front().firstVertex;
    }
    [[nodiscard]] std::vector<std::byte> verticesOf(uint32_t slot, size_t r) const {
        return part(vertices, output.streams.vertices.stride, firstVertex(slot, r), vertexCount(r));
    }
    [[nodiscard]] std::vector<std::byte> previousOf(uint32_t slot, size_t r) const {
        return part(previous, 12, firstVertex(slot, r), vertexCount(r));
    }
    [[nodiscard]] std::vector<std::byte> tangentsOf(uint32_t slot, size_t r) const {
        return part(tangents, 4, firstVertex(slot, r), vertexCount(r));
    }
    /// Positions of verticesOf, without normals.
    [[nodiscard]] std::vector<std::byte> positionsOf(uint32_t slot, size_t r) const {
        std::vector<std::byte> positions;
        for (size_t v = firstVertex(slot, r), end = v + vertexCount(r); v < end; ++v) {
            const std::vector<std::byte> one = part(vertices, 1, v * output.streams.vertices.stride, 12);
            positions.insert(positions.end(), one.begin(), one.end());
        }
        return positions;
    }
    /// The rate that an instance is listed at; fails where it is more than one.
    [[nodiscard]] std::optional<size_t> rateOf(uint32_t slot) const {
        std::optional<size_t> found;
        for (size_t r = 0; r < rates.size(); ++r) {
            if (std::count(rates[r].slots.begin(), rates[r].slots.end(), slot) > 0) {
                EXPECT_FALSE(found.has_value()) << "slot " << slot << " has two rates";
                found = r;
            }
        }
        return found;
    }
};

enum class Parts { all, lists };
ReadBack readBack(const Crowd& crowd, Parts parts = Parts::all) {
    ReadBack written;
    written.output = crowd.output();
    const host::GroupOutput& o = written.output;
    if (parts == Parts::all) {
        written.vertices = crowd.read(o.streams.vertices);
        written.previous = crowd.read(o.streams.previousPositions);
        written.tangents = crowd.read(o.streams.tangents);
        written.attributes = crowd.read(o.streams.attributes);
        written.uvs1 = crowd.read(o.streams.uvs1);
    }
    const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
    EXPECT_EQ(draws.size(), o.grid.drawRangeCount);
    for (uint32_t r = 0; r < o.grid.rateCount; ++r) {
        RateOutput& rate = written.rates.emplace_back();
        rate.rate = o.grid.rates[r];
        for (uint32_t d = 0; d < rate.rate.drawRangeCount; ++d) {
            rate.ranges.push_back(o.grid.drawRanges[rate.rate.firstDrawRange + d]);
            rate.draws.push_back(draws[rate.rate.firstDrawRange + d]);
        }
        rate.slots.resize(rate.draws.front().instanceCount / rate.ranges.front().patchCount);
        const std::vector<std::byte> list = crowd.read(rate.rate.instances);
        EXPECT_LE(rate.slots.size() * 4, list.size());
        if (!rate.slots.empty()) {
            std::memcpy(rate.slots.data(), list.data(), rate.slots.size() * 4);
        }
        for (uint32_t d = 0; d < rate.rate.drawRangeCount; ++d) {
            const SuppleDrawRange& range = rate.ranges[d];
            const VkDrawIndexedIndirectCommand& draw = rate.draws[d];
            EXPECT_EQ(draw.instanceCount, range.patchCount * rate.slots.size());
            EXPECT_EQ(draw.indexCount, range.indexCount);
            EXPECT_EQ(draw.firstIndex, range.firstIndex);
            EXPECT_EQ(draw.vertexOffset, 0);
            EXPECT_EQ(draw.firstInstance, 0u);
        }
    }
    return written;
}

/// The list of all that are drawn.
std::vector<uint32_t> allSlots(const Crowd& crowd, const ReadBack& written) {
    size_t count = 0;
    for (const RateOutput& rate : written.rates) {
        count += rate.slots.size();
    }
    std::vector<uint32_t> slots(count);
    const std::vector<std::byte> bytes = crowd.read(written.output.info.instances);
    if (count > 0) {
        std::memcpy(slots.data(), bytes.data(), count * 4);
    }
    return slots;
}

/// The level of an instance by its deformed cage, in double.
double levelOf(const Crowd& crowd, uint32_t slot, const cage::Cage& bindPose, const SuppleCameraDesc& camera) {
    const surface::lod::InstanceMeasure measure = surface::lod::measureInstance(bindPose);
    const host::GroupOutput output = crowd.output();
    const std::vector<std::byte> bytes = crowd.slotBytes(output.info.deformedCage, slot);
    glm::dvec3 low(1e30), high(-1e30);
    for (uint32_t v = 0; v < output.info.cageVertexCount; ++v) {
        glm::vec3 p;
        std::memcpy(&p, bytes.data() + size_t{16} * v, sizeof(p));
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const double diagonal = glm::length(high - low);
    const glm::dvec3 eye(camera.position[0], camera.position[1], camera.position[2]);
    const double away = std::max(glm::length((low + high) * 0.5 - eye) - 0.5 * diagonal, 0.01);
    const double pixels = static_cast<double>(camera.pixelsPerUnit) / away;
    return std::min(static_cast<double>(measure.longest) * diagonal * pixels / 3.0,
                    std::sqrt(0.75 / 0.25 * static_cast<double>(measure.bend) * diagonal * pixels));
}

/// Groups of one rate, each rate of `crowd` one, whose instances do what those of the crowd do.
class RateTwins {
public:
    RateTwins(Crowd& crowd, const SuppleGroupDesc& desc, uint32_t flags, uint32_t firstRate) : crowd_(crowd) {
        SuppleGroupDesc own = desc;
        own.view = {};
        own.flags = flags;
        for (uint32_t r = 0; r < crowd.output().grid.rateCount; ++r) {
            own.rate = firstRate << r;
            twins_.push_back(std::make_unique<Crowd>(crowd.context(), own));
        }
    }
    void spawn() {
        instances_.push_back({crowd_.spawn()});
        for (const auto& twin : twins_) {
            instances_.back().push_back(twin->spawn());
        }
    }
    void pose(size_t i, uint32_t clip, double time, const glm::mat4& transform) {
        crowd_.pose(instances_[i][0], clip, time, transform);
        for (size_t t = 0; t < twins_.size(); ++t) {
            twins_[t]->pose(instances_[i][1 + t], clip, time, transform);
        }
    }
    void run() {
        std::vector<SuppleGroup> groups{crowd_.group()};
        for (const auto& twin : twins_) {
            groups.push_back(twin->group());
        }
        crowd_.context().run(groups);
    }
    [[nodiscard]] size_t size() const { return instances_.size(); }
    [[nodiscard]] const Crowd& at(size_t rate) const { return *twins_[rate]; }

private:
    Crowd& crowd_;
    std::vector<std::unique_ptr<Crowd>> twins_;
    std::vector<std::vector<SuppleInstance>> instances_; ///< of the crowd, then of its twins
};

struct RateCase {
    const char* name;
    SuppleScheme scheme;
    cage::Character character;
    uint32_t clip = SUPPLE_BIND_POSE;
    uint32_t firstRate = 2; ///< of a cage's edge: one segment a patch
    uint32_t rate = 16;
    uint32_t instances = 8; ///< at first; two more come later
};

cage::Character bodyOf(const cage::Cage& cage) {
    cage::Character character;
    character.name = "body";
    character.cage = cage;
    return character;
}

/// Two UV sets with seams at every edge.
cage::Cage withUvs(cage::Cage cage) {
    cage.cornerUvs.clear();
    cage.cornerUvs1.clear();
    for (uint32_t c = 0; c < cage.cornerCount(); ++c) {
        const auto x = static_cast<float>(c % 97) / 97.0f;
        cage.cornerUvs.emplace_back(x, 1.0f - x * x);
        cage.cornerUvs1.emplace_back(x * x, 0.5f * x);
    }
    return cage;
}

cage::Cage creased(cage::Cage cage) {
    return withRandomSharpness(std::move(cage), 7);
}

std::vector<RateCase> rateCases() {
    const cage::Cage quads = withUvs(perturbed(cage::makeCubeSphere(2), 0.05f, 3));
    const std::vector<SubdivisionCage>& zoo = subdivisionZoo();
    const auto named =
        std::find_if(zoo.begin(), zoo.end(), [](const SubdivisionCage& z) { return z.name == "mixed, valence 5"; });
    const cage::Cage mixed = withUvs(named->cage);
    std::vector<RateCase> cases{
        {"fragments, quads", SUPPLE_SCHEME_FRAGMENTS, bodyOf(quads)},
        {"fragments, quads, creased", SUPPLE_SCHEME_FRAGMENTS, bodyOf(creased(quads))},
        {"fragments, mixed", SUPPLE_SCHEME_FRAGMENTS, bodyOf(mixed), SUPPLE_BIND_POSE, 4},
        {"fragments, mixed, creased", SUPPLE_SCHEME_FRAGMENTS, bodyOf(creased(mixed)), SUPPLE_BIND_POSE, 4},
    };
    const Result<cage::Character> pip = cage::readGltfFile(std::string(SUPPLE_SAMPLE_ASSETS) + "/pip_quads.glb");
    EXPECT_TRUE(pip.ok());
    if (pip.ok()) {
        cases.push_back({"fragments, animated", SUPPLE_SCHEME_FRAGMENTS, *pip, 0, 2, 4, 3});
    }
    return cases;
}

TEST_P(LodRates, EveryInstanceIsThatOfAGroupOfItsRate) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    for (const RateCase& c : rateCases()) {
        SCOPED_TRACE(c.name);
        TestView view(context, 1024,
                      SUPPLE_VIEW_MOTION | SUPPLE_VIEW_ATTRIBUTES | SUPPLE_VIEW_UVS1 | SUPPLE_VIEW_TANGENTS);
        const SuppleAsset asset =
            c.clip == SUPPLE_BIND_POSE ? context.createAsset(c.character.cage) : context.createAsset(c.character);
        SuppleGroupDesc desc = groupOf(asset, 10, c.scheme, c.rate);
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        const uint32_t rates = static_cast<uint32_t>(std::countr_zero(c.rate) - std::countr_zero(c.firstRate)) + 1;
        ASSERT_EQ(crowd.output().grid.rateCount, rates);
        ASSERT_EQ(crowd.output().levels.drawCount, 0u);
        RateTwins twins(crowd, desc, SUPPLE_GROUP_MOTION | SUPPLE_GROUP_ATTRIBUTES | SUPPLE_GROUP_TANGENTS,
                        c.firstRate);
        for (uint32_t i = 0; i < c.instances; ++i) {
            twins.spawn();
        }
        size_t compared = 0, changed = 0;
        std::vector<size_t> usedBy(rates);
        std::map<uint32_t, size_t> before; // rates by slot
        const uint32_t frames = lessInWide(GetParam(), 6, 4);
        for (uint32_t frame = 0; frame < frames; ++frame) {
            if (frame == 3) { // two that have no past
                twins.spawn();
                twins.spawn();
            }
            for (size_t i = 0; i < twins.size(); ++i) {
                const float turn = 0.1f * static_cast<float>(frame) * static_cast<float>(1 + i);
                const glm::vec3 at(0.3f * static_cast<float>(frame), 0.0f,
                                   -std::exp2(1.0f + 6.8f * static_cast<float>(i) / static_cast<float>(c.instances)));
                twins.pose(i, c.clip, 0.2 * frame, glm::rotate(glm::translate(glm::mat4(1.0f), at), turn, {0, 1, 0}));
            }
            view.camera.pixelsPerUnit =
                250.0f * std::pow(1.8f, 5.0f * static_cast<float>(frame) / static_cast<float>(frames - 1));
            view.look({0.0f, 0.4f, 2.5f});
            twins.run();
            const ReadBack written = readBack(crowd);
            std::vector<ReadBack> alone;
            for (uint32_t r = 0; r < rates; ++r) {
                alone.push_back(readBack(twins.at(r)));
                ASSERT_EQ(alone[r].rates.size(), 1u);
                ASSERT_EQ(alone[r].output.grid.rate, written.rates[r].rate.rate) << "rate " << r;
                ASSERT_EQ(alone[r].rates[0].slots.size(), twins.size());
                ASSERT_EQ(written.rates[r].rate.drawRangeCount, alone[r].rates[0].rate.drawRangeCount);
                for (size_t d = 0; d < alone[r].rates[0].ranges.size(); ++d) {
                    const SuppleDrawRange &own = written.rates[r].ranges[d], &theirs = alone[r].rates[0].ranges[d];
                    EXPECT_EQ(own.firstPatch, theirs.firstPatch);
                    EXPECT_EQ(own.patchCount, theirs.patchCount);
                    EXPECT_EQ(own.material, theirs.material);
                    EXPECT_EQ(own.domain, theirs.domain);
                    EXPECT_EQ(own.samplesPerPatch, theirs.samplesPerPatch);
                    const auto triangles = [&](const Crowd& of, const SuppleDrawRange& range) {
                        return ReadBack::part(of.read(of.output().indices()), 2, range.firstIndex, range.indexCount);
                    };
                    EXPECT_EQ(triangles(crowd, own), triangles(twins.at(r), theirs));
                }
                EXPECT_EQ(ReadBack::part(written.attributes, 16, written.firstVertex(0, r), written.vertexCount(r)),
                          ReadBack::part(alone[r].attributes, 16, 0, alone[r].vertexCount(0)));
                ASSERT_EQ(alone[r].uvs1.empty(), c.character.cage.cornerUvs1.empty());
                ASSERT_EQ(written.uvs1.empty(), alone[r].uvs1.empty());
                for (size_t v = 0; v < (written.uvs1.empty() ? 0 : written.vertexCount(r)); v += 1) {
                    ASSERT_EQ(ReadBack::part(written.uvs1, 8, written.firstVertex(0, r) + v, 1),
                              ReadBack::part(alone[r].uvs1, 8, v, 1));
                }
                ASSERT_TRUE(std::is_sorted(written.rates[r].slots.begin(), written.rates[r].slots.end()));
            }
            std::vector<uint32_t> everyone(twins.size());
            for (uint32_t slot = 0; slot < everyone.size(); ++slot) {
                everyone[slot] = slot;
                const double level = levelOf(crowd, slot, c.character.cage, view.camera);
                size_t wanted = 0;
                while (wanted + 1 < rates && static_cast<double>(c.firstRate << wanted) < level) {
                    ++wanted;
                }
                // The device computes in float: a level this near to a rate says nothing.
                for (uint32_t r = 0; r < rates; ++r) {
                    ASSERT_GT(std::abs(level / (c.firstRate << r) - 1.0), 1e-5) << "move the instance a little";
                }
                const std::optional<size_t> rate = written.rateOf(slot);
                ASSERT_TRUE(rate.has_value()) << "slot " << slot;
                EXPECT_EQ(*rate, wanted) << "slot " << slot << ", level " << level;
                ++usedBy[*rate];
                const auto last = before.find(slot);
                changed += last != before.end() && last->second != *rate ? 1 : 0;
                before[slot] = *rate;

                EXPECT_EQ(written.verticesOf(slot, *rate), alone[*rate].verticesOf(slot, 0)) << "slot " << slot;
                EXPECT_EQ(written.previousOf(slot, *rate), alone[*rate].previousOf(slot, 0)) << "slot " << slot;
                EXPECT_EQ(written.tangentsOf(slot, *rate), alone[*rate].tangentsOf(slot, 0)) << "slot " << slot;
                EXPECT_EQ(written.tangentsOf(slot, *rate).size(), 4 * written.vertexCount(*rate));
                const bool fresh = written.previousOf(slot, *rate) == written.positionsOf(slot, *rate);
                EXPECT_EQ(fresh, frame == 0 || (frame == 3 && slot >= c.instances))
                    << "slot " << slot << ", frame " << frame;
                compared += written.vertexCount(*rate);
            }
            EXPECT_EQ(allSlots(crowd, written), everyone);
        }
        std::printf("%s: %zu vertices compared, %zu changes of rate\n", c.name, compared, changed);
        EXPECT_GE(changed, lessInWide(GetParam(), 2, 1));
        for (const size_t used : usedBy) {
            EXPECT_GT(used, 0u);
        }
    }
}

/// A column of instances that goes away from the camera, each twice as far as the one before.
void spawnColumn(Crowd& crowd, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        crowd.pose(crowd.spawn(), SUPPLE_BIND_POSE, 0.0,
                   glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, 0.0f, -std::exp2(static_cast<float>(i)))));
    }
}

cage::Cage bumpySphere() {
    return perturbed(cage::makeCubeSphere(2), 0.05f, 3);
}

std::vector<std::vector<uint32_t>> slotsByRate(const ReadBack& written) {
    std::vector<std::vector<uint32_t>> slots;
    for (const RateOutput& rate : written.rates) {
        slots.push_back(rate.slots);
    }
    return slots;
}

TEST_P(LodRates, OnlyWhatIsSeenIsEvaluatedAndDrawn) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 1024, SUPPLE_VIEW_MOTION | SUPPLE_VIEW_CULL);
    SuppleGroupDesc desc = groupOf(context.createAsset(creased(bumpySphere())), 12, SUPPLE_SCHEME_FRAGMENTS, 8);
    desc.view = view.handle();
    Crowd crowd(context, desc);
    ASSERT_TRUE(crowd.valid());
    std::vector<SuppleInstance> instances;
    for (int i = 0; i < 10; ++i) {
        instances.push_back(crowd.spawn());
    }
    std::map<uint32_t, double> moved; // along x, by slot
    // Sees about 12 units of a row with an instance every 6, from `left` on.
    const auto drawn = [&](float left, float drift) {
        for (size_t i = 0; i < instances.size(); ++i) {
            const glm::vec3 at(6.0f * static_cast<float>(i) + drift, 0.0f, 0.0f);
            crowd.pose(instances[i], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), at));
        }
        const glm::mat4 both = glm::orthoRH_ZO(-6.0f, 6.0f, -4.0f, 4.0f, 0.1f, 100.0f) *
                               glm::lookAt(glm::vec3(left + 6.0f, 0.0f, 30.0f), glm::vec3(left + 6.0f, 0.0f, 0.0f),
                                           glm::vec3(0.0f, 1.0f, 0.0f));
        std::memcpy(view.camera.viewProjection, &both, sizeof(both));
        view.look({left + 6.0f, 0.0f, 30.0f});
        context.run(crowd.group());
        const ReadBack written = readBack(crowd);
        std::set<uint32_t> seen;
        for (const uint32_t slot : allSlots(crowd, written)) {
            const size_t rate = written.rateOf(slot).value_or(0);
            const auto x = [](const std::vector<std::byte>& bytes) {
                float first = 0.0f;
                std::memcpy(&first, bytes.data(), sizeof(first));
                return static_cast<double>(first);
            };
            moved[slot] = x(written.positionsOf(slot, rate)) - x(written.previousOf(slot, rate));
            seen.insert(slot);
        }
        size_t listed = 0;
        for (const RateOutput& rate : written.rates) {
            listed += rate.slots.size();
            for (const uint32_t slot : rate.slots) {
                EXPECT_TRUE(seen.contains(slot));
            }
        }
        EXPECT_EQ(listed, seen.size());
        return seen;
    };
    EXPECT_EQ(drawn(-3.0f, 0.0f), (std::set<uint32_t>{0, 1}));
    EXPECT_EQ(drawn(3.0f, 0.25f), (std::set<uint32_t>{1, 2}));
    EXPECT_NEAR(moved[1], 0.25, 1e-5);
    EXPECT_NEAR(moved[2], 0.0, 1e-5) << "was not seen before: has no past";
    EXPECT_EQ(drawn(200.0f, 0.5f), std::set<uint32_t>{});
    EXPECT_EQ(drawn(3.0f, 0.75f), (std::set<uint32_t>{1, 2}));
    EXPECT_NEAR(moved[1], 0.0, 1e-5) << "was not seen in the frame before";
    crowd.setVisible(instances[1], false);
    EXPECT_EQ(drawn(3.0f, 1.0f), (std::set<uint32_t>{2}));
    EXPECT_NEAR(moved[2], 0.25, 1e-5);
    crowd.setVisible(instances[1], true);
    EXPECT_EQ(drawn(3.0f, 1.25f), (std::set<uint32_t>{1, 2}));
    EXPECT_NEAR(moved[1], 0.0, 1e-5) << "was hidden";
    EXPECT_NEAR(moved[2], 0.25, 1e-5);
    view.camera.farthest = 10.0f;
    EXPECT_EQ(drawn(3.0f, 1.25f), std::set<uint32_t>{});
    view.camera.farthest = 0.0f;
    view.camera.smallestRadius = 1e6f;
    EXPECT_EQ(drawn(3.0f, 1.25f), std::set<uint32_t>{});
}

TEST_P(LodRates, WithoutAVertexBudgetTheyAreNotCounted) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const SuppleAsset asset = context.createAsset(bumpySphere());
    TestView view(context, 60000);
    SuppleGroupDesc desc = groupOf(asset, 8, SUPPLE_SCHEME_FRAGMENTS, 32);
    desc.view = view.handle();
    Crowd rates(context, desc);
    desc.scheme = SUPPLE_SCHEME_PREP;
    desc.capacity = 16;
    Crowd levels(context, desc);
    ASSERT_TRUE(rates.valid() && levels.valid());
    EXPECT_EQ(levels.output().grid.rateCount, 0u);
    EXPECT_EQ(levels.output().grid.rates, nullptr);
    spawnColumn(rates, 8);
    spawnColumn(levels, 16);
    const auto run = [&](std::span<const SuppleGroup> groups) {
        view.look({0.0f, 0.0f, 3.0f});
        context.run(groups);
        std::vector<std::vector<uint32_t>> slots = slotsByRate(readBack(rates));
        context.run(groups); // statistics come with the frame after
        return slots;
    };
    const SuppleGroup alone[] = {rates.group()}, both[] = {rates.group(), levels.group()};
    const std::vector<std::vector<uint32_t>> wanted = run(alone);
    EXPECT_EQ(view.statistics().vertexCount, 0u);
    EXPECT_EQ(view.statistics().patchCount, 0u);
    EXPECT_EQ(view.statistics().instanceCount, 8u);
    EXPECT_EQ(view.statistics().drawnInstanceCount, 8u);
    EXPECT_EQ(view.statistics().levelScales[0], 1.0f);
    EXPECT_EQ(view.statistics().shortfall, 0u);
    std::set<size_t> used;
    for (size_t r = 0; r < wanted.size(); ++r) {
        if (!wanted[r].empty()) {
            used.insert(r);
        }
    }
    EXPECT_GE(used.size(), 3u);

    EXPECT_EQ(run(both), wanted);
    const SuppleViewStatistics free = view.statistics();
    EXPECT_EQ(free.levelScales[0], 1.0f);
    EXPECT_EQ(free.instanceCount, 24u);
    EXPECT_EQ(free.drawnInstanceCount, 24u);
    EXPECT_EQ(free.backFaceCount, 0u);
    EXPECT_GT(free.vertexCount, 0u);

    // Other groups' patches have no room: less than the coarsest of all. What does not count is not left out either.
    TestView small(context, 1024);
    desc.view = small.handle();
    desc.capacity = 16;
    Crowd many(context, desc);
    desc.scheme = SUPPLE_SCHEME_FRAGMENTS;
    desc.capacity = 8;
    Crowd few(context, desc);
    ASSERT_TRUE(many.valid() && few.valid());
    spawnColumn(many, 16);
    spawnColumn(few, 8);
    const SuppleGroup crowded[] = {many.group(), few.group()};
    small.look({0.0f, 0.0f, 3.0f});
    context.run(crowded);
    EXPECT_EQ(slotsByRate(readBack(few)), wanted);
    context.run(crowded);
    EXPECT_EQ(small.statistics().shortfall, 1u);
    EXPECT_GE(small.statistics().droppedInstanceCount, 1u);
    EXPECT_EQ(small.statistics().drawnInstanceCount + small.statistics().droppedInstanceCount, 24u);
    EXPECT_LE(small.statistics().vertexCount, 1024u);
}

/// Vertices of an instance, by rate.
std::vector<uint32_t> verticesByRate(const Crowd& crowd) {
    const host::GroupOutput output = crowd.output();
    std::vector<uint32_t> vertices;
    for (uint32_t r = 0; r < output.grid.rateCount; ++r) {
        vertices.push_back(0);
        for (uint32_t d = 0; d < output.grid.rates[r].drawRangeCount; ++d) {
            const SuppleDrawRange& range = output.grid.drawRanges[output.grid.rates[r].firstDrawRange + d];
            vertices.back() += range.patchCount * range.samplesPerPatch;
        }
    }
    return vertices;
}

/// Those that the draws take.
uint32_t drawnVertices(const Crowd& crowd) {
    const host::GroupOutput output = crowd.output();
    const std::vector<VkDrawIndexedIndirectCommand> draws = crowd.draws();
    uint32_t vertices = 0;
    for (uint32_t d = 0; d < output.grid.drawRangeCount; ++d) {
        vertices += draws[d].instanceCount * output.grid.drawRanges[d].samplesPerPatch;
    }
    return vertices;
}

// Rates and levels share a budget as a camera comes closer: no frame is over, all levels only fall, and each instance's
// rate is what its level asks for as it is scaled.
TEST_P(LodRates, TheBudgetHolds) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    const SuppleAsset asset = context.createAsset(bumpySphere());
    for (const bool alone : {true, false}) {
        TestView view(context, 300000);
        SuppleGroupDesc desc = groupOf(asset, 48, SUPPLE_SCHEME_FRAGMENTS, 32);
        desc.view = view.handle();
        Crowd rates(context, desc);
        desc.scheme = SUPPLE_SCHEME_PREP;
        desc.capacity = 16;
        Crowd levels(context, desc);
        ASSERT_TRUE(rates.valid() && levels.valid());
        for (int i = 0; i < 48; ++i) {
            const SuppleInstance instance = rates.spawn();
            const uint32_t row = i / 8;
            const glm::vec3 at(3.0f * static_cast<float>(i % 8) - 10.5f, 0.0f, -3.1f * static_cast<float>(row));
            rates.pose(instance, SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), at));
            EXPECT_EQ(suppleSetPriority(context.handle(), instance, i % 7 == 0 ? 1 : i == 9 ? 3 : 0), SUPPLE_OK);
        }
        spawnColumn(levels, 16);
        std::vector<SuppleGroup> groups{rates.group()};
        if (!alone) {
            groups.push_back(levels.group());
        }
        const std::vector<uint32_t> vertices = verticesByRate(rates);
        const auto frame = [&](float distance, uint32_t vertexBudget) {
            view.camera.vertexBudget = vertexBudget;
            view.look({0.0f, 2.0f, distance});
            context.run(groups);
            context.run(groups);
            return view.statistics();
        };
        // Enough: as without one.
        (void)frame(14.0f, 0);
        const std::vector<std::vector<uint32_t>> wanted = slotsByRate(readBack(rates, Parts::lists));
        const uint32_t free = drawnVertices(rates);
        const SuppleViewStatistics enough = frame(14.0f, 300000);
        ASSERT_LT(enough.wantedVertexCount, 290000u);
        EXPECT_GE(enough.wantedVertexCount, enough.vertexCount - (alone ? 0 : 200 * 3));
        EXPECT_EQ(slotsByRate(readBack(rates, Parts::lists)), wanted);
        EXPECT_EQ(enough.levelScales[0], 1.0f);
        if (alone) {
            EXPECT_EQ(enough.vertexCount, free);
            EXPECT_EQ(enough.patchCount, 0u);
        } else {
            EXPECT_GT(enough.vertexCount, free);
        }

        const uint32_t limit = enough.vertexCount / 3;
        const uint32_t padding = levels.output().levels.drawCount / shared::kCapacityCount * 3 * 64; // runtime/view.cpp
        float distance = 40.0f, before = 1.0f, steepest = 0.0f;
        size_t steps = 0, changes = 0, scaled = 0;
        std::vector<std::vector<uint32_t>> last;
        uint32_t most = 0, least = ~0u;
        const float closer = GetParam() == SUPPLE_MAPPING_WIDE ? 0.94f : 0.98f;
        for (; distance > 12.0f; distance *= closer, ++steps) {
            const SuppleViewStatistics now = frame(distance, limit);
            ASSERT_LE(now.vertexCount, limit) << steps;
            ASSERT_EQ(now.shortfall, 0u) << steps;
            ASSERT_EQ(now.drawnInstanceCount, alone ? 48u : 64u);
            ASSERT_LE(now.levelScales[0], before * 1.0001f) << steps;
            ASSERT_NEAR(now.levelScales[1], std::sqrt(now.levelScales[0]), 1e-5f);
            ASSERT_EQ(now.levelScales[3], 1.0f);
            const ReadBack written = readBack(rates, Parts::lists);
            if (alone) {
                ASSERT_EQ(now.vertexCount, drawnVertices(rates));
            }
            const std::vector<std::byte> bounds = rates.read(rates.output().bounds);
            surface::lod::budget::Priority reference[4];
            for (uint32_t slot = 0; slot < 48; ++slot) {
                const uint32_t priority = slot % 7 == 0 ? 1 : slot == 9 ? 3 : 0;
                float asked = 0.0f;
                std::memcpy(&asked, bounds.data() + size_t{32} * slot + 12, sizeof(asked));
                const auto level = static_cast<double>(asked);
                reference[priority].rates.add(level, 2, vertices);
                const double own = level * static_cast<double>(now.levelScales[priority]);
                size_t r = 0;
                while (r + 1 < vertices.size() && (2u << r) < own) {
                    ++r;
                }
                if (std::abs(own / std::exp2(std::round(std::log2(own))) - 1.0) > 1e-4) {
                    ASSERT_EQ(written.rateOf(slot), r) << "slot " << slot << ", step " << steps;
                }
            }
            if (alone && now.levelScales[0] < 1.0f) {
                const double elasticities[] = {1.0, 0.5, 0.25, 0.0};
                for (size_t p = 0; p < 4; ++p) {
                    reference[p].elasticity = elasticities[p];
                }
                const surface::lod::budget::Solution expected = surface::lod::budget::solve(reference, limit - padding);
                ASSERT_TRUE(expected.fits);
                const double x = -std::log2(static_cast<double>(now.levelScales[0])) * shared::kBinsPerOctave;
                // A step of demand is as steep as a rate's vertices in one bin.
                ASSERT_NEAR(x, expected.x, 0.02) << steps;
            }
            if (before < 1.0f) {
                steepest = std::max(steepest, before / now.levelScales[0] - 1.0f);
                least = std::min(least, now.vertexCount);
                ++scaled;
            }
            most = std::max(most, now.vertexCount);
            changes += steps > 0 && slotsByRate(written) != last ? 1 : 0;
            last = slotsByRate(written);
            before = now.levelScales[0];
        }
        std::printf(
            "%s: %zu steps, %zu scaled down, to %.3f, at most %.2f %% a step; %u to %u of %u vertices used; rates "
            "changed in %zu steps\n",
            alone ? "rates alone" : "rates and levels", steps, scaled, static_cast<double>(before),
            100.0 * static_cast<double>(steepest), least, most, limit, changes);
        EXPECT_GT(scaled, lessInWide(GetParam(), 20, 8));
        // The same again is the same, bit for bit.
        const SuppleViewStatistics once = frame(13.0f, limit);
        const std::vector<std::vector<uint32_t>> first = slotsByRate(readBack(rates, Parts::lists));
        (void)frame(30.0f, limit);
        const SuppleViewStatistics again = frame(13.0f, limit);
        EXPECT_EQ(std::memcmp(once.levelScales, again.levelScales, sizeof(once.levelScales)), 0);
        EXPECT_EQ(once.vertexCount, again.vertexCount);
        EXPECT_EQ(slotsByRate(readBack(rates, Parts::lists)), first);

        // Not even the coarsest of all: whole instances go, the untouchable one last; the rest is at its coarsest, but
        // for the untouchable one, which takes what is left.
        const SuppleViewStatistics short_ = frame(13.0f, vertices[0] * 20 + 1024);
        EXPECT_LE(short_.vertexCount, vertices[0] * 20 + 1024);
        EXPECT_EQ(short_.shortfall, 1u);
        EXPECT_GE(short_.droppedInstanceCount, 1u);
        EXPECT_EQ(short_.drawnInstanceCount + short_.droppedInstanceCount, alone ? 48u : 64u);
        const ReadBack coarse = readBack(rates, Parts::lists);
        const std::vector<uint32_t> kept = allSlots(rates, coarse);
        EXPECT_NE(std::find(kept.begin(), kept.end(), 9u), kept.end());
        for (const uint32_t slot : kept) {
            EXPECT_TRUE(slot == 9 || coarse.rateOf(slot) == 0) << slot;
        }
        EXPECT_LT(short_.levelScales[3], 1.0f);
        EXPECT_LT(short_.levelScales[0], short_.levelScales[3]);
    }
}

TEST_P(LodRates, OneRateWhereThereIsNoCoarserOne) {
    CrowdContext& context = CrowdContexts::context(GetParam());
    const ValidationGuard guard;
    TestView view(context, 1024);
    struct Case {
        cage::Cage cage;
        SuppleScheme scheme;
        uint32_t asked, rateCount, rate;
    };
    for (const Case& c :
         {Case{bumpySphere(), SUPPLE_SCHEME_FRAGMENTS, 1, 1, 1}, Case{bumpySphere(), SUPPLE_SCHEME_FRAGMENTS, 2, 1, 1},
          Case{bumpySphere(), SUPPLE_SCHEME_FRAGMENTS, 5, 3, 4}, Case{dodecahedron(), SUPPLE_SCHEME_FRAGMENTS, 2, 1, 1},
          Case{dodecahedron(), SUPPLE_SCHEME_FRAGMENTS, 64, 5, 16}}) {
        SuppleGroupDesc desc = groupOf(context.createAsset(c.cage), 2, c.scheme, c.asked);
        desc.view = view.handle();
        Crowd crowd(context, desc);
        ASSERT_TRUE(crowd.valid());
        (void)crowd.spawn();
        view.look({0.0f, 0.0f, 2.0f});
        context.run(crowd.group());
        const ReadBack written = readBack(crowd);
        EXPECT_EQ(written.output.grid.rate, c.rate);
        ASSERT_EQ(written.output.grid.rateCount, c.rateCount);
        for (uint32_t r = 0; r < c.rateCount; ++r) {
            EXPECT_EQ(written.rates[r].rate.rate, c.rate >> (c.rateCount - 1 - r));
        }
        EXPECT_TRUE(written.rateOf(0).has_value());
        EXPECT_EQ(suppleSetRate(context.handle(), crowd.group(), c.asked), SUPPLE_OK);
        EXPECT_EQ(suppleSetRate(context.handle(), crowd.group(), 2 * c.asked), SUPPLE_ERROR_ARGUMENT);
        EXPECT_NE(context.takeError(), 0);
    }
    // A group without a view has one, and it is all of it; also at another rate.
    for (const SuppleScheme scheme : {SUPPLE_SCHEME_PM, SUPPLE_SCHEME_FRAGMENTS}) {
        Crowd crowd(context, groupOf(context.createAsset(bumpySphere()), 2, scheme, 8));
        ASSERT_TRUE(crowd.valid());
        for (const uint32_t rate : {8u, 4u}) {
            if (scheme == SUPPLE_SCHEME_PM) {
                crowd.setRate(rate);
            }
            const host::GroupOutput output = crowd.output();
            ASSERT_EQ(output.grid.rateCount, 1u);
            EXPECT_EQ(output.grid.rates[0].rate, output.grid.rate);
            EXPECT_EQ(output.grid.rates[0].firstDrawRange, 0u);
            EXPECT_EQ(output.grid.rates[0].drawRangeCount, output.grid.drawRangeCount);
            EXPECT_EQ(output.grid.rates[0].instances.buffer, output.info.instances.buffer);
            EXPECT_EQ(output.grid.rates[0].instances.offset, output.info.instances.offset);
            EXPECT_EQ(output.grid.rates[0].instances.size, output.info.instances.size);
        }
    }
}

/// What a view draws of a crowd, and how many commands it took.
struct DrawnRates {
    std::map<uint32_t, std::pair<size_t, std::vector<std::byte>>> instances; ///< rate and its vertices, by slot
    std::map<uint32_t, std::vector<std::byte>> previous;
    WrappedVulkan counts;
};
DrawnRates drawRatesThrough(LimitedDevice& device, uint32_t count, uint32_t capacity) {
    DrawnRates drawn;
    if (device.context() != nullptr) {
        CrowdContext& context = *device.context();
        TestView view(context, 1024, SUPPLE_VIEW_MOTION);
        SuppleGroupDesc desc = groupOf(context.createAsset(creased(cube())), capacity, SUPPLE_SCHEME_FRAGMENTS, 8);
        desc.view = view.handle();
        Crowd crowd(context, desc);
        EXPECT_TRUE(crowd.valid());
        // The visible ones all over the slots, near and far.
        const uint32_t step = capacity / count;
        std::vector<SuppleInstance> instances;
        for (uint32_t slot = 0; slot < capacity; ++slot) {
            instances.push_back(crowd.spawn());
            crowd.setVisible(instances.back(), slot % step == 0 && slot / step < count);
        }
        for (int frame = 0; frame < 3; ++frame) { // until nothing is new
            for (uint32_t slot = 0; slot < capacity; slot += step) {
                const glm::vec3 at(0.1f * static_cast<float>(frame), 0.0f,
                                   -0.5f * std::pow(1.1f, static_cast<float>(slot / step % 96)));
                crowd.pose(instances[slot], SUPPLE_BIND_POSE, 0.0, glm::translate(glm::mat4(1.0f), at));
            }
            view.look({0.0f, 1.0f, 4.0f});
            drawn.counts = device.count(crowd.group());
        }
        const ReadBack written = readBack(crowd);
        for (size_t r = 0; r < written.rates.size(); ++r) {
            for (const uint32_t slot : written.rates[r].slots) {
                const bool once = drawn.instances.try_emplace(slot, r, written.verticesOf(slot, r)).second;
                EXPECT_TRUE(once) << slot;
                drawn.previous[slot] = written.previousOf(slot, r);
            }
        }
        EXPECT_EQ(drawn.instances.size(), count);
    }
    return drawn;
}

TEST_P(LodRates, CommandsDoNotCountInstances) {
    LimitedDevice device(GetParam(), [](WrappedVulkan&) {});
    const DrawnRates one = drawRatesThrough(device, 1, 1000);
    for (const uint32_t instances : {30u, 1000u}) {
        const DrawnRates many = drawRatesThrough(device, instances, 1000);
        EXPECT_EQ(many.counts.dispatches, one.counts.dispatches);
        EXPECT_EQ(many.counts.indirectDispatches, one.counts.indirectDispatches);
        EXPECT_EQ(many.counts.barriers, one.counts.barriers);
        EXPECT_EQ(many.counts.copies, one.counts.copies);
    }
    std::printf("%llu dispatches, %llu indirect ones, %llu barriers\n",
                static_cast<unsigned long long>(one.counts.dispatches),
                static_cast<unsigned long long>(one.counts.indirectDispatches),
                static_cast<unsigned long long>(one.counts.barriers));
    EXPECT_GT(one.counts.indirectDispatches, 3u);
}

TEST_P(LodRates, SplitDispatchesDrawTheSame) {
    const uint32_t instances = 600, capacity = 1200;
    DrawnRates drawn[2]; // whole and split
    for (const size_t split : {0u, 1u}) {
        LimitedDevice device(GetParam(), [&](WrappedVulkan& w) { w.maxComputeWorkGroupCountX = split == 1 ? 3 : 0; });
        drawn[split] = drawRatesThrough(device, instances, capacity);
    }
    std::set<size_t> rates;
    for (const auto& [slot, at] : drawn[0].instances) {
        rates.insert(at.first);
    }
    EXPECT_GE(rates.size(), 2u);
    EXPECT_TRUE(drawn[1].instances == drawn[0].instances);
    EXPECT_TRUE(drawn[1].previous == drawn[0].previous);
}

} // namespace
} // namespace supple::test
