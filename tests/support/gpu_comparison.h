// What the suites on the device have in common: their cases, the bits they compare, and the faces that patches are.
#pragma once

#include "cage/gltf/reader.h"
#include "cage/topology.h"
#include "surface/grid.h"
#include "tests/support/gpu_surface.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace supple::test {

/// Positions compared.
struct ComparedBits {
    uint64_t samples = 0;
    uint64_t different = 0; ///< in some bit

    void compare(const glm::vec3& a, const glm::vec3& b) {
        ++samples;
        different += std::memcmp(&a, &b, sizeof(a)) != 0 ? 1 : 0;
    }
    void add(const ComparedBits& other) {
        samples += other.samples;
        different += other.different;
    }
    void print(const char* what) const {
        std::printf("%llu %s, %llu differ\n", static_cast<unsigned long long>(samples), what,
                    static_cast<unsigned long long>(different));
    }
};

inline constexpr SuppleMapping kMappings[] = {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE};
/// Less of the same in the wide mapping, which is made for GPUs: lavapipe takes five to ten times as long for it.
inline uint32_t lessInWide(SuppleMapping mapping, uint32_t inNarrow, uint32_t inWide) {
    return mapping == SUPPLE_MAPPING_WIDE ? inWide : inNarrow;
}

inline std::string mappingName(SuppleMapping mapping) {
    return mapping == SUPPLE_MAPPING_NARROW ? "Narrow" : "Wide";
}

/// The groups of a suite's case, and its name.
struct GpuCase {
    std::string name;
    GpuOptions options;

    [[nodiscard]] GpuOptions at(uint32_t rate) const {
        GpuOptions result = options;
        result.rate = rate;
        return result;
    }
    friend std::ostream& operator<<(std::ostream& out, const GpuCase& c) { return out << c.name; }
};

/// Every case on both mappings, "NarrowLoop" and "WideLoop".
inline std::vector<GpuCase> onBothMappings(const std::vector<GpuCase>& cases) {
    std::vector<GpuCase> both;
    for (const GpuCase& c : cases) {
        for (const SuppleMapping mapping : {SUPPLE_MAPPING_NARROW, SUPPLE_MAPPING_WIDE}) {
            both.push_back({mappingName(mapping) + c.name, c.options});
            both.back().options.mapping = mapping;
        }
    }
    return both;
}

/// The positions of the narrow and the wide mapping, and in `compareMore` whatever else they should share.
template <class CompareMore>
void compareMappings(host::Device& device, const cage::Cage& cage, GpuOptions options, ComparedBits& bits,
                     CompareMore&& compareMore) {
    options.mapping = SUPPLE_MAPPING_NARROW;
    GpuSurface narrow(device, cage, options);
    options.mapping = SUPPLE_MAPPING_WIDE;
    GpuSurface wide(device, cage, options);
    ASSERT_TRUE(narrow.valid() && wide.valid());
    narrow.evaluate();
    wide.evaluate();
    for (uint32_t p = 0; p < narrow.output().surface.patchCount; ++p) {
        for (uint32_t s = 0; s < narrow.sampleCount(p); ++s) {
            bits.compare(narrow.vertex(0, p, s).position, wide.vertex(0, p, s).position);
        }
        compareMore(narrow, wide, p);
    }
}
inline void compareMappings(host::Device& device, const cage::Cage& cage, const GpuOptions& options,
                            ComparedBits& bits) {
    compareMappings(device, cage, options, bits, [](const GpuSurface&, const GpuSurface&, uint32_t) {});
}

/// Which patch is which face of a refined cage.
struct PatchFaces {
    std::vector<uint32_t> faces;       ///< per patch
    std::vector<uint32_t> patches;     ///< per face, cage::kNone for holes
    std::vector<uint8_t> firstCorners; ///< per face: the one that is corner 0 of its patch; empty: the face's first

    /// Whether an edge has a patch on both sides.
    [[nodiscard]] bool shared(const cage::Topology& topology, const cage::Topology::Edge& edge) const {
        return edge.twin != cage::kNone && patches[topology.cornerFaces[edge.corner]] != cage::kNone &&
               patches[topology.cornerFaces[edge.twin]] != cage::kNone;
    }
};

/// By class, then material, part, kind and face. Fails the test where `patches`, those of a group, come of other faces.
template <class Mesh, class Patches, class ClassOf, class KindOf>
PatchFaces patchFaces(const Mesh& mesh, const Patches& patches, ClassOf&& classOf, KindOf&& kindOf) {
    PatchFaces found;
    for (uint32_t f = 0; f < mesh.cage.faceCount(); ++f) {
        if (!std::binary_search(mesh.cage.holes.begin(), mesh.cage.holes.end(), f)) {
            found.faces.push_back(f);
        }
    }
    const auto key = [&](uint32_t f) {
        return std::tuple(classOf(f), mesh.cage.faceMaterials.empty() ? cage::kNone : mesh.cage.faceMaterials[f],
                          mesh.cage.faceParts.empty() ? 0 : mesh.cage.faceParts[f], kindOf(f));
    };
    std::stable_sort(found.faces.begin(), found.faces.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    found.patches.assign(mesh.cage.faceCount(), cage::kNone);
    EXPECT_EQ(found.faces.size(), patches.size());
    for (uint32_t p = 0; p < found.faces.size(); ++p) {
        found.patches[found.faces[p]] = p;
        if (p < patches.size()) {
            EXPECT_EQ(patches[p].face, mesh.sourceFaces[found.faces[p]]);
        }
    }
    return found;
}

template <class Mesh, class ClassOf>
PatchFaces patchFaces(const Mesh& mesh, const GpuSurface& gpu, ClassOf&& classOf) {
    return patchFaces(mesh, gpu.patches(), classOf, [](uint32_t /*face*/) { return 0u; });
}

/// What the patches on both sides of every edge have in common.
inline ComparedBits borderBits(const cage::Cage& cage, const cage::Topology& topology, const PatchFaces& found,
                               const GpuSurface& gpu) {
    ComparedBits bits;
    const uint32_t rate = gpu.output().grid.rate;
    const auto onEdge = [&](uint32_t corner, uint32_t k) {
        const uint32_t f = topology.cornerFaces[corner], p = found.patches[f];
        const auto domain = static_cast<surface::Domain>(gpu.rangeOf(p).domain);
        const uint32_t first = found.firstCorners.empty() ? 0 : found.firstCorners[f], sides = cage.sides(f);
        const uint32_t side = (corner - cage.faceStarts[f] + sides - first) % sides;
        return gpu.vertex(0, p, surface::edgeSample(domain, rate, side, k)).position;
    };
    for (const cage::Topology::Edge& edge : topology.edges) {
        for (uint32_t k = 0; found.shared(topology, edge) && k <= rate; ++k) {
            bits.compare(onEdge(edge.corner, k), onEdge(edge.twin, rate - k));
        }
    }
    return bits;
}

/// Hands on every character that its file holds. A file that cannot be read fails the test.
template <class Visit>
void forEachCharacter(const std::vector<std::string>& paths, Visit&& visit) {
    for (const std::string& path : paths) {
        SCOPED_TRACE(path);
        const Result<cage::Character> character = cage::readGltfFile(path);
        ASSERT_TRUE(character.ok()) << character.error().message;
        ASSERT_NO_FATAL_FAILURE(visit(path, *character));
    }
}

/// A group made of a character's file, in a pose of its first clip where it has one.
inline void evaluateInAPose(GpuSurface& gpu, const cage::Character& character) {
    if (!character.clips.empty()) {
        ASSERT_EQ(suppleSetClipPose(gpu.context().handle(), gpu.instance(0), 0, 0.4 * character.clips[0].duration),
                  SUPPLE_OK);
    }
    gpu.evaluate();
}

} // namespace supple::test
