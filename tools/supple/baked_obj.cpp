#include "tools/supple/baked_obj.h"

#include "tools/common/schemes.h"
#include "tools/supple/baked_mesh.h"
#include "tools/supple/text_file.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <numeric>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace supple::tools {
namespace {

/// glTF's t runs down the picture, OBJ's up.
glm::vec2 turned(const glm::vec2& uv) {
    return {uv.x, 1.0f - uv.y};
}

template <class Vec>
void writeVector(TextFile& file, std::string_view keyword, const Vec& value) {
    file.text(keyword);
    for (int i = 0; i < Vec::length(); ++i) {
        file.text(" ").number(value[i]);
    }
    file.text("\n");
}

/// Writes surfaces part by part into one file, which counts vertices through.
class SurfaceWriter {
public:
    SurfaceWriter(TextFile& file, const EvaluatedSurface& surface, uint64_t firstPatch)
        : file_(file), surface_(surface), firstPatch_(firstPatch) {}

    /// What the surface has of a part: a group per patch, of a mesh one per material. `written`: vertices in the file.
    void write(uint32_t part, uint64_t& written);

private:
    [[nodiscard]] bool isMesh() const {
        return surface_.output.surface.tessellation == SUPPLE_TESSELLATION_INDEXED_MESH;
    }
    /// `mirrored`: of each vertex; its normal is that of a face that the pose mirrors.
    void writeVertices(uint64_t first, std::span<const uint8_t> mirrored, uint64_t& written);
    void writeFaces(const cage::Polygons& faces, uint64_t first);
    /// Which vertices of a mesh the pose mirrors: those whose first triangle it mirrors.
    [[nodiscard]] std::vector<uint8_t> mirroredVertices() const;
    [[nodiscard]] cage::Polygons facesOf(const SuppleDrawRange& range, uint64_t patch) const;
    void writeTriangles(const SuppleDrawRange& range);
    void writePatches(const SuppleDrawRange& range, uint64_t& written);

    TextFile& file_;
    const EvaluatedSurface& surface_;
    uint64_t firstPatch_;                ///< number of its first patch in the file
    std::optional<uint64_t> meshVertex_; ///< of a mesh whose vertices are written: the first
};

void SurfaceWriter::write(uint32_t part, uint64_t& written) {
    const SuppleGridOutput& grid = surface_.output.grid;
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        if (range.part != part) {
            continue;
        }
        if (!isMesh()) {
            writePatches(range, written);
            continue;
        }
        if (!meshVertex_) {
            meshVertex_ = written;
            writeVertices(0, mirroredVertices(), written);
        }
        writeTriangles(range);
    }
}

std::vector<uint8_t> SurfaceWriter::mirroredVertices() const {
    constexpr uint8_t kUnknown = 2;
    const SuppleGridOutput& grid = surface_.output.grid;
    std::vector<uint8_t> mirrored(grid.vertexCount, kUnknown);
    for (const SuppleDrawRange& range : std::span(grid.drawRanges, grid.drawRangeCount)) {
        const cage::Polygons triangles = gridFaces(surface_, range, false);
        for (size_t corner = 0; corner < triangles.vertices.size(); ++corner) {
            uint8_t& own = mirrored[triangles.vertices[corner]];
            own = own == kUnknown ? uint8_t{surface_.isMirrored(range, 0, corner / 3)} : own;
        }
    }
    std::replace(mirrored.begin(), mirrored.end(), kUnknown, uint8_t{0});
    return mirrored;
}

/// As they are seen from outside.
cage::Polygons SurfaceWriter::facesOf(const SuppleDrawRange& range, uint64_t patch) const {
    cage::Polygons faces = gridFaces(surface_, range, !isMesh());
    for (size_t face = 0; face < faces.faceCount(); ++face) {
        if (surface_.isMirrored(range, patch, face)) {
            turnRound(
                std::span(faces.vertices).subspan(faces.starts[face], faces.starts[face + 1] - faces.starts[face]));
        }
    }
    return faces;
}

/// An element of the surface's streams for each of `mirrored`, from `first` on.
void SurfaceWriter::writeVertices(uint64_t first, std::span<const uint8_t> mirrored, uint64_t& written) {
    const SuppleVertexStreams& streams = surface_.output.streams;
    const uint64_t count = mirrored.size();
    for (uint64_t i = first; i < first + count; ++i) {
        writeVector(file_, "v", element<glm::vec3>(surface_.vertices, streams.vertices, i));
    }
    for (uint64_t i = first; i < first + count; ++i) {
        const auto normal = element<glm::vec3>(surface_.vertices, streams.vertices, i, sizeof(glm::vec3));
        writeVector(file_, "vn", mirrored[i - first] != 0 ? -normal : normal);
    }
    for (uint64_t i = first; !surface_.attributes.empty() && i < first + count; ++i) {
        writeVector(file_, "vt", turned(element<glm::vec2>(surface_.attributes, streams.attributes, i)));
    }
    written += count;
}

/// `first`: the vertex of sample 0, counted from 0 through the whole file.
void SurfaceWriter::writeFaces(const cage::Polygons& faces, uint64_t first) {
    for (size_t face = 0; face < faces.faceCount(); ++face) {
        file_.text("f");
        for (uint32_t corner = faces.starts[face]; corner < faces.starts[face + 1]; ++corner) {
            const uint64_t vertex = first + faces.vertices[corner] + 1; // OBJ counts from 1
            file_.text(" ").number(vertex).text("/");
            if (!surface_.attributes.empty()) {
                file_.number(vertex);
            }
            file_.text("/").number(vertex);
        }
        file_.text("\n");
    }
}

void SurfaceWriter::writeTriangles(const SuppleDrawRange& range) {
    file_.text("g material_");
    if (range.material == SUPPLE_NO_MATERIAL) {
        file_.text("none\n");
    } else {
        file_.number(uint64_t{range.material}).text("\n");
    }
    writeFaces(facesOf(range, 0), *meshVertex_);
}

/// Each with its vertices.
void SurfaceWriter::writePatches(const SuppleDrawRange& range, uint64_t& written) {
    const cage::Polygons asDrawn = gridFaces(surface_, range, true);
    for (uint64_t patch = range.firstPatch; patch < range.firstPatch + range.patchCount; ++patch) {
        const uint64_t samples = range.samplesPerPatch, first = written;
        file_.text("g patch_").number(firstPatch_ + patch).text("\n");
        const uint64_t own = patch - range.firstPatch;
        const bool mirrored = surface_.isMirrored(range, own, 0);
        writeVertices(range.firstVertex + own * samples, std::vector<uint8_t>(samples, mirrored ? 1 : 0), written);
        writeFaces(mirrored ? facesOf(range, own) : asDrawn, first);
    }
}

/// "scheme pm, rate 4, 8 patches"
void writeSummary(TextFile& file, const host::GroupOutput& output, uint32_t askedRate) {
    file.text("# supple bake: scheme ").text(schemeName(output.surface.scheme));
    if (output.surface.tessellation == SUPPLE_TESSELLATION_INDEXED_MESH) {
        file.text(", ").number(uint64_t{output.surface.patchCount}).text(" triangles\n");
        return;
    }
    file.text(", rate ").number(uint64_t{output.grid.rate});
    if (output.grid.rate != askedRate) {
        file.text(" (").number(uint64_t{askedRate}).text(" asked for along an edge of the cage)");
    }
    file.text(", ").number(uint64_t{output.surface.patchCount}).text(" patches\n");
}

} // namespace

Status writeObj(const std::string& path, const Evaluation& baked, size_t partCount, uint32_t askedRate) {
    TextFile file(path);
    std::vector<SurfaceWriter> writers;
    uint64_t patches = 0, written = 0;
    for (const EvaluatedSurface& surface : baked.surfaces) {
        writeSummary(file, surface.output, askedRate);
        writers.emplace_back(file, surface, patches);
        patches += surface.output.surface.patchCount;
    }
    for (uint32_t part = 0; part < partCount; ++part) {
        for (SurfaceWriter& writer : writers) {
            writer.write(part, written);
        }
    }
    return file.close();
}

Status writeCageObj(const std::string& path, const Evaluation& baked, const cage::Cage& cage) {
    TextFile file(path);
    file.text("# supple bake: deformed cage\n");
    const SuppleBufferRange& view = baked.surfaces.front().output.info.deformedCage;
    for (uint32_t vertex = 0; vertex < cage.vertexCount(); ++vertex) {
        writeVector(file, "v", element<glm::vec3>(baked.deformedCage, view, vertex));
    }
    for (const glm::vec2& uv : cage.cornerUvs) {
        writeVector(file, "vt", turned(uv));
    }
    std::vector<uint32_t> corners;
    for (uint32_t face = 0; face < cage.faceCount(); ++face) {
        file.text("f");
        corners.resize(cage.sides(face));
        std::iota(corners.begin(), corners.end(), cage.faceStarts[face]);
        if (baked.mirroredFaces[face] != 0) {
            turnRound(corners);
        }
        for (const uint32_t corner : corners) {
            file.text(" ").number(uint64_t{cage.faceVertices[corner]} + 1);
            if (!cage.cornerUvs.empty()) {
                file.text("/").number(uint64_t{corner} + 1);
            }
        }
        file.text("\n");
    }
    return file.close();
}

} // namespace supple::tools
