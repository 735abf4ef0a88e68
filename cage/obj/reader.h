// Reads Wavefront OBJ into a Character.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/file_reader.h"
#include "cage/finish.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::cage {

struct ObjOptions {
    FinishOptions finish;
    /// Make vertices of a part one where they lie in one place and faces meet edge by edge (cage/weld.h). A warning
    /// counts them.
    bool weld = true;
    /// Where MTL files and images come from; null: they are left out, with a warning.
    FileReader readFile;
};

/// Parses an OBJ held in memory. Its vertices and polygons are the cage, in the file's order; one joint, called as the
/// file without folder and ending, carries it.
///
/// Read: v with colors (of sRGB), vt (per corner; OBJ counts v upwards, the cage as glTF downwards), vn (per corner),
/// f with any number of corners and with negative indices, usemtl and mtllib (docs/gltf.md says what is taken of MTL
/// files), and OpenSubdiv's tags "t NAME ints/floats/strings ...", whose vertices and faces count from 0: crease (a
/// chain of vertices, one sharpness or one an edge), corner, hole.
///
/// Objects (o) are the parts of the character, or its groups (g) if no face is of an object. Parts are in the order of
/// their first faces; the same name again is the same part; what has no name is one part. A vertex that several parts
/// use is in each of them, until they are sewn. More than kMaxParts (cage/part_amount.h) are read as one part. The
/// nodes of several parts are below the joint.
///
/// Left out with a line in Character::warnings: vertices without a face (Cage::sourceVertices tells what is left),
/// normals that are no directions, creases that are not edges, points and lines, boundary rules other than sharp
/// corners, statements and tags of other kinds, MTL files and images that are missing.
///
/// `name` begins every error and becomes Character::name; warnings are without it. Never throws. Errors have a line for
/// each fault: "cube.obj: line 12: face corner 3: vertex 99 of 8".
/// A damaged cage is repaired (cage/repair.h), or refused if options say so: then the error has one line for each kind
/// of damage.
[[nodiscard]] Result<Character> readObj(std::span<const std::byte> bytes, const std::string& name,
                                        const ObjOptions& options = {});

} // namespace supple::cage
