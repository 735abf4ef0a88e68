// What checks tables from files: all tables that are built pass, and whatever does not fit is refused.
#include "surface/table_check.h"

#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/subdivision_zoo.h"
#include "tests/support/table_cases.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <set>

namespace supple::surface {
namespace {

/// Cages of all kinds.
std::vector<test::NamedCage> cages() {
    std::vector<test::NamedCage> all{{"cube", test::cube()},
                                     {"grid", test::grid(4, 3)},
                                     {"one quad", test::grid(1, 1)},
                                     {"torus", test::torus(6, 5)},
                                     {"jack", test::jack()},
                                     {"biped", test::biped()},
                                     {"poles of valence 9", test::trapezohedron(9)},
                                     {"dodecahedron", test::dodecahedron()},
                                     {"octagonal prism", test::prism(8)}};
    for (const test::PmCage& own : test::pmZoo()) {
        all.push_back({own.name.c_str(), own.cage});
    }
    for (const test::SubdivisionCage& own : test::subdivisionZoo()) {
        all.push_back({own.name.c_str(), own.cage});
    }
    for (test::NamedCage& own : all) {
        own.cage = test::withAttributes(std::move(own.cage));
    }
    return all;
}

std::vector<SchemeId> checkedSchemes() {
    std::vector<SchemeId> checked;
    for (const Scheme& scheme : schemes()) {
        if (canCheckTables(scheme.id)) {
            checked.push_back(scheme.id);
        }
    }
    return checked;
}

/// One recipe's tables of all cages that the scheme takes pass. Returns how many these are.
size_t checkAll(const Recipe& recipe, const std::vector<test::NamedCage>& cages, double& mostPoolPerWord) {
    size_t taken = 0;
    for (const test::NamedCage& own : cages) {
        const Result<Tables> tables = buildTables(recipe, own.cage);
        if (!tables) {
            continue;
        }
        const Status status = checkTables(*tables, test::sourceOf(recipe, own.cage));
        EXPECT_TRUE(status.ok()) << own.name << ", " << test::nameOf(recipe) << ": " << status.error().message;
        mostPoolPerWord = std::max(mostPoolPerWord,
                                   static_cast<double>(tables->poolStride) / static_cast<double>(tables->words.size()));
        ++taken;
    }
    return taken;
}

TEST(TableCheck, TablesThatAreBuiltPass) {
    const std::vector<test::NamedCage> all = cages();
    for (const SchemeId scheme : checkedSchemes()) {
        double mostPoolPerWord = 0.0;
        for (const Recipe& recipe : test::recipesOf(scheme)) {
            EXPECT_GT(checkAll(recipe, all, mostPoolPerWord), 5u) << test::nameOf(recipe);
        }
        std::printf("%s: at most %.2f coefficients of an instance's pool per word of the tables\n",
                    schemeOf(scheme).name, mostPoolPerWord);
        EXPECT_LT(mostPoolPerWord, 4.0); // half of what is refused
    }
}

} // namespace
} // namespace supple::surface
