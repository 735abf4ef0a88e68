/**
 * @file supple_character.h
 * A character as arrays, from a host that has an importer of its own: nodes, parts with skins and morph targets, clips,
 * materials, images. supple.h includes this header. docs/integration.md shows how to fill it. supple_tinygltf.hpp makes
 * it of a tinygltf::Model.
 *
 * Every array is checked as a file is: counts, indices, that numbers are finite and within plus or minus
 * SUPPLE_MAX_COORDINATE, that times rise. A faulty description is refused with all reasons, one per line. Each line
 * names the part, clip or channel and the element.
 *
 * Elements of an array whose structs begin with structSize are as far apart as the structSize of the first one says.
 * All elements of an array must have the same structSize.
 *
 * All pointers are needed during the call only. Names may be null, which is the same as empty.
 */
#ifndef SUPPLE_CHARACTER_H
#define SUPPLE_CHARACTER_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_NO_NODE 0xFFFFFFFFu /**< the parent of a root */

/** A node of the scene: where a joint or a mesh stands. Either translation, rotation and scale, or a matrix. */
typedef struct SuppleNodeDesc {
    uint32_t structSize;
    uint32_t parent; /**< a node, or SUPPLE_NO_NODE */
    const char* name;
    const float* translation; /**< 3; null: 0 */
    const float* rotation;    /**< 4, a quaternion x y z w, which is normalised; null: none */
    const float* scale;       /**< 3; null: 1 */
    /** 16, column-major, with the last row 0 0 0 1; null: none. With it, the three above must be null, and no clip may
     * move the node. */
    const float* matrix;
} SuppleNodeDesc;

/** The influences of joints on vertices. Vertex v has those from starts[v] to starts[v + 1]; without `starts` those
 * from v * perVertex to (v + 1) * perVertex. Weights of zero do not count, and their joints are not looked at. The
 * others are normalised to a sum of 1. If all are zero, the vertex follows the first joint named there, with a warning.
 * A vertex without an influence is a fault. */
typedef struct SuppleInfluences {
    const uint32_t* starts; /**< one more than vertices, rising from 0; or null */
    uint32_t perVertex;     /**< if starts is null */
    const uint32_t* joints; /**< indices into SuppleSkinDesc.joints */
    const float* weights;   /**< as many; 0 and more */
} SuppleInfluences;

/** What a part is bound to. */
typedef struct SuppleSkinDesc {
    uint32_t structSize;
    uint32_t jointCount;    /**< 1 or more */
    const uint32_t* joints; /**< nodes */
    /** 16 per joint: the inverse bind matrices, with the last row 0 0 0 1. Null: identity. */
    const float* inverseBinds;
} SuppleSkinDesc;

/** Displacements of vertices by one morph target, which are added before skinning. */
typedef struct SuppleDisplacements {
    uint32_t count;           /**< entries of deltas, if vertices is not null */
    const uint32_t* vertices; /**< the vertices that move, each at most once; null: all, in order */
    const float* deltas;      /**< 3 per entry; null: the target moves nothing here */
} SuppleDisplacements;

/** A morph target of a part. */
typedef struct SuppleMorphTargetDesc {
    uint32_t structSize;
    float weight; /**< that it has at rest, and in clips that do not move it */
    const char* name;
} SuppleMorphTargetDesc;

/** The subdivision surface that a cage was made for. SUPPLE_SCHEME_AUTO follows it. */
typedef enum SuppleMadeFor {
    SUPPLE_MADE_FOR_UNKNOWN = 0,
    SUPPLE_MADE_FOR_CATMULL_CLARK = 1,
    SUPPLE_MADE_FOR_LOOP = 2,
    SUPPLE_MADE_FOR_BILINEAR = 3,
    SUPPLE_MADE_FOR_NONE = 4, /**< it is drawn as it is */
    SUPPLE_MADE_FOR_MAX_ENUM = 0x7FFFFFFF
} SuppleMadeFor;

/** What a primitive says of its polygons. */
typedef enum SupplePrimitivePolygons {
    SUPPLE_POLYGONS_UNKNOWN = 0, /**< its triangles may be paired into quads: see SuppleAssetFlags */
    SUPPLE_POLYGONS_LISTED = 1,  /**< faceVertexCounts and faceVertexIndices */
    /** Triangles that follow each other and begin with the same vertex are a fan, which is one polygon
     * (FB_ngon_encoding). */
    SUPPLE_POLYGONS_FANS = 2,
    SUPPLE_POLYGONS_HIDDEN_EDGES = 3, /**< hiddenEdges */
    SUPPLE_POLYGONS_MAX_ENUM = 0x7FFFFFFF
} SupplePrimitivePolygons;

/** Vertices and triangles as vertex and index buffers have them, of one material. A vertex is there several times if
 * its texture coordinates or normals differ from face to face. Supple welds and pairs as it does with a glTF file
 * (docs/gltf.md): the vertices of all primitives of a part are welded together. Vertices without a face are left out
 * with a warning. */
typedef struct SupplePrimitiveDesc {
    uint32_t structSize;
    uint32_t vertexCount;
    const float* positions;                   /**< 3 per vertex */
    SuppleInfluences influences;              /**< as of SupplePartDesc */
    const SuppleDisplacements* displacements; /**< one per target of the part */
    const float* uvs;                         /**< optional: 2 per vertex */
    const float* uvs1;                        /**< optional: a second UV set */
    const float* colors;                      /**< optional: 4 per vertex, linear RGBA */
    const float* normals;                     /**< optional: 3 per vertex; see SuppleCageDesc.cornerNormals */
    const float* tangents;                    /**< optional: 4 per vertex; see SuppleCageDesc.cornerTangents */
    const uint32_t* trimTiles;                /**< optional: per vertex; those of a face must be equal */
    uint32_t material;                        /**< of the character, or SUPPLE_NO_MATERIAL */
    uint32_t triangleCount;
    const uint32_t* triangles; /**< 3 per triangle */
    /** 0: it has vertices of its own. Else the number + 1 of a primitive before it, whose positions, influences,
     * displacements and cageVertices it shares; its own must be null or 0, and vertexCount the same. */
    uint32_t sharedVertices;
    SupplePrimitivePolygons polygons;
    uint32_t faceCount;                /**< LISTED. Each vertex counts within the primitive */
    const uint32_t* faceVertexCounts;  /**< faceCount */
    const uint32_t* faceVertexIndices; /**< sum of faceVertexCounts */
    uint32_t holeCount;                /**< LISTED: entries of holes, as of SuppleCageDesc; rising */
    const uint32_t* holes;
    const uint8_t* hiddenEdges; /**< HIDDEN_EDGES: 3 per triangle, 1 where the edge to the next vertex is no edge */
    /** Optional, all primitives of a part or none: per vertex a number. Vertices of one number are one vertex of the
     * cage, and nothing else is welded. */
    const uint32_t* cageVertices;
    uint32_t creaseCount; /**< as of SuppleCageDesc; vertices are numbers of cageVertices, if these are given */
    const uint32_t* creaseVertices;
    const float* creaseSharpnesses;
    uint32_t cornerCount;
    const uint32_t* cornerVertices;
    const float* cornerSharpnesses;
    uint32_t creaseScalarCount; /**< as of SuppleCageDesc, with vertices as of creases */
    uint32_t creaseSetCount;
    const SuppleCreaseScalar* creaseScalars;
    const char* const* creaseSetNames;
    const uint32_t* creaseSets;
} SupplePrimitiveDesc;

/** A part: what one node carries as its mesh. Vertices of a part with a skin are given where the inverse bind matrices
 * of its joints put them, the others in the space of their node. */
typedef struct SupplePartDesc {
    uint32_t structSize;
    uint32_t node; /**< that carries it; no other part may have the same */
    const char* name;
    const SuppleSkinDesc* skin; /**< null: the part is rigid and follows its node */
    /** Either polygons over whole vertices: nothing is welded, and no triangles are paired. */
    const SuppleCageDesc* cage;
    SuppleInfluences influences;              /**< of the cage's vertices. Without a skin all members must be 0 */
    const SuppleDisplacements* displacements; /**< one per target: of the cage's vertices */
    uint32_t targetCount;                     /**< morph targets */
    uint32_t primitiveCount;                  /**< instead of cage */
    const SuppleMorphTargetDesc* targets;
    const SupplePrimitiveDesc* primitives;
    /** If the part is primitives: 1 lets vertices that have one face round the boundary off. */
    uint32_t roundCorners;
    /** What SUPPLE_UV_FROM_FILE means for it. That value itself: nothing is said. */
    SuppleUvInterpolation uvInterpolation;
    SuppleMadeFor madeFor;
} SupplePartDesc;

/** What of a node a channel moves. */
typedef enum SuppleChannelPath {
    SUPPLE_PATH_TRANSLATION = 0,
    SUPPLE_PATH_ROTATION = 1,
    SUPPLE_PATH_SCALE = 2,
    SUPPLE_PATH_WEIGHTS = 3, /**< the morph targets of the part that the node carries */
    SUPPLE_PATH_MAX_ENUM = 0x7FFFFFFF
} SuppleChannelPath;

/** What lies between two keys, as glTF has it. LINEAR: rotations take the shorter way round, at constant speed. */
typedef enum SuppleKeyInterpolation {
    SUPPLE_KEYS_LINEAR = 0,
    SUPPLE_KEYS_STEP = 1,
    SUPPLE_KEYS_CUBICSPLINE = 2, /**< per key: in-tangent, value, out-tangent; 2 keys or more */
    SUPPLE_KEYS_MAX_ENUM = 0x7FFFFFFF
} SuppleKeyInterpolation;

/** One animated property of one node. Channels of weights of a node whose part has no morph targets are left out with a
 * warning. */
typedef struct SuppleChannelDesc {
    uint32_t structSize;
    uint32_t node;
    SuppleChannelPath path;
    SuppleKeyInterpolation interpolation;
    uint32_t keyCount;   /**< 1 or more */
    uint32_t valueCount; /**< numbers in values: per key 3, of rotations 4, of weights one per morph target; three times
                          * as many with CUBICSPLINE */
    const float* times;  /**< keyCount seconds, each later than the one before */
    const float* values; /**< rotations: quaternions x y z w */
} SuppleChannelDesc;

/** A named time of a clip. */
typedef struct SuppleMarkerDesc {
    const char* name;
    double time; /**< seconds, within the clip; markers may have any order */
} SuppleMarkerDesc;

/** The sharpness that a clip gives to a crease set while it runs: suppleGetClipSharpness. */
typedef struct SuppleSharpnessCurveDesc {
    const char* set; /**< the name of a crease set; a clip has one curve of it at most */
    SuppleKeyInterpolation interpolation;
    uint32_t keyCount;   /**< 1 or more */
    const float* times;  /**< keyCount seconds, each later than the one before */
    const float* values; /**< keyCount sharpnesses; three times as many with CUBICSPLINE */
} SuppleSharpnessCurveDesc;

/** An animation clip. If keys lie before 0, its time begins at the first of them, with a warning. */
typedef struct SuppleClipDesc {
    uint32_t structSize;
    uint32_t channelCount;
    const char* name;                  /**< null or empty: "clip_" and its number */
    const SuppleChannelDesc* channels; /**< of one node and path there may be one */
    uint32_t markerCount;
    const SuppleMarkerDesc* markers;
    double duration; /**< seconds; 0 or less than the last key: the last key */
    uint32_t sharpnessCurveCount;
    const SuppleSharpnessCurveDesc* sharpnessCurves;
} SuppleClipDesc;

/** A character. Whatever no part, clip or material refers to stays part of it as well. */
struct SuppleCharacterDesc {
    uint32_t structSize;
    uint32_t nodeCount;
    const SuppleNodeDesc* nodes;
    uint32_t partCount; /**< 1 or more */
    const SupplePartDesc* parts;
    uint32_t clipCount;
    const SuppleClipDesc* clips;
    uint32_t materialCount;
    /** Every member counts: a factor of 0 is 0, and a texture without an image has SUPPLE_NO_IMAGE. glTF's own material
     * has factors, normalScale, occlusionStrength, emissiveStrength and scales of textures of 1, emissiveFactor 0 and
     * alphaCutoff 0.5 (supple::defaultMaterial() of supple.hpp). Numbers outside their range become the nearest in it,
     * with a warning. With trimAlpha 1 the trim is that of alphaMode MASK, and the members of the trim are not looked
     * at. */
    const SuppleMaterialInfo* materials;
    uint32_t imageCount;
    const SuppleImageInfo* images; /**< encoded, in any format; with bytes null the image is missing */
    const char* copyright;
    /** Optional: materialCount entries, what each material has beyond its SuppleMaterialInfo. Every member counts
     * (supple::defaultMaterialLayers() of supple.hpp is a material without any). Null: no material has any. */
    const SuppleMaterialLayers* materialLayers;
};

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_CHARACTER_H */
