/* Mesh shaders that draw patches (supple_patch_tiles.glsl): how many workgroups a patch takes. For hosts and their shaders, so it has
 * macros alone. C++, C and GLSL read it.
 *
 * Up to SUPPLE_WHOLE_TILE_RATE a workgroup draws a whole patch, above that a tile of SUPPLE_TILE_SIDE segments a side. The sectors of P5
 * patches have tiles of their own, as a whole pentagon has too many samples. */
#ifndef SUPPLE_PATCH_TILES_H
#define SUPPLE_PATCH_TILES_H

#define SUPPLE_WHOLE_TILE_RATE 11u
#define SUPPLE_TILE_SIDE 8u
/* What a workgroup needs room for: max_vertices and max_primitives. */
#define SUPPLE_TILE_VERTICES 144
#define SUPPLE_TILE_TRIANGLES 242

/* Segments a side of a tile at a rate, and tiles along a side of a patch. */
#define SUPPLE_TILE_SEGMENTS(rate) ((rate) <= SUPPLE_WHOLE_TILE_RATE ? (rate) : SUPPLE_TILE_SIDE)
#define SUPPLE_TILES_ALONG(rate) (((rate) + SUPPLE_TILE_SEGMENTS(rate) - 1u) / SUPPLE_TILE_SEGMENTS(rate))
/* Tiles of a quad with so many along a side, and of a triangle. */
#define SUPPLE_QUAD_TILES(along) ((along) * (along))
#define SUPPLE_TRIANGLE_TILES(along) ((along) * ((along) + 1u) / 2u)
/* Workgroups of a patch. patchClass: SupplePatchRange.patchClass. */
#define SUPPLE_PATCH_TILES(patchClass, rate)                                                      \
    ((patchClass) == 3u   ? SUPPLE_TRIANGLE_TILES(SUPPLE_TILES_ALONG(rate))                       \
     : (patchClass) == 5u ? 5u * SUPPLE_TRIANGLE_TILES(SUPPLE_TILES_ALONG(rate))                  \
                          : SUPPLE_QUAD_TILES(SUPPLE_TILES_ALONG(rate)))

#endif
