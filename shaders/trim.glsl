// Trimming for hosts: what a fragment shader does with a surface whose material has a trim. Self-contained: copy it, or
// include it from where it lies. docs/trimming.md shows a whole pair of shaders.
//
//     vec2 at = trimUv;                                             // domain uv: the UV set, interpolated
//     vec2 at = suppleTrimTile(faceUv, tiles, textureSize(trim, 0)); // domain face: SuppleVertexStreams.faceUvs, interpolated
//     float value = texture(trim, at)[channel];
//     if (domain is face && !suppleTrimHasTile(faceUv)) value = 1.0;
//     if (suppleTrimmed(value, cutoff)) discard;                    // without multisampling, in depth and shadow passes
//     color.a = suppleTrimCoverage(value, cutoff);                  // with alphaToCoverageEnable instead of discard
//
// The texture is data, not color (UNORM, not SRGB; alpha is the same in both), filtered linearly: then the contour of a
// black and white image is smooth. A strip of tiles has no mip levels, which would mix tiles.
#ifndef SUPPLE_TRIM_GLSL
#define SUPPLE_TRIM_GLSL

/// Whether the face has a tile at all.
bool suppleTrimHasTile(vec2 faceUv) { return faceUv.x > -0.5; }

/// Where to look a strip of tiles up. faceUv is (u + 2 * tile, v), see supple.h. Keeps half a texel away from the tile's
/// border, so that linear filtering does not see the neighboring tile.
vec2 suppleTrimTile(vec2 faceUv, float tiles, ivec2 textureTexels) {
    float tile = floor(0.5 * faceUv.x + 0.25);
    vec2 halfTexel = 0.5 / vec2(float(textureTexels.x) / tiles, float(textureTexels.y));
    vec2 at = clamp(vec2(faceUv.x - 2.0 * tile, faceUv.y), halfTexel, 1.0 - halfTexel);
    return vec2((tile + at.x) / tiles, at.y);
}

/// Whether the surface is taken away here.
bool suppleTrimmed(float value, float cutoff) { return value < cutoff; }

/// The covered share of a pixel, 0..1: half at the contour, over a pixel's width. In uniform control flow, because of the
/// derivatives.
float suppleTrimCoverage(float value, float cutoff) {
    float w = 0.5 * fwidth(value);
    // smoothstep is undefined without width, as inside of an even part of the texture.
    return w > 1e-6 ? smoothstep(cutoff - w, cutoff + w, value) : (suppleTrimmed(value, cutoff) ? 0.0 : 1.0);
}

#endif
