// The kernels for AVX2 and those for every CPU give the same bits.
#include "cpu/lanes.h"

#include <cstring>
#include <gtest/gtest.h>
#include <random>

namespace supple::test {
namespace {

using namespace cpu;

/// Fills what is made of floats alone.
template <class T>
void fill(T& data, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> number(-2.0f, 2.0f);
    auto* const floats = reinterpret_cast<float*>(&data);
    for (size_t i = 0; i < sizeof(T) / sizeof(float); ++i) {
        floats[i] = number(random);
    }
}

template <class T>
bool haveSameBits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <unsigned N>
void compareTensors(const LaneKernels& one, const LaneKernels& other) {
    static TensorLanes<N> patches;
    WeightLanes<N> u, v;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        fill(patches, seed);
        fill(u, seed + 100);
        fill(v, seed + 200);
        JetLanes jets[2]{};
        one.tensors<N>().evaluate(patches, u, v, jets[0]);
        other.tensors<N>().evaluate(patches, u, v, jets[1]);
        EXPECT_TRUE(haveSameBits(jets[0], jets[1]));
        RowLanes<N> rows[2]{};
        one.tensors<N>().collapse(patches, v, rows[0]);
        other.tensors<N>().collapse(patches, v, rows[1]);
        EXPECT_TRUE(haveSameBits(rows[0], rows[1]));
        VertexLanes vertices[2]{};
        one.tensors<N>().vertices(rows[0], u, vertices[0]);
        other.tensors<N>().vertices(rows[1], u, vertices[1]);
        EXPECT_TRUE(haveSameBits(vertices[0].position, vertices[1].position));
        EXPECT_TRUE(haveSameBits(vertices[0].normal, vertices[1].normal));
        EXPECT_FALSE(vertices[0].lacksNormals || vertices[1].lacksNormals);
    }
}

TEST(CpuLanes, HaveTheSameBitsWithAvx2) {
    const LaneKernels *const plain = &plainLaneKernels(), *const best = &laneKernels();
    if (plain == best) {
        GTEST_SKIP() << "neither compiled for AVX2, or not on this CPU";
    }
    compareTensors<4>(*plain, *best);
    compareTensors<6>(*plain, *best);
    QuarticLanes triangles{};
    fill(triangles, 5);
    JetLanes jets[2]{};
    plain->quartics(triangles, jets[0]);
    best->quartics(triangles, jets[1]);
    EXPECT_TRUE(haveSameBits(jets[0], jets[1]));
}

/// Where du and dv are parallel there is no normal, and the kernel says so.
TEST(CpuLanes, SayWhereNormalsAreMissing) {
    static TensorLanes<4> patches;
    fill(patches, 3);
    for (Lanes3& point : patches.net) { // one lane is a line
        point.at[0][2] = point.at[1][2] = point.at[2][2];
    }
    WeightLanes<4> weights{};
    for (unsigned lane = 0; lane < kLanes; ++lane) {
        setBernstein(weights, lane, 0.25f, 0.75f);
    }
    RowLanes<4> rows{};
    VertexLanes vertices{};
    laneKernels().cubic.collapse(patches, weights, rows);
    laneKernels().cubic.vertices(rows, weights, vertices);
    EXPECT_TRUE(vertices.lacksNormals);
    EXPECT_EQ(vertices.normal.at[0][2], 0.0f);
    EXPECT_NE(vertices.normal.at[0][3], 0.0f);
}

} // namespace
} // namespace supple::test
