// Mesh shaders for groups with SUPPLE_GROUP_DIRECT: which samples and triangles of a patch a workgroup draws. A workgroup has a tile of
// a patch: all of it up to rate 11, 8 x 8 segments above. The samples are those that a vertex shader draws, by the same numbers, so
// tiles and patches agree on their borders to the bit; so are the triangles, and the order of their corners.
//
//     #extension GL_EXT_mesh_shader : require
//     #define SUPPLE_SURFACE_SET 1
//     #define SUPPLE_PATCH_SET 1
//     #include "supple_patch_tiles.glsl" // and with it supple_patch.glsl and supple_patch_tiles.h, which lie beside it
//     layout(local_size_x = 64) in;
//     layout(triangles, max_vertices = SUPPLE_TILE_VERTICES, max_primitives = SUPPLE_TILE_TRIANGLES) out;
//     layout(push_constant) uniform Push { SupplePatchRange range; uint commandWord; };
//
//     void main() {
//         uint instanceIndex;
//         SuppleTile tile = suppleTile(range, gl_WorkGroupID.x);
//         bool isDrawn = suppleTileInstance(range, commandWord, gl_WorkGroupID, instanceIndex);
//         SetMeshOutputsEXT(isDrawn ? tile.vertexCount : 0u, isDrawn ? tile.triangleCount : 0u);
//         if (!isDrawn) return;
//         SuppleRange drawn = suppleRangeOf(range);
//         for (uint v = gl_LocalInvocationIndex; v < tile.vertexCount; v += 64u) {
//             uint index = suppleTileSample(tile, v); // what gl_VertexIndex is to a vertex shader
//             SuppleVertex at = suppleVertex(drawn, instanceIndex, index);
//             SuppleSample s = suppleEvaluate(range, gl_WorkGroupID.y, at.slot, index);
//             gl_MeshVerticesEXT[v].gl_Position = viewProjection * vec4(s.position, 1.0);
//         }
//         for (uint t = gl_LocalInvocationIndex; t < tile.triangleCount; t += 64u)
//             gl_PrimitiveTriangleIndicesEXT[t] = suppleTileTriangle(tile, t);
//     }
//
// The host asks for SUPPLE_PATCH_TILES(range.patchClass, range.rate) x range.patchCount x N workgroups. N is how many instances may be
// visible: the capacity of the group, or of a window. suppleTileInstance reads how many are from the range's command in
// SuppleGridOutput.indirect. That buffer is bound as a whole at SUPPLE_COMMANDS_BINDING, with commandWord =
// (indirect.offset + number of the command * indirect.stride) / 4. docs/direct.md has all of it.
#ifndef SUPPLE_PATCH_TILES_GLSL
#define SUPPLE_PATCH_TILES_GLSL

#include "supple_patch.glsl"
#include "supple_patch_tiles.h"

/// A tile of a grid of quads, or of a triangle with `rate` segments a side: of a P3 patch, of a sector of a P5 patch. Its cells (i, j)
/// are i < cells.x, j < cells.y; of a triangle those below the diagonal.
struct SuppleTile {
    uint patchClass;
    uint rate;
    uint sector;    // of a P5 patch
    uvec2 first;    // (i, j) of its first sample in the grid
    uvec2 cells;
    uint wholeRows; // of a triangle: rows of cells that have all their triangles
    uint vertexCount;
    uint triangleCount;
};

bool suppleIsTriangle(uint patchClass) { return patchClass == SUPPLE_CLASS_P3 || patchClass == SUPPLE_CLASS_P5; }

/// Before row j of a tile of a triangle: samples, triangles. Whole rows have the same number; those behind are a triangle's.
uint suppleSamplesBefore(SuppleTile tile, uint j) {
    uint whole = min(j, tile.wholeRows), m = j - whole, n = tile.cells.x + 1u;
    return whole * n + m * (2u * n + 1u - m) / 2u;
}
uint suppleTrianglesBefore(SuppleTile tile, uint j) {
    uint whole = min(j, tile.wholeRows), m = j - whole;
    return whole * 2u * tile.cells.x + m * (2u * tile.cells.x - m);
}

/// A tile of a patch, 0 to SUPPLE_PATCH_TILES - 1.
SuppleTile suppleTile(SupplePatchRange range, uint number) {
#ifdef SUPPLE_PATCH_CLASS
    uint patchClass = SUPPLE_PATCH_CLASS;
#else
    uint patchClass = range.patchClass;
#endif
    uint side = SUPPLE_TILE_SEGMENTS(range.rate), along = SUPPLE_TILES_ALONG(range.rate);
    SuppleTile tile = SuppleTile(patchClass, range.rate, 0u, uvec2(0u), uvec2(0u), 0u, 0u, 0u);
    if (!suppleIsTriangle(patchClass)) {
        tile.first = side * uvec2(number % along, number / along);
        tile.cells = min(uvec2(side), range.rate - tile.first);
        tile.vertexCount = (tile.cells.x + 1u) * (tile.cells.y + 1u);
        tile.triangleCount = 2u * tile.cells.x * tile.cells.y;
        // A polar patch's last row ends in one point.
        if (patchClass == SUPPLE_CLASS_POLAR && tile.first.y + tile.cells.y == range.rate) tile.triangleCount -= tile.cells.x;
        return tile;
    }
    uint ofSector = SUPPLE_TRIANGLE_TILES(along);
    tile.sector = number / ofSector;
    tile.first = side * suppleTriangleSample(along, number - tile.sector * ofSector);
    uint left = range.rate - tile.first.x - tile.first.y; // cells of its first row up to the diagonal
    tile.cells = uvec2(min(side, left));
    tile.wholeRows = left - tile.cells.x;
    tile.vertexCount = suppleSamplesBefore(tile, tile.cells.y + 1u);
    tile.triangleCount = suppleTrianglesBefore(tile, tile.cells.y);
    return tile;
}

/// The sample of its patch that a vertex of a tile is.
uint suppleTileSample(SuppleTile tile, uint vertex) {
    uint side = tile.cells.x + 1u;
    if (!suppleIsTriangle(tile.patchClass)) {
        uvec2 at = tile.first + uvec2(vertex % side, vertex / side);
        return at.y * (tile.rate + 1u) + at.x;
    }
    uint whole = tile.wholeRows * side;
    uvec2 at = vertex < whole ? uvec2(vertex % side, vertex / side)
                              : suppleTriangleSample(side, vertex - whole) + uvec2(0u, tile.wholeRows);
    at += tile.first;
    uint rate = tile.rate, before = at.y * (at.y - 1u) / 2u; // samples that rows below have less than the first
    if (tile.patchClass == SUPPLE_CLASS_P3) return at.y * (rate + 1u) - before + at.x;
    uint perSector = rate * (rate + 1u) / 2u, sector = tile.sector;
    if (at.y == rate) return 5u * perSector; // the centre
    if (at.x + at.y == rate) { // on the ray, which is the next sector's
        sector = sector == 4u ? 0u : sector + 1u;
        at.x = 0u;
    }
    return sector * perSector + at.y * rate - before + at.x;
}

/// The vertices of a tile that a triangle lies between, counter-clockwise seen from outside.
uvec3 suppleTileTriangle(SuppleTile tile, uint triangle) {
    uint row = 2u * tile.cells.x;
    if (!suppleIsTriangle(tile.patchClass)) {
        uint j = triangle / row, k = triangle - j * row;
        bool isHalf = tile.patchClass == SUPPLE_CLASS_POLAR && tile.first.y + j + 1u == tile.rate; // no second triangles
        uint i = isHalf ? k : k / 2u, a = j * (tile.cells.x + 1u) + i, c = a + tile.cells.x + 2u;
        return isHalf || (k & 1u) == 0u ? uvec3(a, a + 1u, c) : uvec3(a, c, c - 1u);
    }
    uint j = triangle / row, s = tile.cells.x;
    if (j >= tile.wholeRows) { // from the end, rows have 1, 3, 5, .. triangles. The square root only guesses
        uint fromEnd = s * s - 1u - (triangle - tile.wholeRows * row), root = uint(sqrt(float(fromEnd)));
        if (root * root > fromEnd) --root;
        if ((root + 1u) * (root + 1u) <= fromEnd) ++root;
        j = tile.wholeRows + s - 1u - root;
    }
    uint k = triangle - suppleTrianglesBefore(tile, j), a = suppleSamplesBefore(tile, j) + k / 2u,
         above = suppleSamplesBefore(tile, j + 1u) + k / 2u;
    return (k & 1u) == 0u ? uvec3(a, a + 1u, above) : uvec3(a + 1u, above + 1u, above);
}

#ifdef SUPPLE_PATCH_SET
#ifndef SUPPLE_COMMANDS_BINDING
#define SUPPLE_COMMANDS_BINDING 9
#endif
layout(set = SUPPLE_PATCH_SET, binding = SUPPLE_COMMANDS_BINDING, std430) readonly buffer SuppleCommands {
    uint suppleCommands[]; // SuppleGridOutput.indirect.buffer
};

/// What gl_InstanceIndex is to a vertex shader, of the workgroup (tile, patch, visible instance). False: fewer instances are visible.
bool suppleTileInstance(SupplePatchRange range, uint commandWord, uvec3 workgroup, out uint instanceIndex) {
    uint index = workgroup.z * range.patchCount + workgroup.y;
    instanceIndex = suppleCommands[commandWord + 4u] + index; // VkDrawIndexedIndirectCommand: firstInstance
    return index < suppleCommands[commandWord + 1u];          // instanceCount
}
#endif

#endif
