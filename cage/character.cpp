#include "cage/character.h"

namespace supple::cage {

const char* polygonSourceName(PolygonSource source) {
    switch (source) {
    case PolygonSource::triangles:
        return "triangles";
    case PolygonSource::ngonEncoding:
        return "FB_ngon_encoding";
    case PolygonSource::pairedTriangles:
        return "paired triangles";
    case PolygonSource::arrays:
        return "arrays";
    }
    return "unknown";
}

} // namespace supple::cage
