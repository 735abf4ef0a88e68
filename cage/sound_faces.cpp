#include "cage/sound_faces.h"

#include "cage/repair/draft.h"
#include "cage/repair/faces.h"
#include "cage/repair/found.h"
#include "cage/repair/sheets.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace supple::cage {

Polygons soundFaces(const Cage& cage) {
    using namespace repair;
    // Nobody reads the names, but every part has one.
    const size_t parts = cage.faceParts.empty() ? 1 : size_t{cage.faceParts.back()} + 1;
    const CageNames names{std::vector<std::string>(parts), {}};
    const Places places(cage, names);
    FaceDamage faces;
    SheetDamage sheets;
    Draft draft = withoutDuplicates(simpleFaces(cage, places, faces), places, faces);
    (void)joinFaces(cage, draft, places, sheets);
    Polygons sound;
    sound.starts = std::move(draft.starts);
    sound.vertices = std::move(draft.vertices);
    return sound;
}

} // namespace supple::cage
