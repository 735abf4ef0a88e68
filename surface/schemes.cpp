#include "surface/schemes.h"

#include "surface/pm/scheme.h"
#include "surface/prep/scheme.h"

namespace supple::surface {

const char* schemeName(SchemeId scheme) {
    return scheme == SchemeId::prep ? "p-rep" : "P_m";
}

Result<Tables> buildTables(const Recipe& recipe, const cage::Cage& cage) {
    if (recipe.scheme == SchemeId::pm) {
        Result<pm::Mesh> mesh = pm::buildMesh(cage);
        if (!mesh) {
            return mesh.error();
        }
        return pm::buildTables(*mesh);
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
