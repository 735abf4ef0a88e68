// Which scheme suits a part of a character: what `auto` takes.
#pragma once

#include "cage/character.h"
#include "surface/recipe.h"

#include <string>
#include <vector>

namespace supple::surface {

struct SchemeChoice {
    SchemeId scheme = SchemeId::catmullClark;
    std::string reason; ///< "its polygons are known": follows the part's name
};

/// The scheme that `auto` takes for each part of the character, and why. The first rule that fits decides:
///  - the file says what subdivision the part was made for (Part::madeFor): that, or polygons where it is none, or
///    bilinear;
///  - the faces are polygons that the file, or the host, has drawn: Catmull-Clark;
///  - hard edges everywhere: polygons. It takes normals to say so (Cage::cornerNormals);
///  - quads that triangles were paired into: Catmull-Clark;
///  - else triangles: Loop.
/// Triangles and larger faces mixed count as triangles if these are more than half of the surface, counted in
/// triangles. Parts that share cage vertices, which have been sewn, count as one part; what files say of some of them,
/// or differently of them, does not count. A cage that is no manifold is drawn as polygons, which alone take it; what
/// readers read is one always. The limits of a scheme are not looked at: who builds its tables learns of them.
/// O(corners log corners).
[[nodiscard]] std::vector<SchemeChoice> chooseSchemes(const cage::Character& character);

} // namespace supple::surface
