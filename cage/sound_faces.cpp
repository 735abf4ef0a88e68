#include "cage/sound_faces.h"

#include "cage/repair/draft.h"
#include "cage/repair/faces.h"
#include "cage/repair/found.h"
#include "cage/repair/sheets.h"

#include <utility>

namespace supple::cage {

Polygons soundFaces(const Cage& cage) {
    using namespace repair;
    const CageNames names{{""}, {}};
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
