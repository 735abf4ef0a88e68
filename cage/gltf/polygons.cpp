#include "cage/gltf/polygons.h"

#include "cage/gltf/accessors.h"
#include "cage/gltf/triangles.h"
#include "cage/refusal.h"

#include <algorithm>
#include <utility>

namespace supple::cage::gltf {
namespace {

/// Refuses vertices out of range and vertices that a polygon repeats.
void checkPolygons(const Polygons& polygons, size_t vertexCount, const std::string& element) {
    std::vector<uint32_t> seenIn(vertexCount, kNone);
    for (uint32_t f = 0; f < polygons.faceCount(); ++f) {
        for (uint32_t c = polygons.starts[f]; c < polygons.starts[f + 1]; ++c) {
            const uint32_t vertex = polygons.vertices[c];
            if (vertex >= vertexCount) {
                refuse(element, "vertex " + std::to_string(vertex) + " of " + at("face", f) +
                                    " is out of range: the primitive has " + std::to_string(vertexCount));
            }
            if (seenIn[vertex] == f) {
                refuse(element, at("face", f) + " repeats vertex " + std::to_string(vertex));
            }
            seenIn[vertex] = f;
        }
    }
}

Polygons readCagePolygons(const Document& document, const CageExtension& extension, size_t vertexCount) {
    const std::string countsName = extension.element + " faceVertexCounts";
    const std::string indicesName = extension.element + " faceVertexIndices";
    const auto counts = readIntegers(document, extension.faceVertexCounts, file::kScalar, kIntegers, countsName);
    Polygons polygons;
    polygons.vertices = readIntegers(document, extension.faceVertexIndices, file::kScalar, kIntegers, indicesName);
    uint64_t end = 0;
    for (size_t f = 0; f < counts.size(); ++f) {
        if (counts[f] < 3) {
            refuse(item(countsName, f), counted(counts[f], "corner", "corners") + ", at least 3 are needed");
        }
        end += counts[f];
        polygons.starts.push_back(static_cast<uint32_t>(end));
    }
    if (end != polygons.vertices.size()) {
        refuse(indicesName, counted(polygons.vertices.size(), "index", "indices") + " for faces of " +
                                std::to_string(end) + " corners");
    }
    checkPolygons(polygons, vertexCount, indicesName);
    return polygons;
}

std::vector<uint32_t> readHoles(const Document& document, const CageExtension& extension, size_t faceCount) {
    const std::string name = extension.element + " holeIndices";
    auto holes = readIntegers(document, extension.holeIndices, file::kScalar, kIntegers, name);
    for (size_t i = 0; i < holes.size(); ++i) {
        if (holes[i] >= faceCount) {
            refuse(item(name, i), "face " + std::to_string(holes[i]) + " is out of range: the primitive has " +
                                      std::to_string(faceCount));
        }
        if (i > 0 && holes[i] <= holes[i - 1]) {
            refuse(item(name, i), "not more than the one before it");
        }
    }
    return holes;
}

/// One of EXT_mesh_polygon's accessors of offsets: one a polygon, rising from 0, into a list of `length`.
std::vector<uint32_t> readOffsets(const Document& document, const Json& object, const char* key, size_t count,
                                  size_t length, const std::string& element) {
    const std::string name = element + " " + key;
    auto offsets = readIntegers(document, static_cast<int>(object.at(key).index()), file::kScalar, kIntegers, name);
    if (offsets.size() != count) {
        refuse(name, counted(offsets.size(), "offset", "offsets") + " for " + counted(count, "polygon", "polygons"));
    }
    for (size_t i = 0; i < count; ++i) {
        if (i == 0 ? offsets[i] != 0 : offsets[i] <= offsets[i - 1]) {
            refuse(item(name, i), i == 0 ? "not 0" : "not more than the one before it");
        }
        if (offsets[i] >= length) {
            refuse(item(name, i),
                   std::to_string(offsets[i]) + " is out of range: the list has " + std::to_string(length));
        }
    }
    return offsets;
}

/// Refuses an EXT_mesh_polygon whose triangles, which begin at `offsets`, are not those of its polygons.
void checkCovered(const Polygons& polygons, std::span<const uint32_t> triangles, std::span<const uint32_t> offsets,
                  size_t vertexCount, const std::string& element) {
    std::vector<uint32_t> covered(vertexCount, kNone);
    for (uint32_t p = 0; p < offsets.size(); ++p) {
        const size_t end = p + 1 < offsets.size() ? offsets[p + 1] : triangles.size();
        if (offsets[p] % 3 != 0) {
            refuse(item(element + " indicesOffsets", p), "not the beginning of a triangle");
        }
        for (size_t i = offsets[p]; i < end; ++i) {
            covered[triangles[i]] = p;
        }
        for (uint32_t c = polygons.starts[p]; c < polygons.starts[p + 1]; ++c) {
            if (covered[polygons.vertices[c]] != p) {
                refuse(element + " loopIndices", "vertex " + std::to_string(polygons.vertices[c]) + " of " +
                                                     at("polygon", p) + " is in none of its triangles");
            }
        }
    }
}

/// EXT_mesh_polygon as the draft had it at KhronosGroup/glTF 43df01ab: the exterior loop of every polygon, then its
/// holes, with restart values between loops and perhaps behind them. Nothing, and why, where a polygon has a hole, or
/// where the object is of another form of the draft.
std::optional<Polygons> readMeshPolygons(const Document& document, const Json& object,
                                         std::span<const uint32_t> triangles, size_t vertexCount,
                                         const std::string& element, std::string& whyNot) {
    for (const char* key : {"count", "indicesOffsets", "loopIndices", "loopIndicesOffsets"}) {
        if (member(object, key) == nullptr) {
            whyNot = std::string("a form of the draft that is not understood, without ") + key;
            return std::nullopt;
        }
    }
    for (const char* key : {"indicesOffsets", "loopIndices", "loopIndicesOffsets"}) {
        checkIndexMember(object, key, element, "accessor", document.model.accessors.size());
    }
    const std::string loopsName = element + " loopIndices";
    const int loopsAccessor = static_cast<int>(object.at("loopIndices").index());
    const auto loops = readIntegers(document, loopsAccessor, file::kScalar, kIntegers, loopsName);
    const uint32_t restart = restartIndex(document, loopsAccessor);
    const auto count = static_cast<size_t>(unsignedMember(object, "count", element, std::nullopt));
    if (count == 0) {
        refuse(element + " count", "zero");
    }
    const auto loopOffsets = readOffsets(document, object, "loopIndicesOffsets", count, loops.size(), element);
    const auto triangleOffsets = readOffsets(document, object, "indicesOffsets", count, triangles.size(), element);

    Polygons polygons;
    size_t pierced = 0;
    size_t firstPierced = 0;
    for (size_t p = 0; p < count; ++p) {
        size_t end = p + 1 < count ? loopOffsets[p + 1] : loops.size();
        end -= loops[end - 1] == restart ? 1 : 0;
        const auto loop = std::span(loops).subspan(loopOffsets[p], end - loopOffsets[p]);
        if (std::find(loop.begin(), loop.end(), restart) != loop.end()) {
            firstPierced = pierced++ == 0 ? p : firstPierced;
        }
        if (loop.size() < 3) {
            refuse(loopsName,
                   at("polygon", p) + " has " + counted(loop.size(), "corner", "corners") + ", at least 3 are needed");
        }
        polygons.vertices.insert(polygons.vertices.end(), loop.begin(), loop.end());
        polygons.close();
    }
    if (pierced > 0) {
        whyNot = counted(pierced, "polygon has a hole", "polygons have holes") +
                 " (first: " + at("polygon", firstPierced) + "), which no face of a cage can";
        return std::nullopt;
    }
    checkPolygons(polygons, vertexCount, loopsName);
    checkCovered(polygons, triangles, triangleOffsets, vertexCount, element);
    return polygons;
}

/// The edges that EXT_mesh_primitive_edge_visibility hides: neither in `visibility`, of two bits an edge, nor in one of
/// the lineStrings. (A silhouette edge hides one of its two sides only.)
std::vector<uint8_t> readHiddenEdges(const Document& document, const Json& object, std::span<const uint32_t> triangles,
                                     size_t vertexCount, const std::string& element) {
    const Json* lineStrings = arrayMember(object, "lineStrings", element);
    if (member(object, "visibility") == nullptr && lineStrings == nullptr) {
        refuse(element, "neither visibility nor lineStrings");
    }
    std::vector<uint8_t> hidden(triangles.size(), 1);
    if (member(object, "visibility") != nullptr) {
        const std::string name = element + " visibility";
        checkIndexMember(object, "visibility", element, "accessor", document.model.accessors.size());
        const auto bytes =
            readIntegers(document, static_cast<int>(object.at("visibility").index()), file::kScalar, kU8, name);
        if (bytes.size() != (2 * triangles.size() + 7) / 8) {
            refuse(name, counted(bytes.size(), "byte", "bytes") + " for " +
                             counted(triangles.size() / 3, "triangle", "triangles"));
        }
        for (size_t e = 0; e < hidden.size(); ++e) {
            hidden[e] = (bytes[e / 4] >> (2 * (e % 4)) & 3u) == 0 ? 1 : 0;
        }
    }
    std::vector<std::pair<uint32_t, uint32_t>> drawn;
    for (size_t s = 0; lineStrings != nullptr && s < lineStrings->size(); ++s) {
        const std::string place = element + " " + at("lineString", s);
        if (!(*lineStrings)[s].isObject()) {
            refuse(place, "not an object");
        }
        checkIndexMember((*lineStrings)[s], "indices", place, "accessor", document.model.accessors.size(), true);
        const int accessor = static_cast<int>((*lineStrings)[s].at("indices").index());
        const auto line = readIntegers(document, accessor, file::kScalar, kIntegers, place + " indices");
        const uint32_t restart = restartIndex(document, accessor);
        for (size_t i = 0; i < line.size(); ++i) {
            if (line[i] != restart && line[i] >= vertexCount) {
                refuse(item(place + " indices", i), "vertex " + std::to_string(line[i]) +
                                                        " is out of range: the primitive has " +
                                                        std::to_string(vertexCount));
            }
            if (i > 0 && line[i] != restart && line[i - 1] != restart) {
                drawn.push_back(std::minmax(line[i - 1], line[i]));
            }
        }
    }
    std::sort(drawn.begin(), drawn.end());
    for (size_t e = 0; e < hidden.size(); ++e) {
        const uint32_t a = triangles[e];
        const uint32_t b = triangles[e % 3 == 2 ? e - 2 : e + 1];
        if (std::binary_search(drawn.begin(), drawn.end(), std::pair<uint32_t, uint32_t>(std::minmax(a, b)))) {
            hidden[e] = 0;
        }
    }
    return hidden;
}

/// The extensions that say something of each triangle count those of TRIANGLES.
bool sayNothingOfRuns(const Document& document, const Json& primitive, int mode, const std::string& element,
                      Warnings& warnings) {
    if (mode == file::kTriangles) {
        return false;
    }
    for (const char* name : {"EXT_mesh_polygon", "FB_ngon_encoding", "EXT_mesh_primitive_edge_visibility"}) {
        if (hasExtension(primitive, name)) {
            const std::string reason = std::string(modeName(mode)) + " instead of TRIANGLES";
            if (isRequired(document, name)) {
                document.leniency->gather([&] { refuse(element + " " + name, reason); });
                continue;
            }
            warn(warnings, element + " " + name, reason + "; not used");
        }
    }
    return true;
}

} // namespace

PolygonData readPolygons(const Document& document, const Json& primitive, int mode,
                         const std::optional<CageExtension>& extension, std::span<const uint32_t> triangles,
                         size_t vertexCount, const std::string& element, Warnings& warnings) {
    PolygonData data;
    if (extension && extension->faceVertexCounts >= 0) {
        data.source = PolygonSource::cageExtension;
        data.polygons = readCagePolygons(document, *extension, vertexCount);
        if (extension->holeIndices >= 0) {
            data.holes = readHoles(document, *extension, data.polygons.faceCount());
        }
        return data;
    }
    if (sayNothingOfRuns(document, primitive, mode, element, warnings)) {
        return data;
    }
    const auto extensionObject = [&](const char* name) -> const Json* {
        return hasExtension(primitive, name) ? objectMember(primitive.at("extensions"), name, element) : nullptr;
    };
    if (const Json* object = extensionObject("EXT_mesh_polygon")) {
        const std::string place = element + " EXT_mesh_polygon";
        std::string whyNot;
        std::optional<Polygons> polygons = readMeshPolygons(document, *object, triangles, vertexCount, place, whyNot);
        if (polygons) {
            data.source = PolygonSource::meshPolygon;
            data.polygons = std::move(*polygons);
            return data;
        }
        if (isRequired(document, "EXT_mesh_polygon")) {
            document.leniency->gather([&] { refuse(place, whyNot); });
            return data;
        }
        warn(warnings, place, whyNot + "; not used");
    }
    if (hasExtension(primitive, "FB_ngon_encoding")) {
        data.source = PolygonSource::ngonEncoding;
        return data;
    }
    if (const Json* object = extensionObject("EXT_mesh_primitive_edge_visibility")) {
        data.source = PolygonSource::hiddenEdges;
        data.hidden =
            readHiddenEdges(document, *object, triangles, vertexCount, element + " EXT_mesh_primitive_edge_visibility");
    }
    return data;
}

} // namespace supple::cage::gltf
