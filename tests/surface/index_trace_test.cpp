// Whatever tables of fragments and of the blending surface pass the check, kernels stay within them, the pool, the
// scratch buffer and workgroup memory. This goes through the indices as the kernels themselves compute them, in 32
// bits.
#include "shaders/shared/blend.h"
#include "shaders/shared/subdivision.h"
#include "surface/grid.h"
#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/table_cases.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <random>

namespace supple::surface {
namespace {

using namespace shared;

/// Memory as a kernel sees it; notes what lies beyond.
class Memory {
public:
    explicit Memory(const Tables& tables, uint32_t vertices) : tables_(tables), vertices_(vertices) {}

    uint32_t word(uint32_t i) { return expect(i < tables_.words.size(), "word", i) ? tables_.words[i] : 0; }
    uint32_t element(uint32_t i, uint32_t k) { return word(4 * i + k); }
    uint32_t half(uint32_t i, uint32_t k) { return element(i, k / 2) >> 16 * (k % 2) & 0xFFFFu; }
    void pool(uint32_t i) { expect(i < tables_.poolStride, "coefficient", i); }
    void cage(uint32_t i) { expect(i < vertices_, "cage vertex", i); }
    /// Rounds have an end: no table here is so large.
    bool goesOn() {
        constexpr uint64_t kMostRounds = 4000000;
        ++rounds_;
        return fault.empty() && expect(rounds_ < kMostRounds, "rounds", rounds_);
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
    uint32_t vertices_;
    uint64_t rounds_ = 0;
};

/// shaders/subdivision/isolate.comp.
void traceStencils(Memory& at, const Construction& c) {
    const bool inPool = c.kernel.kernel == Kernel::subdivisionIsolateMeshInPool, halves = c.kernel.kind == kHalfWords;
    const auto vertex = [&](uint32_t i) { inPool ? at.pool(c.from + i) : at.cage(c.from + i); };
    for (uint32_t lane = 0; lane < c.section.count && at.goesOn(); ++lane) {
        const uint32_t block = c.section.table + lane / kBlockLanes;
        const uint32_t row =
            at.element(block, 0) + at.element(block, 1) * std::min(lane % kBlockLanes, at.element(block, 2) - 1);
        const auto number = [&](uint32_t k) {
            return halves ? at.word(row + k / 2) >> 16 * (k % 2) & 0xFFFFu : at.word(row + k);
        };
        for (uint32_t i = 0; i < std::max(at.element(block, 3), 1u) && at.goesOn(); ++i) {
            vertex(number(2 * i + 2));
            vertex(number(2 * i + 3));
            (void)at.element(c.section.table - number(1) + i / 2, 3);
        }
        at.pool(c.to + number(0));
    }
}

/// shaders/subdivision/{fragment,refine,limit}.comp.
class FragmentTrace {
public:
    FragmentTrace(const Tables& tables, Memory& memory)
        : tables_(tables), all_(tables.fragments), at_(memory), loop_(all_.loop),
          samples_(sampleCount(loop_ ? Domain::triangle : Domain::quad, tables.rate)) {}

    void run() {
        for (const Fragments::Class& own : all_.classes) {
            for (uint32_t f = 0; f < own.fragments.count && at_.goesOn(); ++f) {
                inWorkgroup(own.fragments.table + f, own.sharedPoints);
            }
        }
        for (uint32_t step = 1; step <= all_.steps + 1; ++step) {
            for (uint32_t kind = 0; kind < kWorkKinds; ++kind) {
                for (const Fragments::Class& own : all_.classes) {
                    const Section& blocks = own.blocks[(step - 1) * kWorkKinds + kind];
                    for (uint32_t id = 0; id < blocks.count * kBlockLanes && at_.goesOn(); ++id) {
                        lane(blocks.table, id, step, kind);
                    }
                }
            }
        }
    }

private:
    void point(uint32_t i) {
        if (local_ != 0) {
            at_.expect(region_ + i < local_, "workgroup point", region_ + i);
            return;
        }
        const uint32_t at = read_ + i * fragments_ + fragment_;
        if (fromNet_) {
            at_.pool(at_.word(at));
        } else {
            at_.expect(at < all_.scratchStride, "scratch point", at);
        }
    }
    void points(uint32_t element, uint32_t count) {
        for (uint32_t k = 0; k < count; ++k) {
            point(at_.half(element, k));
        }
    }
    void write(uint32_t i) {
        const uint32_t at = local_ != 0 ? target_ + i : write_ + i * fragments_ + fragment_;
        at_.expect(at < (local_ != 0 ? local_ : all_.scratchStride), "written point", at);
    }

    void refinedPoint(uint32_t row, uint32_t neighbours, uint32_t header, uint32_t step) {
        const uint32_t packed = at_.half(row, 7), rule = packed & 3u, spoke = packed >> 2;
        const uint32_t head = at_.element(header, 1), sectors = head & ~kSharpClass, stride = loop_ ? 1 : 2;
        const bool sharp = (head & kSharpClass) != 0;
        if (spoke != 0 && sharp) {
            (void)at_.word(at_.element(header, 3) + (spoke - 1) * fragments_ + fragment_);
        }
        if (rule == kVertexRule) {
            points(row, loop_ ? 7 : 1);
            if (!loop_) {
                points(neighbours + at_.half(row, 0), 8);
            }
        } else if (rule == kEdgeRule) {
            points(row, loop_ ? 4 : 6);
        } else if (rule == kFaceRule && !loop_) {
            points(row, 4);
        } else if (rule == kCentreRule) {
            for (uint32_t k = 0; k < sectors && at_.goesOn(); ++k) {
                point(1 + stride * k);
                point(stride + stride * k);
            }
            if (sharp) {
                const uint32_t centre = at_.element(header + 1, 2) + (step - 1) * fragments_ + fragment_;
                point(1 + stride * at_.element(centre, 2));
                point(1 + stride * at_.element(centre, 3));
            }
        }
    }

    void writeSample(uint32_t patch, uint32_t sample) {
        if (patch != kNoPatch) {
            at_.expect(patch < tables_.patches.size(), "patch", patch);
            at_.expect(sample < samples_, "sample", sample);
        }
    }

    void limitSample(uint32_t row, uint32_t header, uint32_t patches) {
        const uint32_t own = at_.element(row + 1, 0), spoke = at_.element(row + 1, 1), place = at_.element(row + 1, 2);
        const uint32_t sector = place & kSectorMask, masks = at_.element(header + 1, 1);
        if (spoke != 0 && (at_.element(header, 1) & kSharpClass) != 0) {
            (void)at_.word(at_.element(header, 3) + (spoke - 1) * fragments_ + fragment_);
        }
        point(own);
        points(row, loop_ ? 6 : 8);
        if (own == 0 && masks != 0) {
            centreLimit(at_.word(masks + sector * fragments_ + fragment_), sector);
        }
        writeSample(at_.word(patches + sector * fragments_ + fragment_), at_.element(row + 1, 3));
    }
    void centreLimit(uint32_t mask, uint32_t sector) {
        const uint32_t stride = loop_ ? 1 : 2, first = at_.element(mask, 1), sectors = at_.element(mask, 2),
                       ring = at_.element(mask, 3);
        point(0);
        for (uint32_t i = 1; i <= ring && at_.goesOn(); ++i) {
            (void)at_.element(mask + i, 3);
            point(i);
        }
        const uint32_t spokes = ring / stride + ring % stride;
        if (!at_.expect(spokes > 0, "spokes", spokes)) {
            return;
        }
        const bool corner = (at_.element(mask, 0) & kCornerMask) != 0;
        for (uint32_t h = first; h < (corner ? first + sectors : 0) && at_.goesOn(); ++h) {
            point(1 + stride * (h % spokes));
            point(1 + stride * ((h + 1) % spokes));
        }
        if (corner) {
            point(1 + stride * sector);
            point(1 + stride * ((sector + 1) % spokes));
        }
    }

    void inWorkgroup(uint32_t record, uint32_t localPoints) {
        const uint32_t header = at_.element(record, 0), levels = header + kClassHeaderElements;
        fragment_ = at_.element(record, 1);
        fragments_ = at_.element(header, 0);
        local_ = localPoints;
        target_ = region_ = 0;
        for (uint32_t i = 0; i < at_.element(levels, 2) && at_.goesOn(); ++i) {
            at_.pool(at_.word(at_.element(header, 2) + i * fragments_ + fragment_));
            write(i);
        }
        for (uint32_t step = 1; step <= all_.steps; ++step) {
            const uint32_t rows = at_.element(levels + step, 0), count = at_.element(levels + step, 2);
            target_ = region_ == 0 ? local_ - count : 0;
            for (uint32_t i = 0; i < count && at_.goesOn(); ++i) {
                refinedPoint(rows + i, at_.element(levels + step - 1, 1), header, step);
                write(i);
            }
            region_ = target_;
        }
        for (uint32_t i = 0; i < at_.element(header + 2, 3) && at_.goesOn(); ++i) {
            limitSample(at_.element(header + 2, 2) + 2 * i, header, at_.element(header + 1, 0));
        }
        local_ = 0;
    }

    void lane(uint32_t records, uint32_t id, uint32_t step, uint32_t kind) {
        const uint32_t block = records + 3 * (id / kBlockLanes), rows = at_.element(block, 0),
                       list = at_.element(block, 1), places = at_.element(block + 1, 3);
        read_ = at_.element(block + 1, 0);
        write_ = at_.element(block + 1, 1);
        fragments_ = at_.element(block + 1, 2);
        fromNet_ = step == 1;
        const uint32_t beyond = at_.element(block, 3) + id % kBlockLanes;
        const auto past = static_cast<uint32_t>((static_cast<float>(beyond) + 0.5f) / static_cast<float>(fragments_));
        fragment_ = beyond - past * fragments_;
        uint32_t place = at_.element(block, 2) + past;
        const bool idle = place >= places;
        place = std::min(place, places - 1);
        if (step > all_.steps) {
            kind == kInBulk ? strip(rows + place, list)
                            : limitSample(rows + 2 * place, at_.element(block + 2, 1), list);
        } else if (kind == kInBulk) {
            if (!idle) {
                cell(rows + place, at_.element(block + 2, 0));
            }
        } else {
            const uint32_t row = at_.word(list + place);
            refinedPoint(rows + row, at_.element(block + 2, 0), at_.element(block + 2, 1), step);
            write(row);
        }
    }
    void cell(uint32_t cell, uint32_t neighbours) {
        const uint32_t own = at_.half(cell, kCellTargets);
        point(own);
        points(neighbours + own, loop_ ? 6 : 8);
        for (uint32_t k = 0; k < (loop_ ? 7u : 6u); ++k) {
            if (at_.half(cell, k) != kNoTarget) {
                write(at_.half(cell, k));
            }
        }
    }
    void strip(uint32_t strip, uint32_t patches) {
        const uint32_t first = at_.element(strip, 0), columns = at_.element(strip, 1);
        const uint32_t patch = at_.word(patches + at_.element(strip, 2) * fragments_ + fragment_);
        for (uint32_t i = 0; i < columns && at_.goesOn(); ++i) {
            points(first + i, 3);
            if (i >= 2 && at_.element(first + i - 1, 2) != kNoSample) {
                writeSample(patch, at_.half(first + i - 1, 3));
            }
        }
    }

    const Tables& tables_;
    const Fragments& all_;
    Memory& at_;
    bool loop_, fromNet_ = false;
    uint32_t samples_, fragments_ = 0, fragment_ = 0, read_ = 0, write_ = 0;
    uint32_t local_ = 0, region_ = 0, target_ = 0; ///< local_: in workgroup memory, which has so many points
};

/// shaders/blend/{chart,evaluate}.comp and the smooth texture coordinates.
void traceBlend(const Tables& tables, Memory& at) {
    const bool refined = tables.isolationSteps > 0;
    const auto vertex = [&](uint32_t i) { refined ? at.pool(i) : at.cage(i); };
    const Section& charts = tables.constructions.back().section;
    for (uint32_t c = charts.table; c < charts.table + charts.count && at.goesOn(); ++c) {
        vertex(at.element(c, 0));
        const uint32_t fit = at.element(c, 2);
        for (uint32_t i = 0; i < at.element(fit, 0) && at.goesOn(); ++i) {
            vertex(at.word(at.element(c, 1) + i));
            (void)at.element(fit + 3 + 3 * i, 3);
        }
        at.pool(at.element(c, 3) + kChartCoefficients - 1);
        at.pool(at.element(c, 3));
    }
    const uint32_t side = tables.rate + 3;
    const auto corner = [&](uint32_t record, bool sharp) {
        (void)at.element(at.element(record, 1), 3);
        for (uint32_t i = 0; tables.rate > 0 && i < side * side; ++i) {
            (void)at.element(at.element(record, 2) + i, 3);
            if (sharp && (at.element(record, 0) & kCreasedChart) != 0) {
                (void)at.element(at.element(record, 3) + 2 * i + 1, 3);
            }
        }
    };
    for (uint32_t i = 0; tables.rate > 0 && i < side; ++i) {
        (void)at.element(tables.coordinates + i, 3);
    }
    for (const PatchRange& range : tables.ranges) {
        const bool sharp = range.patchClass == PatchClass::blendSharp;
        for (uint32_t c = 0; c < 4 * range.section.count && at.goesOn(); ++c) {
            at.pool((at.element(range.section.table + c, 0) & kPoolIndexMask) + kChartCoefficients - 1);
            corner(range.section.table + c, sharp);
        }
        for (uint32_t c = 0; tables.uvMode != cage::UvMode::all && c < 4 * tables.uvSets * range.section.count; ++c) {
            (void)at.element((at.element(range.smoothUvs + c, 0) & kPoolIndexMask) + 4, 3);
            corner(range.smoothUvs + c, sharp);
        }
    }
    for (const LodTables::Edges& edges : tables.lod.edges) {
        for (uint32_t e = 0; e < 2 * edges.section.count; ++e) {
            at.pool((at.element(edges.section.table + e, 0) & kPoolIndexMask) + kChartCoefficients - 1);
        }
    }
}

std::string faultOf(const Tables& tables, const TableSource& source) {
    Memory memory(tables, source.vertices);
    for (const Construction& c : tables.constructions) {
        if (c.kernel.kernel == Kernel::subdivisionIsolate || c.kernel.kernel == Kernel::subdivisionIsolateMeshInPool) {
            traceStencils(memory, c);
        }
    }
    if (source.recipe.scheme == SchemeId::blend) {
        traceBlend(tables, memory);
    } else {
        FragmentTrace(tables, memory).run();
    }
    return memory.fault;
}

/// A word that leads somewhere, or nowhere.
uint32_t wordLike(uint32_t word, std::mt19937& random) {
    const uint32_t choices[] = {word + 1,          word - 1,    word ^ 1u << random() % 32,
                                word + (1u << 16), 0xFFFFFFFFu, static_cast<uint32_t>(random())};
    return choices[random() % 6];
}

/// How many of the spoilt tables passed.
size_t spoil(Tables tables, const TableSource& source, const std::string& name, uint32_t seed, uint32_t rounds) {
    EXPECT_EQ(faultOf(tables, source), "") << name;
    std::mt19937 random(seed);
    size_t passed = 0;
    const Tables whole = tables;
    for (uint32_t round = 0; round < rounds; ++round) {
        std::vector<uint32_t*> members = {&tables.words[random() % tables.words.size()]};
        if (round % 8 == 0 && !tables.fragments.classes.empty()) {
            Fragments::Class& own = tables.fragments.classes[random() % tables.fragments.classes.size()];
            Section& blocks = own.blocks[random() % own.blocks.size()];
            members = {&own.sharedPoints,
                       &own.fragments.table,
                       &own.fragments.count,
                       &blocks.table,
                       &blocks.count,
                       &tables.poolStride,
                       &tables.fragments.scratchStride,
                       &tables.coordinates};
        }
        uint32_t& member = *members[random() % members.size()];
        const uint32_t before = member;
        member = wordLike(before, random);
        if (checkTables(tables, source)) {
            ++passed;
            EXPECT_EQ(faultOf(tables, source), "") << name << ": " << member << " instead of " << before;
        }
        member = before;
    }
    return passed;
}

TEST(IndexTrace, WhatPassesStaysWithinBounds) {
    std::vector<test::NamedCage> cages{
        {"jack", test::withoutFaces(test::jack(), {0, 13})}, {"prism", test::prism(5)}, {"cube", test::cube()}};
    size_t passed = 0;
    uint32_t seed = 1;
    for (test::NamedCage& own : cages) {
        cage::Cage& cage = own.cage;
        cage.creases.push_back({cage.faceVertices[0], cage.faceVertices[1], 1.5f});
        cage = test::withAttributes(cage);
        for (const SchemeId scheme : {SchemeId::fragments, SchemeId::loopFragments, SchemeId::blend}) {
            for (const uint32_t rate : {2u, 8u}) {
                Recipe recipe;
                recipe.scheme = scheme;
                recipe.lod = scheme == SchemeId::blend && rate == 2;
                recipe.rate = schemeOf(scheme).tableRate(rate, recipe.lod);
                recipe.uvMode = cage::UvMode::none;
                const Result<Tables> tables = buildTables(recipe, cage);
                ASSERT_TRUE(tables.ok()) << tables.error().message;
                passed +=
                    spoil(*tables, test::sourceOf(recipe, cage), own.name + (", " + test::nameOf(recipe)), ++seed, 400);
            }
        }
    }
    std::printf("%zu spoilt tables pass\n", passed);
    EXPECT_GT(passed, 500u);
}

} // namespace
} // namespace supple::surface
