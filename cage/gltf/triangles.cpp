#include "cage/gltf/triangles.h"

#include "cage/gltf/accessors.h"
#include "cage/message.h"
#include "cage/refusal.h"

#include <numeric>
#include <span>

namespace supple::cage::gltf {
namespace {

void addStrip(std::span<const uint32_t> run, std::vector<uint32_t>& triangles) {
    for (size_t i = 0; i + 2 < run.size(); ++i) {
        const uint32_t a = run[i], b = run[i + 1 + i % 2], c = run[i + 2 - i % 2];
        if (a != b && b != c && c != a) {
            triangles.insert(triangles.end(), {a, b, c});
        }
    }
}

void addFan(std::span<const uint32_t> run, std::vector<uint32_t>& triangles) {
    for (size_t i = 0; i + 2 < run.size(); ++i) {
        triangles.insert(triangles.end(), {run[i + 1], run[i + 2], run[0]});
    }
}

/// The triangles of one strip or fan.
void addRun(int mode, std::span<const uint32_t> run, const std::string& name, Leniency& leniency,
            std::vector<uint32_t>& triangles) {
    if (run.size() < 3) {
        leniency.mend(name,
                      std::string("a ") + modeName(mode) + " of " + counted(run.size(), "vertex", "vertices") +
                          ", at least 3 are needed",
                      "left out");
        return;
    }
    mode == file::kTriangleStrip ? addStrip(run, triangles) : addFan(run, triangles);
}

} // namespace

bool hasTriangles(int mode) {
    return mode == file::kTriangles || mode == file::kTriangleStrip || mode == file::kTriangleFan;
}

bool isDrawn(const file::Primitive& primitive) {
    return !primitive.broken && hasTriangles(primitive.mode) && primitive.attributes.contains("POSITION");
}

const char* modeName(int mode) {
    static constexpr const char* kModes[] = {"POINTS",    "LINES",          "LINE_LOOP",   "LINE_STRIP",
                                             "TRIANGLES", "TRIANGLE_STRIP", "TRIANGLE_FAN"};
    return kModes[mode];
}

std::vector<uint32_t> readTriangles(const Document& document, const file::Primitive& primitive, uint32_t vertexCount,
                                    const std::string& element) {
    const int mode = primitive.mode;
    const bool indexed = primitive.indices >= 0;
    const std::string name = indexed ? element + " indices" : element;
    std::vector<uint32_t> indices;
    if (indexed) {
        indices = readIntegers(document, primitive.indices, file::kScalar, kU8 | kU16 | kU32, name);
    } else {
        indices.resize(vertexCount);
        std::iota(indices.begin(), indices.end(), 0u);
    }
    if (mode == file::kTriangles && indices.size() % 3 != 0) {
        document.leniency->mend(name,
                                indexed ? std::to_string(indices.size()) + ", not a multiple of 3"
                                        : counted(vertexCount, "vertex", "vertices") +
                                              " without indices, not a multiple of 3",
                                "what is over is left out");
        indices.resize(indices.size() / 3 * 3);
    }
    const uint32_t restart = indexed ? restartIndex(document, primitive.indices) : kNone;
    const bool mayRestart = mode != file::kTriangles && (isUsed(document, "KHR_mesh_primitive_restart") ||
                                                         isUsed(document, "EXT_mesh_primitive_restart"));
    std::vector<uint32_t> triangles;
    size_t first = 0; // of the strip or fan at work
    for (size_t i = 0; i < indices.size() && indexed; ++i) {
        if (indices[i] == restart && mayRestart) {
            addRun(mode, std::span(indices).subspan(first, i - first), name, *document.leniency, triangles);
            first = i + 1;
        } else if (indices[i] == restart) {
            refuse(item(name, i), std::to_string(restart) + " is the restart value, which glTF 2.0 forbids");
        } else if (indices[i] >= vertexCount) {
            refuse(item(name, i), std::to_string(indices[i]) + " is out of range: the primitive has " +
                                      counted(vertexCount, "vertex", "vertices"));
        }
    }
    if (mode == file::kTriangles) {
        return indices;
    }
    addRun(mode, std::span(indices).subspan(first), name, *document.leniency, triangles);
    return triangles;
}

} // namespace supple::cage::gltf
