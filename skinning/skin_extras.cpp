#include "skinning/skin_extras.h"

#include <utility>

namespace supple::skinning {

bool SkinExtras::has(SkinExtra extra) const {
    switch (extra) {
    case SkinExtra::none:
        return true;
    case SkinExtra::centers:
        return centers.has_value();
    case SkinExtra::mush:
        return mush.has_value();
    }
    return false;
}

Status SkinExtras::find(const cage::Character& character, SkinExtra extra) {
    if (has(extra)) {
        return success();
    }
    if (extra == SkinExtra::centers) {
        centers = findCenters(character);
        return success();
    }
    Result<DeltaMush> found = findDeltaMush(character);
    if (!found) {
        return found.error();
    }
    mush = std::move(*found);
    return success();
}

} // namespace supple::skinning
