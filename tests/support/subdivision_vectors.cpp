#include "tests/support/subdivision_vectors.h"

#include "tests/support/json_vectors.h"
#include "tests/support/meshes.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace supple::test {
namespace {

using nlohmann::json;
using surface::subdivision::Fan;
using surface::subdivision::Rule;
using surface::subdivision::Subdivision;

SubdivisionVectors readSubdivision(const json& j, const std::string& name) {
    SubdivisionVectors v;
    v.name = name;
    v.subdivision = j.at("scheme") == "cc" ? Subdivision::catmullClark : Subdivision::loop;
    v.depth = j.at("depth");
    v.positions = jsonVectors(j.at("vertices"));
    v.cage = makeCage({v.positions.begin(), v.positions.end()}, j.at("faces").get<Faces>());
    for (const json& crease : j.at("creases")) {
        v.cage.creases.push_back({crease.at(0), crease.at(1), crease.at(2)});
    }
    for (const json& corner : j.at("corners")) {
        v.cage.sharpVertices.push_back({corner.at(0), corner.at(1)});
    }
    v.isolated = jsonVectors(j.at("isolated_level"));
    for (const json& stored : j.at("sectors")) {
        // The files count the faces before the last step to the isolated level, and their corners; -1 is the middle.
        const int corner = stored.at("corner");
        const uint32_t face = stored.at("face");
        v.sectors.push_back({4 * face + (corner < 0 ? 3u : static_cast<uint32_t>(corner)), stored.at("n"),
                             jsonVectors(stored.at("refined")), jsonVectors(stored.at("limit")),
                             jsonVectors(stored.at("normal"))});
    }
    return v;
}

StoredPattern patternOf(const Fan& fan, const json& rows) {
    StoredPattern pattern{fan, {}};
    for (const json& row : rows) {
        StoredPattern::Row& to = pattern.rows.emplace_back();
        const int rule = row.at(1);
        const int spoke = row.at(2);
        to.point = row.at(0);
        to.rule = static_cast<Rule>(rule);
        to.spoke = spoke < 0 ? surface::subdivision::kNoSpoke : static_cast<uint32_t>(spoke);
        for (size_t i = 3; i < row.size(); ++i) {
            to.sources.push_back(row.at(i));
        }
    }
    return pattern;
}

} // namespace

const std::vector<SubdivisionVectors>& subdivisionVectors() {
    static const std::vector<SubdivisionVectors> kAll = readJsonFolder("subdivision", readSubdivision);
    return kAll;
}

std::vector<StoredPattern> storedPatterns() {
    const json j = parseFile(SUPPLE_TEST_DATA "/subdivision/tables/pattern_tables.json");
    return {patternOf({Subdivision::loop, 7, false}, j.at("loop_valence7")),
            patternOf({Subdivision::catmullClark, 5, false}, j.at("cc_valence5"))};
}

} // namespace supple::test
