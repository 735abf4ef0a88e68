// Reads Wavefront OBJ into a Character.
#pragma once

#include "base/result.h"
#include "cage/character.h"
#include "cage/finish.h"

#include <cstddef>
#include <span>
#include <string>

namespace supple::cage {

/// Parses an OBJ held in memory. Its vertices and polygons are the cage, in the file's order; one joint, called as the
/// file without folder and ending, carries it.
///
/// Read: v, vt (per corner; OBJ counts v upwards, the cage as glTF downwards), vn (per corner), f with any number of
/// corners and with negative indices, usemtl (a material of that name; .mtl files are not read), and OpenSubdiv's tags
/// "t NAME ints/floats/strings ...", whose vertices and faces count from 0: crease (a chain of vertices, one sharpness
/// or one an edge), corner, hole. Groups and smoothing groups mean nothing to a cage and are skipped.
///
/// Left out with a line in Character::warnings: vertices without a face (Cage::sourceVertices tells what is left),
/// normals that are no directions, creases that are not edges, vertex colors, points and lines, boundary rules other
/// than sharp corners, statements and tags of other kinds.
///
/// `name` begins every error and becomes Character::name; warnings are without it. Never throws. Errors have a line for
/// each fault: "cube.obj: line 12: face corner 3: vertex 99 of 8".
/// A damaged cage is repaired (cage/repair.h), or refused if options say so: then the error has one line for each kind
/// of damage. There is one part, so nothing is sewn.
[[nodiscard]] Result<Character> readObj(std::span<const std::byte> bytes, const std::string& name,
                                        const FinishOptions& options = {});

} // namespace supple::cage
