// The scheme polygons. A cage vertex has a tangent frame for each of its smooth groups (cage/smooth_groups.h); surface vertices with the
// same group share it. The frame turns with the faces round it, and the normal that the file gives a surface vertex is stored in
// its coordinates.
//
// Coefficient pool, an instance: for every face of the cage twice its area vector; then (TableHeader::frames) for every frame
// three elements: the position of its vertex, and in w -1 if the pose mirrors it, else 1; its unit normal, which is the area-weighted
// mean of its faces; and a unit tangent.
//
// Tables
//   faces       of up to four sides: four cage vertices i; twice the area vector is (i1 - i0) x (i3 - i2)
//   long faces  of more: (first word of their vertices, count, number among all faces, -)
//   frames      (cage vertex, cage vertex towards which the tangent points, first word of the faces, how many). The words are
//               numbers of faces. A frame without faces is that of the axes: normal z, tangent x
//   vertices    (first pool element of the frame, coordinates of the normal along tangent, normal x tangent and normal)
//   directions  with tangents, a word a vertex: where its tangent points among two axes across the normal (docs/tangents.md)
//   attributes  as in shared/surface.h, for every vertex
#ifndef SUPPLE_SHARED_POLYGONS_H
#define SUPPLE_SHARED_POLYGONS_H

#include "shaders/shared/portable.h"

SUPPLE_SHARED_BEGIN

// Kinds of faces: specialization of the face kernel.
SUPPLE_SHARED_CONST kShortFaces = 0u; // up to four sides
SUPPLE_SHARED_CONST kLongFaces = 1u;

SUPPLE_SHARED_CONST kFrameElements = 3u; // in the pool
SUPPLE_SHARED_CONST kFrameNormal = 1u;
SUPPLE_SHARED_CONST kFrameTangent = 2u;

SUPPLE_SHARED_END

#endif
