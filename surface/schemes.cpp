#include "surface/schemes.h"

#include "surface/kernel/scheme.h"
#include "surface/pm/scheme.h"
#include "surface/prep/scheme.h"

namespace supple::surface {

const char* schemeName(SchemeId scheme) {
    switch (scheme) {
    case SchemeId::prep:
        return "p-rep";
    case SchemeId::pm:
        return "P_m";
    case SchemeId::catmullClark:
        return "Catmull-Clark";
    case SchemeId::loop:
        return "Loop";
    }
    return "";
}

Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage) {
    if (recipe.scheme == SchemeId::pm) {
        Result<pm::Mesh> mesh = pm::buildMesh(cage);
        if (!mesh) {
            return mesh.error();
        }
        return pm::buildTables(*mesh);
    }
    if (subdivides(recipe.scheme)) {
        const Result<kernel::Mesh> mesh = kernel::buildMesh(
            cage, recipe.scheme == SchemeId::loop ? kernel::Subdivision::loop : kernel::Subdivision::catmullClark);
        if (!mesh) {
            return mesh.error();
        }
        return kernel::buildTables(*mesh, recipe.depth);
    }
    const Result<cage::Topology> topology = cage::buildTopology(cage);
    if (!topology) {
        return topology.error();
    }
    const Status accepted = prep::accepts(cage);
    if (!accepted) {
        return accepted.error();
    }
    return prep::buildTables(cage, *topology, recipe.prep);
}

} // namespace supple::surface
