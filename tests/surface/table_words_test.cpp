// Every word of tables that leads out of bounds is refused, and every other word may be anything.
#include "tests/surface/table_words.h"

#include "surface/schemes.h"
#include "tests/support/meshes.h"
#include "tests/support/pm_zoo.h"
#include "tests/support/table_cases.h"

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace supple::surface {
namespace {

constexpr SchemeId kSchemes[] = {SchemeId::prep, SchemeId::pm, SchemeId::polygons, SchemeId::blend};

/// Small ones, so that each word has its turn, which between them have all classes, fans, creases and boundaries.
std::vector<test::NamedCage> smallCages() {
    std::vector<test::NamedCage> all{{"grid", test::grid(3, 2)},
                                     {"cube", test::cube()},
                                     {"open jack", test::withoutFaces(test::jack(), {0, 13})},
                                     {"pentagons", test::fanOverPentagons(6)},
                                     {"polar", test::cappedCylinder(7, 3)},
                                     {"octagonal prism", test::prism(8)}};
    for (test::PmVariant variant : {test::PmVariant::open, test::PmVariant::creased, test::PmVariant::alphas}) {
        const auto own = std::find_if(test::pmZoo().begin(), test::pmZoo().end(),
                                      [&](const test::PmCage& cage) { return cage.variant == variant; });
        all.push_back({test::pmVariantName(variant), own->cage});
    }
    for (test::NamedCage& own : all) {
        own.cage = test::withAttributes(std::move(own.cage));
    }
    return all;
}

/// The same of fragments. Their tables are long, so that few must do: after one step, and of one cage after two.
template <class Visit>
void forFragments(SchemeId scheme, const std::vector<test::NamedCage>& cages, Visit& visit) {
    Recipe recipe;
    recipe.scheme = scheme;
    recipe.uvMode = cage::UvMode::none;
    const auto give = [&](const cage::Cage& cage, uint32_t rate, const std::string& name) {
        recipe.rate = rate;
        Result<Tables> tables = buildTables(recipe, cage);
        ASSERT_TRUE(tables.ok()) << name << ": " << tables.error().message;
        visit(*tables, test::sourceOf(recipe, cage), name + ", " + test::nameOf(recipe));
    };
    for (const test::NamedCage& own : cages) {
        cage::Cage creased = own.cage;
        creased.creases.push_back({creased.faceVertices[0], creased.faceVertices[1], 1.5f});
        give(creased, 4, own.name);
    }
    give(test::withAttributes(test::cube()), 8, "cube");
}

/// Gives what `visit` is called with: tables, what they were made of, and a name.
template <class Visit>
void forAllTables(Visit&& visit) {
    const std::vector<test::NamedCage> cages = smallCages();
    for (const SchemeId scheme : kSchemes) {
        for (const Recipe& recipe : test::recipesOf(scheme)) {
            for (const test::NamedCage& own : cages) {
                if (Result<Tables> tables = buildTables(recipe, own.cage)) {
                    visit(*tables, test::sourceOf(recipe, own.cage), own.name + (", " + test::nameOf(recipe)));
                }
            }
        }
    }
    for (const SchemeId scheme : {SchemeId::fragments, SchemeId::loopFragments}) {
        forFragments(scheme, cages, visit);
    }
}

TEST(TableWords, WhatLeadsOutOfBoundsIsRefused) {
    std::map<std::string, size_t> refused;
    forAllTables([&](Tables& tables, const TableSource& source, const std::string& name) {
        for (const test::IndexWord& index : test::indexWords(tables, source)) {
            const uint32_t own = tables.words[index.word];
            for (const uint32_t bad : index.bad) {
                tables.words[index.word] = bad;
                const bool passes = checkTables(tables, source).ok();
                ASSERT_FALSE(passes) << name << ", " << index.what << ", word " << index.word << ": " << bad
                                     << " instead of " << own;
                ++refused[index.what];
            }
            tables.words[index.word] = own;
        }
    });
    for (const auto& [what, count] : refused) {
        std::printf("%s: %zu\n", what.c_str(), count);
    }
    EXPECT_EQ(refused.size(), 108u);
}

TEST(TableWords, AllOthersMayBeAnything) {
    std::mt19937 random(5);
    size_t others = 0;
    forAllTables([&](Tables& tables, const TableSource& source, const std::string& name) {
        std::vector<bool> isIndex(tables.words.size(), false);
        for (const test::IndexWord& index : test::indexWords(tables, source)) {
            isIndex[index.word] = true;
        }
        for (size_t word = 0; word < tables.words.size(); ++word) {
            if (!isIndex[word]) {
                tables.words[word] = static_cast<uint32_t>(random());
                ++others;
            }
        }
        const Status status = checkTables(tables, source);
        EXPECT_TRUE(status.ok()) << name << ": " << status.error().message;
    });
    EXPECT_GT(others, 10000u);
}

TEST(TableWords, AnyWordsAreRead) {
    std::mt19937 random(7);
    size_t passed = 0, refused = 0;
    forAllTables([&](Tables& tables, const TableSource& source, const std::string&) {
        for (uint32_t round = 0; round < 20; ++round) {
            std::vector<uint32_t> words = tables.words;
            for (uint32_t change = 0; change <= round % 4; ++change) {
                uint32_t& word = tables.words[random() % tables.words.size()];
                const uint32_t choices[] = {static_cast<uint32_t>(random()), 1u << random() % 32,
                                            word ^ 1u << random() % 32, words[random() % words.size()]};
                word = choices[random() % 4];
            }
            ++(checkTables(tables, source) ? passed : refused);
            tables.words = std::move(words);
        }
    });
    EXPECT_GT(passed, 1000u);
    EXPECT_GT(refused, 1000u);
}

} // namespace
} // namespace supple::surface
