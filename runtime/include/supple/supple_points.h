/**
 * @file supple_points.h
 * Points on the surfaces of a group's instances: an earring, an arrow, hair roots. In every frame a buffer on the
 * device has where they are and how they are turned. supple.h includes this header; docs/surface_points.md shows how it
 * is used.
 *
 * A point is a face of the cage and a place in it (SuppleSurfacePoint), whatever the scheme. It lies on the limit of
 * the surface and rides on it in poses of every source. It needs no surface vertices, so it is the same at every rate
 * and level of detail, and groups with SUPPLE_SCHEME_CAGE have points too.
 */
#ifndef SUPPLE_POINTS_H
#define SUPPLE_POINTS_H

#include "supple.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SUPPLE_NO_FACE 0xFFFFFFFFu /**< suppleFindPoints: there is no such point */

/** Points on the surfaces of one group. It is destroyed with its group. */
typedef struct SupplePointSet {
    uint64_t id; /**< 0 is never a valid handle */
} SupplePointSet;

/** A point of a surface, whatever its scheme: a face of the character's cage and a place in it. Corners are those of
 * the face, in its order. On an edge it belongs to the face named, with that side's derivatives. */
typedef struct SuppleSurfacePoint {
    uint32_t face; /**< of the character's cage */
    uint32_t side; /**< faces of five and more sides: the side, from corner `side` to the next. Others: 0 */
    /** Triangle: a and b are the weights of corners 1 and 2. Quad: a from corner 0 (0) to corner 1 (1), b from corner 0
     * to corner 3. More sides: in the triangle of the side and the face's middle, a is the weight of corner side + 1
     * and b that of the middle. */
    float a;
    float b; /**< see a */
} SuppleSurfacePoint;

/** A point of a triangle of a glTF file, as scanners, painters and physics name it. Both triangles of a quad give
 * points of the quad: each fills its half of the quad's own square. So the diagonal is the same curve from both. */
typedef struct SuppleGltfPoint {
    uint32_t mesh;      /**< as the file numbers them */
    uint32_t primitive; /**< within the mesh */
    /** Within the primitive: the indices 3 * triangle and the two behind it. Triangles of strips and fans are counted
     * in their order, those of strips that repeat a vertex not at all. */
    uint32_t triangle;
    float a; /**< the weight of the triangle's second vertex, 0..1 */
    float b; /**< that of its third; a + b is at most 1 */
} SuppleGltfPoint;

/** What the surface is at a point. The derivatives are those by a and b of the point: du by a, dv by b, then the second
 * ones. du x dv points outwards. Where a scheme cuts a face, they jump inside it (docs/cpu.md). */
typedef struct SuppleSurfaceJet {
    float position[3]; /**< x, y, z in the space of the cage */
    float du[3];       /**< by a */
    float dv[3];       /**< by b */
    float duu[3];      /**< twice by a */
    float duv[3];      /**< by a and by b */
    float dvv[3];      /**< twice by b */
} SuppleSurfaceJet;

/** What the device has of a point. The frame is three unit vectors at right angles: the tangent t, the bitangent b and
 * the normal n, which points outwards. It turns with the surface as its nearest rotation: shear in the surface turns it
 * by half of the shear, and it does not depend on the two numbers of the face. It is never zero. Where a pose mirrors
 * the surface, b = -(n x t), else b = n x t. */
typedef enum SupplePointFormat {
    /** Rows of a 3x4 matrix: (t.x, b.x, n.x, p.x), (t.y, b.y, n.y, p.y), (t.z, b.z, n.z, p.z), p the position.
     * A VkTransformMatrixKHR. */
    SUPPLE_POINT_FRAME_48 = 0,
    /** The same, then the position in the frame before (in this frame's coordinates, suppleSetOrigin), and how much
     * larger the surface is at the point than in the bind pose (an area). A point without a past has its own position:
     * in the first frame of the set, and where SUPPLE_GROUP_MOTION has none. The set keeps 16 bytes more a point. */
    SUPPLE_POINT_FRAME_64 = 1,
    SUPPLE_POINT_VERTEX_16 = 2, /**< position and normal, as SUPPLE_VERTEX_16 */
    /** No frame: the derivatives of the position by a and by b of the point, each x, y, z, 0. */
    SUPPLE_POINT_DERIVATIVES_32 = 3,
    SUPPLE_POINT_FORMAT_MAX_ENUM = 0x7FFFFFFF
} SupplePointFormat;

/** SupplePointSetDesc.flags. */
typedef enum SupplePointSetFlags {
    /** Points that lie where a surface vertex is have that vertex's position, to the bit. Other points, and how all are
     * turned, are as they are without the flag. For groups without a view that keep surface vertices, of any scheme
     * but SUPPLE_SCHEME_CAGE. */
    SUPPLE_POINT_SET_ON_VERTICES = 1,
    SUPPLE_POINT_SET_FLAGS_MAX_ENUM = 0x7FFFFFFF
} SupplePointSetFlags;

/** A set of points. Pointers are needed during the call only. */
typedef struct SupplePointSetDesc {
    uint32_t structSize;
    uint32_t flags;                   /**< SupplePointSetFlags */
    SuppleGroup group;                /**< whose surfaces the points are on */
    const SuppleSurfacePoint* points; /**< pointCount of them */
    /** Optional: x, y, z per point, the direction of its tangent in the bind pose. What is not in the tangent plane is
     * taken away. Null, or across the plane: the tangent is along the first number of the face. */
    const float* tangents;
    uint32_t pointCount;      /**< 1 and more */
    SupplePointFormat format; /**< what the device writes */
} SupplePointSetDesc;

/** Filled by suppleGetPointOutput. */
typedef struct SupplePointOutput {
    uint32_t structSize;
    SupplePointFormat format; /**< as in the description */
    uint32_t pointCount;      /**< of the set */
    uint32_t reserved;        /**< 0 */
    /** Point k of the instance in slot s is element s * pointCount + k, of stride bytes, in the coordinates of surface
     * vertices. Instances that no frame has deformed since the set was made have zeros. Those that are hidden, or left
     * out as their view does not see them (SUPPLE_VIEW_CULL), keep what they had (with SUPPLE_CONTEXT_ASYNC_COMPUTE
     * what they have is undefined): see docs/surface_points.md. */
    SuppleBufferRange frames;
} SupplePointOutput;

/** Puts points on the surfaces of a group. suppleRecord writes their frames for every instance of the group that it
 * deforms, in the pass *points*, behind *deform*; SuppleRecordDesc.after then covers them too. Frames go on while the
 * tables of the set are uploaded (suppleSetUploadBudget), and leave the set out until they are there.
 *
 * suppleSetCapacity and suppleReloadAsset make the set anew: ask for its output again. If the reloaded cage has other
 * faces the set is destroyed, with a warning (SUPPLE_MESSAGE_POINTS_DROPPED).
 *
 * The first set of a group takes 10 to 100 ms, as it makes the group's surfaces on the CPU (supple_cpu.h), and the
 * first of a format compiles a pipeline. Then a point takes about 0.01 ms; beside a vertex of many faces 0.001 ms a
 * face. suppleReloadAsset takes the points again. Sharpness that suppleSetSharpness sets is not seen: points have that
 * of the file, but for those that have the positions of vertices (SUPPLE_POINT_SET_ON_VERTICES).
 *
 * Errors: a stale handle; no points, unknown flags, a format that does not exist; a face that does not exist or is a
 * hole, a place outside its face (the log names the first such point); tangents that are not finite; what
 * suppleCpuCreateGroup refuses; more points than the device can bind for one instance, or than 32 bits number with all
 * instances; a point that hangs on more than 4096 vertices, or weights of more than 33,554,432 elements (one for each
 * vertex of a point) or than the device binds; SUPPLE_POINT_SET_ON_VERTICES with SUPPLE_POINT_DERIVATIVES_32, or of a
 * group without surface vertices at a rate (SUPPLE_SCHEME_CAGE, a view, SUPPLE_GROUP_DIRECT); memory.
 * SUPPLE_ERROR_UNSUPPORTED if the library was built with SUPPLE_WITH_CPU=OFF. `out->id` is 0 then. */
SUPPLE_API SuppleResult suppleCreatePointSet(SuppleContext context, const SupplePointSetDesc* desc,
                                             SupplePointSet* out);
/** Its buffer stays until all frames that may use it are complete. */
SUPPLE_API SuppleResult suppleDestroyPointSet(SuppleContext context, SupplePointSet set);
/** Where the frames of a set are. */
SUPPLE_API SuppleResult suppleGetPointOutput(SuppleContext context, SupplePointSet set, SupplePointOutput* out);

/** By what suppleFindPoints finds points. */
typedef enum SupplePointQueryKind {
    /** The nearest point to each place: x, y, z in the coordinates of the cage. Of faces that meet there (distances
     * that differ by less than a millionth of the extent), the lowest. */
    SUPPLE_FIND_NEAREST = 0,
    /** The point with these texture coordinates: u, v. Of several, that of the lowest face, or as many as pointsEach
     * asks for. Where no face covers them, its face is SUPPLE_NO_FACE. Faces have straight texture coordinates here:
     * quads bilinear ones, also where Loop or polygons cut them into triangles, which draw others. */
    SUPPLE_FIND_UV = 1,
    /** Points spread evenly by area: each of as many equal parts of the area has one, and neighbours may be close. */
    SUPPLE_FIND_SCATTER = 2,
    /** What each ray hits first, from either side: origin and direction, x, y, z each, in the coordinates of the cage.
     * A direction need not have a length of 1. If a ray hits nothing, its face is SUPPLE_NO_FACE. */
    SUPPLE_FIND_RAY = 3,
    /** The points of triangles of the glTF file (query->gltf). A triangle that no face has, as reading has left it out
     * or a repair has cut its face, has SUPPLE_NO_FACE. If several nodes carry the mesh, it is that of the first part.
     */
    SUPPLE_FIND_GLTF = 4,
    /** None: out has the points, and jets are filled with what the surface is there. */
    SUPPLE_FIND_GIVEN = 5,
    SUPPLE_FIND_MAX_ENUM = 0x7FFFFFFF
} SupplePointQueryKind;

/** What suppleFindPoints is asked. Pointers are needed during the call only. */
typedef struct SupplePointQuery {
    uint32_t structSize;
    SupplePointQueryKind kind; /**< by what */
    uint32_t count;            /**< of places, texture coordinates, rays or points */
    uint32_t uvSet;            /**< UV: 0 or 1, as in the file. Else 0 */
    uint32_t seed;             /**< SCATTER: another one gives other points. Else 0 */
    uint32_t cageVertexCount;  /**< of cage; 0 without one */
    const float* values;       /**< NEAREST: 3 for each point; UV: 2; RAY: 6. Others: null */
    /** Optional, but for UV and GLTF: x, y, z of the character's cage vertices, deformed. Null: the bind pose. */
    const float* cage;
    /** UV: how many points are listed for each coordinate. They are those of the lowest faces that cover it, one for
     * each face, in rising order; the rest have SUPPLE_NO_FACE. 0 means 1. Else 0 */
    uint32_t pointsEach;
    uint32_t reserved; /**< 0 */
    /** Optional: filled with what the surface is at each point of out, in the cage that is searched. Zeros where the
     * face is SUPPLE_NO_FACE. A ray o + t d has hit at t = dot(position - o, d) / dot(d, d). */
    SuppleSurfaceJet* jets;
    const SuppleGltfPoint* gltf; /**< GLTF: count of them. Else null */
} SupplePointQuery;

/** Finds points on the surfaces of a group, on the CPU: for a set, or to be kept in a file. No device is waited for.
 *
 * out: query->count points, with UV pointsEach times as many; null if there are none. Like a first set, the first call
 * for a group makes its surfaces. NEAREST begins from samples: 16 a triangle or quad; of a larger face 16 a side up to
 * 8 sides, 4 up to 32, one beyond. RAY begins from triangles between as many samples, at least 4 a side. The first
 * call in the bind pose makes and keeps them (80 bytes a sample, for RAY 400 bytes a quad); with a cage each call makes
 * its own. Then a point takes about 0.1 ms. UV and SCATTER go over all faces once in each call. The result is the same
 * on every machine up to rounding. If a ray grazes a face and meets it twice, the farther of the two points may be
 * found: less than 4 in 1000 rays are wrong where a third of them graze.
 *
 * Errors: a stale handle; numbers that are not finite or beyond SUPPLE_MAX_COORDINATE; a direction without a length; a
 * cage of another number of vertices; a UV set that the character lacks; a character that was read from no glTF file (a
 * cooked one is none), a mesh, a primitive or a triangle that it lacks, weights outside of the triangle; GIVEN without
 * jets, or points that suppleCreatePointSet refuses; more points than 32 bits number; what suppleCreatePointSet refuses
 * of a group. */
SUPPLE_API SuppleResult suppleFindPoints(SuppleContext context, SuppleGroup group, const SupplePointQuery* query,
                                         SuppleSurfacePoint* out);

#ifdef __cplusplus
}
#endif

#endif /* SUPPLE_POINTS_H */
