// Whatever tables pass the check (surface/chains/table_check.cpp), kernels stay within them, the pool and workgroup
// memory. This goes through the indices as the kernels themselves compute them, in 32 bits.
#include "shaders/shared/chains.h"
#include "shaders/shared/subdivision.h"
#include "surface/patch_records.h"
#include "surface/smooth_uvs.h"
#include "tests/support/exact_tables.h"

#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

using namespace shared;
using surface::Construction;
using surface::Kernel;
using surface::PatchClass;
using surface::SchemeId;
using surface::Tables;

/// Memory as a kernel sees it; notes what lies beyond.
class TracedMemory {
public:
    explicit TracedMemory(const Tables& tables) : tables_(tables) {}

    uint32_t word(uint32_t i) { return expect(i < tables_.words.size(), "word", i) ? tables_.words[i] : 0; }
    uint32_t element(uint32_t i, uint32_t k) { return word(4 * i + k); }
    uint32_t half(uint32_t first, uint32_t k) { return word(first + k / 2) >> 16 * (k % 2) & 0xFFFFu; }
    /// Rounds have an end: no table here is so large.
    bool goesOn() {
        constexpr uint64_t kMostRounds = 1000000;
        ++rounds_;
        return fault.empty() && expect(rounds_ < kMostRounds, "rounds", rounds_);
    }
    void pool(uint32_t i) { expect(i < tables_.poolStride, "coefficient", i); }
    void write(uint32_t i) {
        pool(i);
        expect(i != tables_.lod.depth || i == 0, "depth", i);
    }
    bool expect(bool holds, const char* what, uint64_t i) {
        if (!holds && fault.empty()) {
            fault = std::string(what) + " " + std::to_string(i);
        }
        return holds;
    }
    std::string fault;

private:
    const Tables& tables_;
    uint64_t rounds_ = 0;
};

/// shaders/chains/chain.comp.
class ChainTrace {
public:
    ChainTrace(const Tables& tables, bool loop, TracedMemory& memory) : loop_(loop), tables_(tables), at_(memory) {}

    void run(const Construction& c) {
        makes_ = c.kernel.kind;
        for (uint32_t lane = 0; lane < c.section.count && at_.goesOn(); ++lane) {
            if (makes_ == kMakesLimits) {
                limits(c.section.table + 2 * lane);
                continue;
            }
            block_ = c.section.table + lane / kBlockLanes;
            for (uint32_t k = 0; k < 4; ++k) {
                fan_[k] = at_.element(at_.element(block_, 0), k);
            }
            if (makes_ == kMakesChains) {
                wholeChains(lane % kBlockLanes);
            } else {
                level(lane % kBlockLanes);
            }
        }
    }

private:
    void netPoint(uint32_t i) { at_.pool(netFirst_ + at_.half(source_, i)); }
    void point(uint32_t i) {
        if (makes_ == kMakesChains) {
            at_.expect(source_ + i < kBlockPoints, "workgroup point", source_ + i);
        } else if (makes_ == kMakesLevel) {
            at_.pool(source_ + i);
        } else {
            netPoint(i);
        }
    }
    void put(uint32_t i) {
        if (makes_ == kMakesChains) {
            at_.expect(i < kBlockPoints, "workgroup point", i);
        } else {
            at_.write(i);
        }
    }
    void readNet(uint32_t record) {
        source_ = at_.element(record, 0);
        netFirst_ = at_.element(record + 1, 2);
        netPoint(0);
    }
    void limits(uint32_t record) {
        readNet(record);
        const uint32_t arrangement = at_.element(record, 2), normals = at_.element(record + 1, 1);
        const uint32_t runs = at_.element(arrangement, 0), ring = at_.element(arrangement, 3);
        uint32_t at = arrangement + 1;
        at_.write(at_.element(record, 3));
        for (uint32_t run = 0; run < runs && at_.goesOn(); ++run) {
            const uint32_t blocks = at_.element(at++, 0);
            for (uint32_t block = 0; block < blocks && at_.goesOn(); ++block) {
                for (uint32_t i = 1; i <= ring && at_.goesOn(); ++i) {
                    point(i);
                    (void)at_.element(at++, 3);
                }
            }
            at_.write(normals + run);
        }
        if (const uint32_t chain = at_.element(record + 1, 0); chain != 0) {
            at_.write(chain - 1);
        }
        if (const uint32_t centre = at_.element(record + 1, 3); centre != 0) {
            const uint32_t step = at_.element(arrangement, 2), each = loop_ ? 1 : 2;
            (void)at_.element(at_.element(record, 1) + 1, 0);
            point(1 + each * at_.element(step, 2));
            point(1 + each * at_.element(step, 3));
            at_.write(centre);
        }
    }

    [[nodiscard]] uint32_t index(uint32_t h, uint32_t a, uint32_t b) const {
        const uint32_t r = loop_ ? a + b : std::max(a, b), each = loop_ ? 1 : 2;
        if (r == 0) {
            return 0;
        }
        uint32_t place = loop_ ? r * h + b : 2 * r * h + (a >= b ? b : 2 * b - a);
        if (fan_[2] == 0 && place == each * r * fan_[0]) {
            place = 0;
        }
        return loop_ ? 1 + fan_[0] * r * (r - 1) / 2 + fan_[2] * (r - 1) + place
                     : 1 + fan_[0] * r * (r - 1) + fan_[2] * (r - 1) + place;
    }
    void readSpoke(uint32_t h) {
        const uint32_t before = h == 0 ? fan_[0] - 1 : h - 1;
        if (loop_) {
            const uint32_t own = h == fan_[0] ? 0 : 1, beside = fan_[2] != 0 && h == 0 ? 0 : 1;
            for (const uint32_t i :
                 {0u, index(h, 1, 0), index(h, 2, 0), own * index(h, 0, 1), own * index(h, 1, 1), own * index(h, 0, 2),
                  beside * index(before, 1, 0), beside * index(before, 1, 1)}) {
                point(i);
            }
            return;
        }
        for (uint32_t j = 0; j < 4; ++j) {
            for (uint32_t i = 0; i < 3; ++i) {
                const bool outside = j == 0 ? fan_[2] != 0 && h == 0 : h == fan_[0] && j > 1;
                point(outside ? 0 : j == 0 ? index(before, 1, i) : index(h, i, j - 1));
            }
        }
    }
    void putSpoke(uint32_t target, uint32_t h) {
        for (uint32_t i = 1; i < 4; ++i) {
            put(target + index(h, i, 0));
            for (uint32_t j = 1; j < 4 && h != fan_[0]; ++j) {
                if (!loop_ || i + j < 4) {
                    put(target + index(h, i, j));
                }
            }
        }
    }
    void readItem(uint32_t record, uint32_t spoke, uint32_t level) {
        const uint32_t arrangement = at_.element(record, 2);
        const uint32_t sharpness = at_.element(arrangement, 1), steps = at_.element(arrangement, 2);
        if (spoke != fan_[0] + fan_[2]) {
            if (sharpness != kNoSharpness) {
                (void)at_.word(sharpness + spoke);
            }
            readSpoke(spoke);
            return;
        }
        (void)at_.element(at_.element(block_, 0) + 1, 0);
        const uint32_t stride = loop_ ? 1 : 2;
        for (uint32_t k = 0; k < fan_[0] && at_.goesOn(); ++k) {
            point(1 + stride * k);
            point(loop_ ? 0 : 2 + stride * k);
        }
        point(1 + stride * at_.element(steps + level - 2, 2));
        point(1 + stride * at_.element(steps + level - 2, 3));
    }
    void putItem(uint32_t target, uint32_t spoke) {
        if (spoke == fan_[0] + fan_[2]) {
            put(target);
        } else {
            putSpoke(target, spoke);
        }
    }

    void wholeChains(uint32_t lane) {
        const uint32_t first = at_.element(block_, 1), vertices = at_.element(block_, 2), last = at_.element(block_, 3);
        const uint32_t spokes = fan_[0] + fan_[2], net = 1 + (loop_ ? 3 : 6) * fan_[0] + 2 * fan_[2];
        for (uint32_t n = lane; n < vertices * net && at_.goesOn(); n += kBlockLanes) {
            readNet(first + 2 * (n / net));
            netPoint(n % net);
            put(n / net * fan_[1] + n % net);
        }
        const bool idle = lane >= vertices * (spokes + 1);
        const uint32_t spoke = idle ? 0 : lane / vertices, vertex = idle ? 0 : lane - spoke * vertices;
        source_ = vertex * fan_[1];
        for (uint32_t l = 2; l <= last && at_.goesOn(); ++l) {
            readItem(first + 2 * vertex, spoke, l);
            if (!idle) {
                putItem(source_, spoke);
            }
            for (uint32_t n = lane; n < vertices * fan_[1] && at_.goesOn(); n += kBlockLanes) {
                const uint32_t chain = at_.element(first + 2 * (n / fan_[1]) + 1, 0);
                at_.write(chain + (l - 2) * fan_[1] + n % fan_[1]);
                at_.expect(n < kBlockPoints, "workgroup point", n);
            }
        }
    }
    void level(uint32_t lane) {
        const uint32_t word = at_.element(block_, 2), l = word >> kChainLevelShift;
        const uint32_t vertices = word & ((1u << kChainLevelShift) - 1), centres = makes_ == kMakesFirstLevel ? 0 : 1;
        const uint32_t items = vertices * (fan_[0] + fan_[2] + centres);
        if (!at_.expect(vertices > 0, "vertices", 0)) {
            return;
        }
        const uint32_t n = std::min(at_.element(block_, 3) + lane, items - 1), spoke = n / vertices;
        const uint32_t record = at_.element(block_, 1) + 2 * (n - spoke * vertices);
        const uint32_t target = at_.element(record + 1, 0) + (l - 2) * fan_[1];
        if (makes_ == kMakesFirstLevel) {
            readNet(record);
        } else {
            source_ = target - fan_[1];
        }
        readItem(record, spoke, l);
        putItem(target, spoke);
    }

    bool loop_;
    const Tables& tables_;
    TracedMemory& at_;
    uint32_t makes_ = 0, block_ = 0, source_ = 0, netFirst_ = 0;
    std::array<uint32_t, 4> fan_{};
};

/// shaders/subdivision/isolate.comp.
void traceStencils(const ExactTables& made, const Construction& c, const Tables& tables, TracedMemory& at) {
    const bool halves = c.kernel.kind == kHalfWords, inPool = c.kernel.kernel != Kernel::subdivisionIsolate;
    const auto vertex = [&](uint32_t i) {
        at.expect(c.from + i < (inPool ? tables.poolStride : made.vertices), "vertex", c.from + i);
    };
    for (uint32_t lane = 0; lane < c.section.count && at.goesOn(); ++lane) {
        const uint32_t block = c.section.table + lane / kBlockLanes;
        const uint32_t row =
            at.element(block, 0) + at.element(block, 1) * std::min(lane % kBlockLanes, at.element(block, 2) - 1);
        const auto numberAt = [&](uint32_t k) { return halves ? at.half(row, k) : at.word(row + k); };
        for (uint32_t pair = 0; pair < std::max(at.element(block, 3), 1u) && at.goesOn(); ++pair) {
            vertex(numberAt(2 + 2 * pair));
            vertex(numberAt(3 + 2 * pair));
            (void)at.element(c.section.table - numberAt(1) + pair / 2, 3);
        }
        at.write(c.to + numberAt(0));
    }
}

/// What kernels read of the records of leaves (shaders/catmull_clark/quad.glsl, shaders/loop/triangle.glsl): of
/// positions, or of texture coordinates.
class LeafTrace {
public:
    LeafTrace(const Tables& tables, bool loop, TracedMemory& memory) : tables_(tables), loop_(loop), at_(memory) {}

    void quad(uint32_t record, bool uvs) {
        const uint32_t net = 4 * (record + kQuadNetElement), last = at_.word(net + kNetListLastWord);
        std::array<bool, 4> chains{};
        for (uint32_t i = 0; i < 4; ++i) {
            point(at_.element(record, i), uvs);
            const uint32_t spoke = at_.element(record + 1, i), normal = at_.half(net, kNetListNormals + i);
            const uint32_t netList = at_.element(record + kQuadNetListElement, i);
            chains[i] = netList != 0;
            corner(spoke, netList, normal, uvs);
            if ((last >> (kCubicSide + i) & 1u) != 0) {
                at_.expect(!uvs, "cubic side", i);
                at_.pool(tables_.tangents + SUPPLE_SPOKE(spoke));
                const uint32_t next = at_.element(record + 1, (i + 1) % 4);
                at_.pool(tables_.tangents + SUPPLE_NEXT_SPOKE(next));
            }
        }
        for (uint32_t k = 0; k < kNetPoints; ++k) {
            point((last >> kNetFirstShift) + at_.half(net, k), uvs);
        }
        if (at_.half(net, kNetListSharp) != 0) {
            (void)at_.element(record + kQuadSharpnessElement, 3);
        }
    }
    /// `record`: where the vertices round it begin; those of texture coordinates have none.
    void triangle(uint32_t record, bool irregular, bool uvs) {
        const uint32_t flags = at_.element(record + kTriangleCornerElement, 3);
        for (uint32_t i = 0; i < 3; ++i) {
            point(at_.element(record + kTriangleCornerElement, i), uvs);
        }
        for (uint32_t k = 0; k < kLeafPoints && !uvs; ++k) {
            at_.pool(at_.word(4 * record + k));
        }
        at_.expect(!uvs || (flags >> kWholeTriangleSide & 7u) == 0, "whole side", record);
        if (!irregular) {
            return;
        }
        const uint32_t net = 4 * (record + kTriangleNetElement);
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t netList = at_.element(record + kTriangleChainElement + 1, i);
            at_.expect(uvs || (netList == 0) == ((flags >> (kPlainTriangleCorner + i) & 1u) != 0), "plain corner", i);
            corner(at_.element(record + kTriangleChainElement, i), netList, at_.half(net, kTriangleNetListNormals + i),
                   uvs);
        }
        for (uint32_t k = 0; k < kTriangleNetPoints; ++k) {
            point(at_.word(net + kTriangleNetListLastWord) + at_.half(net, k), uvs);
        }
    }

private:
    void point(uint32_t i, bool uvs) {
        if (uvs) {
            (void)at_.element(i / 2, 3);
        } else {
            at_.pool(i);
        }
    }
    void corner(uint32_t chain, uint32_t netList, uint32_t normal, bool uvs) {
        if (normal != 0) {
            point(chain - normal, uvs);
        }
        if (netList == 0) {
            return;
        }
        at_.expect(normal != 0 || uvs, "normal", chain);
        const uint32_t lastWord = at_.word(4 * netList + (loop_ ? kTriangleNetListLastWord : kNetListLastWord));
        const uint32_t size = lastWord & ((1u << kChainLevelShift) - 1), last = lastWord >> kChainLevelShift;
        at_.expect(last >= 2, "last level", last);
        point(chain - 1, uvs);
        for (uint32_t level = 2; level <= last && at_.goesOn(); ++level) {
            for (uint32_t k = 0; k < (loop_ ? kTriangleNetPoints : kNetPoints); ++k) {
                point(chain + (level - 2) * size + at_.half(4 * netList, k), uvs);
            }
        }
    }

    const Tables& tables_;
    bool loop_;
    TracedMemory& at_;
};

/// Empty if all stays within.
std::string traced(const ExactTables& made, const Tables& tables) {
    TracedMemory memory(tables);
    const bool loop = made.recipe.scheme == SchemeId::loop;
    ChainTrace chains(tables, loop, memory);
    for (const Construction& c : tables.constructions) {
        switch (c.kernel.kernel) {
        case Kernel::subdivisionIsolate:
        case Kernel::subdivisionIsolateMeshInPool:
            traceStencils(made, c, tables, memory);
            break;
        case Kernel::chainsVertex: // see table_words_test.cpp
        case Kernel::chainsVertexMeshInPool:
            break;
        default:
            chains.run(c);
        }
    }
    LeafTrace leaves(tables, loop, memory);
    for (const surface::PatchRange& range : tables.ranges) {
        const uint32_t each = surface::recordElements(tables, range.patchClass);
        for (uint32_t p = 0; p < range.section.count && range.patchClass != PatchClass::regular; ++p) {
            const uint32_t record = range.section.table + each * p;
            if (loop) {
                leaves.triangle(record, range.patchClass != PatchClass::loopRegular, false);
            } else {
                leaves.quad(record, false);
            }
        }
        const uint32_t uvs = surface::uvElements(tables, range.patchClass);
        for (uint32_t r = 0; tables.uvLeaves && r < tables.uvSets * range.section.count; ++r) {
            const uint32_t record = range.smoothUvs + uvs * r;
            if (loop) {
                leaves.triangle(record - kTriangleCornerElement, true, true);
            } else {
                leaves.quad(record, true);
            }
        }
    }
    return memory.fault;
}

/// A word as others of its kind are, or near to what it was.
uint32_t likely(const std::vector<uint32_t>& words, size_t at, std::mt19937& random) {
    const size_t strides[] = {1, 2, 3, 4, 8, 16, 28, 32, 36};
    const size_t stride = strides[random() % std::size(strides)] * (1 + random() % 3);
    switch (random() % 6) {
    case 0:
        return words[at] + 1 + static_cast<uint32_t>(random()) % 4;
    case 1:
        return words[at] - 1 - static_cast<uint32_t>(random()) % 4;
    case 2:
        return words[at] ^ 1u << random() % 32;
    case 3:
        return static_cast<uint32_t>(random()) % 8;
    default:
        return words[random() % 2 == 0 ? (at + stride) % words.size() : at - std::min(at, stride)];
    }
}

void expectInside(const ExactTables& made, uint32_t tries) {
    ASSERT_TRUE(made.check()) << made.check().error().message;
    ASSERT_EQ(traced(made, made.tables), "");
    std::mt19937 random(11);
    uint32_t passed = 0, beyond = 0;
    Tables tables = made.tables;
    for (uint32_t n = 0; n < tries; ++n) {
        std::vector<std::pair<size_t, uint32_t>> changes;
        for (uint32_t k = 1 + static_cast<uint32_t>(random()) % 2; k > 0; --k) {
            const size_t at = random() % tables.words.size();
            changes.emplace_back(at, tables.words[at]);
            tables.words[at] = likely(tables.words, at, random);
        }
        const bool fits = made.check(tables).ok();
        // Some that are refused are traced as well, so that it is known that the trace finds something.
        const std::string fault = fits || n % 8 == 0 ? traced(made, tables) : "";
        passed += fits ? 1 : 0;
        beyond += fault.empty() ? 0 : 1;
        ASSERT_TRUE(!fits || fault.empty()) << "word " << changes[0].first << " of " << tables.words.size()
                                            << " became " << tables.words[changes[0].first] << ": " << fault;
        for (size_t k = changes.size(); k-- > 0;) {
            tables.words[changes[k].first] = changes[k].second;
        }
    }
    std::printf("%u of %u tables passed, kernels would have left %u\n", passed, tries, beyond);
    EXPECT_GT(passed, tries / 10);
    EXPECT_GT(beyond, 0u);
}

TEST(ExactTableTrace, KernelsStayInside) {
    for (const SchemeId scheme : {SchemeId::catmullClark, SchemeId::loop}) {
        for (const bool wide : {false, true}) {
            surface::Recipe recipe;
            recipe.scheme = scheme;
            recipe.wide = wide;
            recipe.lod = wide;
            recipe.uvMode = cage::UvMode::cornersOnly;
            const bool loop = scheme == SchemeId::loop;
            const cage::Cage cage =
                loop ? withCreases(quartered(gyroBipyramid(5)), false) : withCreases(withoutFaces(prism(5), {2}), true);
            const Result<ExactTables> made = makeExactTables(recipe, 4, withCharts(cage));
            ASSERT_TRUE(made) << made.error().message;
            expectInside(*made, 1000);
        }
    }
}

} // namespace
} // namespace supple::test
